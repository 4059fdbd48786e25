"""Events of speech: what is said, in which phrases, and the silences between."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from scorebreath.errors import ScoreError
from scorebreath.score.event import Closing, Event, Part, PauseKind, SentenceType
from scorebreath.score.values import FORWARD, LARGEST, Flag, Limits, Number, Whole, limits


@dataclass(frozen=True, slots=True, kw_only=True)
class Word(Part):
    """A word as it is spoken."""

    limits: ClassVar[Limits] = limits(onset=FORWARD, duration=FORWARD)

    text: str
    onset: Number
    """s"""
    duration: Number
    """s"""
    source: tuple[Whole, Whole] | None = None
    """code points of the Score's text"""
    accent: Flag = False
    """whether it bears a pitch accent: a content word (A7)"""
    tone: str = ""
    """ToBI label of the accent, where somebody told it"""
    pos: str = ""
    """part of speech, where somebody told it"""
    merged: Flag = False
    """spoken as one with its neighbours ("was the")"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Phone(Part):
    """A phone; phones are contiguous over the utterance, pauses among them."""

    limits: ClassVar[Limits] = limits(onset=FORWARD, duration=FORWARD, word=(0, 2**31))

    ipa: str
    """International Phonetic Alphabet; empty for a pause"""
    onset: Number
    """s"""
    duration: Number
    """s"""
    stress: Whole = 0
    """0 none, 1 primary, 2 secondary"""
    word: Whole | None = None
    """index among the utterance's words"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pitch(Part):
    """Fundamental frequency, one value a step, the first at half a step."""

    limits: ClassVar[Limits] = limits(step=(1e-6, LARGEST))

    step: Number
    """s"""
    hertz: tuple[Number, ...]
    """0 where unvoiced"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Level(Part):
    """Level of the sound, one value a step, the first at half a step."""

    limits: ClassVar[Limits] = limits(step=(1e-6, LARGEST))

    step: Number
    """s"""
    db: tuple[Number, ...]
    """dB re full scale, of the media as stored"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Utterance(Event):
    """The speech of one breath group."""

    type: ClassVar[str] = "utterance"
    limits: ClassVar[Limits] = limits(gain_db=(-200.0, 60.0))
    media: str
    """SHA-256 of the samples"""
    gain_db: Number
    """dB"""
    closing: Closing
    words: tuple[Word, ...]
    phones: tuple[Phone, ...]
    pitch: Pitch
    level: Level

    def __post_init__(self) -> None:
        """Check the numbers, and that every phone is of a word that is there.

        Raises:
            ScoreError: A phone names a word beyond the last one.
        """
        super(Utterance, self).__post_init__()  # zero-argument super() breaks under dataclass slots
        count = len(self.words)
        for number, phone in enumerate(self.phones):
            if phone.word is not None and phone.word >= count:
                known = f"in [0, {count - 1}], an index among its words" if count else "left out, as it has no words"
                raise ScoreError(f"Utterance {self.id!r}: phones[{number}].word={phone.word} must be {known}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Phrase(Event):
    """An intonational phrase, or what stands for one (a line of verse)."""

    type: ClassVar[str] = "phrase"
    limits: ClassVar[Limits] = limits(break_index=(0, 6))
    source: tuple[Whole, Whole]
    """code points of the Score's text"""
    break_index: Whole
    """of the boundary it ends with: 3 intermediate, 4 intonational, 5 a sentence's end, 6 a paragraph's (ToBI, A12)"""
    tone: str = ""
    """of that boundary, such as `l-l%`"""
    position: Literal["internal", "final"]
    """whether its sentence goes on behind it (A8)"""
    sentence_type: SentenceType
    """of the sentence it belongs to"""
    line: Whole | None = None
    """of the text, from 0, in verse"""
    stanza: Whole | None = None
    """from 0, in verse"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pause(Event):
    """Silence between groups or inside one."""

    type: ClassVar[str] = "pause"
    kind: PauseKind
