"""What emotions and looking up or down do to brows, head and lids, in channels; their shapes are the rigs' affair."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

LID_DOWN = 0.018
"""Closing of the lid for each degree that the eye looks down in the head (A36; physiology 7.5)."""
LID_UP = 0.012
"""Widening of the lid for each degree that it looks up."""
EMOTION_HEAD: Mapping[str, tuple[float, float, float]] = MappingProxyType(
    {"sad": (-4.0, 0.0, 0.0), "kidding": (0.0, 0.0, 4.0)}
)
"""Pitch, yaw and roll at full intensity, degrees (physiology 7.7); the wink is on the right."""
EMOTION_BROW: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "sad": {"raise": 0.7, "frown": 0.2},
        "angry": {"frown": 0.8},
        "surprised": {"raise": 0.8},
        "disgusted": {"frown": 0.35},
        "kidding": {"raise": 0.35},
        "afraid": {"raise": 0.6, "frown": 0.3},
    }
)
"""Brows raised and drawn together at full intensity (physiology 7.7)."""
