"""`scorebreath presets`."""

from __future__ import annotations

from typing import Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting


def presets(
    name: Annotated[
        str | None,
        typer.Argument(metavar="NAME|FILE", help="Show this one.", autocompletion=o.complete_presets),
    ] = None,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """List the presets, or show what one sets and why."""
    with reporting(lambda: printers.make(json_lines), debug=debug) as printer:
        from scorebreath.parameters.presets import load_preset, names

        found = [load_preset(one) for one in ([name] if name is not None else names())]
        rows = [
            {
                "name": preset.name,
                "description": preset.description,
                "source": preset.source,
                "parameters": dict(preset.values),
            }
            for preset in found
        ]
        if name is None:
            printer.table("preset", rows, ("name", "description"))
            return
        preset = rows[0]
        lines = [f"{preset['name']}: {preset['description']}", f"  {preset['source']}"]
        lines += [f"  {key} = {_toml(value)}" for key, value in found[0].values.items()]
        printer.item("preset", preset, "\n".join(lines))


def _toml(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, float) else f'"{value}"'
