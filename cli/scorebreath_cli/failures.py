"""From errors to exit statuses, one line each: the user's, the machine's, or ours."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from scorebreath_cli.printers import HumanPrinter, set_current
from scorebreath_cli.streams import silence

if TYPE_CHECKING:
    from scorebreath_cli.printers import Printer


class Status(IntEnum):
    """What a command ends with."""

    DONE = 0
    BUG = 1
    """ours"""
    INPUT = 2
    """bad usage or input"""
    ENVIRONMENT = 3
    """engine, voice, extra, disk, device"""
    INTERRUPTED = 130
    """Ctrl-C"""
    PIPE_CLOSED = 141
    """the reader of our output left; said by nobody"""


GRAVITY = (Status.DONE, Status.INPUT, Status.ENVIRONMENT, Status.BUG, Status.INTERRUPTED, Status.PIPE_CLOSED)
"""From harmless to worst: of several inputs, the worst status is the command's."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """An error as it is told."""

    status: Status
    kind: str
    """the error's class"""
    message: str
    line: int = 0
    """of a script, from 1; 0 where it has none"""
    column: int = 0


def worst(statuses: Iterator[Status] | list[Status]) -> Status:
    """The gravest of several; DONE for none.

    >>> worst([Status.ENVIRONMENT, Status.INPUT, Status.DONE])
    <Status.ENVIRONMENT: 3>
    """
    return max(statuses, key=GRAVITY.index, default=Status.DONE)


def failure_of(error: BaseException, *, debug: bool = False) -> Failure:
    """What an error means for the one who gave the command; with `debug` its traceback goes to stderr."""
    if debug and not isinstance(error, BrokenPipeError):
        traceback.print_exception(error)
    from scorebreath.errors import ScorebreathError, ScriptError

    kind = type(error).__name__
    if isinstance(error, KeyboardInterrupt):
        return Failure(status=Status.INTERRUPTED, kind="Interrupted", message="interrupted; nothing was left behind")
    if isinstance(error, ScriptError):
        return Failure(
            status=Status.INPUT, kind=kind, message=str(error), line=error.line, column=error.column
        )  # fmt: skip
    if isinstance(error, ScorebreathError) and error.exit_status != Status.BUG:
        return Failure(status=Status(error.exit_status), kind=kind, message=str(error))
    if isinstance(error, BrokenPipeError):
        return Failure(status=Status.PIPE_CLOSED, kind=kind, message="")
    if isinstance(error, OSError):
        name = error.filename2 or error.filename
        place = f"{os.fsdecode(name)}: " if isinstance(name, (str, bytes)) else ""
        return Failure(status=Status.ENVIRONMENT, kind=kind, message=f"{place}{error.strerror or error}")
    if isinstance(error, MemoryError):
        return Failure(status=Status.ENVIRONMENT, kind=kind, message="out of memory")
    return Failure(status=Status.BUG, kind=kind, message=_bug(error))


@contextmanager
def reporting(make_printer: Callable[[], Printer], *, debug: bool) -> Iterator[Printer]:
    """Run a command: whatever it raises is told in one place, and becomes the exit status.

    Args:
        make_printer: Who tells it.
        debug: Whether tracebacks are shown.

    Raises:
        typer.Exit: With a status other than 0.
    """
    printer = make_printer()
    set_current(printer)
    try:
        try:
            yield printer
        finally:
            printer.close()
        sys.stdout.flush()
    except (Exception, KeyboardInterrupt) as error:
        if isinstance(error, typer.Exit):
            raise
        failure = failure_of(error, debug=debug)
        tell(printer, failure)
        raise typer.Exit(failure.status) from None


def tell(printer: Printer, failure: Failure) -> None:
    """Even when nobody listens any more: what cannot be told on stdout is told on stderr."""
    said = failure.status == Status.PIPE_CLOSED
    try:
        if not said:
            printer.failed(failure)
        sys.stdout.flush()
    except OSError as error:
        silence()
        if not said and not isinstance(error, BrokenPipeError):
            with suppress(OSError):
                HumanPrinter().failed(failure)


def _bug(error: BaseException) -> str:
    """One line that asks for a report, and where the traceback is."""
    import tempfile

    frames = traceback.extract_tb(error.__traceback__)
    place = f" ({Path(frames[-1].filename).name}:{frames[-1].lineno})" if frames else ""
    what = " ".join(str(error).split())[:200]
    said = f"this is a bug in scorebreath: {type(error).__name__}: {what}{place}; please report it"
    try:
        handle, name = tempfile.mkstemp(prefix="scorebreath-", suffix=".txt")
        with open(handle, "w", encoding="utf-8", errors="backslashreplace") as stream:  # noqa: PTH123 - a descriptor
            stream.writelines(traceback.format_exception(error))
    except OSError:
        return f"{said} with what --debug prints"
    return f"{said} with the traceback in {name}"
