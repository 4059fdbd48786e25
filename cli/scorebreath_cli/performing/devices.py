"""What an engine could play on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scorebreath_cli.failures import Status

if TYPE_CHECKING:
    from scorebreath_cli.performing.settings import EngineOptions
    from scorebreath_cli.printers import Printer


def list_devices(printer: Printer, options: EngineOptions) -> None:
    """Tell every device of an engine.

    Raises:
        InputError: There is no such engine.
        EngineError: It is not installed.
    """
    from scorebreath.engine.live.devices import devices

    options.check()
    found = devices(options.engine)
    if found.names:
        printer.table("device", [{"name": name} for name in found.names], ("name",))
    printer.done(Status.DONE, found.about, about=found.about)
