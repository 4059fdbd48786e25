"""A Score rendered to sound: stage, tell, run, cut, limit, write."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from scorebreath.engine.commands import commands, write_commands
from scorebreath.engine.engines import DEFAULT, Engine, engine_named
from scorebreath.engine.onsets import Onset, onsets
from scorebreath.engine.rates import SAMPLE_RATE, check_sample_rate
from scorebreath.engine.room import temporary_folder
from scorebreath.engine.run import COMMANDS, Needs, run
from scorebreath.engine.segments import Segment, segments
from scorebreath.engine.staging import stage
from scorebreath.errors import EngineError
from scorebreath.media.store import MediaStore
from scorebreath.media.wave import Encoding, write_wave
from scorebreath.score.document import Score
from scorebreath.signal.limit import PeakLimiter
from scorebreath.units import decibels, frame_count

Progress = Callable[[str, float], None]
"""Called with `sound` and the share of it that is done."""
_BLOCK = 1 << 18  # frames read at once
_FRAME = 4  # bytes of a float32 sample
_STAGING, _ENGINE, _WRITING = (0.0, 0.4), (0.4, 0.8), (0.8, 1.0)  # where in a segment's work a stage lies


@dataclass(frozen=True, slots=True, kw_only=True)
class Rendered:
    """What a rendering gave."""

    frames: int
    sample_rate: int
    """Hz"""
    peak_db: float
    """dB re full scale, before limiting"""
    limited_db: float
    """the most that limiting took away, dB; 0 where nothing was"""
    engine: str
    """name and version"""
    sounds: int
    """breaths and utterances; mouth and nose count as two"""


def render(
    score: Score,
    media: MediaStore,
    stream: BinaryIO,
    *,
    engine: str | Engine = DEFAULT,
    sample_rate: int = SAMPLE_RATE,
    encoding: Encoding = "pcm24",
    timeout: float | None = None,
    on_progress: Progress | None = None,
) -> Rendered:
    """Render a Score into a mono WAV file of exactly round(duration * sample_rate) frames.

    Equal Scores give equal bytes on one machine. Neither memory nor temporary files grow with the Score.

    Args:
        score: What to render.
        media: Its samples.
        stream: Where the WAV file goes, front to back.
        engine: A name (`embedded`, `scsynth`, `scsynth:FILE`) or an engine.
        sample_rate: Of the engine and the file, Hz.
        encoding: Of the file.
        timeout: Seconds the engine may take for five minutes or so; None: a minute and half the length of the sound.
        on_progress: Told how far it is.

    Raises:
        EngineError: The engine is missing or failed; carries its own words.
        EnvironmentFailure: The disk has no room.
        ScoreError: Media are missing or broken, or a sound cannot be played.
        InputError: The rate or the engine's name is unknown.
    """
    return render_sounds(
        onsets(score),
        media,
        stream,
        duration=score.duration,
        engine=engine,
        sample_rate=sample_rate,
        encoding=encoding,
        timeout=timeout,
        on_progress=on_progress,
    )


def render_sounds(
    sounds: Sequence[Onset],
    media: MediaStore,
    stream: BinaryIO,
    *,
    duration: float,
    engine: str | Engine = DEFAULT,
    sample_rate: int = SAMPLE_RATE,
    encoding: Encoding = "pcm24",
    timeout: float | None = None,
    on_progress: Progress | None = None,
) -> Rendered:
    """Render some of a Score's sounds (a stem, one breath); otherwise as `render`.

    Args:
        sounds: In order of time.
        media: Samples of those that play any.
        stream: Where the WAV file goes, front to back.
        duration: Seconds of the file; what starts later is left out.
        engine: A name or an engine.
        sample_rate: Hz.
        encoding: Of the file.
        timeout: Seconds the engine may take.
        on_progress: Told how far it is.
    """
    chosen = engine_named(engine) if isinstance(engine, str) else engine
    version = chosen.version()
    frames = frame_count(duration, check_sample_rate(sample_rate))
    heard = [sound for sound in sounds if sound.duration > 0 and frame_count(sound.time, sample_rate) < frames]
    job = _Job(media=media, engine=chosen, sample_rate=sample_rate, timeout=timeout, frames=frames, tell=on_progress)
    limiter = PeakLimiter()
    pieces = segments(heard, frames=frames, sample_rate=sample_rate)
    blocks = itertools.chain.from_iterable(map(job.blocks, pieces))
    write_wave(stream, limiter.limit(blocks), frames=frames, sample_rate=sample_rate, encoding=encoding)
    return Rendered(
        frames=frames,
        sample_rate=sample_rate,
        peak_db=decibels(limiter.peak),
        limited_db=limiter.reduction_db,
        engine=f"{chosen.name} ({version})",
        sounds=len(heard),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Job:
    """What the pieces of one rendering share."""

    media: MediaStore
    engine: Engine
    sample_rate: int
    timeout: float | None
    frames: int
    tell: Progress | None

    def blocks(self, segment: Segment) -> Iterator[NDArray[np.float32]]:
        """The samples of one piece, (n,) float32 each."""
        if not segment.sounds:
            for start in range(0, segment.frames, _BLOCK):
                block = np.zeros(min(_BLOCK, segment.frames - start), dtype=np.float32)
                yield block
                self._progress(segment, _WRITING, (start + len(block)) / segment.frames)
            return
        with temporary_folder(self._bytes(segment)) as folder:
            made = self._engine_makes(segment, folder)
            with made.open("rb") as stream:
                for start in range(0, segment.frames, _BLOCK):
                    block = np.fromfile(stream, dtype=np.float32, count=min(_BLOCK, segment.frames - start))
                    if not np.isfinite(np.abs(block).max(initial=0.0)):
                        raise EngineError(f"the {self.engine.name} engine made samples that are not finite")
                    yield block
                    self._progress(segment, _WRITING, (start + len(block)) / segment.frames)

    def _engine_makes(self, segment: Segment, folder: Path) -> Path:
        staged = stage(
            _lengths(segment), self.media, folder,
            sample_rate=self.sample_rate, on_progress=partial(self._progress, segment, _STAGING),
        )  # fmt: skip
        with (folder / COMMANDS).open("wb") as stream:
            write_commands(stream, commands(segment, staged.__getitem__, sample_rate=self.sample_rate))
        return run(
            self.engine, folder,
            frames=segment.frames, sample_rate=self.sample_rate, timeout=self.timeout,
            needs=Needs(buffers=len(segment.sounds) + 1, nodes=segment.overlap),
            on_progress=partial(self._progress, segment, _ENGINE),
        )  # fmt: skip

    def _bytes(self, segment: Segment) -> int:
        seconds = sum(_lengths(segment).values())
        return int(1.05 * _FRAME * (segment.frames + self.sample_rate * seconds))

    def _progress(self, segment: Segment, part: tuple[float, float], share: float) -> None:
        if self.tell is not None:
            before, after = part
            within = before + (after - before) * share
            self.tell("sound", (segment.start + within * segment.frames) / self.frames)


def _lengths(segment: Segment) -> dict[str, float]:
    return {sound.media: sound.duration for sound in segment.sounds if sound.media is not None}
