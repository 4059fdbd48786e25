"""`scorebreath curves`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import Status, reporting

if TYPE_CHECKING:
    from scorebreath_cli.printers import Printer

FORMATS = ("csv", "json")
COLUMNS = ("name", "unit", "low", "high", "meaning")


def curves(
    *,
    score: Annotated[
        str | None, typer.Argument(metavar="SCORE", help="A score, the folder of a take, or - for stdin.")
    ] = None,
    output: Annotated[
        str, typer.Option("--output", "-o", metavar="FILE", help="Where the curves go; - is stdout.")
    ] = "-",
    fps: o.Fps = "60",
    kind: Annotated[
        str | None,
        typer.Option("--format", metavar="csv|json", help="How they are written.", show_default="as FILE ends, or csv"),
    ] = None,
    body: Annotated[
        str | None, typer.Option("--body", metavar="ID", help="Whose curves, where the score has several bodies.")
    ] = None,
    describe: Annotated[bool, typer.Option("--describe", help="Print what each curve means instead.")] = False,
    force: o.Force = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """Write the curves that move a character: lungs, chest, belly, neck, nostrils, mouth, airflow, levels.

    Row i is at i / fps seconds from the first sample of the sound.
    """
    with reporting(lambda: printers.make(json_lines, score or ""), debug=debug) as printer:
        from scorebreath.errors import InputError

        if describe:
            _describe(printer)
        elif score is None:
            raise InputError("SCORE is missing: expected a score, the folder of a take, or - for stdin")
        else:
            _write(printer, score, output, fps=fps, kind=kind, body=body, force=force, json_lines=json_lines)


def _describe(printer: Printer) -> None:
    from scorebreath.curves.channels import CHANNELS

    rows = [{column: getattr(channel, column) for column in COLUMNS} for channel in CHANNELS]
    printer.table("channel", rows, COLUMNS)


def _write(
    printer: Printer, given: str, output: str, *, fps: str, kind: str | None, body: str | None, force: bool,
    json_lines: bool,
) -> None:  # fmt: skip
    import sys

    from scorebreath.errors import InputError
    from scorebreath_cli.inputs import load_score, read_source
    from scorebreath_cli.outputs import STANDARD, behind, refuse_existing, refuse_own_input, staged_file
    from scorebreath_cli.settings import frame_rate
    from scorebreath_cli.streams import check_stdout

    rate = frame_rate(fps)
    path = behind(Path(output))
    suffix = path.suffix.lower().removeprefix(".")
    form = kind or (suffix if suffix in FORMATS else "csv")
    if form not in FORMATS:
        raise InputError(f"--format {form}: must be csv or json")
    if output == STANDARD and json_lines:
        raise InputError("--json tells its events on stdout, where -o - would put the curves; use -o FILE")
    if output == STANDARD:
        check_stdout()
    else:
        refuse_own_input(given, [path])
        refuse_existing(path.parent, (path.name,), force=force)

    from scorebreath.formats.formats import ExportOptions, format_named

    write = format_named(f"curves.{form}").write
    score, _ = load_score(read_source(given))
    choice = ExportOptions(fps=rate, body=body)
    if output == STANDARD:
        write(sys.stdout.buffer, score, choice)
        return
    printer.started(given, output)
    with staged_file(path) as part, part.open("wb") as stream:
        write(stream, score, choice)
    printer.written(str(path), path.stat().st_size)
    printer.done(Status.DONE)
