"""What a live engine counts."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf


@dataclass(slots=True)
class Tally:
    """Counts that grow as things happen."""

    sent: int = 0
    late_sent: int = 0
    lost: int = 0
    lead_min: float = inf
    _sounds: int = 0
    _lead_sum: float = 0.0

    def bundle(self, lead: float, *, sound: bool) -> None:
        """A bundle was sent so many seconds before its time; moves and cuts are not told as early as sounds."""
        self.sent += 1
        if sound:
            self._sounds += 1
            self.lead_min = min(self.lead_min, lead)
            self._lead_sum += lead

    @property
    def lead_mean(self) -> float:
        """Seconds; 0 before the first sound."""
        return self._lead_sum / self._sounds if self._sounds else 0.0
