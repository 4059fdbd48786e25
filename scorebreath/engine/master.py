"""A Score rendered to a wanted loudness, and to stems that add up to the mix: one gain for all of them.

The engine works once for each stem; everything else is done on what it made. The gain is found by measuring
(ITU-R BS.1770-4), then the peaks are limited, and both again until loudness and true peak are as wanted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from scorebreath.engine.engines import DEFAULT, Engine
from scorebreath.engine.moves import moves
from scorebreath.engine.offline import Progress, unlimited
from scorebreath.engine.onsets import Onset, onsets
from scorebreath.engine.rates import SAMPLE_RATE
from scorebreath.engine.room import temporary_folder
from scorebreath.errors import InputError
from scorebreath.media.store import MediaStore
from scorebreath.media.wave import Encoding, write_wave
from scorebreath.score.document import Score
from scorebreath.signal.limit import CEILING_DB, PeakLimiter
from scorebreath.signal.loudness import NOTHING, LoudnessMeter, TruePeak
from scorebreath.units import amplitude, decibels, frame_count
from scorebreath_synthdefs.catalogue import SPEECH

STEMS = ("speech", "breath")
"""What the mix is made of."""
LOUDNESS = (-60.0, -5.0)
"""LUFS that can be asked for"""
NEAR = 0.05
"""LU from the wanted loudness, and dB above the highest peak, that are near enough"""
ROUNDS = 6
"""Times that gain and ceiling are corrected."""
MOST_GAIN = 60.0
"""dB; what needs more is noise"""
MOST_LIMITED = 12.0
"""dB that limiting may take from the highest peak; more would squash speech and lift breaths up to it"""
_BLOCK = 1 << 18
_FRAME = 4

Block = NDArray[np.float32]


@dataclass(frozen=True, slots=True, kw_only=True)
class Mastered:
    """What was made."""

    frames: int
    engine: str
    """name and version"""
    loudness: float | None
    """LUFS of the mix; None: not asked for, or too short or silent to be told"""
    gain_db: float
    """that was given to everything"""
    true_peak_db: float | None
    """dB re full scale; None: not asked for"""
    limited_db: float
    """the most that limiting took away, dB"""


def check_loudness(wanted: float | None) -> None:
    """Refuse what nobody can mean.

    Raises:
        InputError: It is out of range.
    """
    low, high = LOUDNESS
    if wanted is not None and not low <= wanted <= high:
        raise InputError(f"loudness={wanted:g} must be in [{low:g}, {high:g}] LUFS, such as -16 or -23")


def render_mastered(
    score: Score,
    media: MediaStore,
    mix: BinaryIO,
    *,
    loudness: float | None = None,
    stems: Mapping[str, BinaryIO] | None = None,
    engine: str | Engine = DEFAULT,
    sample_rate: int = SAMPLE_RATE,
    encoding: Encoding = "pcm24",
    timeout: float | None = None,
    on_progress: Progress | None = None,
    on_samples: Callable[[Block], None] | None = None,
) -> Mastered:
    """Render a Score as `offline.render` does, to a loudness, and its stems beside it.

    Args:
        score: What to render.
        media: Its samples.
        mix: Where the mix goes, a mono WAV file.
        loudness: Integrated loudness of the mix, LUFS; true peaks are then at most -1 dBTP. None: as it is.
        stems: Where each of `STEMS` goes; together they are the mix, to the last step of a sample. None: nowhere.
        engine: A name or an engine.
        sample_rate: Hz.
        encoding: Of the files.
        timeout: Seconds the engine may take for a piece.
        on_progress: Told how far it is.
        on_samples: Given every block (n,) of the mix as it goes into the file.

    Raises:
        InputError: The loudness, the rate or the engine's name is wrong.
        MissingExtraError: pyloudnorm is not installed.
        EngineError, EnvironmentFailure, ScoreError: As for `offline.render`.
    """
    check_loudness(loudness)
    if loudness is not None:
        LoudnessMeter(sample_rate)  # says now what is missing
    sounds = onsets(score)
    parts: list[Sequence[Onset]] = [sounds] if stems is None else [_speech(sounds, True), _speech(sounds, False)]
    frames = frame_count(score.duration, sample_rate)
    with temporary_folder(len(parts) * frames * _FRAME) as folder:
        raw = [folder / f"{number}.f32" for number in range(len(parts))]
        for number, (path, part) in enumerate(zip(raw, parts, strict=True)):
            with unlimited(
                part, media, duration=score.duration, moved=moves(score), engine=engine, sample_rate=sample_rate,
                timeout=timeout, on_progress=_part_of(on_progress, number, len(parts)),
            ) as made, path.open("wb") as stream:  # fmt: skip
                for block in made.blocks:
                    block.astype("<f4", copy=False).tofile(stream)
        setting = _settled(raw, loudness, sample_rate)
        limiter = PeakLimiter(ceiling_db=setting.ceiling_db)
        heard = _limited(raw, limiter, setting.gain)
        if on_samples is not None:
            heard = _heard_by(on_samples, heard)
        write_wave(mix, heard, frames=frames, sample_rate=sample_rate, encoding=encoding)
        for name, path in zip(STEMS, raw, strict=True) if stems is not None else ():
            again = _stem(path, raw, setting)
            write_wave((stems or {})[name], again, frames=frames, sample_rate=sample_rate, encoding=encoding)
    return Mastered(
        frames=frames, engine=made.engine, loudness=setting.loudness, gain_db=setting.gain_db,
        true_peak_db=setting.true_peak_db, limited_db=limiter.reduction_db,
    )  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class _Setting:
    """What is done to everything."""

    gain_db: float = 0.0
    ceiling_db: float = CEILING_DB
    loudness: float | None = None
    true_peak_db: float | None = None

    @property
    def gain(self) -> np.float32:
        """As a factor."""
        return np.float32(amplitude(self.gain_db))


def _settled(raw: Sequence[Path], wanted: float | None, sample_rate: int) -> _Setting:
    """The gain and the ceiling with which the mix is as loud as wanted, and its true peaks are low enough."""
    if wanted is None:
        return _Setting()
    meter, highest = LoudnessMeter(sample_rate), 0.0
    for block in _mixed(raw, np.float32(1.0)):
        meter.add(block)
        highest = max(highest, float(np.abs(block).max(initial=0.0)))
    own = meter.integrated()
    most = min(MOST_GAIN, CEILING_DB + MOST_LIMITED - decibels(highest)) if highest > 0.0 else 0.0
    setting = _Setting(gain_db=0.0 if own <= NOTHING else min(most, wanted - own))
    for last in [*[False] * (ROUNDS - 1), True]:
        loud, peak = _measured(raw, setting, sample_rate)
        told = _Setting(
            gain_db=setting.gain_db, ceiling_db=setting.ceiling_db, true_peak_db=peak,
            loudness=None if loud <= NOTHING else loud,
        )  # fmt: skip
        quieter = max(0.0, peak - CEILING_DB)
        louder = 0.0 if loud <= NOTHING else wanted - loud
        if last or (quieter <= 0.0 and (abs(louder) <= NEAR or (louder > 0.0 and setting.gain_db >= most))):
            return told
        setting = _Setting(
            gain_db=min(most, setting.gain_db + (louder if abs(louder) > NEAR else 0.0)),
            ceiling_db=setting.ceiling_db - (quieter + NEAR if quieter else 0.0),
        )
    raise AssertionError("the last round returns")


def _measured(raw: Sequence[Path], setting: _Setting, sample_rate: int) -> tuple[float, float]:
    """Loudness and true peak of the limited mix, LUFS and dB."""
    meter, peaks = LoudnessMeter(sample_rate), TruePeak(sample_rate)
    for block in _limited(raw, PeakLimiter(ceiling_db=setting.ceiling_db), setting.gain):
        meter.add(block)
        peaks.add(block)
    peaks.add(np.zeros(0, dtype=np.float32), last=True)
    return meter.integrated(), peaks.peak_db()


def _limited(raw: Sequence[Path], limiter: PeakLimiter, gain: np.float32) -> Iterator[Block]:
    return limiter.limit(_mixed(raw, gain))


def _mixed(raw: Sequence[Path], gain: np.float32) -> Iterator[Block]:
    """The sum of all parts, block by block."""
    for blocks in zip(*(_read(path) for path in raw), strict=True):
        together: Block = blocks[0] if len(blocks) == 1 else np.add(*blocks)
        yield np.asarray(together * gain, dtype=np.float32)


def _stem(path: Path, raw: Sequence[Path], setting: _Setting) -> Iterator[Block]:
    """A part under the gain of the whole."""
    limiter = PeakLimiter(ceiling_db=setting.ceiling_db)
    with path.open("rb") as stream:
        for inner, given in limiter.gains(_mixed(raw, setting.gain)):
            own = np.fromfile(stream, dtype="<f4", count=len(inner)) * setting.gain
            yield own if given is None else np.asarray(own * given, dtype=np.float32)


def _read(path: Path) -> Iterator[Block]:
    with path.open("rb") as stream:
        while len(block := np.fromfile(stream, dtype="<f4", count=_BLOCK)):
            yield block


def _speech(sounds: Sequence[Onset], speech: bool) -> list[Onset]:
    """What is said, or all the rest."""
    return [sound for sound in sounds if (sound.instrument == SPEECH) == speech]


def _part_of(tell: Progress | None, number: int, count: int) -> Progress | None:
    """Progress of one of several renderings."""
    return tell and (lambda stage, share: tell(stage, (number + share) / count))


def _heard_by(hear: Callable[[Block], None], blocks: Iterator[Block]) -> Iterator[Block]:
    for block in blocks:
        hear(block)
        yield block
