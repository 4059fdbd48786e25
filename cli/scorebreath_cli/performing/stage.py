"""The stage of a live performance: engine, show, streams of curves and controls, opened and closed together."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

from scorebreath.errors import EnvironmentFailure
from scorebreath_cli.performing.opening import figures, open_sender, open_streams
from scorebreath_cli.performing.settings import OWN_PORT, ControlOptions, EngineOptions, StreamOptions
from scorebreath_cli.performing.telling import Teller
from scorebreath_cli.performing.typed import shown

if TYPE_CHECKING:
    from scorebreath.curves.curve_set import CurveSet
    from scorebreath.engine.live.journal import Entry, JournalFile
    from scorebreath.engine.live.server import LiveServer
    from scorebreath.live.controls.midi import MidiServer
    from scorebreath.live.controls.midi_control import MidiControl
    from scorebreath.live.controls.osc_server import OscServer
    from scorebreath.live.desk import Setting
    from scorebreath.live.picture import Stream
    from scorebreath.live.preview import Saying
    from scorebreath.live.show import Setting as ShowSetting
    from scorebreath.live.show import Show
    from scorebreath.live.streams.sender import Sender
    from scorebreath.live.viewing import Said
    from scorebreath.speech.model import Voice

JOURNAL = "journal.jsonl"
"""What the engine was told and when, in a take's folder."""
MOVES, REMEMBERED = 6, 60
"""Moves that are shown, and that are remembered."""
ECHO = 0.05
"""s after the last sound before an engine is closed"""


@dataclasses.dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """What is to be opened; checked."""

    setting: ShowSetting
    engine: EngineOptions
    streams: StreamOptions
    controls: ControlOptions
    preview: int | None = None
    """port of the moving figure; None: none"""
    json_lines: bool = False


class Stage:
    """Everything that a live performance needs; a context manager that opens and closes it.

    Args:
        plan: What.
        open_voice: Opens voices; the show closes them.
        teller: Told what happens.
    """

    def __init__(self, plan: Plan, open_voice: Callable[[str, str], Voice], teller: Teller) -> None:
        """Nothing is open yet."""
        self._plan, self._open_voice, self._teller = plan, open_voice, teller
        self._stack = ExitStack()
        self.show: Show
        self.sounder: LiveServer
        self.streams: list[Stream] = []
        self.latency = 0.0
        """s from a sound's time to the ear"""
        self._moved: dict[tuple[str, str], str] = {}
        self._sender: Sender | None = None
        self._midi: MidiServer | None = None
        self.drawn = False
        """whether messages went to a screen"""
        self.ended: dict[str, Any] = {}
        """what was counted, for programs, once it is over"""
        self.page = ""
        """address of the preview, if there is one"""

    def __enter__(self) -> Self:
        """Open everything.

        Raises:
            InputError: A name is wrong.
            EnvironmentFailure: Something is not there, or is taken.
        """
        with self._stack:
            self._open()
            self._stack = self._stack.pop_all()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """Close everything; after a performance that has come to its end, when that has been heard."""
        seconds = round(max(0.0, self.show.now), 3)
        if kind is None:
            time.sleep(self.latency + ECHO)
        if self._sender is not None:
            self._sender.stop()
        self.ended = self._summary(seconds)
        self._stack.close()

    @property
    def midi(self) -> MidiControl | None:
        """For learning, where there is MIDI."""
        return self._midi.control if self._midi is not None else None

    @property
    def moved(self) -> list[tuple[str, str, str]]:
        """Bodies, parameter and value of what was moved lately, the latest first."""
        found: dict[tuple[str, str], list[str]] = {}
        for (body, name), value in reversed(self._moved.copy().items()):
            found.setdefault((name, value), []).append(body)
        return [(",".join(sorted(bodies)), name, value) for (name, value), bodies in found.items()][:MOVES]

    def targets(self) -> list[tuple[str, Any]]:
        """Streams, and what became of their pictures."""
        if self._sender is None:
            return []
        return [(s.target.name, count) for s, count in zip(self.streams, self._sender.counts, strict=True)]

    def _summary(self, seconds: float) -> dict[str, Any]:
        for name, count in self.targets():
            if not (count.sent or count.failed or count.skipped):
                self._teller.note(f"{name}: got no picture; there were {', '.join(self.show.desk.bodies)}")
        counts = dataclasses.asdict(self.show.counts)
        return {"seconds": seconds, **counts} | figures(self.sounder.status(), self.streams, self._sender)

    def _open(self) -> None:
        from scorebreath.live.conditions import Timing
        from scorebreath.live.show import Show

        plan, teller = self._plan, self._teller
        timing = Timing(lookahead=plan.engine.lookahead or Timing().lookahead, curve_lead=plan.streams.lead)
        journal = None
        if plan.setting.take is not None:
            journal = _Journal(plan.setting.take / JOURNAL, teller)
            self._stack.callback(journal.close)
        self.sounder = plan.engine.open(journal=journal, on_trouble=teller.engine)
        self._stack.callback(self.sounder.close)
        self.latency = plan.engine.latency(self.sounder)
        self.streams = open_streams(plan.streams)
        if plan.preview is not None:
            self._open_preview(plan.preview)
        if self.streams:
            rate = plan.streams.check(json_lines=plan.json_lines)
            self._sender = open_sender(
                self.streams, self._stack, curves=self._curves, clock=lambda: self.show.now,
                start=lambda: self.show.start_unix, rate=rate, lead=plan.streams.lead, latency=self.latency,
                teller=teller,
            )  # fmt: skip
        self.show = Show(
            plan.setting, sounder=self.sounder, timing=timing, tell=teller.warned, open_voice=self._open_voice
        )
        self._stack.callback(self.show.close)
        self._stack.callback(self.show.desk.listen(self._changed))
        if self._sender is not None:
            self._sender.start()
        osc = self._open_osc()
        self._open_midi()
        self._begun(osc)

    def _curves(self) -> Mapping[str, CurveSet]:
        return self.show.curves()

    def _open_preview(self, port: int) -> None:
        from scorebreath.live.preview import open_preview, said_by

        made: list[Saying] = []

        def said(body: str, time: float) -> Said | None:
            if not made:  # pictures are asked for only when the show has begun
                made.append(said_by(self.show.ledger))
            return made[0](body, time)

        _, stream = open_preview(port, said=said)
        self.streams.append(stream)
        self.page = stream.target.name

    def _open_osc(self) -> OscServer | None:
        wanted = self._plan.controls.osc_endpoint()
        if wanted is None:
            return None
        from scorebreath.live.controls.osc_server import OscServer

        server = OscServer(self.show.desk, host=wanted[0], port=wanted[1])
        try:
            server.start()
        except EnvironmentFailure as error:
            if self._plan.controls.osc is not None:
                raise
            self._teller.note(f"{error}; going on without OSC, --osc PORT listens at another port")
            return None
        self._stack.callback(server.stop)
        return server

    def _open_midi(self) -> None:
        controls = self._plan.controls
        if controls.midi is None:
            return
        from scorebreath.live.controls.midi import MidiServer

        server = MidiServer(
            self.show.desk, port="" if controls.midi == OWN_PORT else controls.midi, output=controls.midi_out or "",
            mapping=controls.mapping(), api=controls.midi_api or "", said=self._teller.note,
            learned=lambda control: self._teller.note(f"learned: {control}"),
        )  # fmt: skip
        server.start()
        self._stack.callback(server.stop)
        self._midi = server

    def _changed(self, body: str, name: str, value: Setting) -> None:
        self._moved.pop((body, name), None)
        self._moved[body, name] = shown(value)
        while len(self._moved) > REMEMBERED:
            del self._moved[next(iter(self._moved))]

    def _begun(self, osc: OscServer | None) -> None:
        plan, status = self._plan, self.sounder.status()
        where = f"{plan.controls.osc_endpoint()[0]}:{osc.port}" if osc is not None else ""  # type: ignore[index]
        names = [stream.target.name for stream in self.streams if stream.target.name != self.page]
        take = str(plan.setting.take) if plan.setting.take else ""
        parts = [
            f"{status.engine} at {status.sample_rate} Hz",
            f"OSC at {where}" if where else "",
            f"MIDI: {', '.join(self._midi.ports)}" if self._midi else "",
            *(f"curves to {name}" for name in names),
            f"take: {take}" if take else "",
        ]
        self._teller.tell(
            "started", "; ".join(filter(None, parts)), engine=status.engine, sample_rate=status.sample_rate,
            voice=plan.setting.voice, start_unix=self.show.start_unix, latency=self.latency, osc=where,
            midi=list(self._midi.ports) if self._midi else [], take=take, preview=self.page,
            curves=names,
        )  # fmt: skip
        if self.page:
            self._teller.note(f"preview: {self.page}")


class _Journal:
    """A journal in a folder that is made later than the engine; a full disk costs the journal, not the sound."""

    def __init__(self, path: Path, teller: Teller) -> None:
        self._path, self._teller = path, teller
        self._file: JournalFile | None = None
        self._broken = False

    def __call__(self, entry: Entry) -> None:
        """Write an entry."""
        if self._broken:
            return
        from scorebreath.engine.live.journal import JournalFile

        try:
            if self._file is None:
                self._file = JournalFile(self._path)
            self._file(entry)
        except (EnvironmentFailure, OSError) as error:
            self._broken = True
            self._teller.tell("trouble", f"no more journal: {error}", source="journal", text=str(error))

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            try:
                self._file.close()
            except OSError as error:
                self._teller.tell("trouble", f"the journal is cut off: {error}", source="journal", text=str(error))
