"""The instruments that play a Score: breath through mouth and nose, and speech."""

from scorebreath_synthdefs.catalogue import CATALOGUE, SPEECH, Control, Instrument, breath_name, synthdef
from scorebreath_synthdefs.tracts import TRACTS, Resonance, Route, Speaker, Tract

__all__ = [
    "CATALOGUE",
    "SPEECH",
    "TRACTS",
    "Control",
    "Instrument",
    "Resonance",
    "Route",
    "Speaker",
    "Tract",
    "breath_name",
    "synthdef",
]
