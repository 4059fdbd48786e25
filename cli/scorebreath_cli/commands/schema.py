"""`scorebreath schema`."""

from __future__ import annotations

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting


def schema(debug: o.Debug = False) -> None:
    """Print the JSON Schema of a Score."""
    with reporting(lambda: printers.make(False), debug=debug) as printer:
        import json

        from scorebreath.score.codec import json_schema

        found = json_schema()
        printer.item("schema", found, json.dumps(found, indent=2, ensure_ascii=False, sort_keys=True))
