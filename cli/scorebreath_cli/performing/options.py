"""The options that `live` and `play` share, and those of `live` alone."""

from __future__ import annotations

from typing import Annotated

import typer

from scorebreath_cli import options as o

SOUND = "Sound"
CURVES = "Curves out"
CONTROLS = "Controls"

Engine = Annotated[
    str,
    typer.Option(
        "--engine", metavar="NAME",
        help="What sounds: embedded, scsynth, scsynth:FILE, a running scsynth@HOST:PORT, or silent.",
        autocompletion=o.complete_live_engines, rich_help_panel=SOUND,
    ),
]  # fmt: skip
Device = Annotated[
    str | None,
    typer.Option("--device", metavar="NAME", help="What it sounds on; see --devices.", rich_help_panel=SOUND),
]
Devices = Annotated[
    bool, typer.Option("--devices", help="List what the engine could sound on, and leave.", rich_help_panel=SOUND)
]
Rate = Annotated[
    int | None,
    typer.Option(
        "--rate", metavar="HZ", help="Samples per second; by default the device's own.", rich_help_panel=SOUND
    ),
]
Lookahead = Annotated[
    float | None,
    typer.Option(
        "--lookahead", metavar="SECONDS", help="How long before a sound the engine is told of it; 0.15 by default.",
        rich_help_panel=SOUND,
    ),
]  # fmt: skip
OutputLatency = Annotated[
    float | None,
    typer.Option(
        "--output-latency", metavar="SECONDS",
        help="From the engine's output to the ear, which curves wait for; as the device reports by default.",
        rich_help_panel=SOUND,
    ),
]  # fmt: skip
To = Annotated[
    list[str] | None,
    typer.Option(
        "--to", metavar="TARGET",
        help="Send curves: osc, vmc, livelink, ws, each with ://HOST:PORT, jsonl:FILE or -; may be repeated.",
        autocompletion=o.complete_targets, rich_help_panel=CURVES,
    ),
]  # fmt: skip
CurveRate = Annotated[
    str,
    typer.Option("--curve-rate", metavar="RATE", help="Pictures of a body a second.", rich_help_panel=CURVES),
]
CurveLead = Annotated[
    float,
    typer.Option(
        "--curve-lead", metavar="SECONDS", help="How long before they are heard pictures are sent.",
        rich_help_panel=CURVES,
    ),
]  # fmt: skip
Preview = Annotated[
    bool, typer.Option("--preview", help="Serve the moving figure to browsers here.", rich_help_panel=CURVES)
]
PreviewPort = Annotated[
    int | None,
    typer.Option(
        "--preview-port", metavar="PORT", min=0, max=65535, show_default="any that is free",
        help="Where it is served; means --preview.", rich_help_panel=CURVES,
    ),
]  # fmt: skip
Osc = Annotated[
    str | None,
    typer.Option(
        "--osc", metavar="[HOST:]PORT", help="Where to listen for OSC; 127.0.0.1:57130 by default.",
        rich_help_panel=CONTROLS,
    ),
]  # fmt: skip
NoOsc = Annotated[bool, typer.Option("--no-osc", help="Do not listen for OSC.", rich_help_panel=CONTROLS)]
Midi = Annotated[
    str | None,
    typer.Option(
        "--midi", metavar="PORT",
        help="Listen to a MIDI controller, by a part of its name; `own` opens a port that others connect to.",
        rich_help_panel=CONTROLS,
    ),
]  # fmt: skip
MidiOut = Annotated[
    str | None,
    typer.Option(
        "--midi-out", metavar="PORT", help="Tell values to a MIDI port, for knobs that turn and keys that light.",
        rich_help_panel=CONTROLS,
    ),
]  # fmt: skip
MidiMap = Annotated[
    str | None,
    typer.Option(
        "--midi-map", metavar="FILE", help="What knobs and keys do, a .toml file; else as `scorebreath params` has it.",
        rich_help_panel=CONTROLS,
    ),
]  # fmt: skip
MidiApi = Annotated[
    str | None,
    typer.Option(
        "--midi-api", metavar="NAME", help="The system of MIDI: alsa, jack, core, windows; else the first that works.",
        rich_help_panel=CONTROLS,
    ),
]  # fmt: skip
Screen = Annotated[
    bool | None,
    typer.Option("--screen/--no-screen", help="Whether a terminal shows what happens; by default where there is one."),
]
