"""The instruments that play a Score: breaths of all kinds, recorded breaths, and speech."""

from scorebreath_synthdefs.catalogue import (
    CATALOGUE,
    RECORDING,
    RECORDING_DB,
    SPEECH,
    Control,
    Instrument,
    breath_name,
    synthdef,
)
from scorebreath_synthdefs.tracts import LENGTHS, TRACTS, Glide, Kind, Resonance, Speaker, Tract, nearest

__all__ = [
    "CATALOGUE",
    "LENGTHS",
    "RECORDING",
    "RECORDING_DB",
    "SPEECH",
    "TRACTS",
    "Control",
    "Glide",
    "Instrument",
    "Kind",
    "Resonance",
    "Speaker",
    "Tract",
    "breath_name",
    "nearest",
    "synthdef",
]
