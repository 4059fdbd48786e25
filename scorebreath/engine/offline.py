"""A Score rendered to sound: stage, tell, run, cut, limit, write."""

from __future__ import annotations

import itertools
import shutil
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from threading import Event, Lock
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from scorebreath.engine.commands import commands, write_commands
from scorebreath.engine.engines import DEFAULT, Engine, engine_named
from scorebreath.engine.moves import Move, buses, moves
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
AHEAD = 2
"""Pieces that are made while one is taken: the sounds of one get ready while the engine makes the other."""
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
    on_samples: Callable[[NDArray[np.float32]], None] | None = None,
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
        timeout: Seconds an engine may take for a piece (some minutes); None: a minute and half the length of the piece.
        on_progress: Told how far it is.
        on_samples: Given every block (n,) as it goes into the file.

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
        moved=moves(score),
        engine=engine,
        sample_rate=sample_rate,
        encoding=encoding,
        timeout=timeout,
        on_progress=on_progress,
        on_samples=on_samples,
    )


def render_sounds(
    sounds: Sequence[Onset],
    media: MediaStore,
    stream: BinaryIO,
    *,
    duration: float,
    moved: Sequence[Move] = (),
    engine: str | Engine = DEFAULT,
    sample_rate: int = SAMPLE_RATE,
    encoding: Encoding = "pcm24",
    timeout: float | None = None,
    on_progress: Progress | None = None,
    on_samples: Callable[[NDArray[np.float32]], None] | None = None,
) -> Rendered:
    """Render some of a Score's sounds (a stem, one breath); otherwise as `render`.

    Args:
        sounds: In order of time.
        media: Samples of those that play any.
        stream: Where the WAV file goes, front to back.
        duration: Seconds of the file; what starts later is left out.
        moved: What is moved meanwhile, in order of time.
        engine: A name or an engine.
        sample_rate: Hz.
        encoding: Of the file.
        timeout: Seconds the engine may take.
        on_progress: Told how far it is.
        on_samples: Given every block (n,) as it goes into the file.
    """
    limiter = PeakLimiter()
    with unlimited(
        sounds, media, duration=duration, moved=moved, engine=engine, sample_rate=sample_rate, timeout=timeout,
        on_progress=on_progress,
    ) as made:  # fmt: skip
        blocks = limiter.limit(made.blocks)
        if on_samples is not None:
            blocks = _heard_by(on_samples, blocks)
        write_wave(stream, blocks, frames=made.frames, sample_rate=sample_rate, encoding=encoding)
    return Rendered(
        frames=made.frames,
        sample_rate=sample_rate,
        peak_db=decibels(limiter.peak),
        limited_db=limiter.reduction_db,
        engine=made.engine,
        sounds=made.sounds,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Unlimited:
    """What an engine makes, before anything is done to it."""

    blocks: Iterator[NDArray[np.float32]]
    """(n,) each, all frames together; taken once, while the context is open"""
    frames: int
    engine: str
    """name and version"""
    sounds: int


@contextmanager
def unlimited(
    sounds: Sequence[Onset],
    media: MediaStore,
    *,
    duration: float,
    moved: Sequence[Move] = (),
    engine: str | Engine = DEFAULT,
    sample_rate: int = SAMPLE_RATE,
    timeout: float | None = None,
    on_progress: Progress | None = None,
) -> Iterator[Unlimited]:
    """What an engine makes of some sounds, as `render_sounds`; whatever goes wrong, no engine works on behind it."""
    chosen = engine_named(engine) if isinstance(engine, str) else engine
    version = chosen.version()
    frames = frame_count(duration, check_sample_rate(sample_rate))
    heard = [sound for sound in sounds if sound.duration > 0 and frame_count(sound.time, sample_rate) < frames]
    job = _Job(media=media, engine=chosen, sample_rate=sample_rate, timeout=timeout, told=_Told(on_progress, frames))
    pieces = list(segments(heard, frames=frames, sample_rate=sample_rate, moves=moved))
    with closing(job.blocks(pieces)) as made:
        yield Unlimited(blocks=made, frames=frames, engine=f"{chosen.name} ({version})", sounds=len(heard))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Job:
    """What the pieces of one rendering share."""

    media: MediaStore
    engine: Engine
    sample_rate: int
    timeout: float | None
    told: _Told

    def blocks(self, pieces: Sequence[Segment]) -> Generator[NDArray[np.float32], None, None]:
        """The samples of all pieces, (n,) float32 each; engines make the next pieces while one is taken."""
        if not any(piece.sounds for piece in pieces):
            yield from itertools.chain.from_iterable(map(self._silence, pieces))
            return
        stopped = Event()
        with (
            temporary_folder(self._bytes(pieces)) as folder,
            ThreadPoolExecutor(AHEAD, thread_name_prefix="engine") as pool,
        ):
            try:
                coming = deque(pool.submit(self._make, piece, folder, stopped) for piece in pieces[:AHEAD])
                for number, piece in enumerate(pieces, AHEAD):
                    made = coming.popleft().result()
                    coming.extend(
                        pool.submit(self._make, following, folder, stopped) for following in pieces[number : number + 1]
                    )
                    yield from self._samples(piece, made) if piece.sounds else self._silence(piece)
            finally:
                stopped.set()

    def _make(self, segment: Segment, folder: Path, stopped: Event) -> Path:
        """Have the engine make one piece, in a folder of its own; its samples are all that is left there."""
        place = folder / f"{segment.start}"
        if not segment.sounds:
            return place
        place.mkdir()
        staged = stage(
            _lengths(segment), self.media, place,
            sample_rate=self.sample_rate, on_progress=partial(self.told, segment, _STAGING),
        )  # fmt: skip
        with (place / COMMANDS).open("wb") as stream:
            told = commands(segment, staged.__getitem__, sample_rate=self.sample_rate, buses=buses(segment.moves))
            write_commands(stream, told)
        made = run(
            self.engine, place,
            frames=segment.frames, sample_rate=self.sample_rate, timeout=self.timeout,
            needs=Needs(buffers=len(segment.sounds) + 1, nodes=segment.overlap),
            on_progress=partial(self.told, segment, _ENGINE), stopped=stopped,
        )  # fmt: skip
        for name in staged.values():
            (place / name).unlink()
        return made

    def _samples(self, segment: Segment, made: Path) -> Iterator[NDArray[np.float32]]:
        """What the engine made of a piece; gone from the disk when it is taken."""
        with made.open("rb") as stream:
            for start in range(0, segment.frames, _BLOCK):
                block = np.fromfile(stream, dtype=np.float32, count=min(_BLOCK, segment.frames - start))
                if not np.isfinite(np.abs(block).max(initial=0.0)):
                    raise EngineError(f"the {self.engine.name} engine made samples that are not finite")
                yield block
                self.told(segment, _WRITING, (start + len(block)) / segment.frames)
        shutil.rmtree(made.parent, ignore_errors=True)

    def _silence(self, segment: Segment) -> Iterator[NDArray[np.float32]]:
        for start in range(0, segment.frames, _BLOCK):
            block = np.zeros(min(_BLOCK, segment.frames - start), dtype=np.float32)
            yield block
            self.told(segment, _WRITING, (start + len(block)) / segment.frames)

    def _bytes(self, pieces: Sequence[Segment]) -> int:
        """Of the pieces that are on the disk at once."""
        sizes = [piece.frames + self.sample_rate * sum(_lengths(piece).values()) for piece in pieces if piece.sounds]
        return int(1.05 * _FRAME * sum(sorted(sizes)[-1 - AHEAD :]))


class _Told:
    """Adds up how far the pieces are. Two threads tell it, so it locks."""

    def __init__(self, tell: Progress | None, frames: int) -> None:
        self._tell, self._frames = tell, frames
        self._done: dict[int, float] = {}
        self._lock = Lock()

    def __call__(self, segment: Segment, part: tuple[float, float], share: float) -> None:
        """So much of a part of the work on a piece is done."""
        if self._tell is None:
            return
        before, after = part
        with self._lock:
            self._done[segment.start] = segment.frames * (before + (after - before) * share)
            self._tell("sound", min(1.0, sum(self._done.values()) / self._frames))


def _heard_by(
    hear: Callable[[NDArray[np.float32]], None], blocks: Iterable[NDArray[np.float32]]
) -> Iterator[NDArray[np.float32]]:
    for block in blocks:
        hear(block)
        yield block


def _lengths(segment: Segment) -> dict[str, float]:
    return {sound.media: sound.media_duration for sound in segment.sounds if sound.media is not None}
