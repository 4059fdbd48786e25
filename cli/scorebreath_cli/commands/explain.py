"""`scorebreath explain`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import Status, reporting
from scorebreath_cli.settings import DEFAULT_MODEL, CompileOptions
from scorebreath_cli.settings import seed as seed_of

if TYPE_CHECKING:
    from scorebreath.planning.explain import GroupRow
    from scorebreath.report.face_rows import FaceRow
    from scorebreath.score.document import Score
    from scorebreath_cli.inputs import Source
    from scorebreath_cli.making import Compiler
    from scorebreath_cli.printers import Printer

SHOWN = 400
"""Characters of a group shown to people: more than one breath holds, unless the text is no text."""
WIDE = 38
"""Characters to which a column of what the face does is padded."""


def explain(
    *,
    inputs: Annotated[
        list[str], typer.Argument(metavar="SCRIPT|SCORE", help="A text file, a score, a take, or - for stdin.")
    ],
    of_face: Annotated[
        bool,
        typer.Option(
            "--face",
            help="Show what the face does instead, speaking the text; restrained or albrecht-2002 may follow.",
        ),
    ] = False,
    body: Annotated[
        str | None, typer.Option("--body", metavar="ID", help="Whose face, where the score has several bodies.")
    ] = None,
    voice: o.Voice = None,
    model: o.Model = None,
    preset: o.Preset = None,
    assign: o.Assign = None,
    state: o.State = None,
    cast: o.Cast = None,
    markup: o.Markup = None,
    seed: o.Seed = None,
    language: o.Language = None,
    poem: o.Poem = None,
    without: o.Without = None,
    no_cache: o.NoCache = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """Show each breath group: its text, its syllables, where it was cut, what else was possible, and the rule.

    Nothing is spoken.

    The Bernardet models give each candidate's distance in characters, natural its cost; the chosen one is marked.

    With --face, show each thing the face does: when, how far, at which words, and by which rule.
    """
    given, face = _told_apart(inputs, of_face=of_face)
    with reporting(lambda: printers.make(json_lines, given[0]), debug=debug) as printer:
        from scorebreath.errors import InputError
        from scorebreath_cli.inputs import read_source
        from scorebreath_cli.making import Compiler

        script = _only(given, of_face=of_face)
        options = CompileOptions(
            voice=voice, model=model, presets=tuple(preset or ()), assignments=tuple(assign or ()),
            states=tuple(state or ()), cast=tuple(cast or ()), markup=markup, seed=seed, language=language, poem=poem,
            face=face, without=tuple(without or ()),
        )  # fmt: skip
        if body is not None and not of_face:
            raise InputError("--body: groups are shown of all bodies; it belongs to --face")
        source = read_source(script)
        with Compiler(options, printer, cache=not no_cache) as compiler:
            if of_face:
                _explain_face(source, compiler, body, printer)
                return
            groups = 0
            for row in _of_score(source, options) if source.compiled else _of_script(source, compiler):
                printer.item("group", asdict(row), _told(row))
                groups += 1
            printer.done(Status.DONE, groups=groups)


def _told_apart(inputs: list[str], *, of_face: bool) -> tuple[list[str], str | None]:
    """Inputs, and the face that was named behind `--face`, if any: an option of typer's has a value or has none."""
    from scorebreath.parameters.face_table import FACES

    if of_face and len(inputs) == 2:
        for place in (1, 0):
            if inputs[place] in FACES:
                return [inputs[1 - place]], inputs[place]
    return inputs, None


def _only(inputs: list[str], *, of_face: bool) -> str:
    from scorebreath.errors import InputError, did_you_mean, shortened
    from scorebreath.parameters.face_table import FACES

    if len(inputs) > 1:
        hint = did_you_mean(inputs[1], FACES) if of_face else ""
        raise InputError(f"{shortened(inputs[1], 40)}: explain takes one script or score{hint}")
    return inputs[0]


def _explain_face(source: Source, compiler: Compiler, body: str | None, printer: Printer) -> None:
    from scorebreath.report.face_rows import blink_interval, face_rows, rule_rows
    from scorebreath.units import snap

    score = _whole_score(source, compiler)
    _check_body(score, body)
    rows = list(face_rows(score, body))
    several = body is None and len(score.bodies) > 1
    for row in rows:
        printer.item("face", asdict(row), _face_told(row, several=several))
    rules = rule_rows(rows, score.duration)
    if rules:
        printer.table("rule", [asdict(rule) for rule in rules], ("kind", "rule", "count", "per_minute"))
    interval = blink_interval(rows)
    said = f"{len(rows)} movements of the face in {score.duration:.1f} s"
    if interval is not None:
        said += f"; from blink to blink {interval:.2f} s on average"
    printer.done(
        Status.DONE, said, events=len(rows), duration=score.duration,
        blink_interval=None if interval is None else snap(interval),
    )  # fmt: skip


def _whole_score(source: Source, compiler: Compiler) -> Score:
    from scorebreath_cli.inputs import load_score

    if source.compiled:
        compiler.options.refuse(source.name)
        return load_score(source)[0]
    from scorebreath.media.store import MemoryStore

    return compiler.compile(source, MemoryStore())


def _check_body(score: Score, body: str | None) -> None:
    from scorebreath.errors import InputError, did_you_mean, shortened

    known = [each.id for each in score.bodies]
    if body is not None and body not in known:
        said = f"--body {shortened(body, 40)}: expected {', '.join(known) or 'none, as the score has no body'}"
        raise InputError(said + did_you_mean(body, known))


def _face_told(row: FaceRow, *, several: bool) -> str:
    who = f"{row.body:<8}" if several else ""
    by = f"{row.rule} ({row.origin})" if row.origin != "rule" else row.rule
    words = f'"{" ".join(row.words.split())}"' if row.words else "(pause)"
    return f"{row.time:>9.3f}  {who}{row.kind:<8} {row.what:<{WIDE}}  {words:<{WIDE}}  {by}".rstrip()


def _of_score(source: Source, options: CompileOptions) -> Iterator[GroupRow]:
    from scorebreath.planning.explain import explain as rows
    from scorebreath_cli.inputs import load_score

    options.refuse(source.name)
    score, _ = load_score(source)
    return rows(score.groups, score.text)


def _of_script(source: Source, compiler: Compiler) -> Iterator[GroupRow]:
    from scorebreath.pipeline import begin_states, plan_script
    from scorebreath.planning.explain import explain as rows
    from scorebreath.script.reader import read
    from scorebreath_cli.making import text_of

    options = compiler.options
    parameters = options.parameters()
    text = text_of(source, options)
    language = compiler.language(text)
    script = read(text, language=language, poem=options.poem, file=source.name)
    groups = plan_script(
        script,
        parameters=parameters,
        model=options.model or DEFAULT_MODEL,
        count=lambda words: compiler.voice(language=language).syllables(words),  # the papers' models never ask
        states=begin_states(options.begin()),
        seed=seed_of(options.seed),
        cast=options.casting(),
    )
    return rows(groups, script.text)


def _told(row: GroupRow) -> str:
    text = " ".join(row.text.split())
    if len(text) > SHOWN:
        text = f"{text[: SHOWN // 2].rstrip()} ... {text[-SHOWN // 2 :].lstrip()}"
    lines = [
        f"{row.index + 1:>4}  {text}",
        f"      {row.syllables} syllables, characters {row.start}-{row.end}; ends at: {row.site}; {row.rule}",
    ]
    unit = "characters away" if row.measure == "characters" else "cost"
    for other in row.candidates:
        value = f"{other.cost:g} {unit}" if row.measure == "characters" else f"{unit} {other.cost:.2f}"
        ending = f"... {other.ending}" if other.ending else ""
        lines.append(f"      {'>' if other.chosen else ' '} {other.site:<10} {value:<20} {ending}".rstrip())
    return "\n".join(lines)
