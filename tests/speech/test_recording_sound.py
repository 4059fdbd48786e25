"""Recordings of any kind: handled and said, or refused in a line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scorebreath.errors import InputError
from scorebreath.speech.recording.sound import LONGEST, load_take

RATE = 16_000
SOUND = (0.3 * np.sin(2 * np.pi * 220 * np.arange(RATE) / RATE)).astype(np.float32)


def save(tmp_path: Path, samples: NDArray[np.float32], rate: int = RATE, subtype: str = "FLOAT") -> Path:
    path = tmp_path / "take.wav"
    soundfile.write(path, samples, rate, subtype=subtype)
    return path


def test_a_good_take_is_as_it_was(tmp_path: Path) -> None:
    take = load_take(save(tmp_path, SOUND))
    assert np.array_equal(take.samples, SOUND)
    assert (take.sample_rate, take.notes) == (RATE, ())
    assert take.duration == 1.0


@pytest.mark.parametrize(
    ("samples", "rate", "subtype", "said"),
    [
        (SOUND, RATE, "PCM_U8", "8 bits a sample"),
        (SOUND, RATE, "ULAW", "8 bits a sample"),
        (SOUND, 8000, "FLOAT", "nothing is heard above 4000 Hz"),
        (np.stack([SOUND, SOUND], axis=1), RATE, "FLOAT", "2 channels: mixed to one"),
        (np.stack([SOUND, -SOUND], axis=1), RATE, "FLOAT", "cancel each other: channel 1 is used alone"),
        (np.clip(4 * SOUND, -0.9, 0.9), RATE, "FLOAT", "clipped in"),
        (SOUND + np.float32(0.1), RATE, "FLOAT", "an offset of +0.100 is taken away"),
        (SOUND * 10, RATE, "FLOAT", "dB beyond full scale"),
    ],
)
def test_what_is_odd_is_handled_and_said(
    tmp_path: Path, samples: NDArray[np.float32], rate: int, subtype: str, said: str
) -> None:
    take = load_take(save(tmp_path, samples, rate, subtype))
    assert any(said in note for note in take.notes), take.notes
    assert take.samples.dtype == np.float32
    assert take.samples.ndim == 1
    assert 0.05 < np.abs(take.samples).max() <= 1
    assert abs(take.samples.mean()) < 0.01


@pytest.mark.parametrize(
    ("samples", "rate", "said"),
    [
        (SOUND[:0], RATE, "is empty"),
        (SOUND[:100], RATE, "is 0.006 s long"),
        (0 * SOUND, RATE, "is silent"),
        (1e-4 * SOUND, RATE, "is silent"),
        (SOUND, 4000, r"sample_rate=4000 must be in \[8000, 192000\] Hz"),
        (SOUND, 400_000, "sample_rate=400000 must be"),
        (np.where(np.arange(RATE) == 500, np.nan, SOUND).astype(np.float32), RATE, "not finite"),
        (np.where(np.arange(RATE) == 500, 1e9, SOUND).astype(np.float32), RATE, "far beyond full scale"),
    ],
)
def test_what_is_no_speech_is_refused(tmp_path: Path, samples: NDArray[np.float32], rate: int, said: str) -> None:
    with pytest.raises(InputError, match=said):
        load_take(save(tmp_path, samples, rate))


def test_an_hour_is_refused_before_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / "hour.flac"
    with soundfile.SoundFile(path, "w", 8000, 1) as file:
        for _ in range(3600):
            file.write(np.zeros(8000))
    with pytest.raises(InputError, match=rf"lasts 60 min; expected at most {LONGEST / 60:.0f}: cut it"):
        load_take(path)


@pytest.mark.parametrize("content", [b"", b"RIFF", b"this is no sound at all", b"RIFF\xff\xff\xff\xffWAVEfmt "])
def test_what_is_no_sound_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "take.wav"
    path.write_bytes(content)
    with pytest.raises(InputError, match="Expected a sound file"):
        load_take(path)


def test_a_torn_file_gives_what_is_there_or_is_refused(tmp_path: Path) -> None:
    path = save(tmp_path, SOUND)
    path.write_bytes(path.read_bytes()[:-20_000])
    assert len(load_take(path).samples) < len(SOUND)


def test_what_is_not_there_is_said(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        load_take(tmp_path / "none.wav")
    with pytest.raises(InputError, match="is a folder"):
        load_take(tmp_path)
    (tmp_path / "take.raw").write_bytes(b"\0" * 9999)
    with pytest.raises(InputError, match="says nothing about its samples"):
        load_take(tmp_path / "take.raw")
