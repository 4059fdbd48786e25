"""Any language in a recording: the transcript spoken by eSpeak NG, and its sound bent in time until it fits.

Both sounds are told as mel-frequency cepstra each 10 ms; dynamic time warping (Sakoe & Chiba 1978) finds the cheapest
way through both, first roughly, then finely around that way. A silence of the recording costs nothing wherever the
transcript has a word's edge.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import InputError
from scorebreath.signal.resample import resample
from scorebreath.spans import Span, join
from scorebreath.speech.model import Speech, SpeechRequest
from scorebreath.speech.recording.model import Alignment, HeardPhone, HeardWord, Take, Written
from scorebreath.speech.recording.pronounce import Pronouncer

NAME = "espeak-ng and dynamic time warping"
RATE = 16_000
HOP = 160
"""frames: 10 ms"""
WINDOW = 400
BANDS, CEPSTRA = 26, 13
ROUGH = 4
"""Steps that are one in the first, rough pass"""
BAND = 60
"""Steps to both sides of the rough way that the fine one may take"""
LONGEST = 600.0
"""s; what is longer takes too much memory"""
SLOWEST, FASTEST = 0.25, 4.0
"""Times as long as eSpeak NG takes, all in all, that a recording of the same text may be"""
SKIPPED = 0.1
"""Cost of a silent step of the recording, beside a step that fits usually"""
BETWEEN = 0.15
"""s of silence put around each phrase of the other sound, so that a silence of the recording has where to be"""
SILENT_DB = -27.0
"""dB re the loudest step: silence, and most breaths"""

Floats = NDArray[np.float64]


def align(take: Take, written: Sequence[Written], say: Pronouncer) -> Alignment:
    """Find the words of a transcript in any language that eSpeak NG speaks.

    Args:
        take: The recording.
        written: Its transcript.
        say: Speaks it.

    Raises:
        InputError: It is too long, or takes a time that the transcript cannot take.
    """
    if take.duration > LONGEST:
        raise InputError(
            f"{take.path}: lasts {take.duration / 60:.0f} min; expected at most {LONGEST / 60:.0f} for this language: "
            "cut it where it is silent, or give a TextGrid or times of words"
        )
    spoken = _spoken(written, say)
    sound, words = _joined(spoken)
    own = _features(take.samples, take.sample_rate)
    other = _features(sound, spoken[0].sample_rate if spoken else RATE)
    heard, told = np.count_nonzero(~own[1]), np.count_nonzero(~other[1])
    if not told or not SLOWEST < heard / told < FASTEST:
        raise InputError(
            f"{take.path}: speaks for {heard * HOP / RATE:.1f} s, and the transcript takes about "
            f"{told * HOP / RATE:.1f} s to say; expected the recording of the transcript"
        )
    way = _way(own, other)
    found = [_found(phones, written[place], place, way) for place, phones in enumerate(words) if phones]
    return Alignment(words=tuple(_ordered(found)), mismatches=(), by=NAME)


def _spoken(written: Sequence[Written], say: Pronouncer) -> list[Speech]:
    """Each phrase as eSpeak NG says it, its words' sources their places."""
    requests: list[SpeechRequest] = []
    pieces: list[tuple[str, Span]] = []
    for place, word in enumerate(written):
        pieces.append((" ".join(word.spoken) or word.text, Span(place, place + 1)))
        if word.phrase_ends or place == len(written) - 1:
            text = join([part for piece in pieces for part in (piece, (" ", None))][:-1])
            requests.append(SpeechRequest(text=text, closing="final"))
            pieces = []
    return say.say(requests)


def _joined(spoken: Sequence[Speech]) -> tuple[NDArray[np.float32], list[list[tuple[str, int, float, float]]]]:
    """One sound of all; and of each word its phones: IPA, stress, start and end, s."""
    words: list[list[tuple[str, int, float, float]]] = []
    rest = np.zeros(round(BETWEEN * (spoken[0].sample_rate if spoken else RATE)), dtype=np.float32)
    sounds, begun = [rest], BETWEEN
    for speech in spoken:
        for word in speech.words:
            place = word.source[0] if word.source else len(words)
            while len(words) <= place:
                words.append([])
        for phone in speech.phones:
            if phone.ipa and phone.word is not None and (source := speech.words[phone.word].source):
                onset = begun + phone.onset
                words[source[0]].append((phone.ipa, phone.stress, onset, onset + phone.duration))
        sounds += [speech.samples, rest]
        begun += speech.duration + len(rest) / speech.sample_rate
    return np.concatenate(sounds), words


def _features(samples: NDArray[np.float32], sample_rate: int) -> tuple[Floats, NDArray[np.bool_]]:
    """(n, 2 * CEPSTRA) cepstra and their slopes, brought to one mean and spread; and which steps are silent, (n,)."""
    sound = samples if sample_rate == RATE else resample(samples, sample_rate, RATE)
    padded = np.concatenate((np.zeros(WINDOW // 2), np.asarray(sound, dtype=np.float64), np.zeros(WINDOW)))
    padded[1:] -= 0.97 * padded[:-1]
    count = max(1, len(sound) // HOP)
    frames = np.lib.stride_tricks.sliding_window_view(padded, WINDOW)[::HOP][:count]
    power = np.square(np.abs(np.fft.rfft(frames * np.hanning(WINDOW), 512)))
    energy = np.log(power @ _bands().T + 1e-9)
    level = 10 * np.log10(power.sum(axis=1) + 1e-12)
    silent = level < level.max() + SILENT_DB
    basis = np.cos(np.pi / BANDS * (np.arange(BANDS) + 0.5)[None, :] * np.arange(1, CEPSTRA + 1)[:, None])
    cepstra = energy @ basis.T
    slopes = np.gradient(cepstra, axis=0) if len(cepstra) > 1 else np.zeros_like(cepstra)
    both = np.concatenate((cepstra, 2.0 * slopes), axis=1)
    heard = both[~silent] if (~silent).any() else both
    return (both - heard.mean(axis=0)) / (heard.std(axis=0) + 1e-6), silent


def _bands() -> Floats:
    """(BANDS, 257) triangles on the mel scale."""
    mel = np.linspace(0.0, 2595 * np.log10(1 + 8000 / 700), BANDS + 2)
    edges = 700 * (10 ** (mel / 2595) - 1) / RATE * 512
    place = np.arange(257)
    rising = (place[None, :] - edges[:-2, None]) / (edges[1:-1] - edges[:-2])[:, None]
    falling = (edges[2:, None] - place[None, :]) / (edges[2:] - edges[1:-1])[:, None]
    return np.asarray(np.maximum(0.0, np.minimum(rising, falling)))


def _way(own: tuple[Floats, NDArray[np.bool_]], other: tuple[Floats, NDArray[np.bool_]]) -> Floats:
    """For each step of the other sound, and one behind its end: the step of the recording that it is at."""
    rough = [
        (_thinned(sound), _thinned(silent[:, None].astype(np.float64))[:, 0] > 0.5) for sound, silent in (own, other)
    ]
    corridor = _warped(*rough[0], *rough[1], None)
    centre = np.interp(np.arange(len(other[0])), np.arange(len(corridor)) * ROUGH, corridor * ROUGH)
    return _warped(*own, *other, centre)


def _thinned(values: Floats) -> Floats:
    """The mean of every few rows."""
    count = max(1, len(values) // ROUGH)
    return np.asarray(values[: count * ROUGH].reshape(count, -1, values.shape[1]).mean(axis=1))


def _warped(
    own: Floats, quiet: NDArray[np.bool_], other: Floats, still: NDArray[np.bool_], centre: Floats | None
) -> Floats:
    """For each step of the other sound: the mean step of the recording it is said at.

    Rows are steps of the other sound; within a row the cheapest way along the recording is a running minimum, since
    each step on costs what it costs wherever it began.
    """
    rows, columns = len(other), len(own)
    width = columns if centre is None else min(columns, 2 * BAND + 1)
    starts = np.zeros(rows, dtype=np.int64)
    if centre is not None:
        starts = np.clip(np.round(centre).astype(np.int64) - BAND, 0, columns - width)
        starts = np.maximum.accumulate(starts)
    last = np.full(width, np.inf)
    came = np.zeros((rows, width), dtype=np.int8)
    norms = np.square(own).sum(axis=1)
    usual = float(other.shape[1])
    for row in range(rows):
        first = int(starts[row])
        part = slice(first, first + width)
        cost = np.sqrt(np.maximum(0.0, norms[part] + np.square(other[row]).sum() - 2.0 * own[part] @ other[row]))
        cost = cost / np.sqrt(usual)
        cost[quiet[part] != still[row]] += 1.0
        along = np.where(quiet[part], SKIPPED, cost)  # staying at this row while the recording goes on
        above = np.full(width, np.inf)
        diagonal = np.full(width, np.inf)
        if row:
            shift = first - int(starts[row - 1])
            above[: width - shift] = last[shift:]
            if shift:
                diagonal[: width - shift + 1] = last[shift - 1 :]
            else:
                diagonal[1:] = last[:-1]
            enter = np.minimum(above, diagonal) + cost
        else:
            enter = np.where(np.arange(width) == 0, cost, np.inf)
        total = np.cumsum(along)
        base = enter - total
        lowest = np.minimum.accumulate(base)
        last = lowest + total
        came[row] = np.where(base <= lowest, np.where(diagonal <= above, 1, 2), 0)
    return _traced(came, starts, columns)


def _traced(came: NDArray[np.int8], starts: NDArray[np.int64], columns: int) -> Floats:
    """From the end back to the beginning: the first step of the recording at which each row is."""
    rows, width = came.shape
    found = np.zeros(rows + 1)
    found[rows] = columns
    row, column = rows - 1, min(width - 1, columns - 1 - int(starts[rows - 1]))
    while row >= 0:
        step = came[row, column]
        if step == 0 and column > 0:
            column -= 1
            continue
        found[row] = starts[row] + column
        if row == 0:
            break
        place = int(starts[row]) + column - (1 if step == 1 else 0)
        row -= 1
        column = max(0, min(width - 1, place - int(starts[row])))
    return found


def _found(phones: Sequence[tuple[str, int, float, float]], word: Written, place: int, way: Floats) -> HeardWord:
    """A word with its phones where the recording has them."""

    def there(time: float) -> float:
        return float(np.interp(time * RATE / HOP, np.arange(len(way)), way)) * HOP / RATE

    heard = tuple(
        HeardPhone(ipa=ipa, stress=stress, start=there(start), end=there(end)) for ipa, stress, start, end in phones
    )
    return HeardWord(word=place, text=word.text, start=heard[0].start, end=heard[-1].end, phones=heard)


def _ordered(words: Sequence[HeardWord]) -> Sequence[HeardWord]:
    """None before the one before it ends: the way never goes back."""
    return sorted(words, key=lambda word: word.word or 0)
