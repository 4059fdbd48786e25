"""From one input to the whole output set."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from scorebreath.errors import InputError
from scorebreath_cli.inputs import Source, load_score
from scorebreath_cli.making import Compiler
from scorebreath_cli.outputs import (
    BODY_FILES,
    RIG_SUFFIX,
    SCORE,
    SET_FILES,
    STEM_FILES,
    old_media,
    old_rigs,
    old_stems,
    refuse_existing,
    refuse_own_input,
    staged,
)
from scorebreath_cli.printers import Printer
from scorebreath_cli.recording import read_input, take_of
from scorebreath_cli.settings import frame_rate
from scorebreath_cli.writers import Writers

if TYPE_CHECKING:
    from fractions import Fraction

    from scorebreath.engine.master import Mastered
    from scorebreath.media.store import MediaStore
    from scorebreath.score.document import Score

BYTES_A_FRAME = 3
"""of mix.wav"""


@dataclass(frozen=True, slots=True, kw_only=True)
class SoundOptions:
    """How a Score is rendered."""

    engine: str
    rate: int
    """Hz"""
    fps: str
    """frames per second of the curves, as given"""
    rigs: tuple[str, ...] = ()
    """characters whose shapes are written as well: names, or paths of `.toml` files"""
    loudness: float | None = None
    """LUFS of the mix; None: as it is"""
    stems: bool = False
    """whether speech and breath are written apart as well"""

    @property
    def mastered(self) -> bool:
        """Whether more is to be done than to render."""
        return self.stems or self.loudness is not None

    @property
    def stem_files(self) -> tuple[str, ...]:
        """What they are called."""
        return STEM_FILES if self.stems else ()

    def check(self) -> Fraction:
        """Refuse what is wrong before anything is made; the frames per second.

        Raises:
            InputError: No such engine, no such rig, or a rate out of range.
        """
        self.check_rigs()
        from scorebreath.engine.engines import engine_named
        from scorebreath.engine.rates import check_sample_rate

        engine_named(self.engine)
        check_sample_rate(self.rate)
        if self.loudness is not None:
            from scorebreath.engine.master import check_loudness
            from scorebreath.signal.loudness import LoudnessMeter

            check_loudness(self.loudness)
            LoudnessMeter(self.rate)  # says what is missing before anything is spoken
        return frame_rate(self.fps)

    def check_rigs(self) -> None:
        """Refuse a rig that is none, and two that would be one file.

        Raises:
            InputError: Names it.
        """
        if not self.rigs:
            return
        from scorebreath.curves.rigs.table import rig_named

        taken = set(SET_FILES)
        for rig, name in zip(self.rigs, self.rig_files, strict=True):
            rig_named(rig)
            if name in taken:
                raise InputError(f"--rig {rig}: {name} is another file of the output already; rename the rig's file")
            taken.add(name)

    @property
    def rig_files(self) -> tuple[str, ...]:
        """What each rig's curves are called."""
        return tuple(Path(rig).name.removesuffix(".toml") + RIG_SUFFIX for rig in self.rigs)


class Renderer:
    """Renders every input of a run."""

    def __init__(self, compiler: Compiler, sound: SoundOptions, printer: Printer) -> None:
        """Nothing starts yet."""
        self._compiler, self._sound, self._printer = compiler, sound, printer

    def into(self, given: str, folder: Path, *, force: bool) -> None:
        """Render one input into a folder.

        Raises:
            ScorebreathError: The input, an option, the voice, the engine or the disk.
        """
        source = read_input(given, self._compiler.options)
        besides = source.path if source.kind == "score" else None
        own = (*SET_FILES, *self._sound.rig_files, *self._sound.stem_files)
        refuse_own_input(given, (folder / name for name in own if besides is None or name != SCORE))
        if (take := take_of(self._compiler.options.voice)) is not None:
            refuse_own_input(str(take), (folder / name for name in own))
        refuse_existing(folder, own, force=force, besides=besides)
        fps = self._begin(source)
        self._printer.started(source.name, str(folder))
        with (
            staged(folder, own=lambda old: old_media(old) | old_rigs(old) | old_stems(old)) as part,
            ThreadPoolExecutor(1, thread_name_prefix="writer") as writer,
        ):
            score, media = self._score(source, part, lambda: _beside(SOUND + PICTURE))
            others = tuple(
                f"{body.id}/{name}"
                for body in score.bodies[1:]
                for name in own
                if name in self._sound.rig_files or name in BODY_FILES
            )
            refuse_existing(folder, others, force=force)
            self._write_set(score, media, part, fps, writer)
        for name in sorted((*own, *others)):
            self._printer.written(str(folder / name), (folder / name).stat().st_size)

    def to_stdout(self, given: str) -> None:
        """Render one input to a WAV file on stdout.

        Raises:
            ScorebreathError: As for `into`.
        """
        from tempfile import TemporaryDirectory

        source = read_input(given, self._compiler.options)
        self._begin(source)
        with TemporaryDirectory(prefix="scorebreath-") as folder:
            score, media = self._score(source, Path(folder), lambda: _beside(SOUND))
            self._sound_of(score, media, sys.stdout.buffer)

    def _begin(self, source: Source) -> Fraction:
        """Refuse options that are wrong, while the voice gets ready; the frames per second."""
        if source.compiled:
            self._compiler.options.refuse(source.name)
        else:
            self._compiler.prepare(source)
        return self._sound.check()

    def _score(self, source: Source, part: Path, meanwhile: Callable[[], object]) -> tuple[Score, MediaStore]:
        """The Score, compiled if it is not one already; its speech is in the store, on disk."""
        if source.compiled:
            return load_score(source)
        from scorebreath.media.store import FolderStore

        media = FolderStore(part)
        return self._compiler.compile(source, media, meanwhile), media

    def _sound_of(
        self, score: Score, media: MediaStore, stream: BinaryIO, hear: Callable[[Any], None] | None = None,
        stems: Mapping[str, BinaryIO] | None = None,
    ) -> None:  # fmt: skip
        sound = self._sound
        if not sound.mastered:
            from scorebreath.engine.offline import render

            render(
                score, media, stream, engine=sound.engine, sample_rate=sound.rate,
                on_progress=self._printer.progress, on_samples=hear,
            )  # fmt: skip
            return
        from scorebreath.engine.master import render_mastered

        made = render_mastered(
            score, media, stream, loudness=sound.loudness, stems=stems, engine=sound.engine, sample_rate=sound.rate,
            on_progress=self._printer.progress, on_samples=hear,
        )  # fmt: skip
        if sound.loudness is not None:
            self._tell_loudness(made, sound.loudness)

    def _tell_loudness(self, made: Mastered, wanted: float) -> None:
        about = {
            "loudness": made.loudness, "gain_db": made.gain_db, "true_peak_db": made.true_peak_db,
            "limited_db": made.limited_db,
        }  # fmt: skip
        self._printer.item("loudness", {key: value and round(value, 2) for key, value in about.items()}, "")
        if made.loudness is None:
            self._printer.note("--loudness: too short or too quiet to have one; it is left as it is")
        elif abs(made.loudness - wanted) > 0.1:
            self._printer.note(
                f"--loudness {wanted:g}: {made.loudness:.1f} LUFS is what it can have with its peaks below -1 dBTP"
            )

    def _write_set(self, score: Score, media: MediaStore, part: Path, fps: Fraction, writer: Executor) -> None:
        """Every file of the set: what needs no sound is made while the engine works in its own process."""
        from scorebreath.report.compact import CompactSound
        from scorebreath.report.preview import seconds_shown
        from scorebreath.score.files import with_media_paths

        _check_room(part, score.duration, self._sound.rate * (1 + len(self._sound.stem_files)))
        first, more = (score.bodies[0].id if score.bodies else None), score.bodies[1:]
        whole = with_media_paths(score)
        rigs = dict(zip(self._sound.rig_files, self._sound.rigs, strict=True))
        silent = Writers(whole, media, part, fps, first, rigs=rigs)
        besides = [Writers(whole, media, part / body.id, fps, body.id, rigs=rigs) for body in more]
        try:
            page, others = writer.submit(silent.page), writer.submit(silent.write)
            jobs = [writer.submit(each.write, (*BODY_FILES, *rigs)) for each in besides]
            compact = CompactSound(self._sound.rate, seconds_shown(score))
            with ExitStack() as files:
                stream = files.enter_context((part / "mix.wav").open("wb"))
                stems = _stems_in(part, files) if self._sound.stems else None
                self._sound_of(score, media, stream, compact.add, stems)
            with (part / "preview.html").open("wb") as stream:
                page.result().write(stream, compact)
            for job in (others, *jobs):
                job.result()
        finally:
            for each in (silent, *besides):
                each.stop()


def _stems_in(part: Path, files: ExitStack) -> dict[str, BinaryIO]:
    """Files for the stems, by what they hold."""
    made: dict[str, BinaryIO] = {}
    for name in STEM_FILES:
        path = part / name
        path.parent.mkdir(exist_ok=True)
        made[path.stem] = files.enter_context(path.open("wb"))
    return made


def _check_room(folder: Path, duration: float, rate: int) -> None:
    """Refuse a sound that the disk cannot hold before any of it is made.

    Raises:
        EnvironmentFailure: Names what is needed and what is free.
    """
    from shutil import disk_usage

    from scorebreath.errors import EnvironmentFailure
    from scorebreath.units import frame_count, plain

    needed, free = BYTES_A_FRAME * frame_count(duration, rate), disk_usage(folder).free
    if needed > free:
        raise EnvironmentFailure(
            f"{folder.parent}: a sound of {plain(duration)} s needs {needed / 1e9:.3g} GB, {free / 1e9:.3g} GB are free"
        )


SOUND = ("scorebreath.engine.offline", "soxr")
PICTURE = (
    "scorebreath.formats.curves_csv", "scorebreath.formats.curves_json", "scorebreath.formats.groups_csv",
    "scorebreath.report.preview", "scorebreath.report.timeline", "scorebreath.score.files", "soundfile",
    "matplotlib.backends.backend_agg", "matplotlib.font_manager",
)  # fmt: skip
"""What rendering imports when it first needs it: seconds in which the voice speaks, and then the engine works."""


def _beside(names: Sequence[str]) -> None:
    """Bring modules in beside the voice, in a thread that nobody waits for.

    An interrupt that strikes while this thread waits for the lock of all imports takes that lock along (Python 3.11):
    the other one then waits for ever.
    """
    threading.Thread(target=_imports, args=(names,), name="imports", daemon=True).start()


def _imports(names: Sequence[str]) -> None:
    """Bring modules in."""
    import importlib

    for name in names:
        with suppress(ImportError):  # told where it is needed
            importlib.import_module(name)
