"""`scorebreath compile`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import Status, reporting
from scorebreath_cli.settings import CompileOptions, RecordingOptions


def compile_(
    *,
    given: Annotated[str | None, typer.Argument(metavar="SCRIPT", help="A text file, or - for stdin.")] = None,
    output: Annotated[
        str, typer.Option("--output", "-o", metavar="FILE", help="Where the score goes; - is stdout.")
    ] = "-",
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
    force: o.Force = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """Turn a script into a score: what is said, when each breath is taken, and why.

    The samples go into speech/ beside the score; on stdout the score stands alone.
    """
    options = CompileOptions(
        voice=voice, model=model, presets=tuple(preset or ()), assignments=tuple(assign or ()),
        states=tuple(state or ()), cast=tuple(cast or ()), markup=markup, breaths=breaths, seed=seed,
        language=language, poem=poem, lead=lead, tail=tail, breath_sound=breath_sound, breath_motion=breath_motion,
        face=face, without=tuple(without or ()),
        recording=RecordingOptions(transcript=transcript, textgrid=textgrid, words=words, own_breaths=own_breaths),
    )  # fmt: skip
    with reporting(lambda: printers.make(json_lines, given or ""), debug=debug) as printer:
        from scorebreath.errors import InputError
        from scorebreath_cli.making import Compiler
        from scorebreath_cli.outputs import STANDARD, behind, refuse_existing, refuse_own_input, staged
        from scorebreath_cli.recording import inputs_of, read_input
        from scorebreath_cli.streams import check_stdout

        (script,) = inputs_of([given] if given else [], options)
        to_stdout = output == STANDARD
        if to_stdout and json_lines:
            raise InputError("--json tells its events on stdout, where -o - would put the score; use -o FILE")
        path = behind(Path(output))
        if to_stdout:
            check_stdout()
        else:
            refuse_own_input(script, [path])
            refuse_existing(path.parent, (path.name,), force=force)
        with Compiler(options, printer, cache=not no_cache) as compiler:
            source = read_input(script, options)
            if source.compiled:
                raise InputError(f"{source.name}: is a score already; expected a script")
            printer.started(source.name, output)
            if to_stdout:
                from scorebreath.media.store import MemoryStore
                from scorebreath.score.codec import dumps

                printers.write_binary(dumps(compiler.compile(source, MemoryStore())))
                return
            with staged(path.parent) as part:
                from scorebreath.media.store import FolderStore
                from scorebreath.score.files import save

                media = FolderStore(part)
                save(compiler.compile(source, media), part / path.name, media)
            printer.written(str(path), path.stat().st_size)
            printer.done(Status.DONE)
