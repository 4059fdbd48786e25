"""The worker process of the eSpeak voice: synthesises, trims and measures.

Pitch is measured here as well: it takes twice as long as the synthesis, and so runs beside the program's own work.
Imports nothing that the answers do not need.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import MissingExtraError
from scorebreath.signal.level import sounding
from scorebreath.signal.pitch import pitch_hertz
from scorebreath.speech.espeak.library import SAMPLE_RATE, Library, Settings
from scorebreath.speech.serve import serve

FULL_SCALE = 32768
THRESHOLD = 16
"""of 32768 (-66 dB): the sound begins and ends with the first and last sample above. The library's pauses are zeros;
bursts begin 35 dB above this, and fricatives fade out below it within 2 ms."""
MARGIN = 0.002
"""s kept on both sides of it, and faded, so that nothing clicks"""
HUNDREDTHS = 100
"""Pitch is sent in hundredths of a Hz."""


def main() -> None:
    """Serve until stdin ends. Arguments: the library's path, its data folder."""
    library = Library(path=sys.argv[1], data=sys.argv[2])
    os.chdir(tempfile.gettempdir())  # the library's voice files go there

    with suppress(MissingExtraError):  # said when pitch is asked for
        pitch_hertz(np.zeros(SAMPLE_RATE // 10), SAMPLE_RATE)  # loads Praat while nobody waits

    def handle(fields: dict[str, Any], payload: bytes) -> tuple[dict[str, Any], bytes]:
        settings = Settings(**fields["settings"])
        if fields["do"] == "phonemes":
            return {"phonemes": library.phonemes(fields["words"], settings)}, b""
        return _speak(library, settings, fields)

    serve(handle)


def _speak(library: Library, settings: Settings, fields: Mapping[str, Any]) -> tuple[dict[str, Any], bytes]:
    sound, events = library.synthesise(fields["text"], settings)
    samples, first = trim(np.frombuffer(sound, dtype=np.int16))
    hertz: NDArray[np.int32] = np.zeros(0, dtype=np.int32)
    if fields["pitch"] and samples.size:
        floor, ceiling = fields["pitch"]
        found = pitch_hertz(samples / FULL_SCALE, SAMPLE_RATE, floor=floor, ceiling=ceiling)
        hertz = np.round(found * HUNDREDTHS).astype(np.int32)
    told = [(kind, position, length, sample - first, ipa) for kind, position, length, sample, ipa in events]
    return {"frames": samples.size, "events": told}, samples.tobytes() + hertz.tobytes()


def trim(samples: NDArray[np.int16]) -> tuple[NDArray[np.int16], int]:
    """Cut the silence before and after.

    Returns:
        The sound with `MARGIN` on both sides where there is as much, faded in and out over the margin, and the frame
        it began at.
    """
    margin = round(MARGIN * SAMPLE_RATE)
    start, end = sounding(samples, THRESHOLD)
    before, after = min(margin, start), min(margin, samples.size - end)
    cut = samples[start - before : end + after].copy()
    if start < end:
        cut[:before] = cut[:before] * np.linspace(0, 1, before, endpoint=False)
        cut[cut.size - after :] = cut[cut.size - after :] * np.linspace(1, 0, after)
    return cut, start - before
