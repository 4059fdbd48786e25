"""What a command is given: a script, a Score, or a take; from a file, a folder, or stdin."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TYPE_CHECKING

from scorebreath.errors import InputError
from scorebreath_cli.outputs import SCORE, STANDARD, TAKE

if TYPE_CHECKING:
    from scorebreath.media.store import MediaStore
    from scorebreath.score.document import Score

TORN = "torn-take"
"""Code of the warning that the last line of a take is dropped."""
_JSON = re.compile(rb"(?:\xef\xbb\xbf)?\s*\{\s*[\"}]")


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """One input, read but not yet understood."""

    name: str
    """as given; `<stdin>` for stdin"""
    path: Path | None
    """None for stdin"""
    data: bytes
    """empty for a take"""
    kind: str
    """`script`, `score` or `take`"""

    @property
    def compiled(self) -> bool:
        """Whether it is a Score already, so no option of compiling applies."""
        return self.kind != "script"


def read_source(given: str) -> Source:
    """Read an input and see what it is.

    A folder is a take, or stands for the Score in it. What begins as a JSON object does is a Score, broken or not: no
    script begins so.

    Raises:
        InputError: It does not exist, or is a folder without a take and a Score.
        OSError: It may not be read.
    """
    if given == STANDARD:
        return _classified("<stdin>", None, _bounded(sys.stdin.buffer))
    path = Path(given)
    try:
        if path.is_dir():
            if (path / TAKE).is_file():
                return Source(name=given, path=path, data=b"", kind="take")
            if not (path / SCORE).is_file():
                raise InputError(
                    f"{given}: is a folder without {TAKE} and {SCORE}; expected a script, a score, or a take"
                )
            path, given = path / SCORE, str(path / SCORE)
        if path.name == TAKE:
            return Source(name=given, path=path, data=b"", kind="take")
        with path.open("rb") as stream:
            return _classified(given, path, _bounded(stream))
    except (FileNotFoundError, NotADirectoryError):
        raise InputError(f"{given}: no such file") from None
    except ValueError as error:
        raise InputError(f"{given!r}: {error}") from None


def load_score(source: Source) -> tuple[Score, MediaStore]:
    """The Score an input is, and where its media lie (for stdin, beside the working directory).

    A Score that ends before its last event does is told to be cut, and a take whose last line is torn, that it is.

    Raises:
        InputError: It is a script.
        ScoreError: It is broken.
    """
    from scorebreath.media.store import FolderStore
    from scorebreath.score import codec, files
    from scorebreath.score.document import overrun
    from scorebreath.score.events import WarningEvent
    from scorebreath.units import plain
    from scorebreath_cli import printers

    if source.kind == "script":
        raise InputError(
            f"{source.name}: is not a score (no JSON object with a schema key); `scorebreath compile` makes one"
        )
    if source.kind == "take" and source.path is not None:
        taken, media = files.load(source.path)  # as long as its last event
        for said in (event.text for event in taken.events if isinstance(event, WarningEvent) and event.code == TORN):
            printers.current().note(f"{source.name}: {said}")
        return taken, media
    score = codec.loads(source.data, source.name)
    if (beyond := overrun(score)) > 0:
        said = f"events go on for {plain(beyond)} s after its duration of {plain(score.duration)} s; they are cut"
        printers.current().note(f"{source.name}: {said}")
    return score, FolderStore(source.path.parent if source.path else Path())


def names_of(given: Sequence[str]) -> list[str]:
    """Folder names for several inputs: a file's name without its suffix.

    The Score in an output folder, `NAME/score.json`, is called NAME.

    Raises:
        InputError: Two would have the same name (or differ only in case), so one would cover the other.

    >>> names_of(["a/one.txt", "out/two/score.json", "-"])
    ['one', 'two', 'stdin']
    """
    found: dict[str, str] = {}
    names: list[str] = []
    for one in given:
        name = _name_of(one)
        if (before := found.get(name.casefold())) is not None:
            raise InputError(f"{before} and {one} would both be written to {name!r}; rename one, or use two folders")
        found[name.casefold()] = one
        names.append(name)
    return names


def _name_of(given: str) -> str:
    if given == STANDARD:
        return "stdin"
    path = Path(given)
    if path.name in (SCORE, TAKE) or not path.name:
        path = path.resolve()
    if path.name in (SCORE, TAKE):
        path = path.parent
        return path.name or "score"
    return path.name if path.is_dir() else path.stem


def _bounded(stream: IO[bytes]) -> bytes:
    """All of it, or one byte more than is accepted: a device or a pipe may never end."""
    from scorebreath.script.decode import LIMIT

    data = stream.read(LIMIT + 1)
    if len(data) > LIMIT and _JSON.match(data[:4096]):
        from scorebreath.score.codec import LARGEST_FILE

        data += stream.read(LARGEST_FILE + 1 - len(data))
    return data


def _classified(name: str, path: Path | None, data: bytes) -> Source:
    suffix = path.suffix.lower() if path else ""
    is_score = bool(_JSON.match(data[:4096])) or suffix == ".json"
    return Source(name=name, path=path, data=data, kind="score" if is_score else "script")
