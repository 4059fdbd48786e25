"""One request's moments: what the channels are computed from is computed once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from types import MappingProxyType

import numpy as np

from scorebreath.curves.breathing import TREMOR_HZ
from scorebreath.curves.lips.lips import LIP_CHANNELS
from scorebreath.curves.looks.mixing import EMOTION_BROW, EMOTION_HEAD, LID_DOWN, LID_UP
from scorebreath.curves.sources import Sources
from scorebreath.curves.tracks import Array
from scorebreath.equations.shapes import trapezoid

Settle = Callable[[str, Array, Array], Array]
"""What a movement is behind a cut: given its name, the moments' times and its values there, as if nothing had been
before."""
TURN = 45.0
"""Degrees that the head turns at most, any way, and the eyes in it: whatever it does, they can look straight ahead."""
WEIGHT_RAMP = 0.2
"""s in which a host hands its own breathing over at the Score's beginning, and takes it back at its end"""


class Moments:
    """Some moments of a body; what several channels need is computed once."""

    def __init__(
        self, sources: Sources, times: Array, *, closure_gate: bool = True, settle: Settle | None = None
    ) -> None:
        """Look up the breath under way.

        Args:
            sources: The body's events.
            times: Seconds, (n,), in any order.
            closure_gate: Whether p, b and m shut the lips whatever else opens them.
            settle: How movements go on from where a cut found them; None: nothing was cut.
        """
        self._settle = settle
        self.sources = sources
        self.closure_gate = closure_gate
        self._emotions: dict[str, Array] = {}
        self.times = times
        self._breathing = sources.breathing
        self._at = sources.breathing.locate(times)

    def movement(self, name: str) -> Array:
        """A movement by its name in `settling.MOVEMENTS`, as it goes on behind a cut: (n,) or (n, columns)."""
        values = _MOVED[name](self) if name in _MOVED else self._named(name)
        return values if self._settle is None else self._settle(name, self.times, values)

    def _named(self, name: str) -> Array:
        kind, _, feeling = name.partition("_")
        if kind == "emotion":
            return self.sources.looks.emotion(feeling, self.times)
        if kind == "leaning":
            return self.sources.looks.leaning(feeling, self.times)
        return self._breathing.factor(name, self.times, self._at.event)

    @cached_property
    def volume(self) -> Array:
        """Fraction of VC above residual volume, (n,)."""
        return self._breathing.volume(self._at)

    @property
    def breathes(self) -> bool:
        """Whether a breath is under way, held or not, at the first moment: else there is nothing to be shared out."""
        return bool(self._at.active[0])

    @cached_property
    def above_rest(self) -> Array:
        """The driver: volume less the resting volume, (n,); the papers' LF where the resting volume is 0 (B6, B12)."""
        return self.volume - self._breathing.person.resting_volume

    def factor(self, name: str) -> Array:
        """What `above_rest` is multiplied by, see `breathing.FACTORS`; (n,)."""
        return self.movement(name)

    @property
    def tremor(self) -> Array:
        """What a trembling chest's shape is multiplied by; its phase is the clock's, so it never jumps; (n,)."""
        share = self.factor("tremor")
        return 1.0 + share * np.sin(2.0 * np.pi * TREMOR_HZ * self.times) if share.any() else np.ones(share.shape)

    @cached_property
    def thorax_share(self) -> Array:
        """The thorax's share of the volume above rest, (n,)."""
        return self.factor("thorax_share")

    @cached_property
    def neck_pitch(self) -> Array:
        """Degrees, (n,)."""
        return self.above_rest * self.factor("neck_pitch")

    @cached_property
    def _lips(self) -> Array:
        return self.movement("lips")

    @property
    def contact(self) -> Array:
        """Where p, b and m must hold the lips shut: (n,)."""
        return self.movement("contact")

    @property
    def visemes(self) -> Array:
        """Shares of the visemes, (n, 15)."""
        return self.movement("visemes")

    @cached_property
    def mouth_open(self) -> Array:
        """The breath's opening of the mouth, (n,)."""
        return self.movement("mouth")

    @property
    def nostrils(self) -> Array:
        """How far the nostrils are flared, (n,)."""
        return self.movement("nostrils")

    def lip(self, name: str) -> Array:
        """One of LIP_CHANNELS, (n,)."""
        return self._lips[:, LIP_CHANNELS.index(name)]

    @cached_property
    def blink(self) -> Array:
        """Left and right, (n, 2)."""
        return self.movement("blink")

    @cached_property
    def brow(self) -> Array:
        """Left, right and frown, (n, 3)."""
        return self.movement("brow")

    @cached_property
    def head(self) -> Array:
        """Pitch, yaw and roll of all causes together, (n, 3) degrees."""
        turned = self.movement("head")  # made for these moments
        turned[:, 0] += self.neck_pitch
        for name, turn in EMOTION_HEAD.items():
            leaning = self.movement(f"leaning_{name}")
            turned += leaning[:, np.newaxis] * np.asarray(turn)
        return np.clip(turned, -TURN, TURN)

    @cached_property
    def eyes(self) -> Array:
        """Yaw and pitch relative to the head, (n, 2) degrees: target less head, as far as eyes can turn."""
        target = self.movement("gaze")
        return np.clip(target - self.head[:, [1, 0]], -TURN, TURN)

    def lid(self, side: int) -> Array:
        """Left (0) or right (1): follows the eye in the head (A36, A37), closed by blinks; (n,) in -1..1.

        With the head down and the gaze at the listener the eye is up in the head: the lid is wider.
        """
        pitch = self.eyes[:, 1]
        follows = np.where(pitch < 0, -LID_DOWN * pitch, -LID_UP * pitch)
        return follows + (1.0 - follows) * self.blink[:, side]

    def emotion(self, name: str) -> Array:
        """Intensity, (n,) in 0..1."""
        if name not in self._emotions:
            self._emotions[name] = self.movement(f"emotion_{name}")
        return self._emotions[name]

    def wrinkle(self, column: str) -> Array:
        """`raise` or `frown`: what brows and emotions together fold (A50); (n,)."""
        moved = self.brow[:, 2] if column == "frown" else self.brow[:, :2].max(axis=1, initial=0.0)
        for name, moves in EMOTION_BROW.items():
            moved = moved + moves.get(column, 0.0) * self.emotion(name)
        return moved

    @property
    def airflow(self) -> Array:
        """L/s, (n,)."""
        return self._breathing.flow(self._at) * self._breathing.person.vital_capacity

    @property
    def weight(self) -> Array:
        """1 inside the Score, ramps of WEIGHT_RAMP at its ends, 0 outside; (n,)."""
        edge = min(WEIGHT_RAMP, self.sources.duration / 2)
        inside = (self.times >= 0) & (self.times <= self.sources.duration)
        return np.where(inside, trapezoid(self.times, edge, self.sources.duration - 2 * edge, edge), 0.0)


_MOVED: Mapping[str, Callable[[Moments], Array]] = MappingProxyType(
    {
        "mouth": lambda m: m.sources.mouth.sample(m.times),
        "nostrils": lambda m: m.sources.nostrils.sample(m.times),
        "lips": lambda m: m.sources.lips.sample(m.times, m.mouth_open, closure_gate=m.closure_gate),
        "contact": lambda m: m.sources.lips.closures.sample(m.times),
        "visemes": lambda m: m.sources.lips.visemes.sample(m.times),
        "head": lambda m: m.sources.looks.head(m.times),
        "gaze": lambda m: m.sources.looks.gaze(m.times),
        "blink": lambda m: m.sources.looks.blinks(m.times),
        "brow": lambda m: m.sources.looks.brows(m.times),
    }
)
"""What moves, as the events say; besides emotions and the factors of the breath."""
