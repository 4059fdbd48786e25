"""`--preview`: the figure of preview.html, moved by the pictures of a performance while it goes on, in any browser.

One server holds the page and sends the pictures: lines of JSON as over any WebSocket, and in each the breath group that
is being said, where that is known.
"""

from __future__ import annotations

import html
import json
from bisect import bisect_right
from collections.abc import Callable, Mapping
from importlib.resources import files
from types import MappingProxyType

from scorebreath.live.ledger import Ledger
from scorebreath.live.picture import Picture, Stream
from scorebreath.live.streams.websocket import PictureServer, Route, WebSocketTarget
from scorebreath.live.viewing import Said, said_at
from scorebreath.report import figure
from scorebreath.score.cutting import end_of, endings, never
from scorebreath.score.document import Group, Score
from scorebreath.score.events import Utterance

TITLE = "scorebreath live"
SCRIPTS = ("moments.js", "connection.js", "strip.js", "preview.js")
"""In the order in which they build on each other."""
Saying = Callable[[str, float], Said | None]
"""What a body says at a time, s of the performance; None where it says nothing."""


def preview_routes(title: str = TITLE) -> Mapping[str, Route]:
    """The page's files, for a `PictureServer`: they ask nothing of any other server, and take text for text alone.

    Args:
        title: What stands above the figures.
    """
    channels = f"const CHANNELS = {json.dumps(figure.CHANNELS)};\n"
    page = figure.filled(_static("preview.html"), {"title": html.escape(title), "figure": figure.drawing()})
    style = figure.style() + _static("preview.css")
    script = channels + figure.script() + "".join(map(_static, SCRIPTS))
    return MappingProxyType(
        {
            "/": ("text/html; charset=utf-8", "".join(page).encode("utf-8", "replace")),
            "/preview.css": ("text/css; charset=utf-8", style.encode()),
            "/preview.js": ("text/javascript; charset=utf-8", script.encode()),
        }
    )


def open_preview(
    port: int = 0, host: str = "127.0.0.1", *, title: str = TITLE, said: Saying | None = None
) -> tuple[PictureServer, Stream]:
    """Serve the page from now on.

    Args:
        port: Where; 0: wherever there is room, as `PictureServer.port` says.
        host: Address to listen at.
        title: What stands above the figures.
        said: What is being said, such as `said_by(ledger)`; None: the page shows no words.

    Returns:
        The server, and the stream that is to be among a sender's; its target's name is the page's address, and closing
        the target, as the sender does at its end, closes the server.

    Raises:
        MissingExtraError: starlette, uvicorn or websockets are not installed.
        EnvironmentFailure: The port is taken.
        InputError: The host is not known.
    """
    server = PictureServer(host, port, routes=preview_routes(title))
    address = f"http://{f'[{host}]' if ':' in host else host}:{server.port}/"

    def more(picture: Picture) -> Mapping[str, object]:
        now = said(picture.body, picture.time) if said else None
        return {"said": {"text": now.text, "word": now.word}} if now else {}

    return server, Stream(target=WebSocketTarget(address, server, more=more))


def said_by(ledger: Ledger) -> Saying:
    """What is being said, of a performance that goes on."""
    groups: dict[str, tuple[str, Group | None]] = {}

    def said(body: str, time: float) -> Said | None:
        near = ledger.near(body)
        ends = endings(near)
        spoken = (e for e in near if isinstance(e, Utterance) and e.onset <= time < end_of(e, ends))
        utterance = next(spoken, None)
        if utterance is None:
            return None
        if groups.get(body, ("", None))[0] != utterance.id:
            part = ledger.part(body, [utterance])
            groups[body] = utterance.id, next((each for each in part.groups if each.id == utterance.group), None)
        return said_at(utterance, groups[body][1], time)

    return said


def said_in(score: Score) -> Saying:
    """What is said, of a Score that is complete."""
    groups = {group.id: group for group in score.groups}
    ends = endings(score.events)
    spoken: dict[str, list[Utterance]] = {}
    for event in sorted(score.events, key=lambda event: event.onset):
        if isinstance(event, Utterance) and not never(event, ends):
            spoken.setdefault(event.body, []).append(event)

    def said(body: str, time: float) -> Said | None:
        utterances = spoken.get(body, [])
        place = bisect_right(utterances, time, key=lambda event: event.onset) - 1
        if place < 0 or time >= end_of(utterances[place], ends):
            return None
        return said_at(utterances[place], groups.get(utterances[place].group or ""), time)

    return said


def _static(name: str) -> str:
    return (files("scorebreath.live") / "static" / name).read_text(encoding="utf-8")
