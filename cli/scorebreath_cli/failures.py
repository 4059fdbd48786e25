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
    HUNG_UP = 129
    """SIGHUP: the terminal is gone"""
    INTERRUPTED = 130
    """Ctrl-C"""
    PIPE_CLOSED = 141
    """the reader of our output left; said by nobody"""
    TERMINATED = 143
    """SIGTERM"""


ENDINGS = {Status.HUNG_UP: "the terminal is gone", Status.INTERRUPTED: "interrupted", Status.TERMINATED: "terminated"}
"""Signals that end a command, and how that is said."""
GRAVITY = (Status.DONE, Status.INPUT, Status.ENVIRONMENT, Status.BUG, *ENDINGS, Status.PIPE_CLOSED)
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


def ending_of(error: BaseException) -> Status | None:
    """The signal that ended a command by this, or None.

    >>> ending_of(KeyboardInterrupt()), ending_of(SystemExit(143)), ending_of(SystemExit(2))
    (<Status.INTERRUPTED: 130>, <Status.TERMINATED: 143>, None)
    """
    if isinstance(error, KeyboardInterrupt):
        return Status.INTERRUPTED
    code = error.code if isinstance(error, SystemExit) else None
    return next((status for status in ENDINGS if status == code), None)


def failure_of(error: BaseException, *, debug: bool = False) -> Failure:
    """What an error means for the one who gave the command; with `debug` its traceback goes to stderr."""
    if debug and not isinstance(error, BrokenPipeError):
        traceback.print_exception(error)
    from scorebreath.errors import ScorebreathError, ScriptError

    kind = type(error).__name__
    if (ended := ending_of(error)) is not None:
        said = f"{ENDINGS[ended]}; nothing was left behind"
        return Failure(status=ended, kind=ended.name.title().replace("_", ""), message=said)
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
    except (Exception, KeyboardInterrupt, SystemExit) as error:
        if isinstance(error, typer.Exit) or (isinstance(error, SystemExit) and ending_of(error) is None):
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


def conclude(printer: Printer, status: Status, said: str = "") -> None:
    """A performance is over, by itself or by a signal: say so, and end with that status.

    Raises:
        typer.Exit: It was ended by a signal.
    """
    if status in ENDINGS:
        said = f"{ENDINGS[status]}; {said}" if said else ENDINGS[status]
    with suppress(OSError):  # where the terminal is gone, nobody is to be told
        printer.done(status, said)
    if status != Status.DONE:
        raise typer.Exit(status)


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
