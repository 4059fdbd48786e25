"""`scorebreath explain`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import Status, reporting
from scorebreath_cli.settings import DEFAULT_LANGUAGE, DEFAULT_MODEL, CompileOptions
from scorebreath_cli.settings import seed as seed_of

if TYPE_CHECKING:
    from scorebreath.planning.explain import GroupRow
    from scorebreath_cli.inputs import Source
    from scorebreath_cli.making import Compiler

SHOWN = 400
"""Characters of a group shown to people: more than one breath holds, unless the text is no text."""


def explain(
    *,
    script: Annotated[str, typer.Argument(metavar="SCRIPT|SCORE", help="A text file, a score, or - for stdin.")],
    voice: o.Voice = None,
    model: o.Model = None,
    preset: o.Preset = None,
    assign: o.Assign = None,
    state: o.State = None,
    markup: o.Markup = None,
    seed: o.Seed = None,
    language: o.Language = None,
    poem: o.Poem = None,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:
    """Show each breath group: its text, its syllables, where it was cut, what else was possible, and the rule.

    Nothing is spoken.

    The Bernardet models give each candidate's distance in characters, natural its cost; the chosen one is marked.
    """
    options = CompileOptions(
        voice=voice, model=model, presets=tuple(preset or ()), assignments=tuple(assign or ()),
        states=tuple(state or ()), markup=markup, seed=seed, language=language, poem=poem,
    )  # fmt: skip
    with reporting(lambda: printers.make(json_lines, script), debug=debug) as printer:
        from scorebreath_cli.inputs import read_source
        from scorebreath_cli.making import Compiler

        source = read_source(script)
        with Compiler(options, printer) as compiler:
            groups = 0
            for row in _of_score(source, options) if source.compiled else _of_script(source, compiler):
                printer.item("group", asdict(row), _told(row))
                groups += 1
            printer.done(Status.DONE, groups=groups)


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
    language = options.language or text.language or DEFAULT_LANGUAGE
    script = read(text, language=language, poem=options.poem, file=source.name)
    groups = plan_script(
        script,
        parameters=parameters,
        model=options.model or DEFAULT_MODEL,
        count=lambda words: compiler.voice(language=language).syllables(words),  # the papers' models never ask
        states=begin_states(options.begin()),
        seed=seed_of(options.seed),
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
