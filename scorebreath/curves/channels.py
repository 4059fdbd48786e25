"""The table of channels. A new channel is a row here: name, unit, range, meaning, and how it is sampled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from scorebreath.curves.moments import Moments
from scorebreath.curves.tracks import Array
from scorebreath.score.acting import EMOTIONS
from scorebreath.units import FLOOR_DB

JAW, LIPS = 8.0, 25.0
"""1/s: 200 mm/s at 25 mm for a jaw quite open (physiology 7.1); lips that shut within 40 ms."""
HEAD, EYES = 60.0, 560.0
"""deg/s: nods below 50 (physiology 7.5, Greta), the breath and emotions beside them; saccades up to 500 (Carpenter
1988), against the head's."""
LIDS, BROWS = 40.0, 12.0
"""1/s: a lid shuts within 75 ms; a brow rises within 150 ms (physiology 7.5)."""


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
    speed: float | None = None
    """how fast it changes at most, units a second, at the default parameters; None: as the events say"""

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
        lambda m: m.nostrils,
    ),
    Channel(
        "mouth_open", "", 0, 1, True, "mouth opened to breathe (not to speak)",
        lambda m: m.mouth_open,
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
        "jaw_open", "", 0, 1, True, "jaw opened to speak: the mouth's opening is the larger of this and mouth_open",
        lambda m: m.lip("jaw_open"), speed=JAW,
    ),
    Channel(
        "lip_close", "", 0, 1, True, "lips closed over the opening: 1 shuts them, whatever the jaw does",
        lambda m: m.lip("lip_close"), speed=LIPS,
    ),
    Channel(
        "lip_round", "", 0, 1, True, "lips rounded and pushed forward (oo)", lambda m: m.lip("lip_round"), speed=LIPS,
    ),
    Channel(
        "lip_spread", "", 0, 1, True, "corners of the mouth drawn apart (ee)", lambda m: m.lip("lip_spread"),
        speed=LIPS,
    ),
    Channel(
        "lip_tuck", "", 0, 1, True, "lower lip drawn under the upper teeth (f, v)", lambda m: m.lip("lip_tuck"),
        speed=LIPS,
    ),
    Channel(
        "tongue_tip", "", 0, 1, True, "tip of the tongue up, behind or between the teeth",
        lambda m: m.lip("tongue_tip"),
        speed=LIPS,
    ),
    Channel(
        "tongue_back", "", 0, 1, True, "back of the tongue up (k, g)", lambda m: m.lip("tongue_back"), speed=LIPS,
    ),
    Channel(
        "head_pitch", "deg", -45, 45, True, "head relative to the upper chest, chin up +, all causes together",
        lambda m: m.head[:, 0], speed=HEAD,
    ),
    Channel(
        "head_yaw", "deg", -45, 45, True, "head turned to the character's own left +", lambda m: m.head[:, 1],
        speed=HEAD,
    ),
    Channel(
        "head_roll", "deg", -45, 45, True, "head tilted towards the character's own right shoulder +",
        lambda m: m.head[:, 2], speed=HEAD,
    ),
    Channel(
        "eye_pitch", "deg", -45, 45, True, "eyes relative to the head, up +", lambda m: m.eyes[:, 1], speed=EYES,
    ),
    Channel(
        "eye_yaw", "deg", -45, 45, True, "eyes relative to the head, to the character's own left +",
        lambda m: m.eyes[:, 0], speed=EYES,
    ),
    Channel(
        "lid_left", "", -1, 1, True, "left lid: 0 neutral, 1 closed, -1 wide; follows the eye", lambda m: m.lid(0),
        speed=LIDS,
    ),
    Channel("lid_right", "", -1, 1, True, "right lid, likewise", lambda m: m.lid(1), speed=LIDS),
    Channel("brow_left", "", 0, 1, True, "left brow raised", lambda m: m.brow[:, 0], speed=BROWS),
    Channel("brow_right", "", 0, 1, True, "right brow raised", lambda m: m.brow[:, 1], speed=BROWS),
    Channel("brow_frown", "", 0, 1, True, "brows drawn together and down", lambda m: m.brow[:, 2], speed=BROWS),
    Channel(
        "wrinkle_forehead", "", 0, 1, True, "folds of the forehead, by raised brows and by emotions",
        lambda m: m.wrinkle("raise"),
    ),
    Channel(
        "wrinkle_glabella", "", 0, 1, True, "folds between the brows, by frowns and by emotions",
        lambda m: m.wrinkle("frown"),
    ),
    *(
        Channel(
            f"emotion_{name}", "", 0, 1, True, f"how {name}: a rig turns it into shapes",
            partial(Moments.emotion, name=name),
        )
        for name in EMOTIONS
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
