"""Files of an output that need no sound: pictures, curves, tables, the Score itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fractions import Fraction

    from scorebreath.media.store import MediaStore
    from scorebreath.report.preview import Preview
    from scorebreath.score.document import Score


class Writers:
    """What can be written without the sound."""

    def __init__(
        self, score: Score, media: MediaStore, part: Path, fps: Fraction, body: str | None, *,
        rigs: Mapping[str, str],
    ) -> None:  # fmt: skip
        from scorebreath.curves.curve_set import curves

        self._body, self._rigs = body, rigs
        self.score, self.curve_set = score, curves(score, body)
        self._media, self._part, self._fps = media, part, fps
        self._stopped = Event()

    def stop(self) -> None:
        """Write no further file."""
        self._stopped.set()

    def page(self) -> Preview:
        """The preview, but for its sound."""
        from scorebreath.report.preview import Preview

        return Preview(self.score, self.curve_set)

    def write(self, names: Sequence[str] | None = None) -> None:
        """One after the other, the slowest first; all of them, or those named."""
        self._part.mkdir(exist_ok=True)
        writers: dict[str, Callable[[Path], None]] = {
            "timeline.png": self._timeline,
            "score.json": self._score,
            "curves.csv": self._curves,
            "curves.json": self._curves,
            "groups.csv": self._groups,
            **dict.fromkeys(self._rigs, self._rig),
        }
        for name, write in writers.items():
            if self._stopped.is_set():
                return
            if names is not None and name not in names:
                continue
            write(self._part / name)

    def _timeline(self, path: Path) -> None:
        from scorebreath.report.timeline import write_timeline

        with path.open("wb") as stream:
            write_timeline(stream, self.score, self.curve_set)

    def _score(self, path: Path) -> None:
        from scorebreath.score.files import save

        save(self.score, path, self._media)

    def _curves(self, path: Path) -> None:
        from scorebreath.formats import curves_csv, curves_json

        write = curves_csv.write if path.suffix == ".csv" else curves_json.write
        with path.open("wb") as stream:
            write(stream, self.curve_set, self.score.duration, self._fps)

    def _rig(self, path: Path) -> None:
        from scorebreath.formats.formats import ExportOptions, rig_formats

        table, *_ = rig_formats(self._rigs[path.name])
        with path.open("wb") as stream:
            table.write(stream, self.score, ExportOptions(fps=self._fps, body=self._body))

    def _groups(self, path: Path) -> None:
        from scorebreath.formats import groups_csv

        with path.open("wb") as stream:
            groups_csv.write(stream, self.score)
