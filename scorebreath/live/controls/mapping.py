"""Which knob, key or pedal of a MIDI controller does what: values, their checks, and the default."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from scorebreath.errors import InputError, did_you_mean
from scorebreath.live.controls.scaling import CURVES, Scale, scale_of
from scorebreath.live.desk import COMMANDS
from scorebreath.parameters.table import Parameters

Source = Literal["cc", "cc14", "note", "pressure", "bend"]
SOURCES: dict[Source, int | None] = {"cc": 127, "cc14": 31, "note": 127, "pressure": None, "bend": None}
"""What can be moved or pressed, and the highest of its numbers; None: a channel has only one."""
CHANNELS = range(1, 17)
FIRST_NOTE = 36
"""of the default's commands: the lowest pad of most drum pads"""
MOST_CONTROLS = 2048
LONGEST_TEXT = 2000
_LSB = 32

Input = tuple[Source, int, int]
"""Kind, channel and number of what a message can move; a 14-bit controller takes two."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Control:
    """One knob, fader, pedal or key, and what it does: exactly one of `parameter`, `command` and `say`."""

    source: Source
    number: int = 0
    """of the controller or key, 0..127 (14 bit: of its first half, 0..31)"""
    channel: int = 0
    """1..16; 0: any"""
    parameter: str = ""
    command: str = ""
    say: str = ""
    low: float | None = None
    """value at the beginning of its way; None: the parameter's lowest"""
    high: float | None = None
    """value at the end; lower than `low` turns it round"""
    curve: str = "linear"
    takeover: bool = True
    """whether it does nothing until it has met the value"""
    body: str = ""
    """id; empty: everybody"""

    def __post_init__(self) -> None:
        """Check it.

        Raises:
            InputError: Names what is wrong and what is expected.
        """
        _check_source(self)
        _check_target(self)

    @property
    def continuous(self) -> bool:
        """Whether it has positions, not only presses."""
        return self.source != "note"

    @property
    def scale(self) -> Scale:
        """From its way to the parameter's values."""
        return scale_of(self.parameter, self.low, self.high, self.curve)

    @property
    def target(self) -> tuple[str, str, str]:
        """What it moves or does."""
        return (self.parameter, self.command, self.say)

    def inputs(self) -> Iterator[Input]:
        """Everything it takes for itself."""
        for channel in (self.channel,) if self.channel else CHANNELS:
            if self.source == "cc14":
                yield ("cc", channel, self.number)
                yield ("cc", channel, self.number + _LSB)
            else:
                yield (self.source, channel, self.number)

    def __str__(self) -> str:
        """As people call it."""
        number = "" if SOURCES[self.source] is None else f" {self.number}"
        return f"{self.source}{number} on {f'channel {self.channel}' if self.channel else 'any channel'}"


@dataclass(frozen=True, slots=True)
class Mapping:
    """Controls that do not get in each other's way."""

    controls: tuple[Control, ...] = ()

    def __post_init__(self) -> None:
        """Check that no two take the same input.

        Raises:
            InputError: Two do, or there are too many.
        """
        if len(self.controls) > MOST_CONTROLS:
            raise InputError(f"{len(self.controls)} controls, expected {MOST_CONTROLS} at most")
        taken: dict[Input, int] = {}
        for place, control in enumerate(self.controls, 1):
            for one in control.inputs():
                if one in taken:
                    other = self.controls[taken[one] - 1]
                    raise InputError(f"control {place}: {control} is in use already, by control {taken[one]}: {other}")
                taken[one] = place

    def learned(self, control: Control) -> Mapping:
        """A copy with a control that takes the place of those with the same inputs, or the same target and body."""
        wanted = set(control.inputs())
        kept = (
            other
            for other in self.controls
            if not wanted & set(other.inputs()) and (other.target, other.body) != (control.target, control.body)
        )
        return Mapping((*kept, control))


def default_mapping() -> Mapping:
    """The parameters' own controllers on any channel, 14 bit where MIDI has it, and a key for every command."""
    return Mapping((*_knobs(), *_keys()))


def _knobs() -> Iterable[Control]:
    for name, field in Parameters.model_fields.items():
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        number = extra.get("midi_cc")
        if isinstance(number, int):
            yield Control(source="cc14" if number < _LSB else "cc", number=number, parameter=name)


def _keys() -> Iterable[Control]:
    for place, name in enumerate(COMMANDS):
        yield Control(source="note", number=FIRST_NOTE + place, command=name)


def _check_source(control: Control) -> None:
    if control.source not in SOURCES:
        raise InputError(f"source={control.source!r}, expected one of {', '.join(SOURCES)}")
    highest = SOURCES[control.source] or 0
    if not 0 <= control.number <= highest:
        raise InputError(f"{control.source}={control.number} must be a number in [0, {highest}]")
    if not 0 <= control.channel <= 16:
        raise InputError(f"channel={control.channel} must be a number in [1, 16]; without one, any channel")


def _check_target(control: Control) -> None:
    if sum(map(bool, control.target)) != 1:
        raise InputError("expected exactly one of parameter, command and say")
    if control.parameter:
        if control.parameter not in Parameters.model_fields:
            hint = did_you_mean(control.parameter[:40], Parameters.model_fields)
            raise InputError(f"no parameter is called {control.parameter!r}{hint}")
        if control.source == "note":
            raise InputError("a note moves no parameter, expected command or say")
        if control.curve not in CURVES:
            raise InputError(f"curve={control.curve!r}, expected one of {', '.join(CURVES)}")
        scale_of(control.parameter, control.low, control.high, control.curve)
        return
    if control.command and control.command not in COMMANDS:
        raise InputError(f"no command is called {control.command!r}{did_you_mean(control.command[:40], COMMANDS)}")
    if len(control.say) > LONGEST_TEXT:
        raise InputError(f"say: {len(control.say)} characters, expected {LONGEST_TEXT} at most")
    if control.source in ("pressure", "bend"):
        raise InputError(f"{control.source} only moves parameters; expected a note or cc for a command or a text")
    if control.low is not None or control.high is not None or control.curve != "linear" or not control.takeover:
        raise InputError("low, high, curve and takeover are for parameters")
