"""`scorebreath formats`."""

from __future__ import annotations

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting

COLUMNS = ("name", "suffix", "what")


def formats(json_lines: o.Json = False, debug: o.Debug = False) -> None:
    """List the formats that a score can be written in by `scorebreath export`."""
    with reporting(lambda: printers.make(json_lines), debug=debug) as printer:
        from scorebreath.formats.formats import FORMATS

        rows = [{column: getattr(form, column) for column in COLUMNS} for form in FORMATS.values()]
        printer.table("format", rows, COLUMNS)
