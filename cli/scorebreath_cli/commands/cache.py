"""`scorebreath cache`."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting

if TYPE_CHECKING:
    from scorebreath.speech.cache.shelf import Shelf
    from scorebreath_cli.printers import Printer

COLUMNS = ("voice", "utterances")


def cache(
    *,
    clear: Annotated[bool, typer.Option("--clear", help="Remove all utterances; with --voice those of one.")] = False,
    voice: Annotated[
        str | None, typer.Option("--voice", metavar="NAME", help="With --clear: whose, as the list names it.")
    ] = None,
    prune: Annotated[
        str | None,
        typer.Option("--prune", metavar="SIZE", help="Remove what was not used for longest, down to 500MB, say."),
    ] = None,
    check: Annotated[bool, typer.Option("--check", help="Read everything, and remove what is broken.")] = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """Show what voices have said already, so that it need not be said again; or remove it.

    Commands that speak keep each utterance under what it was asked for: text, voice, version, rate, pitch. A script
    compiled again with another way of breathing speaks nothing again.

    SCOREBREATH_CACHE names another folder, or is off. SCOREBREATH_CACHE_LIMIT is a size such as 500MB; 2GB by default.
    """
    with reporting(lambda: printers.make(json_lines), debug=debug) as printer:
        from scorebreath.errors import InputError
        from scorebreath.speech.cache.shelf import FOLDER, OFF, Shelf, default_folder, size_of

        wanted = [flag for flag, given in (("--clear", clear), ("--prune", prune), ("--check", check)) if given]
        if len(wanted) > 1:
            raise InputError(f"{wanted[1]} beside {wanted[0]}: expected one of them")
        if voice is not None and not clear:
            raise InputError("--voice: belongs to --clear")
        limit = None if prune is None else size_of(prune, "--prune")
        folder = default_folder()
        if folder is None:
            printer.item("cache", {"folder": None}, f"off: {FOLDER}={OFF}")
            return
        shelf = Shelf(folder)
        if clear:
            gone = shelf.clear(voice or "")
            printer.item("cleared", {"utterances": gone}, f"{gone} utterances removed")
        elif limit is not None:
            freed = shelf.prune(limit)
            printer.item("pruned", {"bytes": freed}, f"{_megabytes(freed)} removed")
        elif check:
            whole, removed = shelf.check()
            printer.item(
                "checked", {"utterances": whole, "removed": removed},
                f"{whole} utterances are whole; {removed} broken or unused files removed",
            )  # fmt: skip
        else:
            _show(printer, shelf)


def _show(printer: Printer, shelf: Shelf) -> None:
    held = list(shelf.holdings())
    size = sum(holding.size for holding in held)
    utterances = [holding.path for holding in held if holding.path.suffix == ".json" and len(holding.path.stem) == 64]
    counted = Counter(shelf.voice_of(path) for path in utterances if path.parent.parent.name == "utterances")
    count = sum(counted.values())
    printer.item(
        "cache",
        {"folder": str(shelf.folder), "bytes": size, "limit": shelf.limit, "utterances": count},
        f"{shelf.folder}: {count} utterances, {_megabytes(size)} of {_megabytes(shelf.limit)}",
    )
    rows = [{"voice": name, "utterances": number} for name, number in sorted(counted.items())]
    if rows:
        printer.table("voice", rows, COLUMNS)


def _megabytes(size: int) -> str:
    return f"{size / 1e6:.1f} MB"
