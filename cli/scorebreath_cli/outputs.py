"""Where results go: whole or not at all, and never over what is not ours."""

from __future__ import annotations

import os
import re
import shutil
import signal
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from scorebreath.errors import EnvironmentFailure, InputError

SET_FILES = (
    "mix.wav", "curves.csv", "curves.json", "groups.csv", "timeline.png", "preview.html", "score.json",
)  # fmt: skip
"""What `render` writes into its folder beside the media; the Score last, as it names the others' source."""
STANDARD = "-"
"""The name of stdin and stdout."""
_MEDIA = re.compile(r"(speech|breath)/[0-9a-f]{64}\.wav\Z")
_NAMED = re.compile(rb'"path":"((?:speech|breath)/[0-9a-f]{64}\.wav)"')


def refuse_existing(folder: Path, names: tuple[str, ...], *, force: bool, besides: Path | None = None) -> None:
    """Say early that an output is there already.

    Args:
        folder: Where the output goes.
        names: What would be replaced.
        force: Whether that is wanted.
        besides: The input itself, which does not count: it is written as it was.

    Raises:
        InputError: Names the first file that would be replaced.
        EnvironmentFailure: The folder is a file.
    """
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is a file; expected a folder, or a name for a new one")
    for name in names:
        path = folder / name
        if path.is_dir():
            raise InputError(f"{path}: is a folder; it stands where a file of that name would go")
        if not force and os.path.lexists(path) and not (besides and besides.exists() and path.samefile(besides)):
            raise InputError(f"{path} exists already; --force replaces it")


@contextmanager
def staged(folder: Path, *, own: Callable[[Path], set[str]] = lambda _: set()) -> Iterator[Path]:
    """A folder to write into, whose files appear in `folder` together when all is well, and vanish when not.

    A new `folder` is a renamed sibling. In one that exists, files are renamed one by one, and put back if that fails.

    Args:
        folder: Where the files belong.
        own: Names, in the folder, of files that the old output had and the new one may not have.

    Yields:
        The folder to write into.

    Raises:
        EnvironmentFailure: The disk refuses.
    """
    with ExitStack() as undo:
        try:
            _make_parents(folder, undo)
            exists = folder.is_dir()
            home = folder if exists else folder.parent
            part = Path(tempfile.mkdtemp(prefix=f".{folder.name or 'out'}.", suffix=".part", dir=home))
        except OSError as error:
            raise EnvironmentFailure(f"{folder}: cannot be written: {error.strerror}") from None
        undo.callback(shutil.rmtree, part, ignore_errors=True)
        part.chmod(0o777 & ~_umask())
        yield part
        with uninterrupted():
            try:
                if exists:
                    _merge(part, folder, own(folder))
                else:
                    part.rename(folder)
            except OSError as error:
                raise EnvironmentFailure(f"{folder}: cannot be written: {error.strerror}") from None
            if exists:
                shutil.rmtree(part, ignore_errors=True)
            undo.pop_all()


def old_media(folder: Path) -> set[str]:
    """Media of the Score that an earlier run left here, unless another JSON file beside it may name them too."""
    if {path.name for path in folder.glob("*.json")} - set(SET_FILES):
        return set()
    try:
        named = _NAMED.findall((folder / "score.json").read_bytes())
    except OSError:
        return set()
    return {name.decode() for name in named}


@contextmanager
def staged_file(path: Path) -> Iterator[Path]:
    """A path to write to; what stands there replaces `path` when all is well, and vanishes when not.

    Raises:
        EnvironmentFailure: The disk refuses.
    """
    with ExitStack() as undo:
        try:
            _make_parents(path, undo)
            handle, name = tempfile.mkstemp(prefix=f".{path.name}.", suffix=".part", dir=path.parent)
        except OSError as error:
            raise EnvironmentFailure(f"{path}: cannot be written: {error.strerror}") from None
        os.close(handle)
        part = Path(name)
        undo.callback(part.unlink, missing_ok=True)
        part.chmod(0o666 & ~_umask())
        yield part
        with uninterrupted():
            try:
                part.replace(path)
            except OSError as error:
                raise EnvironmentFailure(f"{path}: cannot be written: {error.strerror}") from None
            undo.pop_all()


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
    """Move every file of `part` into `folder`; on failure put everything back."""
    made = sorted(str(path.relative_to(part).as_posix()) for path in part.rglob("*") if path.is_file())
    made.sort(key=lambda name: SET_FILES.index(name) if name in SET_FILES else -1)
    attic = Path(tempfile.mkdtemp(prefix=".old.", suffix=".part", dir=folder))
    moved: list[str] = []
    kept: list[str] = []
    try:
        for name in [*made, *sorted(old - set(made))]:
            target = folder / name
            if target.exists() and name not in kept and (name in made or _MEDIA.match(name)):
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


def _make_parents(path: Path, undo: ExitStack) -> None:
    for missing in reversed([parent for parent in path.parents if not parent.exists()]):
        missing.mkdir()
        undo.callback(_remove_empty, missing)


def _remove_empty(folder: Path) -> None:
    if folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
