"""Where a transcript and what was understood of its recording part, word by word."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from pathlib import Path

from scorebreath.errors import InputError
from scorebreath.speech.recording.model import Mismatch

ALIKE = 0.55
"""Share of the sounds that may differ where one word is taken for another"""
MOST_WRONG = 0.5
"""Share of the transcript that may not be heard"""
TOLD = 4
"""Mismatches in the message about a transcript of something else"""
APART = 2
"""Words between two stretches that are taken for one"""
FEW = 3
"""Sounds; shorter words come and go in what is understood"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Token:
    """A word to be matched."""

    text: str
    sounds: tuple[str, ...]
    """how it is said, or its letters"""
    at: float = 0.0
    """s of the recording; of no meaning for a word of the transcript"""
    until: float = 0.0
    """s of the recording, its end"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """A stretch of both that is not the same."""

    written: range
    """places among the words of the transcript"""
    heard: range
    """places among the words understood"""
    mismatch: Mismatch


def differences(written: Sequence[Token], heard: Sequence[Token], *, exact: bool = False) -> list[Difference]:
    """Where they say different things.

    Args:
        written: The transcript.
        heard: What was understood, in order of time.
        exact: Whether words must be the same; else they need only sound alike, and short ones may come and go, as a
            machine's ears mistake one word for another.

    Returns:
        In order; empty where they agree.

    >>> one, two = ([Token(text=w, sounds=tuple(w)) for w in text.split()] for text in ("a big red dog", "a big dog"))
    >>> [str(found.mismatch) for found in differences(one, two, exact=True)]
    ["0.00 s: 'red' is written and not heard"]
    """
    matcher = SequenceMatcher(None, [word.text for word in written], [word.text for word in heard], autojunk=False)
    places: list[tuple[range, range]] = []
    for kind, first, last, start, end in matcher.get_opcodes():
        if kind != "equal":
            places += _parted(written, heard, range(first, last), range(start, end), exact=exact)
    return [_difference(written, heard, *place) for place in (places if exact else _gathered(places))]


def _gathered(places: Sequence[tuple[range, range]]) -> list[tuple[range, range]]:
    """Stretches that are a few words apart are one: what a machine hears as one word is seldom alone wrong."""
    out: list[tuple[range, range]] = []
    for here, there in places:
        if out and here.start - out[-1][0].stop <= APART and there.start - out[-1][1].stop <= APART:
            before, behind = out.pop()
            out.append((range(before.start, here.stop), range(behind.start, there.stop)))
        else:
            out.append((here, there))
    return out


def _parted(
    written: Sequence[Token], heard: Sequence[Token], said: range, understood: range, *, exact: bool
) -> list[tuple[range, range]]:
    """The stretches of a region that really differ."""
    if exact:
        return [(said, understood)]
    pairs = _paired([written[i] for i in said], [heard[j] for j in understood])
    out: list[tuple[range, range]] = []
    for (first, last), (start, end) in pairs:
        here = range(said.start + first, said.start + last)
        there = range(understood.start + start, understood.start + end)
        one = _sounds(written, here)
        two = _sounds(heard, there)
        if max(len(one), len(two)) <= FEW or (one and two and distance(one, two) <= ALIKE):
            continue
        out.append((here, there))
    return out


def _paired(written: Sequence[Token], heard: Sequence[Token]) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """The cheapest way through both: runs of words that sound alike, and runs that do not.

    A word against nothing costs 1, against another word twice the share of its sounds that differ; of two words against
    one, their sounds together.
    """
    rows, columns = len(written), len(heard)
    best = [[0.0] * (columns + 1) for _ in range(rows + 1)]
    step: list[list[tuple[int, int]]] = [[(0, 0)] * (columns + 1) for _ in range(rows + 1)]
    for i in range(rows + 1):
        for j in range(columns + 1):
            options: list[tuple[float, tuple[int, int]]] = []
            for di, dj in ((1, 1), (1, 0), (0, 1), (2, 1), (1, 2), (2, 2)):
                if di > i or dj > j:
                    continue
                options.append((best[i - di][j - dj] + _cost(written[i - di : i], heard[j - dj : j]), (di, dj)))
            if options:
                best[i][j], step[i][j] = min(options)
    out: list[tuple[tuple[int, int], tuple[int, int]]] = []
    i, j = rows, columns
    while i or j:
        di, dj = step[i][j]
        out.append(((i - di, i), (j - dj, j)))
        i, j = i - di, j - dj
    return _joined(out[::-1])


def _joined(
    steps: Sequence[tuple[tuple[int, int], tuple[int, int]]],
) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Neighbours of which one side is empty are one: what was said instead of what."""
    out: list[tuple[tuple[int, int], tuple[int, int]]] = []
    open_ = False
    for here, there in steps:
        lone = here[0] == here[1] or there[0] == there[1]
        if lone and open_:
            before, behind = out.pop()
            out.append(((before[0], here[1]), (behind[0], there[1])))
        else:
            out.append((here, there))
        open_ = lone
    return out


def _cost(written: Sequence[Token], heard: Sequence[Token]) -> float:
    if not written or not heard:
        return float(len(written) + len(heard))
    one = tuple(sound for word in written for sound in word.sounds)
    two = tuple(sound for word in heard for sound in word.sounds)
    return max(len(written), len(heard)) * 2.0 * distance(one, two)


def _sounds(words: Sequence[Token], places: range) -> tuple[str, ...]:
    return tuple(sound for place in places for sound in words[place].sounds)


def _difference(written: Sequence[Token], heard: Sequence[Token], said: range, understood: range) -> Difference:
    one = " ".join(written[place].text for place in said)
    two = " ".join(heard[place].text for place in understood)
    at = heard[understood.start].at if understood.start < len(heard) else heard[-1].at if heard else 0.0
    mismatch = Mismatch(kind="instead" if one and two else "missing" if one else "extra", written=one, heard=two, at=at)
    return Difference(written=said, heard=understood, mismatch=mismatch)


def check_share(path: Path, mismatches: Sequence[Mismatch], wrong: int, all_: int) -> None:
    """Refuse a transcript of something else.

    Args:
        path: Of the recording, for the message.
        mismatches: What was found.
        wrong: Words of the transcript that are not heard.
        all_: Words of the transcript.

    Raises:
        InputError: Most of it is not heard.
    """
    if wrong > MOST_WRONG * all_:
        told = "; ".join(str(one) for one in mismatches[:TOLD])
        raise InputError(f"{path}: {wrong} of {all_} words of the transcript are not heard in it: {told[:400]}")


def distance(one: Sequence[str], two: Sequence[str]) -> float:
    """Share of sounds to be changed, left out or put in to make one of the other, 0..1 (Levenshtein).

    >>> distance("kitten", "sitting")
    0.42857142857142855
    """
    if not one or not two:
        return 1.0 if one or two else 0.0
    row = list(range(len(two) + 1))
    for i, sound in enumerate(one, 1):
        above, row[0] = row[0], i
        for j, other in enumerate(two, 1):
            above, row[j] = row[j], min(row[j] + 1, row[j - 1] + 1, above + (sound != other))
    return row[-1] / max(len(one), len(two))
