"""WAV files: headers to the byte, samples to the last bit, streams that cannot seek."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator, Sequence

import numpy as np
import pytest
import soundfile
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from scorebreath.errors import ScorebreathError
from scorebreath.media.wave import LARGEST_RIFF, Encoding, wave_header, write_wave

ENCODINGS: tuple[Encoding, ...] = ("pcm16", "pcm24", "float32")
STEPS = {"pcm16": 2.0**-15, "pcm24": 2.0**-23, "float32": 0.0}
SUBTYPES = {"pcm16": "PCM_16", "pcm24": "PCM_24", "float32": "FLOAT"}


class Pipe(io.BytesIO):
    """A stream that only takes."""

    def seekable(self) -> bool:
        return False

    def seek(self, *_: object) -> int:
        raise io.UnsupportedOperation

    def tell(self) -> int:
        raise io.UnsupportedOperation


def written(
    blocks: Sequence[NDArray[np.float32]],
    frames: int,
    rate: int = 48000,
    *,
    channels: int = 1,
    encoding: Encoding = "pcm24",
) -> bytes:
    stream = Pipe()
    write_wave(stream, blocks, frames=frames, sample_rate=rate, channels=channels, encoding=encoding)
    return stream.getvalue()


def test_a_file_to_the_byte() -> None:
    made = written([np.array([0.0, 0.5, -1.0], np.float32)], 3)
    assert made == (
        b"RIFF" + struct.pack("<I", 36 + 10) + b"WAVEfmt "
        + struct.pack("<IHHIIHH", 16, 1, 1, 48000, 144000, 3, 24)
        + b"data" + struct.pack("<I", 9) + b"\0\0\0" + b"\0\0\x40" + b"\0\0\x80" + b"\0"
    )  # fmt: skip


@given(
    st.lists(st.floats(-1, 1, width=32), max_size=40),
    st.integers(1, 20),
    st.sampled_from(ENCODINGS),
    st.integers(1, 2),
    st.integers(1, 192000),
)
def test_libsndfile_reads_what_was_written(
    values: list[float], size: int, encoding: Encoding, channels: int, rate: int
) -> None:
    sound = np.array(values[: len(values) // channels * channels], np.float32).reshape(-1, channels)
    blocks = [sound[start : start + size] for start in range(0, len(sound), size)]
    made = written(
        blocks if channels > 1 else [b[:, 0] for b in blocks], len(sound), rate, channels=channels, encoding=encoding
    )
    assert len(made) % 2 == 0
    assert struct.unpack("<I", made[4:8])[0] == len(made) - 8
    info = soundfile.info(io.BytesIO(made))
    assert (info.frames, info.samplerate, info.channels, info.subtype) == (
        len(sound),
        rate,
        channels,
        SUBTYPES[encoding],
    )
    read, _ = soundfile.read(io.BytesIO(made), dtype="float64", always_2d=True)
    assert np.all(np.abs(read - sound) <= STEPS[encoding])


@pytest.mark.parametrize("encoding", ["pcm16", "pcm24"])
def test_integers_are_rounded_to_the_nearest_and_clipped(encoding: Encoding) -> None:
    step = np.float32(STEPS[encoding])
    sound = np.array([0.49, 0.51, -0.49, -0.51, 1.5, 2.5, 3.0], np.float32) * step
    read, _ = soundfile.read(
        io.BytesIO(written([np.append(sound, [7.0, -7.0]).astype(np.float32)], 9, encoding=encoding))
    )
    np.testing.assert_array_equal(read / step, [0, 1, 0, -1, 2, 2, 3, 1 / step - 1, -1 / step])


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_beyond_4_gib_the_header_is_rf64(encoding: Encoding) -> None:
    width = {"pcm16": 2, "pcm24": 3, "float32": 4}[encoding]
    largest = (LARGEST_RIFF - 36) // width // 2 * 2
    assert wave_header(frames=largest - 8, sample_rate=48000, encoding=encoding)[:4] == b"RIFF"
    frames = largest + 8
    made = wave_header(frames=frames, sample_rate=48000, encoding=encoding)
    assert made[:4] + made[8:16] == b"RF64WAVEds64"
    assert made[4:8] == b"\xff" * 4
    riff, data, samples, table = struct.unpack("<QQQI", made[20:48])
    assert (data, samples, table) == (frames * width, frames, 0)
    assert riff == len(made) - 8 + data + data % 2
    assert made[-8:] == b"data" + b"\xff" * 4


def test_libsndfile_reads_rf64(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scorebreath.media.wave.LARGEST_RIFF", 100)
    sound = np.linspace(-1, 1, 1001, dtype=np.float32)
    made = bytearray(written([sound], 1001))
    made[4:8] = b"\xff" * 4  # as it is with the true limit
    at = made.index(b"data")
    made[at + 4 : at + 8] = b"\xff" * 4
    info = soundfile.info(io.BytesIO(bytes(made)))
    assert (info.format, info.frames) == ("RF64", 1001)
    read, _ = soundfile.read(io.BytesIO(bytes(made)))
    np.testing.assert_allclose(read, sound, atol=2**-22)


@pytest.mark.parametrize("frames", [0, 9, 11])
def test_another_number_of_frames_is_an_error(frames: int) -> None:
    with pytest.raises(ScorebreathError, match=f"{frames} frames was given 10"):
        written([np.zeros(4, np.float32), np.zeros(6, np.float32)], frames)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_samples_that_are_not_finite_are_refused(bad: float) -> None:
    with pytest.raises(ScorebreathError, match=r"samples 4\.\.8 .* not finite"):
        written([np.zeros(4, np.float32), np.array([0, 0, bad, 0], np.float32)], 8)


def test_nothing_is_written_before_the_first_block() -> None:
    stream = io.BytesIO()

    def broken() -> Iterator[NDArray[np.float32]]:
        yield from ()
        raise RuntimeError

    with pytest.raises(RuntimeError):
        write_wave(stream, broken(), frames=1, sample_rate=1)
    assert stream.getvalue() == b""


def test_an_empty_file_has_a_header() -> None:
    assert soundfile.info(io.BytesIO(written([], 0))).frames == 0
