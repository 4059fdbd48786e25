"""A Score to a file of some format, or to stdout."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from scorebreath.errors import InputError
from scorebreath_cli.failures import Status
from scorebreath_cli.inputs import load_score, read_source
from scorebreath_cli.outputs import STANDARD, behind, refuse_existing, refuse_own_input, staged_file
from scorebreath_cli.streams import check_stdout

if TYPE_CHECKING:
    from scorebreath.formats.formats import ExportOptions, Format
    from scorebreath_cli.printers import Printer


def write_as(
    printer: Printer, given: str, output: str, form: Format, choice: ExportOptions, *, force: bool, json_lines: bool,
    besides: Sequence[str] = (),
) -> None:  # fmt: skip
    """Write what a format makes of a Score.

    Args:
        printer: Is told what happens, unless the file goes to stdout.
        given: The Score: a file, a folder, or stdin.
        output: A file, or `-` for stdout.
        form: The format.
        choice: What its writer is told.
        force: Whether a file that is there may be replaced.
        json_lines: Whether stdout is taken already.
        besides: Other files that are read, and may not be replaced, either.

    Raises:
        InputError: The input is no Score, or the output may not stand there.
        EnvironmentFailure: The disk refuses.
    """
    path = behind(Path(output))
    if output == STANDARD and json_lines:
        raise InputError("--json tells its events on stdout, where -o - would put the file; use -o FILE")
    if output == STANDARD:
        check_stdout()
    else:
        for each in (given, *besides):
            refuse_own_input(each, [path])
        refuse_existing(path.parent, (path.name,), force=force)

    score, _ = load_score(read_source(given))
    if output == STANDARD:
        form.write(sys.stdout.buffer, score, choice)
        return
    printer.started(given, output)
    with staged_file(path) as part, part.open("wb") as stream:
        form.write(stream, score, choice)
    printer.written(str(path), path.stat().st_size)
    printer.done(Status.DONE)
