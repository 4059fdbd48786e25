"""`preview.html`: one offline file with the sound, the words, and a figure moved by the curves themselves."""

from __future__ import annotations

import base64
import html
import io
import json
from importlib.resources import files
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from scorebreath.curves.curve_set import CurveSet
from scorebreath.errors import InputError
from scorebreath.report.rows import clock, groups_counted
from scorebreath.report.transcript import transcript
from scorebreath.score.document import Score
from scorebreath.signal.resample import resample

LONGEST = 600.0
"""s; of a longer Score the preview holds the beginning: 1.5 MB a minute, 21 MB at most"""
RATE = 24_000
"""Hz; of the embedded sound, FLAC of 16 bits: sample for sample what was rendered up to 12 kHz, in every browser"""
FPS = 60
CHANNELS = (
    "lung_volume", "thorax", "abdomen", "shoulder", "nostril_flare", "mouth_open", "airflow", "head_pitch",
    "speech_level", "breath_level",
)  # fmt: skip
"""What the page draws."""
STEPS = 2**16 - 1
BLOCK = 1 << 16
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
    shown = min(score.duration, LONGEST)
    title = _title(score)
    parts = {
        "language": html.escape(score.language or "en", quote=True),
        "title": html.escape(title),
        "facts": html.escape(_facts(score, curve_set, shown)),
        "style": _static("preview.css"),
        "figure": _static("figure.svg"),
        "data": _data(score, curve_set, shown),
        "sound": base64.b64encode(_flac(sound, sample_rate, shown)).decode("ascii"),
        "script": _static("figure.js") + _static("preview.js"),
    }
    for number, piece in enumerate(_static("preview.html").replace("}}", "{{").split("{{")):
        stream.write((parts[piece] if number % 2 else piece).encode("utf-8", "replace"))


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
    data = {
        "fps": FPS,
        "shown": shown,
        "channels": {name: _packed(values[:, column]) for column, name in enumerate(CHANNELS)},
        "text": transcript(score, curve_set.body, shown),
    }
    return json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")


def _packed(values: NDArray[np.float64]) -> dict[str, object]:
    """Values as 16-bit steps between the lowest and the highest, little-endian, in base64."""
    low, high = float(values.min()), float(values.max())
    step = (high - low) / STEPS
    steps = np.rint((values - low) / (step or 1.0)).astype("<u2")
    return {"low": low, "step": step, "values": base64.b64encode(steps.tobytes()).decode("ascii")}


def _flac(sound: Path | Samples, sample_rate: int | None, shown: float) -> bytes:
    import soundfile

    mono, rate = _mono(sound, sample_rate, shown)
    made = np.clip(resample(mono, rate, RATE), -1.0, 1.0)
    held = io.BytesIO()
    with soundfile.SoundFile(held, "w", RATE, 1, subtype="PCM_16", format="FLAC") as file:
        for first in range(0, max(1, len(made)), BLOCK):  # libsndfile overflows its stack on one endless block
            file.write(made[first : first + BLOCK])
    return held.getvalue()


def _mono(sound: Path | Samples, sample_rate: int | None, shown: float) -> tuple[NDArray[np.float32], int]:
    """The first `shown` seconds in one channel, and their rate."""
    if isinstance(sound, Path):
        import soundfile

        try:
            with soundfile.SoundFile(sound) as file:
                part = file.read(int(np.ceil(shown * file.samplerate)), dtype="float32", always_2d=True)
                return part.mean(axis=1, dtype=np.float32), file.samplerate
        except soundfile.LibsndfileError as error:
            raise InputError(f"{sound}: {error.error_string} Expected a sound file") from None
    if sample_rate is None:
        raise InputError("sample_rate=None: samples need their rate in Hz")
    part = np.asarray(sound, dtype=np.float32)[: int(np.ceil(shown * sample_rate))]
    return part if part.ndim == 1 else part.mean(axis=1, dtype=np.float32), sample_rate
