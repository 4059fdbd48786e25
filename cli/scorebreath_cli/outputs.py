"""Where results go: whole or not at all, and never over what is not ours."""

from __future__ import annotations

import errno
import os
import re
import shutil
import signal
import stat
import sys
import tempfile
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from types import TracebackType

from scorebreath.errors import EnvironmentFailure, InputError

SET_FILES = (
    "mix.wav", "curves.csv", "curves.json", "groups.csv", "timeline.png", "preview.html", "score.json",
)  # fmt: skip
"""What `render` writes into its folder beside the media; the Score last, as it names the others' source."""
BODY_FILES = ("curves.csv", "curves.json", "timeline.png")
"""What it writes into a folder of its own for each further body of a Score; the files above are those of the first."""
STEM_FILES = ("stems/speech.wav", "stems/breath.wav")
"""What it writes besides if stems are wanted."""
RIG_SUFFIX = ".csv"
"""of what it writes for each `--rig`, there and for every further body."""
STANDARD = "-"
"""The name of stdin and stdout."""
SCORE = "score.json"
"""What an output folder calls its Score."""
TAKE = "take.jsonl"
"""What a take's folder holds."""
_OURS = re.compile(r"(speech|breath)/[0-9a-f]{64}\.wav\Z|([^/]+/)?[a-z]+\.csv\Z|stems/(speech|breath)\.wav\Z")
"""What of an old output may be taken away, whoever names it."""
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""Failures of a write, which do not name the file."""
_NAMED = re.compile(rb'"path":"((?:speech|breath)/[0-9a-f]{64}\.wav)"')


def behind(path: Path) -> Path:
    """The file a link leads to, which is the one to be written; any other path as it is."""
    return path.resolve() if path.is_symlink() else path


def refuse_existing(folder: Path, names: tuple[str, ...], *, force: bool, besides: Path | None = None) -> None:
    """Say early that an output is there already.

    Args:
        folder: Where the output goes.
        names: What would be replaced.
        force: Whether that is wanted.
        besides: The input itself, which does not count: it is written as it was.

    Raises:
        InputError: Names the first file that would be replaced, or what is no file and may not be.
        EnvironmentFailure: The folder is a file.
    """
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is a file; expected a folder, or a name for a new one")
    for name in names:
        path = folder / name
        if path.is_dir():
            raise InputError(f"{path}: is a folder; it stands where a file of that name would go")
        if path.exists() and not path.is_file():
            raise InputError(f"{path}: is a device or a pipe, which a file would replace; `-o - > {path}` writes to it")
        if not force and os.path.lexists(path) and not (besides and besides.exists() and path.samefile(besides)):
            raise InputError(f"{path} exists already; --force replaces it")


def refuse_own_input(given: str, outputs: Iterable[Path]) -> None:
    """Say early that an output would stand where the input does, under whatever name; --force does not mean that.

    Args:
        given: The input as given: a file, the folder of a take, or stdin, which may be a file as well (`< FILE`).
        outputs: Every file that would be replaced.

    Raises:
        InputError: Names the output.
    """
    inputs = [_stdin()] if given == STANDARD else [_regular(Path(given)), _regular(Path(given) / TAKE)]
    for output in outputs:
        found = _regular(output)
        if found and any(one and os.path.samestat(found, one) for one in inputs):
            raise InputError(f"{output}: would replace its own input; expected another place for the output")


def _regular(path: Path) -> os.stat_result | None:
    """What a path leads to, if that is a file."""
    return path.stat() if path.is_file() else None


def _stdin() -> os.stat_result | None:
    """The file that is stdin, if it is one."""
    try:
        found = os.fstat(sys.stdin.fileno())
    except (OSError, ValueError):  # closed, or not a descriptor at all
        return None
    return found if stat.S_ISREG(found.st_mode) else None


class _Staging(ABC):
    """A place to write to that becomes the output, or vanishes.

    A class and not a generator: a signal can strike inside contextlib, where it leaves a generator waiting for ever.
    """

    def __init__(self, target: Path) -> None:
        self.target = target
        self._undo = ExitStack()

    def __enter__(self) -> Path:
        try:
            with uninterrupted(), _told(self.target):
                for missing in reversed([parent for parent in self.target.parents if not parent.exists()]):
                    missing.mkdir()
                    self._undo.callback(_remove_empty, missing)
                return self._create(self._undo)
        except BaseException:
            self._undo.close()
            raise

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        with uninterrupted(), self._undo, _told(self.target):
            if isinstance(error, OSError) and error.errno in _FULL:
                raise EnvironmentFailure(f"{self.target}: cannot be written: {error.strerror}") from None
            if kind is None:
                self._commit()
                self._undo.pop_all()

    @abstractmethod
    def _create(self, undo: ExitStack) -> Path:
        """Make what is written to; `undo` takes it away."""

    @abstractmethod
    def _commit(self) -> None:
        """Put it in its place."""


class staged(_Staging):  # noqa: N801 - reads as the context manager it is
    """A folder to write into, whose files appear in `target` together when all is well, and vanish when not.

    A new folder is a renamed sibling. In one that exists, files are renamed one by one, and put back if that fails.

    Args:
        target: Where the files belong.
        own: Names, in the folder, of files that the old output had and the new one may not have.

    Raises:
        EnvironmentFailure: The disk refuses.
    """

    def __init__(self, target: Path, *, own: Callable[[Path], set[str]] = lambda _: set()) -> None:
        """Nothing is made before it is entered."""
        super().__init__(target)
        self._own = own
        self._exists = False
        self._part = target

    def _create(self, undo: ExitStack) -> Path:
        self._exists = self.target.is_dir()
        home = self.target if self._exists else self.target.parent
        self._part = Path(tempfile.mkdtemp(prefix=f".{self.target.name or 'out'}.", suffix=".part", dir=home))
        undo.callback(shutil.rmtree, self._part, ignore_errors=True)
        self._part.chmod(0o777 & ~_umask())
        return self._part

    def _commit(self) -> None:
        if self._exists:
            _merge(self._part, self.target, self._own(self.target))
            shutil.rmtree(self._part, ignore_errors=True)
        else:
            self._appear()

    def _appear(self) -> None:
        """Another run may have made the folder meanwhile: what it wrote stays."""
        try:
            self._part.rename(self.target)
        except OSError:
            made = [path.name for path in self._part.iterdir() if path.is_file()]
            for path in (self.target / name for name in made):
                if path.exists():
                    raise InputError(
                        f"{path} exists already, made by another run meanwhile; --force replaces it"
                    ) from None
            if not self.target.is_dir():
                raise
            _merge(self._part, self.target, set())
            shutil.rmtree(self._part, ignore_errors=True)


class staged_file(_Staging):  # noqa: N801
    """A path to write to; what stands there replaces `target` when all is well, and vanishes when not.

    Raises:
        EnvironmentFailure: The disk refuses.
    """

    def _create(self, undo: ExitStack) -> Path:
        handle, name = tempfile.mkstemp(prefix=f".{self.target.name}.", suffix=".part", dir=self.target.parent)
        undo.callback(Path(name).unlink, missing_ok=True)
        os.close(handle)
        self._part = Path(name)
        self._part.chmod(0o666 & ~_umask())
        return self._part

    def _commit(self) -> None:
        self._part.replace(self.target)


def old_media(folder: Path) -> set[str]:
    """Media of the Score that an earlier run left here, unless a take or another JSON file may name them too."""
    if (folder / TAKE).exists() or {path.name for path in folder.glob("*.json")} - set(SET_FILES):
        return set()
    try:
        named = _NAMED.findall((folder / "score.json").read_bytes())
    except OSError:
        return set()
    return {name.decode() for name in named}


def old_rigs(folder: Path) -> set[str]:
    """Curves of rigs of ours that an earlier run left beside its Score: with another Score they would be wrong."""
    if not (folder / SCORE).is_file():
        return set()
    from scorebreath.curves.rigs.table import RIGS

    homes = [folder, *(path.parent for path in folder.glob(f"*/{BODY_FILES[0]}"))]
    found = (home / f"{rig}{RIG_SUFFIX}" for home in homes for rig in RIGS)
    return {path.relative_to(folder).as_posix() for path in found if path.is_file()}


def old_stems(folder: Path) -> set[str]:
    """Stems that an earlier run left beside its Score: of another sound they would be no part."""
    if not (folder / SCORE).is_file():
        return set()
    return {name for name in STEM_FILES if (folder / name).is_file()}


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Hold Ctrl-C and termination back until a step that must not be torn is over."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    caught: list[int] = []
    names = [signal.SIGINT, signal.SIGTERM]
    before = {name: signal.signal(name, lambda number, _: caught.append(number)) for name in names}
    try:
        yield
    finally:
        for name, handler in before.items():
            signal.signal(name, handler)
        for number in caught:
            signal.raise_signal(number)


def _merge(part: Path, folder: Path, old: set[str]) -> None:
    """Move every file of `part` into `folder`, and those of `old` away; on failure put everything back."""
    made = sorted(str(path.relative_to(part).as_posix()) for path in part.rglob("*") if path.is_file())
    made.sort(key=lambda name: SET_FILES.index(name) if name in SET_FILES else -1)
    attic = Path(tempfile.mkdtemp(prefix=".old.", suffix=".part", dir=folder))
    moved: list[str] = []
    kept: list[str] = []
    try:
        for name in [*made, *sorted(old - set(made))]:
            target = folder / name
            if target.exists() and name not in kept and (name in made or _OURS.match(name)):
                (attic / name).parent.mkdir(parents=True, exist_ok=True)
                target.rename(attic / name)
                kept.append(name)
            if name in made:
                target.parent.mkdir(parents=True, exist_ok=True)
                (part / name).rename(target)
                moved.append(name)
    except BaseException:
        for name in moved:
            (folder / name).unlink()
        for name in kept:
            (attic / name).rename(folder / name)
        shutil.rmtree(attic)
        raise
    shutil.rmtree(attic, ignore_errors=True)
    for home in sorted({(folder / name).parent for name in kept} - {folder}):
        with suppress(OSError):
            _remove_empty(home)


@contextmanager
def _told(target: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise EnvironmentFailure(f"{target}: cannot be written: {error.strerror}") from None


def _remove_empty(folder: Path) -> None:
    if folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
