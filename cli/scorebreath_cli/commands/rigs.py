"""`scorebreath rigs`."""

from __future__ import annotations

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting

COLUMNS = ("name", "columns", "files", "about", "signs")
BELOW = ("about", "signs")


def rigs(json_lines: o.Json = False, debug: o.Debug = False) -> None:
    """List the rigs: a character's own shapes, what they can be written as, and which way is positive.

    `scorebreath curves --describe --rig NAME` prints the columns of one. A rig of your own is a .toml file: `like =
    "arkit"`, and rows that differ; see the tables in scorebreath/curves/rigs.
    """
    with reporting(lambda: printers.make(json_lines), debug=debug) as printer:
        from scorebreath.curves.rigs.table import RIGS, rig_named
        from scorebreath.formats.formats import rig_formats

        rows = [
            {
                "name": rig.name,
                "columns": len(rig.columns),
                "files": " ".join(form.suffix for form in rig_formats(rig.name)),
                "about": rig.about,
                "signs": rig.signs,
            }
            for rig in map(rig_named, RIGS)
        ]
        printer.table("rig", rows, COLUMNS, BELOW)
