"""`preview.html`: one offline file with the sound, the words, and a figure moved by the curves themselves."""

from __future__ import annotations

import base64
import html
import json
from importlib.resources import files
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.performed import performed
from scorebreath.errors import InputError
from scorebreath.report import figure
from scorebreath.report.compact import BLOCK, CompactSound
from scorebreath.report.rows import clock, groups_counted
from scorebreath.report.transcript import transcript
from scorebreath.score.document import Score
from scorebreath.score.events import Inspiration
from scorebreath.units import snap

LONGEST = 600.0
"""s; of a longer Score the preview holds the beginning: 1.5 MB a minute, 21 MB at most"""
FPS = 60
CHANNELS = figure.CHANNELS
"""What the page draws."""
STEPS = 2**16 - 1
Samples = NDArray[np.floating[Any]]


def write_preview(
    stream: BinaryIO, score: Score, curve_set: CurveSet, sound: Path | Samples, sample_rate: int | None = None
) -> None:
    """Write the page.

    Args:
        stream: Takes bytes.
        score: Any Score.
        curve_set: The curves of the body to be shown.
        sound: A sound file, or samples (n,) or (n, channels); time 0 is the Score's.
        sample_rate: Of the samples, Hz; a file knows its own.

    Raises:
        InputError: Samples came without their rate, or the file is no sound.
    """
    page = Preview(score, curve_set)
    page.write(stream, _compact(sound, sample_rate, page.shown))


class Preview:
    """The page of a Score but for its sound, which may still be in the making."""

    def __init__(self, score: Score, curve_set: CurveSet) -> None:
        """Make it.

        Args:
            score: Any Score.
            curve_set: The curves of the body to be shown.
        """
        self.shown = seconds_shown(score)
        self._parts = {
            "language": html.escape(score.language or "en", quote=True),
            "title": html.escape(_title(score)),
            "facts": html.escape(_facts(score, curve_set, self.shown)),
            "style": figure.style() + _static("preview.css"),
            "figure": figure.drawing(),
            "data": _data(score, curve_set, self.shown),
            "script": figure.script() + _static("preview.js"),
        }

    def write(self, stream: BinaryIO, sound: CompactSound) -> None:
        """Write it with its sound.

        Args:
            stream: Takes bytes.
            sound: The first `shown` seconds of it, all given; time 0 is the Score's.
        """
        parts = {**self._parts, "sound": base64.b64encode(sound.flac()).decode("ascii")}
        for piece in figure.filled(_static("preview.html"), parts):
            stream.write(piece.encode("utf-8", "replace"))


def seconds_shown(score: Score) -> float:
    """How much of a Score its page holds."""
    return min(score.duration, LONGEST)


def _static(name: str) -> str:
    return (files("scorebreath.report") / "static" / name).read_text(encoding="utf-8")


def _title(score: Score) -> str:
    words = " ".join(score.text[:400].split())
    return (words[:79] + "…" if len(words) > 80 else words) or "Speech and breath"


def _facts(score: Score, curve_set: CurveSet, shown: float) -> str:
    voice = next(body.voice.voice for body in score.bodies if body.id == curve_set.body)
    count = sum(group.body == curve_set.body for group in score.groups)
    facts = f"{clock(score.duration)} · {groups_counted(count)} · model {score.model} · voice {voice}"
    return facts + (f" · this page holds the first {clock(shown)}" if shown < score.duration else "")


def _data(score: Score, curve_set: CurveSet, shown: float) -> str:
    """The page's data as JSON in which no `<` can end the script it stands in."""
    times = np.arange(int(np.ceil(shown * FPS)) + 1) / FPS
    values = curve_set.sample(times, CHANNELS)
    breaths = performed(score).of(Inspiration, curve_set.body)
    data = {
        "fps": FPS,
        "shown": shown,
        "channels": {name: _packed(values[:, column]) for column, name in enumerate(CHANNELS)},
        "text": transcript(score, curve_set.body, shown),
        "inspired": sorted([e.onset, snap(e.end)] for e in breaths if e.onset < shown),
    }
    return json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")


def _packed(values: NDArray[np.float64]) -> dict[str, object]:
    """Values as 16-bit steps between the lowest and the highest, little-endian, in base64; a constant as one."""
    low, high = float(values.min()), float(values.max())
    step = (high - low) / STEPS
    if not step:
        values = values[:1]
    steps = np.rint((values - low) / (step or 1.0)).astype("<u2")
    return {"low": low, "step": step, "values": base64.b64encode(steps.tobytes()).decode("ascii")}


def _compact(sound: Path | Samples, sample_rate: int | None, shown: float) -> CompactSound:
    if not isinstance(sound, Path):
        if sample_rate is None:
            raise InputError("sample_rate=None: samples need their rate in Hz")
        compact = CompactSound(sample_rate, shown)
        compact.add(sound)
        return compact
    import soundfile

    try:
        with soundfile.SoundFile(sound) as file:
            compact = CompactSound(file.samplerate, shown)
            while not compact.complete and len(block := file.read(BLOCK, dtype="float32")):
                compact.add(block)
            return compact
    except soundfile.LibsndfileError as error:
        raise InputError(f"{sound}: {error.error_string} Expected a sound file") from None
