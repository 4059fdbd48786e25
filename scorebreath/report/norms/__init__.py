"""How a Score's breathing compares with published human ranges: measures, verdicts, a page with their distributions."""

from __future__ import annotations

from scorebreath.report.norms.compare import Norms, norms
from scorebreath.report.norms.listening import Heard, breaths_alone, listen, speech_level

__all__ = ["Heard", "Norms", "breaths_alone", "listen", "norms", "speech_level"]
