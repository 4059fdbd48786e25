"""`scorebreath play`: a finished Score or a take, with its curves, under a few keys."""

from __future__ import annotations

import sys
import time
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scorebreath.errors import shortened
from scorebreath_cli.failures import Status, conclude, ending_of
from scorebreath_cli.inputs import load_score, read_source
from scorebreath_cli.performing.opening import figures, open_sender, open_streams
from scorebreath_cli.performing.performing import TURN, Interrupts
from scorebreath_cli.performing.settings import EngineOptions, StreamOptions, seconds_from
from scorebreath_cli.performing.telling import Teller
from scorebreath_cli.performing.transport import Transport
from scorebreath_cli.streams import check_stdout

if TYPE_CHECKING:
    from rich.text import Text

    from scorebreath.curves.curve_set import CurveSet
    from scorebreath.engine.live.server import LiveServer
    from scorebreath.live.picture import Stream
    from scorebreath.live.preview import Saying
    from scorebreath.live.streams.sender import Sender
    from scorebreath.live.viewing import BodyView, Doing, View
    from scorebreath.score.document import Score
    from scorebreath_cli.performing.keys import Keyboard
    from scorebreath_cli.printers import Printer

STEP, STRIDE = 5.0, 30.0
"""s that arrows jump"""
KEYS = "Space pauses   Left and Right 5 s   Up and Down 30 s   L loops   Home   Q quits"
FLOWING = 0.02
"""L/s from which on air is seen to flow"""
ECHO = 0.05
"""s after the last sound before an engine is closed"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wishes:
    """Options of playing, as given."""

    engine: EngineOptions
    streams: StreamOptions
    start: float
    loop: bool
    screen: bool | None
    preview: int | None
    json_lines: bool


class Player:
    """A Score while it is played.

    Args:
        name: Of the Score, for people.
        score: Which.
        transport: Plays it.
        sounder: The engine.
        latency: s from a sound's time to the ear.
    """

    def __init__(self, name: str, score: Score, transport: Transport, sounder: LiveServer, latency: float) -> None:
        """Find what is to be shown, and when."""
        from scorebreath.curves.curve_set import curves
        from scorebreath.live.preview import said_in

        self._name = Path(name).name or name
        self._score, self._transport, self._sounder = score, transport, sounder
        self.latency = latency
        self.curves: Mapping[str, CurveSet] = {body.id: curves(score, body.id) for body in score.bodies}
        self.said: Saying = said_in(score)
        self.streams: list[Stream] = []
        self.sender: Sender | None = None
        self._begin = _beginnings(score)

    def press(self, key: str, interrupts: Interrupts) -> bool:
        """A key; whether it is the last one."""
        transport = self._transport
        at = transport.position
        jumps = {"left": -STEP, "right": STEP, "down": -STRIDE, "up": STRIDE}
        if key == "interrupt":
            interrupts.press()
        elif key == " ":
            (transport.pause if transport.playing else transport.play)()
        elif key in jumps:
            transport.seek(at + jumps[key])
        elif key == "home":
            transport.seek(0.0)
        elif key in ("l", "L"):
            transport.loop = not transport.loop
        return key in ("q", "Q", "escape", "panic", "over")

    def draw(self, width: int, height: int, unicode: bool, troubles: Sequence[str]) -> Sequence[Text]:
        """The screen."""
        from scorebreath_cli.performing.drawing import LUNGS, Shown, draw, progress

        transport = self._transport
        samples = min(LUNGS, max(1, width - 30))
        targets = []
        if self.sender is not None:
            targets = [(s.target.name, c) for s, c in zip(self.streams, self.sender.counts, strict=True)]
        fraction = transport.position / self._score.duration if self._score.duration else 1.0
        return draw(
            Shown(
                view=self._view(samples), counts=None, engine=self._sounder.status(), latency=self.latency,
                targets=targets, troubles=troubles, typing=False, unicode=unicode, keys=KEYS,
                head="scorebreath play", about=f"{'loop  ' if transport.loop else ''}{shortened(self._name, 30)}",
                extra=[progress(fraction, self._score.duration, width, unicode=unicode)],
            ),
            width, height,
        )  # fmt: skip

    def figures(self) -> dict[str, Any]:
        """What engine and streams have counted, for programs."""
        return figures(self._sounder.status(), self.streams, self.sender)

    def _view(self, samples: int) -> View:
        from scorebreath.live.viewing import View

        now = self._transport.position
        following = bisect_right(self._begin, now, key=lambda row: row[0])
        return View(
            time=now, bodies=tuple(self._body(body, now, samples) for body in self.curves),
            coming=tuple(text for _, text in self._begin[following : following + 3]),
            paused=not self._transport.playing, ending=False, over=None,
        )  # fmt: skip

    def _body(self, body: str, now: float, samples: int) -> BodyView:
        from scorebreath.live.viewing import BodyView, lungs_until

        said = self.said(body, now)
        flow = float(self.curves[body].sample([now], ["airflow"])[0, 0])
        doing: Doing = "breathes in" if flow > FLOWING else "breathes out" if flow < -FLOWING else "rests"
        lungs = lungs_until(self.curves[body], now, samples)
        return BodyView(body=body, doing="speaks" if said else doing, said=said, lungs=lungs)


def play(given: str, wishes: Wishes, printer: Printer) -> None:
    """Play a Score or a take.

    Raises:
        typer.Exit: It was interrupted.
        ScorebreathError: Something is wrong, missing or broken.
    """
    from scorebreath.score.files import check_media

    wishes.engine.check()
    wishes.streams.check(json_lines=wishes.json_lines)
    if wishes.streams.to_stdout:
        check_stdout()
    score, media = load_score(read_source(given))
    check_media(score, media)
    seconds_from("--start", wishes.start, score.duration)
    _check_bodies(wishes.streams.targets, [body.id for body in score.bodies])
    teller = Teller(printer, json_lines=wishes.json_lines)
    status = Status.DONE
    ended: dict[str, Any] = {}
    try:
        with ExitStack() as stack:
            sounder = wishes.engine.open(journal=None, on_trouble=teller.engine)
            stack.callback(sounder.close)
            transport = Transport(score, media, sounder, start=wishes.start, loop=wishes.loop)
            player = Player(given, score, transport, sounder, wishes.engine.latency(sounder))
            _open_streams(player, wishes, stack, transport, teller)
            stack.callback(transport.pause)
            stack.callback(lambda: ended.update(_counted(player, transport)))
            _begun(player, score, sounder, teller)
            if _played(player, transport, wishes, teller):
                status = Status.INTERRUPTED
            if transport.over:
                time.sleep(player.latency + ECHO)
    except (KeyboardInterrupt, SystemExit) as error:
        status = ending_of(error) or Status.BUG
    finally:
        teller.drain()
        if wishes.json_lines and ended:
            printer.item("ended", ended, "")
    conclude(printer, status)


def _counted(player: Player, transport: Transport) -> dict[str, Any]:
    played = {"seconds": round(transport.position, 3), "complete": transport.over}
    return played | player.figures()


def _open_streams(
    player: Player, wishes: Wishes, stack: ExitStack, transport: Transport, teller: Teller
) -> None:  # fmt: skip
    player.streams = open_streams(wishes.streams)
    if wishes.preview is not None:
        from scorebreath.live.preview import open_preview

        _, stream = open_preview(wishes.preview, said=player.said)
        player.streams.append(stream)
        teller.note(f"preview: {stream.target.name}")
    if not player.streams:
        return
    player.sender = open_sender(
        player.streams, stack, curves=lambda: player.curves, clock=lambda: transport.position,
        start=lambda: time.time() - transport.position, rate=wishes.streams.check(json_lines=wishes.json_lines),
        lead=wishes.streams.lead, latency=player.latency, teller=teller,
    )  # fmt: skip
    player.sender.start()


def _check_bodies(targets: Sequence[str], bodies: Sequence[str]) -> None:
    """Refuse curves of somebody who is not there: in a finished Score, nobody joins."""
    from scorebreath.errors import InputError, did_you_mean
    from scorebreath.live.picture import EVERYBODY
    from scorebreath.live.streams.addresses import parse

    for text in targets:
        target = parse(text)
        if target.body not in ("", EVERYBODY, *bodies):
            there = ", ".join(bodies) or "none"
            said = f"target {target.text!r}: no body is called {shortened(target.body, 40)!r}; expected {there}"
            raise InputError(said + did_you_mean(target.body, bodies))


def _begun(player: Player, score: Score, sounder: LiveServer, teller: Teller) -> None:
    status = sounder.status()
    names = [stream.target.name for stream in player.streams]
    said = f"{score.duration:.1f} s; {status.engine} at {status.sample_rate} Hz"
    said += "".join(f"; curves to {name}" for name in names)
    teller.tell(
        "started", said, engine=status.engine, sample_rate=status.sample_rate, duration=score.duration,
        latency=player.latency, curves=names,
    )  # fmt: skip


def _played(player: Player, transport: Transport, wishes: Wishes, teller: Teller) -> bool:
    """Until it is over or somebody quits; whether it was interrupted."""
    from scorebreath_cli.performing.screen import Screen, can_draw

    drawn = wishes.screen is not False and not wishes.json_lines and can_draw()
    drawn = drawn and not (wishes.streams.to_stdout and sys.stdout.isatty())
    keyboard = _keyboard(wishes)

    def draw(width: int, height: int, unicode: bool) -> Sequence[Text]:
        return player.draw(width, height, unicode, [message.text for message in teller.shown.copy()])

    with ExitStack() as stack:
        interrupts = stack.enter_context(Interrupts())
        screen = stack.enter_context(Screen(draw)) if drawn else None
        teller.screen = screen is not None
        stack.callback(setattr, teller, "screen", False)
        if keyboard is not None:
            stack.enter_context(keyboard)
        transport.play()
        while not transport.over and not interrupts.count:
            if keyboard is None:
                time.sleep(TURN)
            keys = keyboard.read(TURN) if keyboard is not None else []
            quits = [player.press(key, interrupts) for key in keys]
            if any(quits):
                break
            transport.look()
            teller.drain()
            if screen is not None:
                screen.refresh(now=bool(keys))
        return interrupts.count > 0


def _keyboard(wishes: Wishes) -> Keyboard | None:
    from scorebreath_cli.performing.keys import open_keyboard

    return None if wishes.json_lines else open_keyboard(stdin=True, raw=True)


def _beginnings(score: Score) -> list[tuple[float, str]]:
    """When each group begins to be said, s, and its text; in order of time."""
    from scorebreath.score.spoken import spoken_groups

    spoken = spoken_groups(score)
    found = ((spoken[group.id], group.text) for group in score.groups if group.id in spoken)
    return sorted((said.utterances[0].onset, text) for said, text in found if said.utterances)
