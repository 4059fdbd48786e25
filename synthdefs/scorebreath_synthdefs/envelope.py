"""The envelope of a breath, straight (B46) or following the flow, and what makes both equally loud (physiology 3.3)."""

from __future__ import annotations

from math import log, pi
from typing import Any

from supriya.ugens import UGenVector

from scorebreath.equations.breath import LOUD, LOUD_SQUARE
from scorebreath_synthdefs.graph import FREE, sc
from scorebreath_synthdefs.tracts import Glide

_NONE = -99  # neither a release node nor a loop
_LINE = (1, 0)  # shape and curvature of a straight line
_SHORTEST = 1e-6  # s


class Envelope:
    """An envelope with the controls `attack`, `hold`, `release` and `exponent`.

    An exponent of 0 asks for straight ramps; any other is the power of a flow whose ramps are quarters of a sine.
    """

    def __init__(self, graph: Any) -> None:
        """Read the controls of a graph under construction."""
        self._times = (graph["attack"], graph["hold"], graph["release"])
        self.flowing = graph["exponent"] > 0
        """1 where the envelope follows the flow, else 0"""
        self._exponent = graph["exponent"] + (1 - self.flowing)

    def amplitude(self) -> Any:
        """From 0 up to 1, and back to 0, which frees the sound; audio rate.

        Engines of different versions agree on straight lines, so curves are made of them.
        """
        straight = sc.EnvGen.ar(envelope=self._lines(0, 1, 0), done_action=FREE)
        flow = (straight.max(0) * (pi / 2)).sin() ** self._exponent
        return straight * (1 - self.flowing) + flow * self.flowing

    def glide(self, glide: Glide) -> Any:
        """What the glide has come to, by quarters of a sine as the flow; control rate."""
        depth = self.flowing if glide.with_flow else 1
        progress = sc.A2K.kr(source=sc.EnvGen.ar(envelope=self._lines(0, 1, 2)))  # 1 during the hold
        rising, falling = progress.min(1) * (pi / 2), (progress - 1).max(0) * (pi / 2)
        risen = rising.sin() * (glide.full - glide.start) + (glide.start - 1)
        fallen = (1 - falling.cos()) * (glide.end - glide.full)
        return (risen + fallen) * depth + 1

    def evenness(self) -> Any:
        """Gain that makes the RMS over the loud part 1: `equations.breath.flow_loudness` in the engine's arithmetic."""
        attack, hold, release = self._times
        softer = self._exponent.reciprocal()
        share = 1 - (softer * log(LOUD)).exponential().asin() * (2 / pi)
        square = softer * LOUD_SQUARE[1] + LOUD_SQUARE[0]
        ramps = (attack + release) * share
        loudness = ((square * ramps + hold + _SHORTEST) / (ramps + hold + _SHORTEST)).sqrt()
        return (loudness.reciprocal() - 1) * self.flowing + 1

    def _lines(self, start: float, full: float, end: float) -> UGenVector:
        attack, hold, release = self._times
        return UGenVector(start, 3, _NONE, _NONE, full, attack, *_LINE, full, hold, *_LINE, end, release, *_LINE)
