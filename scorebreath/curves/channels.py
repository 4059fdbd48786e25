"""The table of channels. A new channel is a row here: name, unit, range, meaning, and how it is sampled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from scorebreath.curves.sources import Moments
from scorebreath.curves.tracks import Array
from scorebreath.units import FLOOR_DB


@dataclass(frozen=True, slots=True)
class Channel:
    """One curve."""

    name: str
    unit: str
    """empty for a plain ratio"""
    low: float
    high: float
    clamped: bool
    """whether values are held within `low` and `high`; elsewhere these say what to expect"""
    meaning: str
    sample: Callable[[Moments], Array]
    """(n,) values at n moments"""

    def at(self, moments: Moments) -> Array:
        """Values at the moments, clamped where the table says so; (n,)."""
        values = self.sample(moments)
        return np.clip(values, self.low, self.high) if self.clamped else values


CHANNELS: tuple[Channel, ...] = (
    Channel(
        "lung_volume", "", 0, 1, False, "air in the lungs: fraction of vital capacity above residual volume",
        lambda m: m.volume,
    ),
    Channel(
        "thorax_volume", "", -1, 1, False, "the chest's share of lung_volume above the resting level, fraction of VC",
        lambda m: m.thorax_share * m.above_rest,
    ),
    Channel(
        "abdomen_volume", "", -1, 1, False, "the belly's share of it; the two add up to lung_volume - resting level",
        lambda m: (1.0 - m.thorax_share) * m.above_rest,
    ),
    Channel(
        "thorax", "", -1, 1, True, "chest shape: 0 at rest, 1 a full inspiration",
        lambda m: m.above_rest * m.factor("thorax") * m.tremor,
    ),
    Channel(
        "abdomen", "", -1, 1, True, "belly shape: 0 at rest, 1 a full inspiration",
        lambda m: m.above_rest * m.factor("abdomen"),
    ),
    Channel(
        "shoulder", "", 0, 1, True, "shoulders raised by the breath",
        lambda m: m.above_rest * m.factor("shoulder"),
    ),
    Channel(
        "nostril_flare", "", 0, 1, True, "nostrils flared while breathing",
        lambda m: m.sources.nostrils.sample(m.times),
    ),
    Channel(
        "mouth_open", "", 0, 1, True, "mouth opened to breathe (not to speak)",
        lambda m: m.sources.mouth.sample(m.times),
    ),
    Channel(
        "airflow", "L/s", -8, 8, False, "air in (+) and out (-): derivative of lung_volume in litres",
        lambda m: m.airflow,
    ),
    Channel(
        "neck_pitch", "deg", -45, 45, True, "the breath's share of head_pitch, chin up +; never add it to that",
        lambda m: m.neck_pitch,
    ),
    Channel(
        "head_pitch", "deg", -45, 45, True, "head relative to the upper chest, chin up +, all causes together",
        lambda m: m.neck_pitch,
    ),
    Channel(
        "speech_level", "dB", FLOOR_DB, 20, True, "level of speech relative to the voice's reference",
        lambda m: m.sources.speech.sample(m.times),
    ),
    Channel(
        "breath_level", "dB", FLOOR_DB, 20, True, "level of the breath's sound relative to the voice's reference",
        lambda m: m.sources.breath.sample(m.times),
    ),
    Channel(
        "weight", "", 0, 1, True, "1 where the Score rules the breathing, for hosts that breathe by themselves",
        lambda m: m.weight,
    ),
)  # fmt: skip
"""Every channel, in the order of the columns."""
