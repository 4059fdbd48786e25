"""Standard streams: closed ones (`>&-`) are replaced, and stdout says its name in its errors."""

from __future__ import annotations

import errno
import io
import os
import sys
from typing import Any

LAST_STANDARD = 2
"""Descriptors up to this one are children's as well."""
STDOUT = "<stdout>"
"""What stdout is called in messages."""
CLOSED = "is closed, but output goes there"


class Stdout(io.FileIO):
    """Descriptor of stdout; an error in it tells whose it is, as that of a file does."""

    def __init__(self, descriptor: int, *, shut: bool = False) -> None:
        """Write to an open descriptor; `shut` if there was none, and this is a stand-in that takes nothing."""
        super().__init__(descriptor, "w", closefd=False)
        self.shut = shut

    def write(self, data: Any, /) -> int:
        """As of any file.

        Raises:
            BrokenPipeError: The reader left.
            OSError: Anything else; its file is called `<stdout>`.
        """
        try:
            return super().write(data)
        except BrokenPipeError:
            raise
        except OSError as error:
            said = CLOSED if error.errno == errno.EBADF else error.strerror or str(error)
            raise OSError(error.errno, said, STDOUT) from None


def prepare() -> None:
    """Make all three streams usable, whatever we were started with."""
    if sys.stdin is None:
        sys.stdin = os.fdopen(_null(os.O_RDONLY), encoding="utf-8")
    if sys.stdout is None:
        raw = Stdout(_null(os.O_RDONLY), shut=True)
        sys.stdout = io.TextIOWrapper(io.BufferedWriter(raw), encoding="utf-8", errors="backslashreplace")
    elif isinstance(given := sys.stdout, io.TextIOWrapper) and isinstance(_raw(given), io.FileIO):
        # a console of Windows is no file
        raw = Stdout(given.fileno())
        sys.stdout = io.TextIOWrapper(
            raw if given.buffer is _raw(given) else io.BufferedWriter(raw),  # python -u
            encoding=given.encoding,
            errors=given.errors,
            line_buffering=given.line_buffering,
            write_through=given.write_through,
        )
    if sys.stderr is None:
        sys.stderr = os.fdopen(_null(os.O_WRONLY), "w", encoding="utf-8", errors="backslashreplace")


def _raw(stream: object) -> object:
    """What is under the buffers of a text stream, if it has any."""
    buffer = getattr(stream, "buffer", None)
    return getattr(buffer, "raw", buffer)


def stdout_is_shut() -> bool:
    """Whether we were started without stdout."""
    raw = _raw(sys.stdout)
    return isinstance(raw, Stdout) and raw.shut


def check_stdout() -> None:
    """Say early that what is to be made could not be put out.

    Raises:
        EnvironmentFailure: There is no stdout.
    """
    if stdout_is_shut():
        from scorebreath.errors import EnvironmentFailure

        raise EnvironmentFailure(f"{STDOUT}: {CLOSED}")


def silence() -> None:
    """What stdout still holds goes nowhere; else Python would complain once more when it closes it."""
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, sys.stdout.fileno())
    os.close(null)


def _null(flags: int) -> int:
    """The null device, at the lowest free descriptor: that of the stream it stands for."""
    descriptor = os.open(os.devnull, flags)
    os.set_inheritable(descriptor, descriptor <= LAST_STANDARD)
    return descriptor
