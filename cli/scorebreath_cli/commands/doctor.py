"""`scorebreath doctor`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import Status, reporting
from scorebreath_cli.performing import options as p
from scorebreath_cli.settings import DEFAULT_ENGINE

if TYPE_CHECKING:
    from scorebreath_cli.performing.settings import EngineOptions
    from scorebreath_cli.printers import Printer

COLUMNS = ("kind", "name", "state", "what", "remedy")
BELOW = ("what", "remedy")


def doctor(
    *,
    sound: Annotated[
        bool,
        typer.Option(
            "--sound", help="Play a click instead, and listen for it: how late is this device? Turn the volume down."
        ),
    ] = False,
    engine: p.Engine = DEFAULT_ENGINE,
    device: p.Device = None,
    rate: p.Rate = None,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """Try everything on this machine: say what is installed, which engines and voices work, and how to get the rest.

    Ends with 0 where a plain `scorebreath render` works, with 3 where it does not; with --sound, 0 where an engine
    plays.

    --engine, --device and --rate belong to --sound. A cable from the output to the input, or a loudspeaker before a
    microphone, brings the click back.
    """
    with reporting(lambda: printers.make(json_lines), debug=debug) as printer:
        if sound:
            from scorebreath_cli.performing.settings import EngineOptions

            _measure(printer, EngineOptions(engine=engine, device=device, rate=rate))
            return
        from scorebreath.errors import InputError

        for flag, given in (("--engine", engine != DEFAULT_ENGINE), ("--device", device), ("--rate", rate)):
            if given:
                raise InputError(f"{flag}: belongs to --sound")
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


def _measure(printer: Printer, options: EngineOptions) -> None:
    """Play a click on an engine of ours, and say what came back.

    Raises:
        InputError: An option is wrong.
        EngineError: The engine does not run.
    """
    from dataclasses import asdict

    from scorebreath.engine.loopback import measure

    options.check()
    found = measure(options.engine, options.as_device())
    trip = found.round_trip
    said = f"{options.engine}: {found.about}"
    if trip is not None:
        said += f", at {found.sample_rate} Hz; about half of it is the output: --output-latency {trip / 2:.3f}"
    printer.item("sound", {"engine": options.engine, **asdict(found)}, said)
    printer.done(Status.DONE, measured=trip is not None)
