"""Silences of a recording: where exactly speech falls silent and begins again, and the breaths in between.

Whoever found the words knows their edges to a hundredth of a second or worse, and counts breaths among the silence or
the words as it comes. So the level decides: within a few hundredths of a second of the edge that was told, speech ends
where the sound falls to the floor (physiology 9.2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from scorebreath.signal.level import active_db, level_db
from scorebreath.signal.pitch import pitch_hertz
from scorebreath.speech.recording.model import HeardBreath, HeardWord, Take

STEP = 0.005
"""s between two levels"""
GAP = 0.06
"""s that two words must be apart for a silence between them"""
REACH = 0.06
"""s that an edge is moved at most"""
ABOVE_FLOOR = 8.0
"""dB above the recording's own noise, from which on there is sound"""
DEEPEST, SHALLOWEST = -45.0, -28.0
"""dB re the speech, between which that lies in any case"""
SOFT = -18.0
"""dB re the speech; breaths are below, nearly all of speech is above"""
NEAR = 0.08
"""s from a silence, at which the edge of a word belongs to it"""
LEAST_WORD = 0.03
"""s of a word that are left"""
LONG_SOFT = 0.15
"""s; no closure of a consonant lasts as long"""
BREATH_DB = -48.0
"""dB re the speech; what is softer is no breath that anybody hears"""
LOUDEST_BREATH = -6.0
"""dB re the speech; what is louder is none"""
SHORTEST_BREATH, LONGEST_BREATH = 0.1, 2.0
"""s"""
JOINED = 0.08
"""s of silence inside a breath"""
VOICED = 0.25
"""Share of a breath that may seem to have a pitch"""
HIGH = 500.0
"""Hz; most of a breath is above, most of a hum below"""
FLOOR_SHARE = 0.1
"""Quantile of the levels of the silences that is taken for the recording's noise"""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Levels:
    """How loud a recording is over time, and what of it is speech."""

    db: NDArray[np.float64]
    """each `STEP`, re full scale"""
    floor: float
    """dB, of its noise"""
    speech: float
    """dB, of what is said"""

    @classmethod
    def of(cls, take: Take, words: Sequence[HeardWord]) -> Levels:
        """Of a recording whose words are known."""
        db = level_db(take.samples, take.sample_rate, STEP)
        silent = np.ones(len(db), dtype=bool)
        for word in words:
            silent[int(word.start / STEP) : int(word.end / STEP) + 1] = False
        quiet = db[silent] if silent.any() else db
        said = [take.samples[_at(word.start, take) : _at(word.end, take)] for word in words]
        return cls(
            db=db, floor=float(np.quantile(quiet, FLOOR_SHARE)),
            speech=active_db(np.concatenate(said) if said else take.samples, take.sample_rate),
        )  # fmt: skip

    @property
    def sounding(self) -> float:
        """Level from which on there is sound, dB."""
        return min(max(self.floor + ABOVE_FLOOR, self.speech + DEEPEST), self.speech + SHALLOWEST)

    def loud(self, time: float) -> bool:
        """Whether there is sound at a time."""
        place = int(time / STEP)
        return 0 <= place < len(self.db) and bool(self.db[place] >= self.sounding)


def parted(take: Take, words: Sequence[HeardWord], levels: Levels) -> list[HeardWord]:
    """Words with the silences between them that whoever found them has counted as theirs.

    What is softer than `SOFT` for `LONG_SOFT` or more, where one word is said to end and the other to begin, is no part
    of either.
    """
    out = list(words)
    soft = np.flatnonzero(np.concatenate(([False], levels.db < levels.speech + SOFT, [False])))
    runs = [run for run in np.split(soft, np.flatnonzero(np.diff(soft) > JOINED / STEP) + 1) if len(run)]
    spans = [((int(run[0]) - 1) * STEP, int(run[-1]) * STEP) for run in runs if len(run) * STEP >= LONG_SOFT]
    for place in range(1, len(out)):
        before, behind = out[place - 1], out[place]
        near = [span for span in spans if span[0] - NEAR <= behind.start and span[1] + NEAR >= before.end]
        for start, end in sorted(near, key=lambda span: span[0] - span[1])[:1]:
            out[place - 1] = _ending(before, max(start, before.start + LEAST_WORD))
            out[place] = _beginning(behind, max(min(end, behind.end - LEAST_WORD), out[place - 1].end))
    return out


def settled(take: Take, words: Sequence[HeardWord], levels: Levels, *, exact: bool = False) -> list[HeardWord]:
    """Words whose edges at silences are where the sound begins and ends; small gaps between words are closed.

    Args:
        take: The recording.
        words: As they were found.
        levels: Of the recording.
        exact: Whether edges at silences are known better than by level.
    """
    out = list(words)
    for place in range(len(out) + 1):
        before = out[place - 1] if place else None
        behind = out[place] if place < len(out) else None
        start = before.end if before else 0.0
        end = behind.start if behind else take.duration
        if before and behind and end - start < GAP:
            middle = (start + end) / 2
            out[place - 1], out[place] = _ending(before, middle), _beginning(behind, middle)
            continue
        if exact:
            continue
        if before:
            out[place - 1] = _ending(before, _last_sound(before, min(end, start + REACH), levels))
        if behind:
            earliest = max(out[place - 1].end if before else 0.0, end - REACH)
            out[place] = _beginning(behind, _first_sound(behind, earliest, levels))
    return out


def _last_sound(word: HeardWord, latest: float, levels: Levels) -> float:
    """Where a word falls silent."""
    end = word.end
    if levels.loud(end):
        while levels.loud(end) and end < latest:
            end += STEP
        return word.end if end >= latest else end
    earliest = max((word.start + word.end) / 2, word.end - REACH)
    while not levels.loud(end - STEP) and end > earliest:
        end -= STEP
    return end


def _first_sound(word: HeardWord, earliest: float, levels: Levels) -> float:
    """Where a word begins to sound."""
    start = word.start
    if levels.loud(start):
        while levels.loud(start - STEP) and start > earliest:
            start -= STEP
        return word.start if start <= earliest else start
    latest = min((word.start + word.end) / 2, word.start + REACH)
    while not levels.loud(start) and start < latest:
        start += STEP
    return start


def _ending(word: HeardWord, end: float) -> HeardWord:
    """The word ending elsewhere; its last phone with it."""
    phones = word.phones
    if phones:
        kept = [phone for phone in phones if phone.start < end] or [phones[0]]
        phones = (*kept[:-1], replace(kept[-1], end=end))
    return replace(word, end=end, phones=phones)


def _beginning(word: HeardWord, start: float) -> HeardWord:
    """The word beginning elsewhere; its first phone with it."""
    phones = word.phones
    if phones:
        kept = [phone for phone in phones if phone.end > start] or [phones[-1]]
        phones = (replace(kept[0], start=start), *kept[1:])
    return replace(word, start=start, phones=phones)


def breath_in(take: Take, start: float, end: float, levels: Levels) -> HeardBreath | None:
    """The longest breath in a silence; None: there is none to be heard.

    A breath is soft, lasts, has no pitch, and most of it is above 500 Hz.

    Args:
        take: The recording.
        start: s, of the silence.
        end: s.
        levels: Of the recording.
    """
    least = max(levels.floor + ABOVE_FLOOR, levels.speech + BREATH_DB)
    first, last = round(start / STEP) + 1, round(end / STEP) - 1
    loud = np.flatnonzero(levels.db[first:last] >= least)
    best: HeardBreath | None = None
    for run in np.split(loud, np.flatnonzero(np.diff(loud) > JOINED / STEP) + 1) if len(loud) else ():
        begin, over = (first + int(run[0])) * STEP, (first + int(run[-1]) + 1) * STEP
        long = SHORTEST_BREATH <= over - begin <= LONGEST_BREATH
        if long and _breathes(take, begin, over, levels) and (not best or over - begin > best.end - best.start):
            best = HeardBreath(start=begin, end=over)
    return best


def _breathes(take: Take, start: float, end: float, levels: Levels) -> bool:
    sound = np.asarray(take.samples[_at(start, take) : _at(end, take)], dtype=np.float64)
    if active_db(sound, take.sample_rate) > levels.speech + LOUDEST_BREATH:
        return False
    power = np.square(np.abs(np.fft.rfft(sound)))
    above = np.fft.rfftfreq(len(sound), 1.0 / take.sample_rate) >= HIGH
    if power[above].sum() < 0.5 * power.sum():
        return False
    hertz = pitch_hertz(sound, take.sample_rate)
    return bool(len(hertz) == 0 or np.mean(hertz > 0) <= VOICED)


def _at(time: float, take: Take) -> int:
    return min(len(take.samples), max(0, round(time * take.sample_rate)))
