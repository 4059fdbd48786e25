"""`scorebreath export`."""

from __future__ import annotations

from typing import Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting


def export(
    *,
    score: Annotated[str, typer.Argument(metavar="SCORE", help="A score, the folder of a take, or - for stdin.")],
    kind: Annotated[
        str,
        typer.Option(
            "--to", metavar="FORMAT", help="One of `scorebreath formats`.", autocompletion=o.complete_formats
        ),
    ],
    output: Annotated[
        str, typer.Option("--output", "-o", metavar="FILE", help="Where it goes; - is stdout.")
    ] = "-",
    fps: o.Fps = "60",
    body: Annotated[
        str | None, typer.Option("--body", metavar="ID", help="Whose curves, where the score has several bodies.")
    ] = None,
    force: o.Force = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:  # fmt: skip
    """Write a score in another format: curves, breath groups, a character's shapes, MaryXML.

    --fps and --body count for formats of frames.
    """
    with reporting(lambda: printers.make(json_lines, score), debug=debug) as printer:
        from scorebreath.formats.formats import ExportOptions, format_named
        from scorebreath_cli.exporting import write_as
        from scorebreath_cli.settings import frame_rate

        form = format_named(kind)
        choice = ExportOptions(fps=frame_rate(fps), body=body)
        write_as(printer, score, output, form, choice, force=force, json_lines=json_lines)
