"""The user's own recordings of breaths (B43-B45): a folder of sound files, made ready to stand beside speech.

Files are named for what they hold: `mouth.wav`, `mouth-2.flac`, `sigh_soft.ogg`. Each is mixed to mono, cut to its
breath, rid of its offset, resampled to 48 kHz and brought to -20 dBFS over its hold (`signal.breaths`). Breaths drawn
through mouth and nose for speech last as long as the Score says, so of those the hold is stretched to five seconds;
every other kind has a shape of its own and keeps it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from scorebreath import chance
from scorebreath.errors import InputError, did_you_mean, shortened
from scorebreath.media.store import MediaStore, name_of
from scorebreath.signal import breaths
from scorebreath.signal.resample import resample
from scorebreath.units import plain

RecordingKind = Literal["mouth", "nose", "exhale", "sigh", "gasp", "sniff", "laugh", "hold"]
KINDS: tuple[RecordingKind, ...] = get_args(RecordingKind)
SUSTAINED: tuple[RecordingKind, ...] = ("mouth", "nose")
"""Kinds that last as long as they are wanted."""
RATE = 48_000
"""Hz, of every recording as it is kept"""
SUSTAINED_SECONDS = 5.0
LONGEST, SHORTEST = 30.0, 0.03
"""s of a file, and of the breath in it"""
RATES = (4_000, 400_000)
"""Hz"""
HIGHEST = 1000.0
"""Sample, full scale 1: files of floats may go beyond, not that far"""
MOST_CHANNELS, MOST_FILES = 32, 200
BLOCK = 1 << 14
BESIDE = (".txt", ".md")
"""What may lie beside the sounds: notes and licences."""

_NAME = re.compile(rf"({'|'.join(KINDS)})(?![a-z])", re.IGNORECASE)
_TRUNCATED = 60


@dataclass(frozen=True, slots=True, kw_only=True)
class Take:
    """A recording made ready, and what was made of it."""

    kind: RecordingKind
    file: str
    """its name in the folder"""
    sha: str
    """its name in the store"""
    frames: int
    sample_rate: int
    """Hz"""
    recorded: float
    """s that the file lasts"""
    breath: tuple[float, float]
    """where in the file the breath begins and ends, s"""
    sounds: int
    """how many sounds the file holds, the breath among them"""
    gain_db: float
    """by how much it was made louder"""
    stretch: float
    """how much longer its hold was made; 1: not at all"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Recordings:
    """All recordings of a folder."""

    seed: int
    takes: Mapping[RecordingKind, tuple[Take, ...]]
    """of each kind there is, by the names of their files"""

    def take(self, kind: RecordingKind, body: str, key: str) -> Take | None:
        """One recording of a kind, by chance: the same one for the same place, whatever else is drawn.

        Args:
            kind: Which.
            body: Whose breath it is.
            key: The place, e.g. a group's `place`.

        Returns:
            None where there is no recording of that kind.
        """
        known = self.takes.get(kind, ())
        if not known:
            return None
        return known[int(chance.stream(self.seed, body, f"recording.{kind}", key).integers(len(known)))]


def load_recordings(folder: Path, store: MediaStore, *, seed: int) -> Recordings:
    """Make all recordings of a folder ready.

    Args:
        folder: Holds sound files of any format libsndfile reads, and maybe notes (.txt, .md); hidden files and folders
            are passed over.
        store: Keeps the sounds, as media of kind `breath`.
        seed: The Score's.

    Raises:
        InputError: There is no such folder or nothing in it, a name says no kind, or a file is no sound, too long,
            silent, or holds samples that are not finite.
    """
    found: dict[RecordingKind, list[Take]] = {}
    for path, kind in _files(folder):
        take = _prepare(path, kind, store, seed)
        found.setdefault(kind, []).append(take)
    if not found:
        raise InputError(f"{folder}: holds no recordings; expected files such as mouth.wav, nose.wav, sigh.wav")
    ordered = {kind: tuple(found[kind]) for kind in KINDS if kind in found}
    return Recordings(seed=seed, takes=MappingProxyType(ordered))


def describe(recordings: Recordings) -> tuple[str, ...]:
    """A line for each recording: what was made of it.

    >>> take = Take(
    ...     kind="mouth", file="mouth.wav", sha="0" * 64, frames=240000, sample_rate=48000, recorded=1.9,
    ...     breath=(0.42, 1.08), sounds=2, gain_db=7.31, stretch=18.4,
    ... )
    >>> describe(Recordings(seed=0, takes={"mouth": (take,)}))
    ('mouth.wav: mouth, 0.42-1.08 s of 1.90 s (the loudest of 2 sounds), +7.3 dB, hold x18.4 to 5.00 s',)
    """
    return tuple(_described(take) for takes in recordings.takes.values() for take in takes)


def _described(take: Take) -> str:
    begin, end = take.breath
    among = f" (the loudest of {take.sounds} sounds)" if take.sounds > 1 else ""
    length = f"{take.frames / take.sample_rate:.2f} s"
    made = f"hold x{take.stretch:.1f} to {length}" if take.stretch > 1 else length
    where = f"{begin:.2f}-{end:.2f} s of {take.recorded:.2f} s{among}"
    return f"{take.file}: {take.kind}, {where}, {take.gain_db:+.1f} dB, {made}"


def _files(folder: Path) -> Iterator[tuple[Path, RecordingKind]]:
    """The sound files of a folder with their kinds, by name."""
    try:
        paths = sorted(path for path in folder.iterdir() if path.is_file() and not path.name.startswith("."))
    except OSError as error:
        raise InputError(f"{folder}: cannot be read: {error.strerror}; expected a folder of recordings") from None
    paths = [path for path in paths if path.suffix.lower() not in BESIDE]
    if len(paths) > MOST_FILES:
        raise InputError(f"{folder}: holds {len(paths)} files; expected at most {MOST_FILES} recordings")
    for path in paths:
        named = _NAME.match(path.stem)
        if named is None:
            word = re.split(r"[^a-z]", path.stem.lower())[0]
            raise InputError(
                f"{folder}: {shortened(path.name, _TRUNCATED)!r} names no kind of breath; expected a name that begins "
                f"with one of {', '.join(KINDS)}, such as mouth-2.wav{did_you_mean(word, KINDS)}"
            )
        yield path, next(kind for kind in KINDS if kind == named[1].lower())


def _prepare(path: Path, kind: RecordingKind, store: MediaStore, seed: int) -> Take:
    samples, rate = _read(path)
    samples = samples - samples.mean()
    spans = breaths.sounding_spans(samples, rate)
    if not spans:
        raise InputError(f"{path}: is silent; expected a breath")
    span = breaths.loudest(samples, spans)
    if span.frames < SHORTEST * rate:
        raise InputError(f"{path}: its sound lasts {span.frames / rate:.3f} s; expected at least {SHORTEST:g} s")
    breath = resample(np.asarray(samples[span.start : span.stop], dtype=np.float32), rate, RATE)
    breath = breath - breath.mean(dtype=np.float64).astype(np.float32)
    stretch = 1.0
    if kind in SUSTAINED:
        held = breaths.hold_span(breath, RATE)
        if held.frames < breaths.shortest_hold() * RATE:
            raise InputError(
                f"{path}: the loud part of its breath lasts {held.frames / RATE:.2f} s; expected at least "
                f"{breaths.shortest_hold():.2f} s of {kind}, to be stretched to {SUSTAINED_SECONDS:g} s"
            )
        breath = breath[held.start : held.stop]
        own = chance.engine_seed(seed, "", "recording.stretch", name_of(breath))
        breath, stretch = breaths.sustained(breath, RATE, SUSTAINED_SECONDS, own)
    made, gain = breaths.at_target(breath, RATE)
    return Take(
        kind=kind, file=path.name, sha=store.put(made, RATE, "breath"), frames=len(made), sample_rate=RATE,
        recorded=len(samples) / rate, breath=(span.start / rate, span.stop / rate), sounds=len(spans), gain_db=gain,
        stretch=stretch,
    )  # fmt: skip


def _read(path: Path) -> tuple[NDArray[np.float64], int]:
    """A file as mono, and its rate; never more than the longest is held in memory."""
    import soundfile

    try:
        with soundfile.SoundFile(path) as file:
            rate, channels = int(file.samplerate), int(file.channels)
            if not RATES[0] <= rate <= RATES[1]:
                raise InputError(f"{path}: sample_rate={rate} must be in [{RATES[0]}, {RATES[1]}] Hz")
            if channels > MOST_CHANNELS:
                raise InputError(f"{path}: channels={channels} must be at most {MOST_CHANNELS}")
            samples = _mono(file, path, math.floor(LONGEST * rate))
    except soundfile.LibsndfileError as error:
        raise InputError(f"{path}: {error.error_string} Expected a sound file") from None
    except TypeError:  # of a name that ends in .raw it asks for the rate
        raise InputError(f"{path}: says nothing about its samples; expected a sound file such as WAV") from None
    if not len(samples):
        raise InputError(f"{path}: holds no samples; expected a breath")
    return samples, rate


def _mono(file: Any, path: Path, most: int) -> NDArray[np.float64]:
    blocks: list[NDArray[np.float64]] = []
    count = 0
    while len(block := file.read(BLOCK, dtype="float64", always_2d=True)):
        count += len(block)
        if count > most:
            raise InputError(f"{path}: is longer than {plain(LONGEST)} s; expected one breath")
        if not np.max(np.abs(block)) <= HIGHEST:
            raise InputError(f"{path}: holds samples that are not finite, or far beyond full scale")
        blocks.append(block.mean(axis=1))
    return np.concatenate(blocks) if blocks else np.zeros(0)
