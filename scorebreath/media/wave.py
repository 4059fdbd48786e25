"""WAV files whose bytes depend on nothing but the samples: no time stamps, no tags; RF64 beyond 4 GiB."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import BinaryIO, Literal

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import ScorebreathError

Encoding = Literal["pcm16", "pcm24", "float32"]
LARGEST_RIFF = 2**32 - 1
"""Bytes a RIFF chunk can count."""
_PCM, _FLOAT = 1, 3


@dataclass(frozen=True, slots=True, kw_only=True)
class _Form:
    tag: int
    width: int
    """bytes a sample"""
    encode: Callable[[NDArray[np.float32]], bytes]


def _integers(samples: NDArray[np.float32], bits: int) -> NDArray[np.int32]:
    full = np.float32(2 ** (bits - 1))
    scaled = samples * full
    np.rint(scaled, out=scaled)
    np.clip(scaled, -full, full - 1, out=scaled)
    return scaled.astype("<i4")


def _pcm16(samples: NDArray[np.float32]) -> bytes:
    return _integers(samples, 16).astype("<i2").tobytes()


def _pcm24(samples: NDArray[np.float32]) -> bytes:
    return np.ascontiguousarray(_integers(samples, 24)).view(np.uint8).reshape(-1, 4)[:, :3].tobytes()


def _float32(samples: NDArray[np.float32]) -> bytes:
    return samples.astype("<f4").tobytes()


_FORMS: Mapping[Encoding, _Form] = MappingProxyType(
    {
        "pcm16": _Form(tag=_PCM, width=2, encode=_pcm16),
        "pcm24": _Form(tag=_PCM, width=3, encode=_pcm24),
        "float32": _Form(tag=_FLOAT, width=4, encode=_float32),
    }
)


def wave_header(*, frames: int, sample_rate: int, channels: int = 1, encoding: Encoding = "pcm24") -> bytes:
    """Everything before the samples. Integers are as in Microsoft's RIFF, beyond 4 GiB as in EBU Tech 3306 (RF64).

    Args:
        frames: Samples a channel.
        sample_rate: Hz.
        channels: 1 or 2; more would need a speaker mask.
        encoding: How a sample is written.

    >>> wave_header(frames=3, sample_rate=48000)[:4], len(wave_header(frames=3, sample_rate=48000))
    (b'RIFF', 44)
    """
    form = _FORMS[encoding]
    align = form.width * channels
    size = frames * align
    form_chunk = struct.pack("<4sIHHIIHH", b"fmt ", 16, form.tag, channels, sample_rate, sample_rate * align, align,
                             8 * form.width)  # fmt: skip
    if form.tag == _FLOAT:  # whatever is not PCM says its length a second time
        form_chunk += struct.pack("<4sII", b"fact", 4, min(frames, LARGEST_RIFF))
    riff = 4 + len(form_chunk) + 8 + size + size % 2
    if riff <= LARGEST_RIFF:
        return struct.pack("<4sI4s", b"RIFF", riff, b"WAVE") + form_chunk + struct.pack("<4sI", b"data", size)
    sizes = struct.pack("<4sIQQQI", b"ds64", 28, riff + 36, size, frames, 0)
    return (
        struct.pack("<4sI4s", b"RF64", LARGEST_RIFF, b"WAVE")
        + sizes
        + form_chunk
        + struct.pack("<4sI", b"data", LARGEST_RIFF)
    )


def write_wave(
    stream: BinaryIO,
    blocks: Iterable[NDArray[np.float32]],
    *,
    frames: int,
    sample_rate: int,
    channels: int = 1,
    encoding: Encoding = "pcm24",
) -> None:
    """Write a WAV file front to back, block by block: the stream need not seek.

    Nothing is written before the first block is there. Integers are rounded to the nearest, without dither, and
    clipped to full scale.

    Args:
        stream: Where the bytes go.
        blocks: Arrays (n,) or (n, channels), n any.
        frames: How many frames the blocks hold together; the header says it before they come.
        sample_rate: Hz.
        channels: 1 or 2.
        encoding: How a sample is written.

    Raises:
        ScorebreathError: The blocks hold another number of frames, or samples that are not finite.
    """
    form = _FORMS[encoding]
    header = wave_header(frames=frames, sample_rate=sample_rate, channels=channels, encoding=encoding)
    written = 0
    for block in blocks:
        stream.write(header)
        header = b""
        if not np.isfinite(np.abs(block).max(initial=0.0)):
            raise ScorebreathError(f"samples {written}..{written + len(block)} of a WAV file are not finite")
        written += block.size // channels
        stream.write(form.encode(block))
    stream.write(header)
    if written != frames:
        raise ScorebreathError(f"a WAV file of {frames} frames was given {written}")
    if frames * channels * form.width % 2:
        stream.write(b"\0")
