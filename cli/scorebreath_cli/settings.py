"""From options as given to values: parameters, frame rates; and which options belong to compiling."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, cast

from scorebreath.errors import InputError, did_you_mean, shortened

if TYPE_CHECKING:
    from fractions import Fraction

    from scorebreath.parameters.table import Parameters
    from scorebreath.script.markup.marked import Markup

DEFAULT_VOICE = "espeak"
DEFAULT_MODEL = "natural"
DEFAULT_LANGUAGE = "en"
DEFAULT_ENGINE = "embedded"
MARKUPS = ("auto", "tags", "ssml", "maryxml", "none")
LEAD, TAIL = 0.5, 1.0
"""Silence before and after, s."""
LONGEST_SILENCE = 60.0
LARGEST_SEED = 2**53 - 1
FACE_PARTS = ("blinks", "brows", "head", "gaze", "emotion")
"""What a face can be told to leave out: each is a parameter `face_...`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordingOptions:
    """Options of a voice that is a recording; None where one was not given."""

    transcript: str | None = None
    textgrid: str | None = None
    words: str | None = None
    own_breaths: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class CompileOptions:
    """Options that make a Score out of a text; None where one was not given."""

    voice: str | None = None
    model: str | None = None
    presets: tuple[str, ...] = ()
    assignments: tuple[str, ...] = ()
    states: tuple[str, ...] = ()
    cast: tuple[str, ...] = ()
    markup: str | None = None
    breaths: str | None = None
    seed: int | None = None
    language: str | None = None
    poem: bool | None = None
    lead: float | None = None
    tail: float | None = None
    breath_sound: bool | None = None
    breath_motion: bool | None = None
    face: str | None = None
    without: tuple[str, ...] = ()
    recording: RecordingOptions = RecordingOptions()

    def refuse(self, source: str) -> None:
        """A Score is compiled already: none of these applies.

        Raises:
            InputError: Names the first option that was given.
        """
        given = [(field.name, getattr(self, field.name)) for field in fields(self) if field.name != "recording"]
        given += [(field.name, getattr(self.recording, field.name)) for field in fields(self.recording)]
        for name, value in given:
            if value is not None and value != ():
                raise InputError(f"{source}: is a score; {_flag(name, value)} belongs to compiling a script")

    def parameters(self) -> Parameters:
        """Presets, then `--set`, then options of their own (`--breath-sound`, `--face`): what comes later wins.

        Raises:
            ParameterError: A name or value is wrong.
            InputError: There is no such face, or no such part of one.
        """
        from scorebreath.parameters.table import Parameters

        return Parameters(**self.values())

    def values(self) -> dict[str, Any]:
        """Name and value of every parameter these options set."""
        from scorebreath.parameters.assign import parse_assignment
        from scorebreath.parameters.presets import load_preset

        values: dict[str, Any] = {}
        for preset in self.presets:
            values.update(load_preset(preset).values)
        values.update(parse_assignment(text) for text in self.assignments)
        options = {"breath_sound": self.breath_sound, "breath_motion": self.breath_motion, "face": self._face()}
        values |= {name: value for name, value in options.items() if value is not None}
        return values | {f"face_{part}": False for part in self.left_out()}

    def _face(self) -> str | None:
        from scorebreath.parameters.face_table import FACES

        if self.face is not None and self.face not in FACES:
            raise _unknown("--face", self.face, FACES)
        return self.face

    def left_out(self) -> tuple[str, ...]:
        """Parts of the face that are not to be seen.

        Raises:
            InputError: There is no such part.

        >>> CompileOptions(without=("blinks, head", "gaze")).left_out()
        ('blinks', 'head', 'gaze')
        """
        parts = [part.strip() for given in self.without for part in given.split(",")]
        for part in parts:
            if part not in FACE_PARTS:
                raise _unknown("--without", part, FACE_PARTS)
        return tuple(dict.fromkeys(parts))

    def casting(self) -> dict[str, Parameters]:
        """Parameters of those who speak with another voice: as everybody's, and what their presets set.

        Raises:
            InputError: It does not say who, or there is no such preset.
        """
        from scorebreath.parameters.presets import load_preset
        from scorebreath.parameters.table import Parameters

        values: dict[str, dict[str, Any]] = {}
        for given in self.cast:
            voice, _, preset = (part.strip() for part in given.rpartition("="))
            if not voice or not preset:
                raise InputError(f"--cast {shortened(given, 40)}: expected VOICE=PRESET, such as espeak:en-us+f3=woman")
            values[voice] = values.get(voice, self.values()) | dict(load_preset(preset).values)
        return {voice: Parameters(**own) for voice, own in values.items()}

    def begin(self) -> dict[str, float]:
        """Name and intensity of every state the body begins in.

        Raises:
            InputError: There is no such state, or its intensity is not in [0, 1].
        """
        from scorebreath.parameters.states import Blend

        found: dict[str, float] = {}
        for given in self.states:
            name, equals, amount = (part.strip() for part in given.partition("="))
            try:
                intensity = float(amount) if equals else 1.0
            except ValueError:
                intensity = math.nan
            if not 0.0 <= intensity <= 1.0:
                raise InputError(f"--state {shortened(given, 40)}: expected NAME=INTENSITY with an intensity in [0, 1]")
            Blend().changed(0.0, name, intensity, 0.0)  # raises where there is none of that name
            found[name] = intensity
        return found

    def kind_of_markup(self) -> Markup:
        """How the text is marked up.

        Raises:
            InputError: There is no such kind.
        """
        kind = self.markup or MARKUPS[0]
        if kind not in MARKUPS:
            raise InputError(f"--markup {shortened(kind, 40)}: expected {', '.join(MARKUPS)}")
        return cast("Markup", kind)


_RATE = re.compile(r"[0-9]{1,9}(\.[0-9]{0,9}|/0{0,3}[1-9][0-9]{0,8})?")
_FLAGS = {"assignments": "--set", "presets": "--preset", "states": "--state"}


def _unknown(flag: str, given: str, known: tuple[str, ...]) -> InputError:
    shown = shortened(given, 40) or "(nothing)"
    return InputError(f"{flag} {shown}: expected {', '.join(known)}{did_you_mean(given, known) if given else ''}")


def _flag(name: str, value: object) -> str:
    if name == "poem":
        return "--poem" if value else "--prose"
    flag = _FLAGS.get(name, "--" + name.replace("_", "-"))
    return flag.replace("--", "--no-", 1) if value is False else flag


def frame_rate(text: str) -> Fraction:
    """Frames per second, exactly.

    Args:
        text: As for `rate_of`.

    Raises:
        InputError: It is no rate, or out of range.

    >>> frame_rate("60"), frame_rate("29.97"), frame_rate("30000/1001")
    (Fraction(60, 1), Fraction(2997, 100), Fraction(30000, 1001))
    """
    from scorebreath.formats.frames import HIGHEST

    return rate_of("--fps", text, HIGHEST)


def rate_of(flag: str, text: str, highest: float) -> Fraction:
    """A number of frames a second, exactly.

    Args:
        flag: The option, for messages.
        text: A whole number, a decimal, or a ratio; no exponent, as `1e999999999` would take all memory there is.
        highest: The most.

    Raises:
        InputError: It is none of these, or out of range.
    """
    from fractions import Fraction

    rate = Fraction(text) if _RATE.fullmatch(text) else Fraction(0)
    if not 0 < rate <= highest:
        raise InputError(
            f"{flag} {shortened(text, 40)!r}: expected frames per second above 0 and at most {highest}, "
            "such as 60, 29.97 or 30000/1001"
        )
    return rate


def check_engine(name: str) -> None:
    """Refuse an engine that does not exist, with the name that may be meant.

    Raises:
        InputError: There is no such engine.
    """
    if name == DEFAULT_ENGINE:
        return
    from scorebreath.engine.engines import ENGINES, engine_named

    try:
        engine_named(name)
    except InputError as error:
        raise InputError(f"{error}{did_you_mean(name.partition(':')[0], ENGINES)}") from None


def seconds(name: str, value: float | None, default: float) -> float:
    """A length of silence.

    Raises:
        InputError: It is not in [0, 60].
    """
    if value is None:
        return default
    if math.isnan(value) or not 0 <= value <= LONGEST_SILENCE:
        raise InputError(f"--{name} {value:g}: must be in [0, {LONGEST_SILENCE:g}] s")
    return value


def seed(value: int | None) -> int:
    """Where every chance begins.

    Raises:
        InputError: It is below 0, or no JSON reader could hold it.
    """
    if value is not None and not 0 <= value <= LARGEST_SEED:
        raise InputError(f"--seed {value}: must be in [0, {LARGEST_SEED}]")
    return value or 0
