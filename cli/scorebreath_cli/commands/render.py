"""`scorebreath render`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import Status, reporting
from scorebreath_cli.settings import DEFAULT_ENGINE, CompileOptions, RecordingOptions, check_engine

if TYPE_CHECKING:
    from pathlib import Path

    from scorebreath_cli.printers import Printer
    from scorebreath_cli.rendering import Renderer


def render(
    *,
    given: Annotated[
        list[str] | None,
        typer.Argument(metavar="SCRIPT|SCORE|TAKE", help="Texts, scores, folders of takes, or - for stdin."),
    ] = None,
    output: Annotated[
        str,
        typer.Option("--output", "-o", metavar="DIR", help="Where everything goes; - sends the sound to stdout."),
    ],
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
    poem: o.Poem = None,
    lead: o.Lead = None,
    tail: o.Tail = None,
    transcript: o.Transcript = None,
    textgrid: o.TextGrid = None,
    words: o.Words = None,
    own_breaths: o.OwnBreaths = None,
    breath_sound: o.BreathSound = None,
    breath_motion: o.BreathMotion = None,
    face: o.Face = None,
    without: o.Without = None,
    no_cache: o.NoCache = False,
    engine: o.Engine = DEFAULT_ENGINE,
    rate: o.Rate = 48000,
    loudness: o.Loudness = None,
    stems: o.Stems = False,
    fps: o.Fps = "60",
    rig: o.Rigs = None,
    force: o.Force = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """Make everything from a text: the sound of a voice that breathes, and the curves that move a character with it.

    Makes mix.wav, score.json, speech/, curves.csv, curves.json, groups.csv, timeline.png and preview.html in DIR.

    Of several inputs, each goes into DIR/NAME; one that fails does not stop the others.
    """
    options = CompileOptions(
        voice=voice, model=model, presets=tuple(preset or ()), assignments=tuple(assign or ()),
        states=tuple(state or ()), cast=tuple(cast or ()), markup=markup, breaths=breaths, seed=seed,
        language=language, poem=poem, lead=lead, tail=tail, breath_sound=breath_sound, breath_motion=breath_motion,
        face=face, without=tuple(without or ()),
        recording=RecordingOptions(transcript=transcript, textgrid=textgrid, words=words, own_breaths=own_breaths),
    )  # fmt: skip
    alone = given[0] if given and len(given) == 1 else ""
    with reporting(lambda: printers.make(json_lines, alone), debug=debug) as printer:
        from pathlib import Path

        from scorebreath.errors import InputError
        from scorebreath_cli.inputs import names_of
        from scorebreath_cli.making import Compiler
        from scorebreath_cli.outputs import STANDARD
        from scorebreath_cli.recording import inputs_of
        from scorebreath_cli.rendering import Renderer, SoundOptions
        from scorebreath_cli.streams import check_stdout

        check_engine(engine)
        inputs = inputs_of(list(given or ()), options)
        sound = SoundOptions(
            engine=engine, rate=rate, fps=fps, rigs=tuple(dict.fromkeys(rig or ())), loudness=loudness, stems=stems
        )
        with Compiler(options, printer, cache=not no_cache) as compiler:
            renderer = Renderer(compiler, sound, printer)
            if output == STANDARD:
                if len(inputs) > 1 or json_lines or rig or stems:
                    raise InputError("-o -: takes one input, no --json, --rig, --stems: stdout takes the mix alone")
                check_stdout()
                renderer.to_stdout(inputs[0])
            elif len(inputs) == 1:
                renderer.into(inputs[0], Path(output), force=force)
                printer.done(Status.DONE)
            else:
                sound.check()
                folders = [Path(output) / name for name in names_of(inputs)]
                _several(renderer, list(zip(inputs, folders, strict=True)), printer, force=force, debug=debug)


def _several(renderer: Renderer, jobs: list[tuple[str, Path]], printer: Printer, *, force: bool, debug: bool) -> None:
    """Each in turn; one that fails is told and does not stop the others."""
    from scorebreath_cli.failures import failure_of, worst

    statuses: list[Status] = []
    for given, folder in jobs:
        try:
            renderer.into(given, folder, force=force)
            statuses.append(Status.DONE)
        except BrokenPipeError:
            raise
        except Exception as error:
            failure = failure_of(error, debug=debug)
            printer.failed(failure, given)
            statuses.append(failure.status)
    failed = [given for (given, _), status in zip(jobs, statuses, strict=True) if status != Status.DONE]
    made = len(jobs) - len(failed)
    said = f"{made} of {len(jobs)} rendered" + (f"; failed: {', '.join(failed)}" if failed else "")
    printer.done(worst(statuses), said, rendered=made, failed=failed)
    if failed:
        raise typer.Exit(worst(statuses))
