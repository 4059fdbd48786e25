"""Where the melody of an utterance turns: what heads, brows and eyes answer to (A24).

A pitch track has seven maxima a second, most of them a hundredth of an octave high. Those that are meant here are the
corners of the stylised contour, at most one maximum an accented syllable: they stand for the targets that S3's speech
synthesis set itself. It set one at every accent; other voices speak some of them on a level tone. So an accented
syllable far from any maximum counts as one, and says so (`level`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from scorebreath.equations.phones import is_nucleus
from scorebreath.score.events import Phone, Utterance
from scorebreath.signal.contour import TOLERANCE, melody, stylise
from scorebreath.units import snap

LOW = 10.0
"""Percentile of the voiced pitch that is called the voice's low tone."""
LONELY = 0.5
"""s between an accented syllable and the maxima around it from which on it is one of its own"""
REACH = 0.15
"""s that a maximum may lie outside the word it belongs to: peaks come late."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Extremum:
    """A turn of the melody."""

    kind: Literal["maximum", "minimum"]
    time: float
    """s from the utterance's onset"""
    semitones: float
    """above the utterance's low tone, the 10th percentile of its voiced pitch"""
    word: int | None
    """the utterance's word it belongs to; None in a pause"""
    syllable: tuple[float, float] | None
    """onset and end of the accented syllable it belongs to, s from the utterance's onset; None: it belongs to none"""
    level: bool = False
    """whether the melody does not turn here by itself: an accent on a level tone, far from any maximum"""


def extrema(utterance: Utterance) -> tuple[Extremum, ...]:
    """Maxima and minima of an utterance's melody, in turn, ascending in time.

    Args:
        utterance: With pitch, phones, and accents on its words.

    Returns:
        At most one maximum for an accented syllable; empty where nothing is voiced.
    """
    hertz = np.asarray(utterance.pitch.hertz)
    voiced = hertz > 0
    if not voiced.any():
        return ()
    heights = melody(hertz, utterance.pitch.step)
    heights -= np.percentile(heights[voiced], LOW)
    corners = stylise(heights)
    accented = _accented(utterance)
    peaks: dict[tuple[float, float] | int, Extremum] = {}
    for corner in _peaks(heights, corners, round(REACH / utterance.pitch.step)):
        peak = _extremum("maximum", int(corner), heights, utterance, accented)
        key = peak.syllable or int(corner)
        if key not in peaks or peaks[key].semitones < peak.semitones:
            peaks[key] = peak
    found = [*peaks.values()]
    for span in sorted(accented.values()):
        if all(max(span[0] - peak.time, peak.time - span[1]) > LONELY for peak in found):
            found.append(_level(span, heights, utterance, accented))
    return _in_turn(sorted(found, key=lambda peak: peak.time), heights, utterance)


def _level(
    span: tuple[float, float],
    heights: NDArray[np.float64],
    utterance: Utterance,
    accented: dict[int, tuple[float, float]],
) -> Extremum:
    """An accented syllable that stands for a maximum: where it is highest."""
    step = utterance.pitch.step
    first = min(_place(span[0] + 0.5 * step, step), heights.size - 1)
    stop = min(max(_place(span[1] + 0.5 * step, step), first + 1), heights.size)
    highest = first + int(np.argmax(heights[first:stop]))
    found = _extremum("maximum", highest, heights, utterance, accented)
    return replace(found, semitones=max(0.0, found.semitones), syllable=span, level=True)


def _peaks(heights: NDArray[np.float64], corners: NDArray[np.intp], reach: int) -> list[int]:
    """Tops at corners higher than their neighbours; at the ends, where that says little, above a fall or a climb."""
    found = heights[corners]
    around = np.concatenate(([-np.inf], found, [-np.inf]))
    higher = (found > around[:-2]) & (found >= around[2:])
    higher[0] &= _climb(found[::-1]) >= TOLERANCE
    higher[-1] &= _climb(found) >= TOLERANCE
    sides = np.pad(corners, 1, mode="edge")
    return [_top(heights, corners[n], sides[n], sides[n + 2], reach) for n in np.flatnonzero(higher)]


def _climb(found: NDArray[np.float64]) -> float:
    """How far the last corner is above where the melody last turned up."""
    falls = np.flatnonzero(np.diff(found) < 0)
    return float(found[-1] - found[falls[-1] + 1 if falls.size else 0])


def _top(heights: NDArray[np.float64], corner: int, before: int, after: int, reach: int) -> int:
    """The highest place near a corner, between its neighbours: a corner at an end is seldom the top itself."""
    first, stop = max(before, corner - reach), min(after, corner + reach) + 1
    return int(first + np.argmax(heights[first:stop]))


def _in_turn(peaks: Sequence[Extremum], heights: NDArray[np.float64], utterance: Utterance) -> tuple[Extremum, ...]:
    """The maxima, and the lowest place before, between and behind them; halfway where one is a level accent."""
    step = utterance.pitch.step
    places = [-1, *(_place(peak.time, step) for peak in peaks), heights.size]
    out: list[Extremum] = []
    for number, (before, after) in enumerate(pairwise(places)):
        if number:
            out.append(peaks[number - 1])
        if after - before > 1:
            level = 0 < number < len(peaks) and (peaks[number - 1].level or peaks[number].level)
            lowest = (before + after) // 2 if level else before + 1 + int(np.argmin(heights[before + 1 : after]))
            out.append(_extremum("minimum", lowest, heights, utterance, {}))
    return tuple(out)


def _place(time: float, step: float) -> int:
    return round(time / step - 0.5)


def _extremum(
    kind: Literal["maximum", "minimum"],
    place: int,
    heights: NDArray[np.float64],
    utterance: Utterance,
    accented: dict[int, tuple[float, float]],
) -> Extremum:
    time = min(utterance.duration, (place + 0.5) * utterance.pitch.step)
    word = _owner(time, utterance, accented)
    return Extremum(
        kind=kind, time=snap(time), semitones=snap(float(heights[place])), word=word,
        syllable=None if word is None else accented.get(word),
    )  # fmt: skip


def _owner(time: float, utterance: Utterance, accented: dict[int, tuple[float, float]]) -> int | None:
    """The accented word whose syllable is nearest, if within reach; else the word that sounds."""
    words = utterance.words
    near = [
        (max(syllable[0] - time, time - syllable[1], 0.0), word)
        for word, syllable in accented.items()
        if words[word].onset - REACH <= time <= words[word].onset + words[word].duration + REACH
    ]
    if near:
        return min(near)[1]
    return next((n for n, one in enumerate(words) if one.onset <= time < one.onset + one.duration), None)


def _accented(utterance: Utterance) -> dict[int, tuple[float, float]]:
    """The accented syllable of each accented word: around its primarily stressed vowel."""
    phones: dict[int, list[Phone]] = {}
    for phone in utterance.phones:
        if phone.word is not None and utterance.words[phone.word].accent:
            phones.setdefault(phone.word, []).append(phone)
    return {word: syllable(own) for word, own in phones.items()}


def syllable(phones: Sequence[Phone]) -> tuple[float, float]:
    """Onset and end of a word's stressed syllable, s from where the phones' onsets count.

    It is the vowel with primary stress (the first vowel, where none is marked), the consonants before it and those
    behind it; of consonants between two vowels the last one belongs to the second, at a word's edge all do.

    Args:
        phones: Of one word, at least one.
    """
    vowels = [n for n, phone in enumerate(phones) if is_nucleus(phone.ipa)] or [0]
    stressed = [n for n, phone in enumerate(phones) if phone.stress == 1]
    nucleus = next((n for n in vowels if stressed and n >= stressed[0]), stressed[0] if stressed else vowels[0])
    before = max((n for n in vowels if n < nucleus), default=-1)
    after = min((n for n in vowels if n > nucleus), default=len(phones))
    first = 0 if before < 0 else max(before + 1, nucleus - 1)
    last = len(phones) - 1 if after == len(phones) else max(nucleus, after - 2)
    return snap(phones[first].onset), snap(phones[last].onset + phones[last].duration)
