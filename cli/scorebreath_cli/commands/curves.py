"""`scorebreath curves`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting

if TYPE_CHECKING:
    from scorebreath.formats.formats import ExportOptions, Format
    from scorebreath_cli.printers import Printer

COLUMNS = ("name", "unit", "low", "high", "meaning")
RIG_COLUMNS = ("name", "unit", "low", "high", "made_of")


def curves(
    *,
    score: Annotated[
        str | None, typer.Argument(metavar="SCORE", help="A score, the folder of a take, or - for stdin.")
    ] = None,
    output: Annotated[
        str, typer.Option("--output", "-o", metavar="FILE", help="Where the curves go; - is stdout.")
    ] = "-",
    fps: o.Fps = "60",
    rig: Annotated[
        list[str] | None,
        typer.Option(
            "--rig", metavar="NAME|FILE",
            help="As a character's own shapes: one of `scorebreath rigs`, or a .toml file; all channels by default.",
            autocompletion=o.complete_rigs,
        ),
    ] = None,
    kind: Annotated[
        str | None,
        typer.Option(
            "--format", metavar="csv|json|fap", help="How they are written.", show_default="as FILE ends, or csv"
        ),
    ] = None,
    keys: Annotated[
        bool, typer.Option("--keys", help="Add rows where closures begin and end, and at very short phones.")
    ] = False,
    closure_gate: Annotated[
        bool, typer.Option("--closure-gate/--no-closure-gate", help="Whether p, b, m, f and v touch in any case.")
    ] = True,
    degrees: Annotated[bool, typer.Option("--degrees", help="Angles of --rig livelink in degrees.")] = False,
    body: Annotated[
        str | None, typer.Option("--body", metavar="ID", help="Whose curves, where the score has several bodies.")
    ] = None,
    describe: Annotated[bool, typer.Option("--describe", help="Print what each curve means instead.")] = False,
    force: o.Force = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:  # fmt: skip
    """Write the curves that move a character: breath, lips, lids, eyes, brows, head, emotions, levels.

    Row i is at i / fps seconds from the first sample of the sound.
    """
    with reporting(lambda: printers.make(json_lines, score or ""), debug=debug) as printer:
        from scorebreath.errors import InputError
        from scorebreath_cli.exporting import write_as

        if len(rig or ()) > 1:
            raise InputError(f"--rig {' --rig '.join(rig or ())}: one file holds one rig; `render` writes several")
        chosen = rig[0] if rig else None
        if describe:
            if output != "-" or score is not None:
                given = score if output == "-" else f"-o {output}"
                raise InputError(f"{given}: --describe explains columns; expected no score and no -o beside it")
            _describe(printer, chosen)
            return
        if score is None:
            raise InputError("SCORE is missing: expected a score, the folder of a take, or - for stdin")
        form, choice = _chosen(chosen, kind, output, fps=fps, keys=keys, gate=closure_gate, degrees=degrees, body=body)
        besides = [chosen] if chosen and chosen.endswith(".toml") else []
        write_as(printer, score, output, form, choice, force=force, json_lines=json_lines, besides=besides)


def _describe(printer: Printer, rig: str | None) -> None:
    if rig is None:
        from scorebreath.curves.channels import CHANNELS

        rows = [{column: getattr(channel, column) for column in COLUMNS} for channel in CHANNELS]
        printer.table("channel", rows, COLUMNS)
        return
    from scorebreath.curves.rigs.table import rig_named

    found = rig_named(rig)
    columns = [{name: getattr(column, name) for name in RIG_COLUMNS} for column in found.table]
    printer.table("column", columns, RIG_COLUMNS)
    drivers = [{"driver": name, "meaning": meaning} for name, meaning in found.drivers().items()]
    if drivers:
        printer.table("driver", drivers, ("driver", "meaning"))


def _chosen(
    rig: str | None, kind: str | None, output: str, *, fps: str, keys: bool, gate: bool, degrees: bool,
    body: str | None,
) -> tuple[Format, ExportOptions]:  # fmt: skip
    """The format, and what its writer is told; whatever does not fit together is told now.

    Raises:
        InputError: It does not.
    """
    from scorebreath.curves.rigs.table import rig_named
    from scorebreath.errors import InputError
    from scorebreath.formats.formats import FORMATS, ExportOptions, rig_formats
    from scorebreath_cli.settings import frame_rate

    rate = frame_rate(fps)
    if rig is not None:
        rig_named(rig)
    offered = rig_formats(rig) if rig is not None else (FORMATS["curves.csv"], FORMATS["curves.json"])
    kinds = {form.suffix.removeprefix("."): form for form in offered}
    suffix = Path(output).suffix.lower().removeprefix(".")
    if suffix == "fap" and kind is None and suffix not in kinds:
        raise InputError(f"{output}: a .fap file holds --rig fap")
    if suffix and kind is None and suffix not in kinds:
        raise InputError(f"{output}: expected a name that ends with .{' or .'.join(kinds)}, or --format with any name")
    wanted = kind or suffix or "csv"
    of = f" of --rig {rig}" if rig is not None else ""
    if wanted not in kinds:
        raise InputError(f"--format {wanted}{of}: must be {' or '.join(kinds)}")
    form = kinds[wanted]
    if keys and not form.keys:
        raise InputError(
            f"--keys: a {form.suffix}{of} has no column of times; expected a .csv of channels or another rig"
        )
    if degrees and not (rig and wanted == "csv" and rig_named(rig).kind == "livelink"):
        raise InputError("--degrees is for the .csv of --rig livelink")
    if wanted == "fap" and rate.denominator != 1:
        raise InputError(f"--fps {fps}: must be a whole number in a .fap file, such as 25 or 60")
    return form, ExportOptions(fps=rate, body=body, closure_gate=gate, keys=keys, degrees=degrees)
