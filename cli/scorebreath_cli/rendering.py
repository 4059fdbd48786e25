"""From one input to the whole output set."""

from __future__ import annotations

import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING, BinaryIO, Self

from scorebreath_cli.inputs import Source, load_score, read_source
from scorebreath_cli.making import Compiler
from scorebreath_cli.outputs import SET_FILES, old_media, refuse_existing, staged
from scorebreath_cli.printers import Printer
from scorebreath_cli.settings import frame_rate, sample_rate

if TYPE_CHECKING:
    from fractions import Fraction

    from scorebreath.media.store import MediaStore
    from scorebreath.score.document import Score


@dataclass(frozen=True, slots=True, kw_only=True)
class SoundOptions:
    """How a Score is rendered."""

    engine: str
    rate: int
    """Hz"""
    fps: Fraction
    """frames per second of the curves"""

    @classmethod
    def checked(cls, *, engine: str, rate: int, fps: str) -> Self:
        """Refuse what is wrong before anything is made.

        Raises:
            InputError: No such engine, or a rate out of range.
        """
        from scorebreath.engine.engines import engine_named

        engine_named(engine)
        return cls(engine=engine, rate=sample_rate(rate), fps=frame_rate(fps))


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
        source = read_source(given)
        besides = source.path if source.kind == "score" else None
        refuse_existing(folder, SET_FILES, force=force, besides=besides)
        self._printer.started(source.name, str(folder))
        with staged(folder, own=old_media) as part:
            score, media = self._score(source, part)
            _write_set(score, media, part, self._sound, self._printer)
        for name in sorted(SET_FILES):
            self._printer.written(str(folder / name), (folder / name).stat().st_size)

    def to_stdout(self, given: str) -> None:
        """Render one input to a WAV file on stdout.

        Raises:
            ScorebreathError: As for `into`.
        """
        from tempfile import TemporaryDirectory

        with TemporaryDirectory(prefix="scorebreath-") as folder:
            score, media = self._score(read_source(given), Path(folder))
            from scorebreath.engine.offline import render

            render(
                score,
                media,
                sys.stdout.buffer,
                engine=self._sound.engine,
                sample_rate=self._sound.rate,
                on_progress=self._printer.progress,
            )

    def _score(self, source: Source, part: Path) -> tuple[Score, MediaStore]:
        """The Score, compiled if it is not one already; its speech is in the store, on disk."""
        if source.compiled:
            self._compiler.options.refuse(source.name)
            return load_score(source)
        from scorebreath.media.store import FolderStore

        media = FolderStore(part)
        return self._compiler.compile(source, media, _imports), media


def _write_set(score: Score, media: MediaStore, part: Path, sound: SoundOptions, printer: Printer) -> None:
    """Every file of the set: what needs no sound is made while the engine works in its own process."""
    from scorebreath.report.preview import write_preview

    from scorebreath.engine.offline import render
    from scorebreath.score.files import save, with_media_paths

    score = with_media_paths(score)
    silent = _Writers(score, part, sound.fps)
    with ThreadPoolExecutor(1, thread_name_prefix="writer") as pool:
        try:
            others = pool.submit(silent.write)
            with (part / "mix.wav").open("wb") as stream:
                render(score, media, stream, engine=sound.engine, sample_rate=sound.rate, on_progress=printer.progress)
            others.result()
        finally:
            silent.stop()
    with (part / "preview.html").open("wb") as stream:
        write_preview(stream, score, silent.curve_set, part / "mix.wav")
    save(score, part / "score.json", media)


class _Writers:
    """What can be written without the sound."""

    def __init__(self, score: Score, part: Path, fps: Fraction) -> None:
        from scorebreath.curves.curve_set import curves

        self.curve_set = curves(score)
        self._score, self._part, self._fps = score, part, fps
        self._stopped = Event()

    def stop(self) -> None:
        """Write no further file."""
        self._stopped.set()

    def write(self) -> None:
        """One after the other."""
        from scorebreath.formats import curves_csv, curves_json, groups_csv
        from scorebreath.report.timeline import write_timeline

        writers: dict[str, Callable[[BinaryIO], None]] = {
            "timeline.png": lambda stream: write_timeline(stream, self._score, self.curve_set),
            "curves.csv": lambda s: curves_csv.write(s, self.curve_set, self._score.duration, self._fps),
            "curves.json": lambda s: curves_json.write(s, self.curve_set, self._score.duration, self._fps),
            "groups.csv": lambda stream: groups_csv.write(stream, self._score),
        }
        for name, write in writers.items():
            if self._stopped.is_set():
                return
            with (self._part / name).open("wb") as stream:
                write(stream)


def _imports() -> None:
    """Bring in what rendering needs, while the voice gets ready; in one thread, as imports do not like company."""
    import scorebreath.report.preview

    import scorebreath.engine.offline
    import scorebreath.report.timeline  # noqa: F401
