"""From symbols with their lengths to phones in a trimmed sound: whose a stress, a mark and a space are.

A Piper model gives each symbol a length, and symbols are not phones: a stress mark's length belongs to the phone behind
it, a length mark's to the one before, a space's to the next word; two letters make a diphthong; around punctuation it
is silent for a while, which the sound tells. Labels are a little late.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scorebreath.equations.phones import is_vowel
from scorebreath.signal.level import sounding
from scorebreath.speech.assemble import FramedPhone
from scorebreath.speech.piper.marks import BEGIN, END, PAD

STRESS = {"ˈ": 1, "ˌ": 2}
GLIDE = "ʲ"
"""Behind a vowel it says how the next one is joined to it, and is no sound of its own."""
JOINED = frozenset({"aɪ", "aʊ", "eɪ", "oʊ", "əʊ", "ɔɪ", "ɔʏ", "ɔø", "tʃ", "dʒ"})
"""Two letters, one phone."""
LATE = 0.016
"""s by which the model's labels are late: the median over the words of joe, by forced alignment."""
FADED = 0.003
"""of the peak (-50 dB): below it is silent, and the sound begins and ends above it less `WEAKER`"""
WEAKER = 0.3
"""x `FADED`: where the first sound begins and the last one ends (-60 dB)"""
FRAME = 0.005
"""s; silence is looked for in steps of this length"""
PAUSE_MARKED, PAUSE_UNMARKED = 0.03, 0.12
"""s of silence that are a pause: at punctuation, and at a mere space, where it may be the closure of a stop"""
REACH = 0.03
"""s behind the label of the next phone in which a pause may end"""
MARGIN = 0.002
"""s kept on both sides of the sound, and faded, so that nothing clicks"""


class Timed(NamedTuple):
    """A symbol and how long it lasts."""

    symbol: str
    frames: int


@dataclass(frozen=True, slots=True, kw_only=True)
class _Unit:
    """A phone to be, with where it starts by the labels."""

    ipa: str
    start: int
    """frame"""
    stress: int
    word: int | None
    gap: int | None
    """frame where the space or the punctuation before it starts; None: there is none"""
    marked: bool
    """whether there is punctuation before it"""
    label: int
    """frame where its own symbol starts"""
    end: int
    """frame where that of its last letter ends"""


def phones(
    symbols: Sequence[Timed], owners: Sequence[int | None], samples: NDArray[np.float32], sample_rate: int
) -> tuple[NDArray[np.float32], list[FramedPhone]]:
    """Phones and pauses, and the sound from the first of them to the last.

    Args:
        symbols: All of them, with the marks of begin and end; together as long as the sound.
        owners: The word of each symbol, ascending; None for those of no word.
        samples: (n,) as the model gives them.
        sample_rate: Hz.

    Returns:
        The trimmed sound, and its phones: ascending starts, the first 0; pauses belong to no word, every other phone to
        one. Both empty where nothing is said.
    """
    units = _joined(_units(symbols, owners, round(LATE * sample_rate)))
    start, end = sounding(samples, FADED * WEAKER * float(np.abs(samples).max(initial=0.0)))
    if not units or start >= end:
        return samples[:0], []
    margin = round(MARGIN * sample_rate)
    first, last = max(0, start - margin), min(len(samples), end + margin)
    cut = samples[first:last].copy()
    cut[: start - first] *= np.linspace(0, 1, start - first, endpoint=False, dtype=np.float32)
    cut[len(cut) - (last - end) :] *= np.linspace(1, 0, last - end, dtype=np.float32)
    placed: list[FramedPhone] = []
    quiet = _quiet(samples, sample_rate)
    for number, unit in enumerate(units):
        begins = unit.start
        if number and unit.gap is not None:
            limit = unit.label + round(REACH * sample_rate)
            silence = _longest(quiet, max(units[number - 1].label, 0), limit, round(FRAME * sample_rate))
            least = PAUSE_MARKED if unit.marked else PAUSE_UNMARKED
            if silence[1] - silence[0] >= least * sample_rate:
                placed.append(FramedPhone(ipa="", start=silence[0] - first))
                begins = min(silence[1], (unit.label + unit.end) // 2)
        placed.append(FramedPhone(ipa=unit.ipa, start=begins - first, stress=unit.stress, word=unit.word))
    return cut, _ascending(placed, len(cut))


def _units(symbols: Sequence[Timed], owners: Sequence[int | None], late: int) -> list[_Unit]:
    """One for each letter, with its marks."""
    units: list[_Unit] = []
    at = 0
    gap: int | None = None
    waiting: int | None = None
    stress, marked = 0, False
    for (symbol, frames), owner in zip(symbols, owners, strict=True):
        begins, ends, at = max(0, at - late), max(0, at + frames - late), at + frames
        if symbol in (BEGIN, END, PAD):
            continue
        if symbol in STRESS:
            stress, waiting = STRESS[symbol], begins if waiting is None else waiting
        elif owner is None:
            gap = begins if gap is None else gap
            if symbol.strip():
                marked, waiting = True, None
            elif waiting is None:
                waiting = begins
        elif _is_mark(symbol):
            if units and not (symbol == GLIDE and is_vowel(units[-1].ipa)):
                units[-1] = replace(units[-1], ipa=units[-1].ipa + symbol, end=ends)
        else:
            starts = begins if waiting is None else waiting
            units.append(
                _Unit(
                    ipa=symbol, start=starts, stress=stress, word=owner, gap=gap, marked=marked, label=begins, end=ends
                )
            )
            gap, waiting, stress, marked = None, None, 0, False
    return [replace(unit, ipa=unicodedata.normalize("NFC", unit.ipa)) for unit in units]


def _is_mark(symbol: str) -> bool:
    return all(unicodedata.category(character) in ("Lm", "Mn", "Sk") for character in symbol)


def _joined(units: Sequence[_Unit]) -> list[_Unit]:
    out: list[_Unit] = []
    for unit in units:
        before = out[-1] if out else None
        # a stress between the two makes them two syllables
        together = before is not None and unit.gap is None and before.word == unit.word and not unit.stress
        if before is not None and together and before.ipa + unit.ipa in JOINED:
            out[-1] = replace(before, ipa=before.ipa + unit.ipa, end=unit.end)
        else:
            out.append(unit)
    return out


def _quiet(samples: NDArray[np.float32], sample_rate: int) -> NDArray[np.bool_]:
    """(k,) for each step of `FRAME` whether it is silent."""
    width = round(FRAME * sample_rate)
    whole = len(samples) // width * width
    power = np.square(samples[:whole].astype(np.float64)).reshape(-1, width).mean(axis=1)
    return np.asarray(np.sqrt(power) < FADED * np.abs(samples).max(initial=0.0), dtype=np.bool_)


def _longest(quiet: NDArray[np.bool_], start: int, end: int, width: int) -> tuple[int, int]:
    """Frames of the longest silence between two."""
    inside = quiet[start // width : end // width]
    edges = np.flatnonzero(np.diff(np.concatenate(([False], inside, [False])).astype(np.int8))).reshape(-1, 2)
    if not len(edges):
        return 0, 0
    begin, stop = edges[int(np.argmax(edges[:, 1] - edges[:, 0]))]
    return (start // width + int(begin)) * width, (start // width + int(stop)) * width


def _ascending(placed: Sequence[FramedPhone], frames: int) -> list[FramedPhone]:
    """The first at 0, each at least a frame long, the last one inside the sound."""
    count = len(placed)
    starts = [0] * count
    for number, phone in enumerate(placed[1:], 1):
        starts[number] = max(phone.start, starts[number - 1] + 1)
    for number in range(count - 1, 0, -1):
        latest = (starts[number + 1] if number + 1 < count else frames) - 1
        starts[number] = min(starts[number], latest)
    return [replace(phone, start=start) for phone, start in zip(placed, starts, strict=True)]
