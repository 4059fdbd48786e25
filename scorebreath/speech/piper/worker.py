"""The worker process of a Piper voice: one loaded model, and everything that is done with its sound."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.signal.pitch import LOWEST, limits_of, pitch_hertz
from scorebreath.signal.psola import shift_pitch
from scorebreath.speech.pairing import owners
from scorebreath.speech.piper.network import ModelError, Network
from scorebreath.speech.piper.symbols import phones
from scorebreath.speech.serve import serve

HUNDREDTHS = 100
"""Pitch is sent in hundredths of a Hz."""


def main() -> None:
    """Serve until stdin ends. Arguments: the model's path, its JSON, the number of its speaker or nothing."""
    path, config, speaker = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]) if sys.argv[3] else None
    loaded: list[_Speaker | str] = []

    def handle(fields: dict[str, Any], payload: bytes) -> tuple[dict[str, Any], bytes]:
        if not loaded:
            try:
                loaded.append(_Speaker(Network(path, config, speaker)))
            except ModelError as error:
                loaded.append(str(error))
        if isinstance(speaks := loaded[0], str):
            return {"refused": speaks}, b""
        try:
            return speaks.speak(fields)
        except ModelError as error:
            return {"refused": str(error)}, b""

    serve(handle)


class _Speaker:
    """A model and the words it has been asked for alone."""

    def __init__(self, network: Network) -> None:
        self._network = network
        self._alone: dict[str, list[str]] = {}
        self._limits: tuple[float, float] | None = None

    def speak(self, fields: dict[str, Any]) -> tuple[dict[str, Any], bytes]:
        """Answer a request: text, words, rate, pitch, and a known sentence to get to know the speaker by."""
        symbols = self._network.symbols(fields["text"])
        words = [self._symbols_of(word) for word in fields["words"]]
        whose = owners(symbols, words)
        if not any(owner is not None for owner in whose):
            return {"frames": 0, "phones": []}, b""
        made = self._network.speak(symbols, fields["rate"])
        samples, placed = phones(made.symbols, [None, *whose, None], made.samples, self._network.sample_rate)
        rate, factor, (floor, ceiling) = self._network.sample_rate, fields["pitch"], self._speaker(fields["known"])
        if factor != 1.0:  # the model knows no pitch: it is moved in the sound, which keeps its length
            samples = shift_pitch(samples, rate, 12.0 * math.log2(factor), floor=floor, ceiling=ceiling)
        hertz = pitch_hertz(samples, rate, floor=floor * factor, ceiling=ceiling * factor)
        told = [(phone.ipa, phone.start, phone.stress, phone.word) for phone in placed]
        sound = np.ascontiguousarray(samples, dtype="<f4").tobytes()
        return {"frames": len(samples), "phones": told}, sound + _hundredths(hertz)

    def _speaker(self, known: str) -> tuple[float, float]:
        """Hz between which this speaker's pitch lies, from a known sentence."""
        if self._limits is None:
            network = self._network
            made = network.speak(network.symbols(known), 1.0).samples
            self._limits = limits_of(pitch_hertz(made, network.sample_rate, floor=LOWEST))
        return self._limits

    def _symbols_of(self, word: str) -> Sequence[str]:
        if word not in self._alone:
            self._alone[word] = [
                symbol for symbol in self._network.symbols(word) if re.search(r"[^\W\d_]|\s|[\u02b0-\u036f]", symbol)
            ]
        return self._alone[word]


def _hundredths(hertz: NDArray[np.float64]) -> bytes:
    return np.round(hertz * HUNDREDTHS).astype("<i4").tobytes()
