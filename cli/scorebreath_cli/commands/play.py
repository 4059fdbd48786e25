"""`scorebreath play`."""

from __future__ import annotations

from typing import Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting
from scorebreath_cli.performing import options as p
from scorebreath_cli.settings import DEFAULT_ENGINE


def play(
    *,
    score: Annotated[
        str | None, typer.Argument(metavar="SCORE|TAKE", help="A score, the folder of a take, or - for stdin.")
    ] = None,
    start: Annotated[float, typer.Option("--start", metavar="SECONDS", help="Where to begin.")] = 0.0,
    loop: Annotated[bool, typer.Option("--loop", help="Begin again at the end, without a gap.")] = False,
    engine: p.Engine = DEFAULT_ENGINE,
    device: p.Device = None,
    devices: p.Devices = False,
    rate: p.Rate = None,
    lookahead: p.Lookahead = None,
    output_latency: p.OutputLatency = None,
    to: p.To = None,
    curve_rate: p.CurveRate = "60",
    curve_lead: p.CurveLead = 0.0,
    preview: p.Preview = False,
    preview_port: p.PreviewPort = None,
    screen: p.Screen = None,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """Play a score or a take aloud, its curves going out in time.

    In a terminal: space pauses, the arrows jump, L loops, Q quits. Speech is resumed in the middle, a breath is not.
    """
    with reporting(lambda: printers.make(json_lines, score or ""), debug=debug) as printer:
        from scorebreath.errors import InputError
        from scorebreath_cli.performing.devices import list_devices
        from scorebreath_cli.performing.play import Wishes
        from scorebreath_cli.performing.play import play as play_aloud
        from scorebreath_cli.performing.settings import EngineOptions, StreamOptions

        sound = EngineOptions(
            engine=engine, device=device, rate=rate, lookahead=lookahead, output_latency=output_latency
        )
        if devices:
            list_devices(printer, sound)
            return
        if score is None:
            raise InputError("SCORE is missing: expected a score, the folder of a take, or - for stdin")
        shown = preview or preview_port is not None
        wishes = Wishes(
            engine=sound, streams=StreamOptions(targets=tuple(to or ()), rate=curve_rate, lead=curve_lead),
            start=start, loop=loop, screen=screen, preview=preview_port or 0 if shown else None, json_lines=json_lines,
        )  # fmt: skip
        play_aloud(score, wishes, printer)
