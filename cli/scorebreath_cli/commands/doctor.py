"""`scorebreath doctor`."""

from __future__ import annotations

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import Status, reporting

COLUMNS = ("kind", "name", "state", "what", "remedy")
BELOW = ("what", "remedy")


def doctor(json_lines: o.Json = False, debug: o.Debug = False) -> None:
    """Try everything on this machine: say what is installed, which engines and voices work, and how to get the rest.

    Ends with 0 where a plain `scorebreath render` works, with 3 where it does not.
    """
    with reporting(lambda: printers.make(json_lines), debug=debug) as printer:
        from dataclasses import asdict

        from scorebreath_cli.checks import checks

        found = list(checks())
        rows = [asdict(check) for check in found]
        printer.table("check", rows, COLUMNS, BELOW)
        broken = [check.name for check in found if check.needed and check.state != "works"]
        status = Status.ENVIRONMENT if broken else Status.DONE
        said = f"needed but not working: {', '.join(broken)}" if broken else "everything needed works"
        printer.done(status, said, broken=broken)
        if broken:
            raise typer.Exit(status)
