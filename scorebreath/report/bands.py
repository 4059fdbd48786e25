"""Horizontal parts of a row of time, and the inks of a drawing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scorebreath.report.sheet import Points

INK, FAINT, HAIR, PAPER = "#1b2430", "#66717e", "#d9dee4", "#ffffff"
FILL = "#e6ebf1"


@dataclass(frozen=True, slots=True, kw_only=True)
class Band:
    """A horizontal part of a row, from the value at its bottom to the value at its top."""

    top: float
    """pixels from the row's top"""
    bottom: float
    low: float
    high: float

    def y(self, value: Points | float) -> Points:
        """Pixels from the row's top; values beyond the band stay at its edge."""
        share = (np.clip(value, self.low, self.high) - self.low) / (self.high - self.low)
        return np.asarray(self.bottom - share * (self.bottom - self.top), dtype=np.float64)
