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
    _lead_sum: float = 0.0

    def bundle(self, lead: float) -> None:
        """A bundle was sent so many seconds before its time."""
        self.sent += 1
        self.lead_min = min(self.lead_min, lead)
        self._lead_sum += lead

    @property
    def lead_mean(self) -> float:
        """Seconds; 0 before the first bundle."""
        return self._lead_sum / self.sent if self.sent else 0.0
