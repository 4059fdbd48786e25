"""A recorded breath made ready: found in its recording, brought to one level, made as long as any breath.

A breath's **level** is that of its loud tenth: nine in ten of its 10 ms steps are below it, so that a click of the
lips does not count. Its **hold** is where it is at most 6 dB below that level: the part at least half as loud as the
loudest, as `Noise.level_db` has it (physiology 9.2).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from scorebreath.signal.level import STEP, level_db, step_edges
from scorebreath.signal.limit import PeakLimiter
from scorebreath.signal.paulstretch import FADE, WINDOW, paulstretch
from scorebreath.units import FLOOR_DB, amplitude

SOUNDING_DB = -26.0
"""Steps this far below the loudest one are silence: air at a sixth of the flow is as quiet (physiology 3.1)."""
PAUSE = 0.5
"""s of silence that a breath may hold: between two sniffs, between two puffs"""
HOLD_DB = -6.0
LOUD_SHARE = 0.9
"""Share of a breath's steps that are below its level."""
FLICKER = 0.05
"""s; noise is never even: what is shorter does not end a hold"""
TARGET_DB = -20.0
"""RMS of the hold of every recording, dB re full scale (physiology 9.2)"""
EDGE = 0.005
"""s over which a cut recording fades in and out"""
EVENNESS = 0.25
"""s over which a stretched breath is brought to one level"""

Samples = NDArray[np.float32]


class Span(NamedTuple):
    """Some frames of a sound."""

    start: int
    stop: int
    """half-open"""

    @property
    def frames(self) -> int:
        """How many."""
        return self.stop - self.start


def sounding_spans(samples: NDArray[Any], sample_rate: float) -> tuple[Span, ...]:
    """The sounds in a recording: what is within 26 dB of its loudest 10 ms, apart by more than half a second.

    Args:
        samples: (n,) floats.
        sample_rate: Hz.

    Returns:
        In order of time; none where there is only silence.
    """
    levels = level_db(samples, sample_rate)
    if levels.max(initial=FLOOR_DB) <= FLOOR_DB:
        return ()
    loud = levels >= max(levels.max() + SOUNDING_DB, FLOOR_DB + 1e-9)
    return _spans(loud, step_edges(len(samples), sample_rate, STEP), round(PAUSE / STEP))


def loudest(samples: NDArray[Any], spans: tuple[Span, ...]) -> Span:
    """The span with the most energy; the first of equals."""
    return max(spans, key=lambda span: float(np.sum(np.square(samples[span.start : span.stop], dtype=np.float64))))


def hold_span(samples: NDArray[Any], sample_rate: float) -> Span:
    """The longest stretch of a breath at most 6 dB below its level, lapses shorter than 50 ms included.

    Args:
        samples: (n,) floats, a sound without silence around it, n > 0.
        sample_rate: Hz.
    """
    levels = level_db(samples, sample_rate)
    loud = levels >= np.quantile(levels, LOUD_SHARE) + HOLD_DB
    spans = _spans(loud, step_edges(len(samples), sample_rate, STEP), round(FLICKER / STEP))
    return max(spans, key=lambda span: span.frames)


def hold_db(samples: NDArray[Any], sample_rate: float) -> float:
    """RMS of all steps of a breath at most 6 dB below its level, and none louder by more than that; dB re full scale.

    Args:
        samples: (n,) floats, a sound without silence around it, n > 0.
        sample_rate: Hz.
    """
    levels = level_db(samples, sample_rate)
    held = levels[np.abs(levels - np.quantile(levels, LOUD_SHARE)) <= -HOLD_DB]
    return float(10.0 * np.log10(np.mean(10.0 ** (held / 10.0))))


def at_target(samples: NDArray[Any], sample_rate: float) -> tuple[Samples, float]:
    """A breath whose hold has -20 dBFS, its edges faded and clicks limited to -1 dBFS; and by how many dB it was moved.

    Args:
        samples: (n,) floats, n > 0, not silent.
        sample_rate: Hz.
    """
    gain = TARGET_DB - hold_db(samples, sample_rate)
    moved = np.asarray(samples, dtype=np.float64) * amplitude(gain)
    length = min(len(moved) // 2, round(EDGE * sample_rate))
    ramp = (np.arange(length) + 0.5) / max(1, length)
    moved[:length] *= ramp
    moved[len(moved) - length :] *= ramp[::-1]
    limited = np.concatenate(list(PeakLimiter().limit([moved.astype(np.float32)])))
    return limited, gain


def sustained(samples: NDArray[Any], sample_rate: float, seconds: float, seed: int) -> tuple[Samples, float]:
    """A breath's hold, stretched until it lasts (B44, B45), as loud everywhere: a breath of any length begins anywhere.

    What fades at the ends of the stretched sound is cut off.

    Args:
        samples: (n,) floats, the breath's hold, longer than `shortest_hold`.
        sample_rate: Hz.
        seconds: How long it shall be.
        seed: Of the phases.

    Returns:
        (round(seconds * sample_rate),), and how much it was stretched; 1.0 where it was long enough.
    """
    frames = round(seconds * sample_rate)
    if len(samples) >= frames:
        middle = (len(samples) - frames) // 2
        return even(samples[middle : middle + frames], sample_rate), 1.0
    usable = len(samples) / sample_rate - FADE - WINDOW
    stretch = max(1.0, (seconds + WINDOW) / usable)
    made = paulstretch(samples, sample_rate, stretch, seed=seed)
    begin = round(WINDOW / 2 * sample_rate) + 1
    return even(made[begin : begin + frames], sample_rate), stretch


def shortest_hold() -> float:
    """Seconds of a hold that can be stretched: a window, what fades, and a little that is neither."""
    return 2 * FADE + WINDOW


def even(samples: NDArray[Any], sample_rate: float) -> Samples:
    """A sound of one level: every quarter of a second as loud as the whole, whatever is shorter left as it is.

    Args:
        samples: (n,) floats.
        sample_rate: Hz.
    """
    sound = np.asarray(samples, dtype=np.float64)
    width = max(1, min(len(sound), round(EVENNESS * sample_rate)))
    sums = np.concatenate(([0.0], np.cumsum(np.square(sound))))
    centre = np.arange(len(sound))
    low, high = np.maximum(centre - width // 2, 0), np.minimum(centre + width // 2 + 1, len(sound))
    local = (sums[high] - sums[low]) / (high - low)
    whole = sums[-1] / max(1, len(sound))
    return np.asarray(sound * np.sqrt(whole / np.maximum(local, whole * 1e-3 + 1e-30)), dtype=np.float32)


def _spans(loud: NDArray[np.bool_], edges: NDArray[np.int64], gap: int) -> tuple[Span, ...]:
    """Runs of loud steps, as frames; those less than `gap` steps apart are one."""
    steps = np.flatnonzero(loud)
    breaks = np.flatnonzero(np.diff(steps) > gap)
    begins, ends = np.append(0, breaks + 1), np.append(breaks, len(steps) - 1)
    return tuple(Span(int(edges[steps[b]]), int(edges[steps[e] + 1])) for b, e in zip(begins, ends, strict=True))
