"""The rehearsal screen as lines of text: what there is to see, on so many columns and rows. It knows no terminal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING

from rich.console import Console
from rich.text import Text

from scorebreath_cli.printers import printable

if TYPE_CHECKING:
    from scorebreath.engine.live.status import Status
    from scorebreath.live.conditions import Counts
    from scorebreath.live.streams.sender import Count
    from scorebreath.live.viewing import BodyView, Said, View

BARS = " \N{LOWER ONE EIGHTH BLOCK}\N{LOWER ONE QUARTER BLOCK}\N{LOWER THREE EIGHTHS BLOCK}\N{LOWER HALF BLOCK}" \
    "\N{LOWER FIVE EIGHTHS BLOCK}\N{LOWER THREE QUARTERS BLOCK}\N{LOWER SEVEN EIGHTHS BLOCK}\N{FULL BLOCK}"  # fmt: skip
PLAIN_BARS = " .:-=+*#@"
LUNGS = 40
"""Columns of the lungs' last seconds."""
NEXT = 3
"""Groups that are shown before they are said."""
SPOKEN_ROWS, TROUBLES, ANSWER_ROWS = 3, 6, 3
WIDE, USAGE = 60, 25
"""Columns from which on commands stand beside what they do, and those they get."""
KEYS = "Enter says the line   /help   Esc or Ctrl-X panic   Ctrl-D end   Ctrl-C stop"
WATCHING = "Esc or Ctrl-X panic   Ctrl-D end   Ctrl-C stop"
"""What keys do, with a line to type into and without."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """Everything that is to be seen."""

    view: View
    counts: Counts | None
    """None: of what is played, nothing is counted"""
    engine: Status
    latency: float
    """s from a sound's time to the ear"""
    targets: Sequence[tuple[str, Count]] = ()
    moved: Sequence[tuple[str, str, str]] = ()
    """bodies, parameter, value; the latest first"""
    troubles: Sequence[str] = ()
    """the latest last"""
    line: str = ""
    cursor: int = 0
    prompt: str = "> "
    hints: Sequence[str] = ()
    answer: str = ""
    """to what was typed last"""
    wrong: bool = False
    """whether the answer is a refusal"""
    help: Sequence[tuple[str, str]] = ()
    """commands to be listed instead of all else"""
    page: int = 1
    """of the help"""
    typing: bool = True
    """whether there is a line to type into"""
    unicode: bool = True
    head: str = "scorebreath live"
    about: str = ""
    """what else the first row says"""
    keys: str = KEYS
    extra: Sequence[Text] = ()
    """rows below the first"""


def draw(shown: Shown, width: int, height: int) -> list[Text]:
    """Exactly `height` rows, none wider than `width`; the line that is typed is the last."""
    foot = _foot(shown, width)
    room = max(1, height - len(foot))
    body = help_pages(shown.help, width, height)[shown.page - 1] if shown.help else _body(shown, width, room)
    rows = [*body[:room], *(Text() for _ in range(room - len(body))), *foot][-height:]
    for row in rows:
        row.no_wrap = True
        row.truncate(width, overflow="crop")
    return rows


def _body(shown: Shown, width: int, room: int) -> list[Text]:
    view = shown.view
    rows = [_head(shown, width), *shown.extra]
    for body in view.bodies:
        rows += _said(body, width, several=len(view.bodies) > 1)
    rows += [_row("next" if not place else "", text, width) for place, text in enumerate(view.coming[:NEXT])]
    if not view.coming:
        rows.append(_row("next", "", width))
    rows += [_lungs(body, shown) for body in view.bodies]
    rows += [*([_groups(shown.counts)] if shown.counts else []), _engine(shown)]
    if shown.moved:
        several = len(view.bodies) > 1
        said = ", ".join(f"{who + ' ' if several else ''}{name} {value}" for who, name, value in shown.moved)
        rows.append(_row("moved", said, width))
    for place, (name, count) in enumerate(shown.targets):
        lost = f", {count.skipped} skipped, {count.failed} failed" if count.skipped or count.failed else ""
        rows.append(_row("curves" if not place else "", f"{name}: {count.sent} sent{lost}", width))
    return [*rows, *_troubles(shown.troubles, width, max(0, min(TROUBLES, room - len(rows))))]


def _troubles(texts: Sequence[str], width: int, room: int) -> list[Text]:
    """The latest messages, as many as there is room for; each whole."""
    rows: list[Text] = []
    for text in reversed(texts):
        wrapped = _wrapped(text, width - 9)
        if rows and len(rows) + len(wrapped) > room:
            break
        rows[:0] = [Text.assemble(" " * 9, (line, "yellow")) for line in wrapped]
    if rows:
        rows[0] = Text.assemble((f" {'said':<7} ", "dim"), rows[0][9:])
    return rows[:room]


def _wrapped(text: str, width: int) -> list[str]:
    """A message in lines of so many columns."""
    flat = Text(" ".join(_flat(text).split()))
    return [line.plain.rstrip() for line in flat.wrap(_console(), max(10, width))] or [""]


def _head(shown: Shown, width: int) -> Text:
    view = shown.view
    doing = "over" if view.over is not None and view.time > view.over else "ending" if view.ending else ""
    doing = doing or ("paused" if view.paused else "")
    left = "  ".join(filter(None, (f" {shown.head}", clock(view.time), doing, _flat(shown.about))))
    state = "alive" if shown.engine.alive else "AWAY"
    right = f"{shown.engine.engine}, {shown.engine.sample_rate} Hz, {state} "
    gap = max(1, width - len(left) - len(right))
    return Text(f"{left}{' ' * gap}{right}", style="reverse" if shown.engine.alive else "reverse red")


def _said(body: BodyView, width: int, *, several: bool) -> list[Text]:
    label = body.body if several else "now"
    if body.said is None:
        return [_row(label, f"({body.doing})", width, style="dim")]
    text = highlighted(body.said)
    wrapped = list(text.wrap(_console(), max(10, width - 9), no_wrap=False))
    rows = []
    for place, part in enumerate(wrapped[:SPOKEN_ROWS]):
        part.rstrip()
        rows.append(Text.assemble((f" {label if not place else '':<7} ", "dim"), part))
    return rows


def highlighted(said: Said) -> Text:
    """A group on one line, the word that sounds now marked; what a terminal would obey becomes its code."""
    start, end = said.word or (0, 0)
    parts = (_flat(said.text[:start]), _flat(said.text[start:end]), _flat(said.text[end:]))
    return Text.assemble(parts[0].lstrip(), (parts[1], "bold reverse"), parts[2].rstrip())


def _flat(text: str) -> str:
    return printable(text.translate({10: " ", 13: " ", 9: " "}))


def _lungs(body: BodyView, shown: Shown) -> Text:
    bars = BARS if shown.unicode else PLAIN_BARS
    line = "".join(bars[min(len(bars) - 1, max(0, int(value * len(bars))))] for value in body.lungs)
    level = body.lungs[-1] if body.lungs else 0.0
    label = body.body if len(shown.view.bodies) > 1 else "lungs"
    return Text.assemble((f" {label:<7} ", "dim"), (line, "cyan"), f" {level:4.2f}  {body.doing}")


def _groups(counts: Counts) -> Text:
    said = f"{counts.groups} said"
    late = f"{counts.late} late" + (f" (by up to {counts.latest:.3f} s)" if counts.late else "")
    bad = [f"{counts.unspoken} not spoken"] * bool(counts.unspoken) + [f"{counts.stalls} stalls"] * bool(counts.stalls)
    style = "bold red" if counts.late or bad else ""
    more = f", {counts.cuts} cut{'s' * (counts.cuts != 1)}"
    return Text.assemble((f" {'groups':<7} ", "dim"), said, ", ", (", ".join([late, *bad]), style), more)


def _engine(shown: Shown) -> Text:
    engine = shown.engine
    lead = f", lead {1000 * engine.lead_min:.0f} ms" if isfinite(engine.lead_min) else ""
    late = engine.late + engine.late_sent
    told = f"{engine.sent} bundles{lead}, "
    bad = f"{late} late, {engine.lost} lost, {engine.restarts} restarts"
    style = "bold red" if late or engine.lost or engine.restarts else ""
    return Text.assemble(
        (f" {'engine':<7} ", "dim"), told, (bad, style), f", latency {1000 * shown.latency:.0f} ms"
    )  # fmt: skip


def help_pages(rows: Iterable[tuple[str, str]], width: int, height: int) -> list[list[Text]]:
    """All commands, as many on a page as there is room for."""
    room = max(1, height - 2)
    pages: list[list[Text]] = [[]]
    for usage, about in rows:
        if width < WIDE:
            lines = [Text(f" {usage}", "bold"), *(Text(f"   {line}") for line in _wrapped(about, width - 3))]
        else:
            first, *others = _wrapped(about, width - USAGE - 2)
            lines = [Text.assemble((f" {usage:<{USAGE}} ", "bold"), first)]
            lines += [Text(" " * (USAGE + 2) + line) for line in others]
        if pages[-1] and len(pages[-1]) + len(lines) > room:
            pages.append([])
        while len(lines) > room:
            pages[-1:] = [lines[:room], []]
            lines = lines[room:]
        pages[-1] += lines
    return pages


def _foot(shown: Shown, width: int) -> list[Text]:
    if not shown.typing:
        return [Text(f" {shown.keys}", style="dim")]
    hint = [Text(f" {shown.keys}", style="dim")]
    if shown.hints:
        hint = [Text(" " + "  ".join(shown.hints), style="cyan")]
    elif shown.answer:
        style = "bold red" if shown.wrong else "green"
        hint = [Text(f" {line}", style=style) for line in _wrapped(shown.answer, width - 2)[:ANSWER_ROWS]]
    elif shown.help:
        hint = [Text(" /help shows more, Enter goes back", style="dim")]
    before, under, behind = (
        _flat(part)
        for part in (shown.line[: shown.cursor], shown.line[shown.cursor : shown.cursor + 1],
                     shown.line[shown.cursor + 1 :])
    )  # fmt: skip
    typed = Text.assemble((shown.prompt, "bold"), before, (under or " ", "reverse"), behind)
    beyond = Text.assemble((shown.prompt, "bold"), before).cell_len + 2 - width
    if beyond > 0:  # the cursor stays to be seen
        typed = Text.assemble((shown.prompt, "bold"), before[beyond:], (under or " ", "reverse"), behind)
    return [*hint, typed]


def _row(label: str, text: str, width: int, *, style: str = "") -> Text:
    row = Text.assemble((f" {label:<7} ", "dim"), (" ".join(_flat(text).split()), style))
    row.truncate(width, overflow="ellipsis")
    return row


def progress(fraction: float, duration: float, width: int, *, unicode: bool) -> Text:
    """How much of a whole has passed; `duration`: of the whole, s."""
    end = f" {clock(duration)}"
    room = max(1, width - 10 - len(end))
    done = min(room, max(0, round(fraction * room)))
    full, empty = ("\N{BOX DRAWINGS HEAVY HORIZONTAL}", "\N{BOX DRAWINGS LIGHT HORIZONTAL}") if unicode else ("#", "-")
    return Text.assemble(" " * 9, (full * done, "cyan"), (empty * (room - done), "dim"), end)


def clock(seconds: float) -> str:
    """Minutes and seconds.

    >>> clock(75.24), clock(-0.3), clock(3725.0)
    ('1:15', '-0:00', '1:02:05')
    """
    whole = int(abs(seconds))
    hours, minutes, rest = whole // 3600, whole // 60 % 60, whole % 60
    sign = "-" if seconds < 0 else ""
    return sign + (f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}")


def _console() -> Console:
    """Wrapping asks one for its ways with words, whatever its size."""
    return Console(width=200)
