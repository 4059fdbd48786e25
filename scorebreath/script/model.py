"""The Script: a text as words, each with what follows it, sentence by sentence."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from scorebreath.script.marks import Mark
from scorebreath.script.told import Told
from scorebreath.spans import Span, SpokenText

SentenceType = Literal["statement", "question", "exclamation"]
Edge = Literal["paragraph", "sentence", "semicolon", "comma", "line", "marker", "word", "joint"]
"""What follows a word, strongest first.

`paragraph`: a blank line, a stanza's end, or the end of the text. `sentence`: a sentence ends. `semicolon`: also
colon, dash, ellipsis and closing or opening parentheses. `comma`: also a comma inside closing quotes. `line`: a line of
verse ends. `marker`: the pause marker `_`. `word`: only space. `joint`: nothing, as after the hyphen of a compound, or
where a word too long for one breath is cut: no breath belongs there.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class ScriptWord:
    """One word of the text with the punctuation that hangs on it."""

    source: Span
    """the word and its punctuation, without the space around them"""
    text: str
    """the word as written, without punctuation"""
    spoken: SpokenText
    """as a voice is to say it, with its punctuation; source spans are absolute places in the text. Words are joined
    by a space, but by nothing behind a `joint` edge"""
    words: tuple[str, ...]
    """the bare spoken words, for counting syllables: ("twenty", "three") for 23"""
    edge: Edge
    """what follows"""
    line: int
    """line of the text it stands in, from 0"""
    marked: bool = False
    """a pause marker `_` follows, even where `edge` names something stronger"""
    after: tuple[Mark, ...] = ()
    """what the markup asks for between this word and the next"""
    told: Told | None = None
    """what MaryXML tells of it"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sentence:
    """A sentence, or the part of an endless one that fits a window."""

    source: Span
    """from its first word to its last mark"""
    text: str
    """as written: `source` cut from the text"""
    gap: str
    """what stands between this sentence and the next one, as written: white space, and what is not spoken"""
    type: SentenceType
    words: tuple[ScriptWord, ...]
    """at least one"""
    complete: bool
    """False where the window cut it off: its last edge is then a `word`, `comma`, ... inside the sentence"""
    stanza: int
    """paragraph or stanza, from 0"""
    before: tuple[Mark, ...] = ()
    """what the markup asks for before the first word of the text; empty in all other sentences"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Script:
    """A whole text, read."""

    text: str
    """what is said: as given, after universal newlines, without a byte order mark and without markup"""
    language: str
    """BCP 47 primary language, lower case: `en`, `de`, ..."""
    poem: bool
    """line ends are phrase edges and stanza ends paragraphs"""
    sentences: tuple[Sentence, ...]
    """empty only where there are marks"""
    marks: tuple[Mark, ...] = ()
    """all of them, in order; each stands also in a sentence's `before` or a word's `after` if there is any word"""
