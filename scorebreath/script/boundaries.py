"""Where sentences end inside a window of text: pysbd's judgement, over a copy it can read.

pysbd takes white space, quotation marks, brackets and some rare characters in its own way: it breaks at every newline,
treats all a person says between quotes as one sentence, and uses symbols as place holders. So it is shown a copy
without quotes, brackets and emoticons, with single spaces; its answers are taken back to the text, and count only where
a mark stands that can end a sentence. For languages it does not know, every such mark ends one.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from scorebreath.script import emoticons
from scorebreath.script.normalise.figures import has_figures
from scorebreath.script.normalise.numbers import is_number_word
from scorebreath.script.normalise.tables import Tables, tables

END = re.compile(r"(?<![.!?FeZ\"')_])[.!?FeZ\"')_]++")
"""A run of marks and what closes behind them, in kinds; see `candidate`."""
FORCED = "Z"
"""What the reader puts for the kind of a character that ends a sentence because markup says so."""

_BEHIND = re.compile(r"[ nfx]|c?[:;]-[^ n]|[:;S][()]")
"""What may stand directly behind a sentence, in kinds: space, an emoji, or an emoticon with a nose or a bracket."""
_MARK = re.compile(r"[.!?Fe]")
_CLOSED = re.compile(r"[.!?Fe].*[\"')]")
_PLAIN_MARKS = re.compile(r"[\"')]*(?:\.|[!?]+)[\"')]*")
_CAPITAL = re.compile(r"[ n][(\"']?a")
_SMALL = re.compile(r"(?<![^\s\"'“”‘’„»«(-])[^\W\d_]{2,}(?=[^\w\s]*$)")
_WORD = re.compile(r"[^\W\d_]+")
_NUMBER_WORD = re.compile(r"[^\W\d_]+\Z")
_LAST_WORD = re.compile(r"(?:(?<!\w)[^\W\d_]\.\s)*[^\W\d_]+(?:\.[^\W\d_]+)*$")
_INITIAL = re.compile(r"\s([^\W\d_]{1,3})\.")
_NEXT = re.compile(r"[^adk]*")
_COPY = re.compile(
    r"""(?P<dots>…)|(?P<space>[\s\x00-\x1f\x7f-\x9f\u200b]+)|(?P<drop>["“”„‟«»‹›‚‘‛`´()\[\]{}「」『』\\]|
    (?<![^\W_])['’_]+|['’_]+(?![^\W_]))|(?P<strange>[∯♨☝♬♭☉☈☇☄✂⌬☏♟♝∮⎋ȸȹƪᓰᓱᓲᓳᓴᓷᓸ&])""",
    re.VERBOSE,
)


def candidate(kinds: str, run: re.Match[str], limit: int) -> bool:
    """Whether a run of `END` may end a sentence: it has a mark, and space or an emoticon follows, before `limit`."""
    found = run.group()
    if "F" in found or FORCED in found:
        return True
    end = run.end()
    return end < limit and _BEHIND.match(kinds, end, limit) is not None and _MARK.search(found) is not None


def certain(text: str, kinds: str, start: int, end: int, language: str) -> bool:
    """Whether a candidate ends a sentence beyond doubt, so that pysbd need not be asked.

    Beyond doubt are what markup ends and, in languages with a table, marks behind a word of two or more small letters
    that is no abbreviation, followed by a single space and a capital.

    Args:
        text: Text that is known.
        kinds: Its kinds.
        start: Place of the candidate's first mark.
        end: Behind its last one.
        language: BCP 47 primary language.
    """
    if FORCED in kinds[start:end]:
        return True
    if not tables(language).known or not _PLAIN_MARKS.fullmatch(kinds, start, end):
        return False
    following = _CAPITAL.match(kinds, end)
    word = _SMALL.search(text, max(0, start - 24), start)
    if following is None or word is None or not text[following.end() - 1].isupper():
        return False
    if not word.group().islower() or word.group() in _abbreviations(language):
        return False
    return not emoticons.idle(text, start)


def ends(text: str, kinds: str, language: str, *, final: bool) -> list[int]:
    """Places in `text` where sentences end, after their last mark, ascending.

    Args:
        text: The window; starts with a sentence.
        kinds: Its kinds.
        language: BCP 47 primary language.
        final: Whether a paragraph or the text ends with the window; else nothing is said about its very end.
    """
    runs = [run.span() for run in END.finditer(kinds) if candidate(kinds, run, len(kinds))]
    if not runs:
        return []
    judged = _judge(text, language)
    if judged is None:
        found = [end for _, end in runs]
    else:
        stops = [end for _, end in runs]
        found = []
        for place in judged:
            index = bisect_left(stops, place)
            if index < len(runs) and runs[index][0] < place and (not found or found[-1] < stops[index]):
                found.append(stops[index])
    held = set(found)
    return [
        end
        for start, end in runs
        if FORCED in kinds[start:end]
        or (_stands(text, kinds, start, end, language) if end in held else _missed(text, start, end, language))
    ]


def _stands(text: str, kinds: str, start: int, end: int, language: str) -> bool:
    """Whether an end holds: not after a title, nor where no capital follows on closing quotes or an abbreviation."""
    following = _NEXT.match(kinds, end)
    after = following.end() if following else end
    if after == len(text):
        return True
    if text[after].islower() and _CLOSED.search(kinds[start:after]):
        return False
    if text[start:end] != ".":
        return True
    table, word = tables(language), _last_word(text, start)
    if word in table.never_last:
        return _measures(text, start, word, table) and _starter(text, end, table)
    initial = _INITIAL.match(text, end)
    if initial and f"{word}.{initial[1].lower()}" in table.beginnings:
        return False
    goes_on = text[after].islower() or text[after].isdecimal()
    if goes_on and language == "de" and text[start - 1 : start].isdecimal():
        return text[after].isdecimal()
    short = word in table.abbreviation or word.endswith(table.suffixes) or _measures(text, start, word, table)
    return not (goes_on and short)


def _measures(text: str, stop: int, word: str, table: Tables) -> bool:
    """Whether the word before a full stop is a unit behind a number: "2 in. tall", but not "He was in. then"."""
    if word not in table.measures:
        return False
    before = text[max(0, stop - len(word) - 32) : stop - len(word)].rstrip()
    number = _NUMBER_WORD.search(before)
    return has_figures(before[-1:], table) or (number is not None and is_number_word(number.group(), table.language))


def _missed(text: str, start: int, end: int, language: str) -> bool:
    """Whether pysbd took an end for an abbreviation's or an initial's, but a word follows that starts sentences.

    As in "usw. Der Rest" and "Vitamin C. It helps".
    """
    table = tables(language)
    if not table.known or text[start:end] != ".":
        return False
    word = _last_word(text, start)
    if word not in table.lists["often_last"] and not text[max(0, start - 2) : start].strip("([\"'“„").isupper():
        return False
    return _starter(text, end, table)


def _starter(text: str, end: int, table: Tables) -> bool:
    """Whether a word follows that starts sentences."""
    following = _WORD.search(text, end)
    if following is None or text[following.end() : following.end() + 1] == ".":
        return False
    return following.group() in table.lists["starters"]


def _last_word(text: str, end: int) -> str:
    """The word before a full stop, in lower case, with the stops inside it."""
    word = _LAST_WORD.search(text[max(0, end - 16) : end])
    return "".join(word.group().lower().split()) if word else ""


class _Stretch(NamedTuple):
    """Where a piece of the copy comes from; `even` where characters correspond one to one."""

    copy: int
    start: int
    end: int
    even: bool


@dataclass(frozen=True, slots=True)
class _Copy:
    """A window as pysbd sees it."""

    text: str
    stretches: tuple[_Stretch, ...]

    def source(self, end: int) -> int:
        """Place in the window after the character before `end` in the copy."""
        stretch = self.stretches[bisect_right(self.stretches, end - 1, key=lambda one: one.copy) - 1]
        return stretch.start + end - stretch.copy if stretch.even else stretch.end


def _copy(text: str) -> _Copy:
    """What pysbd is shown."""
    pieces: list[str] = []
    stretches: list[_Stretch] = []
    length = at = 0

    def add(piece: str, start: int, end: int, even: bool) -> None:
        nonlocal length
        if piece:
            pieces.append(piece)
            stretches.append(_Stretch(length, start, end, even))
            length += len(piece)

    skipped = emoticons.spans(text) if emoticons.possible(text) else ()
    for span in (*skipped, None):
        stop = span.start if span else len(text)
        for match in _COPY.finditer(text, at, stop):
            add(text[at : match.start()], at, match.start(), True)
            at = match.end()
            if match.lastgroup == "space":
                if not pieces or pieces[-1] != " ":
                    add(" ", match.start(), at, False)
            elif match.lastgroup != "drop":
                add("..." if match.lastgroup == "dots" else "-", match.start(), at, False)
        add(text[at:stop], at, stop, True)
        at = span.end if span else stop
    return _Copy("".join(pieces), tuple(stretches))


def _judge(text: str, language: str) -> list[int] | None:
    """Ends of sentences by pysbd, as places after a character of `text`; None where it cannot say."""
    segment = _segmenter(language)
    if segment is None:
        return None
    copy = _copy(text)
    try:
        sentences = segment(copy.text)
    except (re.error, IndexError):  # it builds patterns from the text, unescaped
        return None
    found, at = [], 0
    for sentence in sentences:
        place = copy.text.find(sentence, at) if sentence else -1
        if place >= 0:
            at = place + len(sentence)
            found.append(copy.source(at))
    return found


@lru_cache(maxsize=16)
def _abbreviations(language: str) -> frozenset[str]:
    """Words that may stand before a full stop without ending a sentence."""
    from pysbd.languages import LANGUAGE_CODES

    table = tables(language)
    known = (word.strip().lower() for word in LANGUAGE_CODES[language].Abbreviation.ABBREVIATIONS)
    return frozenset((*known, *table.never_last, *table.abbreviation, *table.suffix))


@lru_cache(maxsize=16)
def _segmenter(language: str) -> Callable[[str], list[str]] | None:
    """Sentences of a text by pysbd, or None for a language it does not know."""
    import pysbd
    from pysbd.languages import LANGUAGE_CODES

    if language not in LANGUAGE_CODES:
        return None
    segmenter = pysbd.Segmenter(language=language, clean=False)

    def segment(text: str) -> list[str]:
        return list(segmenter.processor(text).process())

    return segment
