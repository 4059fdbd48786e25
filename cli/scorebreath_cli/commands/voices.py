"""`scorebreath voices`."""

from __future__ import annotations

from dataclasses import asdict

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting

COLUMNS = ("name", "engine", "version", "installed", "deterministic", "licence", "provenance", "how", "languages")
BELOW = COLUMNS[5:]


def voices(json_lines: o.Json = False, debug: o.Debug = False) -> None:
    """List the voices with their licences, and what they were made from.

    A variant is named after a colon: espeak:de, espeak:en-us+f3.
    """
    with reporting(lambda: printers.make(json_lines), debug=debug) as printer:
        from scorebreath.speech.voices import list_voices

        printer.table("voice", [asdict(voice) for voice in list_voices()], COLUMNS, BELOW)
