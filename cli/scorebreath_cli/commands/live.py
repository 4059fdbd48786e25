"""`scorebreath live`."""

from __future__ import annotations

from typing import Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import reporting
from scorebreath_cli.performing import options as p
from scorebreath_cli.settings import DEFAULT_ENGINE, CompileOptions


def live(
    *,
    texts: Annotated[
        list[str] | None,
        typer.Argument(metavar="TEXT", help="Text files, said in order; - is what comes from stdin.",
                       show_default="the rehearsal screen; without a terminal, stdin"),
    ] = None,
    engine: p.Engine = DEFAULT_ENGINE,
    device: p.Device = None,
    devices: p.Devices = False,
    rate: p.Rate = None,
    lookahead: p.Lookahead = None,
    output_latency: p.OutputLatency = None,
    take: Annotated[
        str | None,
        typer.Option("--take", metavar="DIR", help="Keep all that happens in a new folder, which `render` takes."),
    ] = None,
    stay: Annotated[bool, typer.Option("--stay", help="Go on when all texts are said, until told to end.")] = False,
    to: p.To = None,
    curve_rate: p.CurveRate = "60",
    curve_lead: p.CurveLead = 0.0,
    preview: p.Preview = False,
    preview_port: p.PreviewPort = None,
    osc: p.Osc = None,
    no_osc: p.NoOsc = False,
    midi: p.Midi = None,
    midi_out: p.MidiOut = None,
    midi_map: p.MidiMap = None,
    midi_api: p.MidiApi = None,
    screen: p.Screen = None,
    voice: o.Voice = None,
    model: o.Model = None,
    preset: o.Preset = None,
    assign: o.Assign = None,
    state: o.State = None,
    cast: o.Cast = None,
    markup: o.Markup = None,
    breaths: o.Breaths = None,
    seed: o.Seed = None,
    language: o.Language = None,
    lead: o.Lead = None,
    tail: o.Tail = None,
    breath_sound: o.BreathSound = None,
    breath_motion: o.BreathMotion = None,
    face: o.Face = None,
    without: o.Without = None,
    no_cache: o.NoCache = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:  # fmt: skip
    """Perform: say texts now, breathing, while you type more of them and turn knobs; curves go out to characters.

    In a terminal there is a rehearsal screen: what is typed is said, /help lists commands, Esc is silence at once.

    Text that comes through a pipe is said as it comes, cut anywhere.

    Ctrl-C stops as soon as that sounds natural, and ends; a second one ends at once.
    """
    with reporting(lambda: printers.make(json_lines, " ".join(texts or ())), debug=debug) as printer:
        from scorebreath_cli.making import Compiler
        from scorebreath_cli.performing.devices import list_devices
        from scorebreath_cli.performing.live import Wishes, perform
        from scorebreath_cli.performing.settings import ControlOptions, EngineOptions, StreamOptions

        options = CompileOptions(
            voice=voice, model=model, presets=tuple(preset or ()), assignments=tuple(assign or ()),
            states=tuple(state or ()), cast=tuple(cast or ()), markup=markup, breaths=breaths, seed=seed,
            language=language, lead=lead, tail=tail, breath_sound=breath_sound, breath_motion=breath_motion,
            face=face, without=tuple(without or ()),
        )  # fmt: skip
        sound = EngineOptions(
            engine=engine, device=device, rate=rate, lookahead=lookahead, output_latency=output_latency
        )
        if devices:
            list_devices(printer, sound)
            return
        shown = preview or preview_port is not None
        wishes = Wishes(
            engine=sound,
            streams=StreamOptions(targets=tuple(to or ()), rate=curve_rate, lead=curve_lead),
            controls=ControlOptions(
                osc=osc, no_osc=no_osc, midi=midi, midi_out=midi_out, midi_map=midi_map, midi_api=midi_api
            ),
            take=take, preview=preview_port or 0 if shown else None, screen=screen, stay=stay, json_lines=json_lines,
        )  # fmt: skip
        with Compiler(options, printer, cache=not no_cache) as compiler:
            perform(texts or (), wishes, compiler, printer)
