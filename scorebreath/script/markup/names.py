"""Inline tags by name: the words people already type, what may stand behind them, and the mark each makes."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache

from scorebreath.errors import did_you_mean
from scorebreath.parameters.states import STATES
from scorebreath.script import emotions
from scorebreath.script.marks import Act, ActName, EmotionMark, Mark, NamedMark, NoBreath, StateMark, VoiceMark
from scorebreath.script.markup.quantities import LONGEST_PAUSE, LONGEST_RAMP, seconds, share

HOLD = 0.5
"""s that a breath is held if nothing is said about it"""
RAMP = 2.0
"""s until a state is reached if nothing is said about it"""
NEUTRAL = "neutral"
LONGEST_NAME = 64
"""Code points of the name of a mark or a voice."""

_NAME = re.compile(rf"[^\s<>\"'\[\]]{{1,{LONGEST_NAME}}}")
_WORD = re.compile(r"\S+")

Make = Callable[[str, str], Mark | str]
"""From what stands behind the name and the tag as written, the mark, or what was expected instead."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Tag:
    """One row of the table."""

    name: str
    """with the slash of what ends something"""
    aliases: tuple[str, ...] = ()
    form: str
    """how it is written, for messages and documents"""
    make: Make


def is_name(text: str) -> bool:
    """Whether a text may name a mark or a voice."""
    return _NAME.fullmatch(text) is not None


def _act(name: ActName) -> Make:
    """What the body does, as it does it by itself."""

    def make(rest: str, written: str) -> Mark | str:
        return f"nothing behind the name: [{name}]" if rest else Act(at=0, written=written, name=name)

    return make


def _timed(name: ActName, default: float | None) -> Make:
    """What has a length."""

    def make(rest: str, written: str) -> Mark | str:
        length = seconds(rest, LONGEST_PAUSE) if rest else default
        if length is None:
            return f"a length of at most {LONGEST_PAUSE:g} seconds, such as [{name} 0.4] or [{name} 400ms]"
        return Act(at=0, written=written, name=name, seconds=length)

    return make


def _no_breath(rest: str, written: str) -> Mark | str:
    return "nothing behind the name: [no-breath]" if rest else NoBreath(at=0, written=written)


def _named(rest: str, written: str) -> Mark | str:
    if not is_name(rest):
        return f"one name of at most {LONGEST_NAME} letters without spaces, such as [mark chapter-2]"
    return NamedMark(at=0, written=written, name=rest)


def _voice(rest: str, written: str) -> Mark | str:
    if not is_name(rest):
        return "the name of one voice, such as [voice espeak:en-us]"
    return VoiceMark(at=0, written=written, voice=rest)


def _voice_end(rest: str, written: str) -> Mark | str:
    return "nothing behind the name: [/voice]" if rest else VoiceMark(at=0, written=written, voice="")


def _state(rest: str, written: str) -> Mark | str:
    words = _WORD.findall(rest)
    name = states().get(words[0].lower().replace("_", "-")) if words else None
    if name is None:
        meant = did_you_mean(words[0], states(), 1) if words else ""
        return f"a state: [state NAME [INTENSITY] [over SECONDS] [hold]] with one of {', '.join(STATES)}{meant}"
    return _state_mark(name, words[1:], written)


def _emotion(rest: str, written: str) -> Mark | str:
    words = _WORD.findall(rest)
    name = emotions.named(words[0]) if words else None
    if name is None:
        return f"an emotion: [emotion NAME [INTENSITY]] with {emotions.expected(words[0] if words else '')}"
    intensity = share(words[1]) if words[1:] else 1.0
    if intensity is None or words[2:]:
        return f"[emotion {name} [INTENSITY 0..1]]"
    return EmotionMark(at=0, written=written, name=name, intensity=intensity)


def _state_end(rest: str, written: str) -> Mark | str:
    words = _WORD.findall(rest)
    return _state_mark(NEUTRAL, words, written)


def _state_mark(name: str, words: list[str], written: str) -> Mark | str:
    """A state with what stands behind its name: how much of it, how fast, whether it stays."""
    intensity: float | None = None
    ramp: float | None = None
    held = False
    waiting = list(words)
    while waiting:
        word = waiting.pop(0).lower()
        if word == "over" and ramp is None:
            told = " ".join(waiting[:2]) if waiting[1:] and waiting[1].lower() in _UNITS else "".join(waiting[:1])
            ramp = seconds(told, LONGEST_RAMP) if told else None
            if ramp is None:
                return f"seconds behind `over`, at most {LONGEST_RAMP:g}"
            del waiting[: len(told.split())]
        elif word == "hold" and not held:
            held = True
        elif intensity is None and (value := share(word)) is not None:
            intensity = value
        else:
            return f"[state {name} [INTENSITY 0..1] [over SECONDS] [hold]]"
    return StateMark(
        at=0,
        written=written,
        name=name,
        intensity=1.0 if intensity is None else intensity,
        ramp=RAMP if ramp is None else ramp,
        held=held,
    )


_UNITS = ("s", "ms", "sec", "secs", "second", "seconds")

TAGS = (
    Tag(
        name="breath",
        aliases=("breaths", "breathe", "breathes", "breathing", "inhale", "inhales", "inhaling"),
        form="[breath]",
        make=_act("breath"),
    ),
    Tag(name="sigh", aliases=("sighs", "sighing"), form="[sigh]", make=_act("sigh")),
    Tag(name="gasp", aliases=("gasps", "gasping"), form="[gasp]", make=_act("gasp")),
    Tag(name="sniff", aliases=("sniffs", "sniffing"), form="[sniff]", make=_act("sniff")),
    Tag(name="laugh", aliases=("laughs", "laughing", "laughter"), form="[laugh]", make=_act("laugh")),
    Tag(name="exhale", aliases=("exhales", "exhaling"), form="[exhale]", make=_act("exhale")),
    Tag(name="hold", aliases=("holds", "hold-breath"), form="[hold [SECONDS]]", make=_timed("hold", HOLD)),
    Tag(name="pause", aliases=("pauses",), form="[pause SECONDS]", make=_timed("pause", None)),
    Tag(name="no-breath", aliases=("no_breath", "nobreath"), form="[no-breath]", make=_no_breath),
    Tag(name="state", form="[state NAME [INTENSITY] [over SECONDS] [hold]]", make=_state),
    Tag(name="emotion", form="[emotion NAME [INTENSITY]]", make=_emotion),
    Tag(name="/state", form="[/state]", make=_state_end),
    Tag(name="mark", form="[mark NAME]", make=_named),
    Tag(name="voice", form="[voice NAME]", make=_voice),
    Tag(name="/voice", form="[/voice]", make=_voice_end),
)
"""All tags but the states' names, which are tags too: `[anxious 0.8]` is `[state anxious 0.8]`. Other words for states
are none, for `[content]` and `[running head]` stand in books."""


@cache
def states() -> Mapping[str, str]:
    """Names of states, and other words for them, to names."""
    aliases = {alias.lower(): name for name, row in STATES.items() for alias in row.aliases}
    return {**aliases, **{name: name for name in STATES}}


@cache
def tags() -> Mapping[str, Tag]:
    """Every tag by each of its names. Where a state is called like an act, `laughing`, the act comes first."""
    named = {name: tag for tag in TAGS for name in (tag.name, *tag.aliases)}
    return {**{name: _shorthand(name) for name in STATES}, **named}


def _shorthand(name: str) -> Tag:
    """A state's name as a tag."""

    def make(rest: str, written: str) -> Mark | str:
        return _state_mark(name, _WORD.findall(rest), written)

    return Tag(name=name, form=f"[{name} [INTENSITY] [over SECONDS] [hold]]", make=make)


@lru_cache(maxsize=1024)
def make(name: str, rest: str, written: str) -> Mark | str:
    """The mark of a tag, or what was expected instead.

    Args:
        name: One of `tags()`, in lower case.
        rest: What stands behind it, without the space around.
        written: The whole tag.

    >>> make("hold", "", "[hold]").seconds, make("laughing", "0.5", "[laughing 0.5]").name
    (0.5, 'laughing')
    """
    tag = _shorthand(name) if rest and name in STATES else tags()[name]
    return tag.make(rest, written)
