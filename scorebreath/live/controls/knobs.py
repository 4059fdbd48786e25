"""MIDI messages made moves and presses: halves of 14-bit controllers put together, floods thinned, soft takeover."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from scorebreath.live.controls.mapping import Control, Input, Mapping, Source

PATIENCE = 0.02
"""s that the second half of a 14-bit value may take; then the first is taken alone"""
WINDOW = 2 / 127
"""How near a knob must come to take over, of its way."""
FINE, COARSE = 16383, 127
PRESSED = 64
"""Position from which a pedal is down."""
_LSB = 32
_EXACT = 1e-9


@dataclass(frozen=True, slots=True)
class Touch:
    """What one MIDI message says about one input."""

    input: Input
    value: int
    """0..127; 0..16383 of the bend"""


def touch_of(message: Any) -> Touch | None:
    """What a message of mido's says; None: nothing that concerns us."""
    channel = getattr(message, "channel", 0) + 1
    match message.type:
        case "control_change":
            return Touch(("cc", channel, message.control), message.value)
        case "note_on" | "note_off":
            return Touch(("note", channel, message.note), message.velocity if message.type == "note_on" else 0)
        case "aftertouch":
            return Touch(("pressure", channel, 0), message.value)
        case "pitchwheel":
            return Touch(("bend", channel, 0), message.pitch + 8192)
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Move:
    """A control was moved."""

    control: Control
    channel: int
    way: float
    """0..1"""
    raw: int
    """as MIDI counts it"""
    fine: bool
    """whether `raw` goes to 16383"""


@dataclass(slots=True)
class _Halves:
    coarse: int
    until: float | None = None
    """the second half is awaited until then"""


class Reader:
    """Collects what is moved and pressed between two looks: of each control the last move, of each key one press.

    So what it holds is bounded by the mapping, whatever arrives.
    """

    def __init__(self, mapping: Mapping) -> None:
        """Read by a mapping."""
        self._controls = {one: control for control in mapping.controls for one in control.inputs()}
        self._halves: dict[tuple[Control, int], _Halves] = {}
        self._down: dict[tuple[Control, int], bool] = {}
        self._moves: dict[Control, Move] = {}
        self._presses: dict[Control, None] = {}

    def feed(self, touch: Touch, now: float) -> None:
        """Take a message in; `now`: s on a steady clock."""
        control = self._controls.get(touch.input)
        if control is None:
            return
        source, channel, number = touch.input
        if not control.parameter:
            self._press(control, channel, touch.value >= (1 if source == "note" else PRESSED))
        elif source == "bend":
            self._move(control, channel, touch.value, fine=True)
        elif control.source != "cc14":
            self._move(control, channel, touch.value, fine=False)
        elif number == control.number:
            self._halves[control, channel] = _Halves(touch.value, now + PATIENCE)
        elif halves := self._halves.get((control, channel)):
            halves.until = None
            self._move(control, channel, halves.coarse << 7 | touch.value, fine=True)

    def expire(self, now: float) -> None:
        """Take first halves alone whose second did not come in time."""
        for (control, channel), halves in self._halves.items():
            if halves.until is not None and now >= halves.until:
                halves.until = None
                self._move(control, channel, halves.coarse, fine=False)

    def take(self) -> tuple[tuple[Move, ...], tuple[Control, ...]]:
        """What was moved and pressed since the last time."""
        moves, presses = tuple(self._moves.values()), tuple(self._presses)
        self._moves, self._presses = {}, {}
        return moves, presses

    def _move(self, control: Control, channel: int, raw: int, *, fine: bool) -> None:
        self._moves.pop(control, None)
        way = raw / (FINE if fine else COARSE)
        self._moves[control] = Move(control=control, channel=channel, way=way, raw=raw, fine=fine)

    def _press(self, control: Control, channel: int, down: bool) -> None:
        before = self._down.get((control, channel), False)
        self._down[control, channel] = down
        if down and (not before or control.source == "note"):
            self._presses[control] = None


@dataclass(slots=True)
class Grip:
    """Soft takeover: whether a knob has hold of its value."""

    holds: bool = False
    before: float | None = None
    """where the knob was last, 0..1"""

    def meets(self, way: float, current: float) -> bool:
        """Move the knob; whether it has hold of the value from now on.

        It takes hold when it comes near the value, or goes past it: so no value ever jumps farther than `WINDOW`, or
        than the knob itself went.

        >>> grip = Grip()
        >>> [grip.meets(way, 0.5) for way in (0.2, 0.4, 0.6, 0.9)]
        [False, False, True, True]
        """
        past = self.before is not None and (self.before - current) * (way - current) <= 0.0
        self.holds = self.holds or past or abs(way - current) <= WINDOW + _EXACT
        self.before = way
        return self.holds


@dataclass(slots=True, kw_only=True)
class Learner:
    """Waits for the next knob or key, to bind it."""

    parameter: str = ""
    command: str = ""
    body: str = ""
    _first: tuple[int, int, float] | None = None
    """channel, number and end of waiting of a controller that may turn out to have 14 bits"""

    def offer(self, touch: Touch, now: float) -> Control | None:
        """The control to bind, if this message settles it."""
        source, channel, number = touch.input
        if source == "note":
            return self._bound("note", channel, number) if self.command and touch.value else None
        if source != "cc":
            return self._bound(source, channel, 0) if self.parameter else None
        if self.command:
            return self._bound("cc", channel, number) if touch.value >= PRESSED else None
        if self._first and (channel, number) == (self._first[0], self._first[1] + _LSB):
            return self._bound("cc14", channel, number - _LSB)
        if number >= _LSB:
            return self._bound("cc", channel, number)
        if self._first is None or self._first[:2] != (channel, number):
            self._first = (channel, number, now + PATIENCE)
        return None

    def expire(self, now: float) -> Control | None:
        """The control to bind, if no second half came."""
        if self._first is None or now < self._first[2]:
            return None
        return self._bound("cc", *self._first[:2])

    def _bound(self, source: Source, channel: int, number: int) -> Control:
        return Control(
            source=source, channel=channel, number=number,
            parameter=self.parameter, command=self.command, body=self.body,
        )  # fmt: skip
