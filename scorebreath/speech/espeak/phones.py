"""From events to phones: contiguous, with pauses, stress, and closures where the sound has them.

An event marks where the library starts a piece of sound. For a stop that is about the burst; the closure before it is
heard as part of the stop and seen as closed lips, so the run of near silence before the event is given to the stop.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from scorebreath.speech.espeak.library import PHONEME, WORD, Event

STOPS = tuple("pbtdkɡgqɢcɟʈɖʔʡʦʣʧʤ")
"""First symbols of stops and affricates."""
STRESS = {"ˈ": 1, "ˌ": 2}
MODIFIERS = frozenset("ːˑʰʲʷˠˤᵝ")
"""Alone they are no phone, but belong to the one before."""
PLAIN = (("tS", "tʃ"), ("dZ", "dʒ"), ("N", "ŋ"), ("S", "ʃ"), ("Z", "ʒ"), ("A", "ɑ"), ("g", "ɡ"))
"""What some languages' phonemes are written as instead of IPA."""
_LEFTOVERS = re.compile(r'[#"^`\[\].\-_|;!*]+')
_NEAR_SILENCE = 0.003
"""of the peak (-50 dB)"""
_SHORTEST_CLOSURE = 0.004
"""s"""
_BURST_BEFORE, _BURST_AFTER = 0.016, 0.010
"""s around the event in which a closure may end"""
_LEAST = 0.005
"""s left to the phone before a closure, and given to a phone that has no length of its own"""
_SHARE = 0.4
"""of the phone before, for a phone that has no length of its own (the l of "well" is one sound with its vowel)"""
_SHARE_MOST = 0.06
"""s"""
_SHORTEST = 0.001
"""s; less is no length"""


class Piece(NamedTuple):
    """A phone or a pause, in frames."""

    ipa: str
    """empty for a pause"""
    start: int
    stress: int = 0
    event: int | None = None
    """number of the word event it follows; None for a pause"""
    until: int = 0
    """where the library ends a pause; the next phone may start later"""


def pieces(events: Sequence[Event], samples: NDArray[Any], sample_rate: int) -> tuple[Piece, ...]:
    """Phones and pauses of a sound.

    Args:
        events: Words and phonemes in order, in frames of `samples`.
        samples: (n,) floats from the first to the last sound, n > 0.
        sample_rate: Hz.

    Returns:
        Ascending starts, the first 0, all below n; each lasts until the next one starts, the last until n. No two
        pauses follow one another. Empty when nothing is said.
    """
    found = _read(events)
    if not any(piece.ipa for piece in found):
        return ()
    found = _sounding(found, len(samples))
    found = _with_closures(found, _quiet_runs(samples, sample_rate), sample_rate)
    return tuple(_with_lengths(found, len(samples), sample_rate))


def _read(events: Sequence[Event]) -> list[Piece]:
    """One piece for each phoneme event that has a sound or a length; a pause ends where the next event is."""
    out: list[Piece] = []
    word = -1
    for index, event in enumerate(events):
        if event.type == WORD:
            word += 1
        elif event.type == PHONEME:
            ipa, stress = _symbol(event.ipa)
            if event.ipa.startswith("("):  # the name of a language it changes to
                continue
            if ipa and out and out[-1].ipa and all(_modifies(symbol) for symbol in ipa):
                out[-1] = out[-1]._replace(ipa=out[-1].ipa + ipa)
            elif ipa:
                out.append(Piece(ipa=ipa, start=event.sample, stress=stress, event=max(word, 0)))
            elif index + 1 < len(events) and events[index + 1].sample > event.sample:
                until = events[index + 1].sample
                if out and not out[-1].ipa:
                    out[-1] = out[-1]._replace(until=until)
                else:
                    out.append(Piece(ipa="", start=event.sample, until=until))
    return out


def _symbol(written: str) -> tuple[str, int]:
    """IPA without stress marks, and the stress."""
    stress = next((STRESS[symbol] for symbol in written if symbol in STRESS), 0)
    ipa = "".join(symbol for symbol in written if symbol not in STRESS)
    ipa = _LEFTOVERS.sub("", ipa)
    for plain, right in PLAIN:
        ipa = ipa.replace(plain, right)
    return ipa, stress


def _modifies(symbol: str) -> bool:
    return symbol in MODIFIERS or "\u0300" <= symbol <= "\u036f"


def _sounding(found: list[Piece], frames: int) -> list[Piece]:
    """Starts inside the sound and ascending; no pause at its beginning or end."""
    out: list[Piece] = []
    at = 0
    for piece in found:
        at = min(max(piece.start, at), frames)
        out.append(piece._replace(start=at))
    while out and not out[-1].ipa:
        out.pop()
    while out and not out[0].ipa:
        out.pop(0)
    out[0] = out[0]._replace(start=0)
    return out


def _quiet_runs(samples: NDArray[Any], sample_rate: int) -> NDArray[np.int64]:
    """(m, 2) half-open frame ranges of near silence that are long enough for a closure."""
    loudness = np.abs(samples)
    quiet = loudness <= _NEAR_SILENCE * loudness.max(initial=0)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], quiet, [False])).astype(np.int8)))
    runs = edges.reshape(-1, 2)
    return runs[runs[:, 1] - runs[:, 0] >= _SHORTEST_CLOSURE * sample_rate]


def _with_closures(found: list[Piece], runs: NDArray[np.int64], sample_rate: int) -> list[Piece]:
    """Start each stop at its closure: after the pause before it, and not within the phone before."""
    least = round(_LEAST * sample_rate)
    ends = runs[:, 1]
    for index, piece in enumerate(found):
        if index == 0 or not piece.ipa.startswith(STOPS):
            continue
        before = found[index - 1]
        first = int(np.searchsorted(ends, piece.start - _BURST_BEFORE * sample_rate))
        for begin, end in runs[first:].tolist():
            if end > piece.start + _BURST_AFTER * sample_rate or begin >= piece.start:
                # a run around the event that goes on long after it is a pause, not this stop's closure
                break
            earliest = before.start + least if before.ipa else before.until
            found[index] = piece._replace(start=min(max(begin, earliest), piece.start))
    return found


def _with_lengths(found: list[Piece], frames: int, sample_rate: int) -> list[Piece]:
    """Give those without a length a share of the phone before, or, after a pause, of the one that follows."""
    starts = [piece.start for piece in found] + [frames]
    some = _SHORTEST * sample_rate
    index = 0
    while index < len(found):
        last = index
        while last < len(found) and starts[last + 1] - starts[index] < some:
            last += 1
        count = last - index
        if count and index and found[index - 1].ipa:
            room = min(_SHARE * (starts[index] - starts[index - 1]), _SHARE_MOST * sample_rate * count)
            for number in range(count):
                starts[index + number] = round(starts[last] - room * (count - number) / count)
        elif count and last < len(found):
            room = min(_SHARE * (starts[last + 1] - starts[last]), _SHARE_MOST * sample_rate * count)
            for number in range(count):
                starts[index + number + 1] = round(starts[index] + room * (number + 1) / count)
        index = last + 1
    for number in range(1, len(found)):
        starts[number] = max(starts[number], starts[number - 1] + 1)
    for number in range(len(found) - 1, 0, -1):
        starts[number] = min(starts[number], starts[number + 1] - 1)
    return [piece._replace(start=start) for piece, start in zip(found, starts, strict=False)]
