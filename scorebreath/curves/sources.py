"""What the channels are computed from: one body's events, and one request's moments."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scorebreath.curves.breathing import TREMOR_HZ, Breathing, breathing
from scorebreath.curves.levels import BreathLevel, SpeechLevel, breath_level, speech_level
from scorebreath.curves.lips.lips import LIP_CHANNELS, Lips, lips
from scorebreath.curves.looks.looks import Looks, looks
from scorebreath.curves.looks.mixing import EMOTION_BROW, EMOTION_HEAD, LID_DOWN, LID_UP
from scorebreath.curves.nose_and_mouth import FaceShape, face_shape
from scorebreath.curves.tracks import Array
from scorebreath.equations.shapes import trapezoid
from scorebreath.score.document import Body, Score
from scorebreath.score.events import Expiration, Inspiration

TURN = 45.0
"""Degrees that the head turns at most, any way, and the eyes in it: whatever it does, they can look straight ahead."""
WEIGHT_RAMP = 0.2
"""s in which a host hands its own breathing over at the Score's beginning, and takes it back at its end"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sources:
    """A body's events, sorted and as arrays."""

    duration: float
    """s, of the Score"""
    breathing: Breathing
    nostrils: FaceShape
    mouth: FaceShape
    speech: SpeechLevel
    breath: BreathLevel
    lips: Lips
    looks: Looks


def sources(score: Score, body: Body) -> Sources:
    """Read one body's events.

    Raises:
        ScoreError: Events contradict each other, or leave their own reach.
    """
    breaths = [e for e in score.events if isinstance(e, Inspiration | Expiration) and e.body == body.id]
    return Sources(
        duration=score.duration,
        breathing=breathing(score, body.id, body.person),
        nostrils=face_shape(breaths, "nostril"),
        mouth=face_shape(breaths, "mouth"),
        speech=speech_level(score, body.id, body.voice.reference_db),
        breath=breath_level(score, body.id),
        lips=lips(score, body.id),
        looks=looks(score, body.id),
    )


class Moments:
    """Some moments of a body; what several channels need is computed once."""

    def __init__(self, sources: Sources, times: Array, *, closure_gate: bool = True) -> None:
        """Look up the breath under way.

        Args:
            sources: The body's events.
            times: Seconds, (n,), in any order.
            closure_gate: Whether p, b and m shut the lips whatever else opens them.
        """
        self.sources = sources
        self.closure_gate = closure_gate
        self._emotions: dict[str, Array] = {}
        self.times = times
        self._breathing = sources.breathing
        self._at = sources.breathing.locate(times)

    @cached_property
    def volume(self) -> Array:
        """Fraction of VC above residual volume, (n,)."""
        return self._breathing.volume(self._at)

    @cached_property
    def above_rest(self) -> Array:
        """The driver: volume less the resting volume, (n,); the papers' LF where the resting volume is 0 (B6, B12)."""
        return self.volume - self._breathing.person.resting_volume

    def factor(self, name: str) -> Array:
        """What `above_rest` is multiplied by, see `breathing.FACTORS`; (n,)."""
        return self._breathing.factor(name, self.times, self._at.event)

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
        return self.sources.lips.sample(self.times, self.mouth_open, closure_gate=self.closure_gate)

    @cached_property
    def mouth_open(self) -> Array:
        """The breath's opening of the mouth, (n,)."""
        return self.sources.mouth.sample(self.times)

    def lip(self, name: str) -> Array:
        """One of LIP_CHANNELS, (n,)."""
        return self._lips[:, LIP_CHANNELS.index(name)]

    @cached_property
    def blink(self) -> Array:
        """Left and right, (n, 2)."""
        return self.sources.looks.blinks(self.times)

    @cached_property
    def brow(self) -> Array:
        """Left, right and frown, (n, 3)."""
        return self.sources.looks.brows(self.times)

    @cached_property
    def head(self) -> Array:
        """Pitch, yaw and roll of all causes together, (n, 3) degrees."""
        turned = self.sources.looks.head(self.times)
        turned[:, 0] += self.neck_pitch
        for name, turn in EMOTION_HEAD.items():
            turned += self.sources.looks.leaning(name, self.times)[:, np.newaxis] * np.asarray(turn)
        return np.clip(turned, -TURN, TURN)

    @cached_property
    def eyes(self) -> Array:
        """Yaw and pitch relative to the head, (n, 2) degrees: target less head, as far as eyes can turn."""
        target = self.sources.looks.gaze(self.times)
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
            self._emotions[name] = self.sources.looks.emotion(name, self.times)
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
