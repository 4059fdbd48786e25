"""`scorebreath live`: everything is checked, then opened, then it is performed."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scorebreath.errors import InputError
from scorebreath_cli.failures import Status, conclude, ending_of
from scorebreath_cli.inputs import read_source
from scorebreath_cli.making import Compiler, text_of
from scorebreath_cli.outputs import STANDARD, TAKE
from scorebreath_cli.performing.settings import ControlOptions, EngineOptions, StreamOptions
from scorebreath_cli.settings import DEFAULT_MODEL, DEFAULT_VOICE, LEAD, TAIL, seconds, seed
from scorebreath_cli.streams import check_stdout

if TYPE_CHECKING:
    from scorebreath.script.markup.marked import Marked
    from scorebreath_cli.performing.feeding import Whole
    from scorebreath_cli.performing.keys import Keyboard
    from scorebreath_cli.performing.stage import Plan, Stage
    from scorebreath_cli.performing.telling import Teller
    from scorebreath_cli.printers import Printer

SCREEN_KEPT = 10
"""Messages of the screen that are told again when it is gone."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wishes:
    """Options of performing, as given."""

    engine: EngineOptions
    streams: StreamOptions
    controls: ControlOptions
    take: str | None
    preview: int | None
    """port; 0: any"""
    screen: bool | None
    stay: bool
    json_lines: bool


def perform(given: Sequence[str], wishes: Wishes, compiler: Compiler, printer: Printer) -> None:
    """Perform, from the first check to the last word.

    Args:
        given: Text files, `-` for stdin; none: the rehearsal screen, or stdin where there is no terminal.
        wishes: How.
        compiler: Opens voices.
        printer: Told what happens.

    Raises:
        typer.Exit: It was interrupted.
        ScorebreathError: Something is wrong, missing or broken.
    """
    from scorebreath_cli.performing.stage import Stage
    from scorebreath_cli.performing.telling import Teller

    names = list(given) or ([] if sys.stdin.isatty() else [STANDARD])
    if names.count(STANDARD) > 1:
        raise InputError("-: stdin is there once; expected it once")
    texts, first = _texts(names, compiler)
    plan = _planned(wishes, compiler, first)
    teller = Teller(printer, json_lines=wishes.json_lines)
    stage = Stage(plan, compiler.voice, teller)
    status = Status.DONE
    try:
        with stage:
            status = _performed(stage, texts, wishes, teller, typing=STANDARD not in names)
    except (KeyboardInterrupt, SystemExit) as error:
        status = ending_of(error) or Status.BUG
    finally:
        _last_words(stage, wishes, teller, printer)
    said = _summary(stage.ended, plan) if stage.ended else ""
    conclude(printer, status, said)


def _texts(names: Sequence[str], compiler: Compiler) -> tuple[list[Whole | None], Marked | None]:
    """What is to be said, and the first text of all, for its language.

    Raises:
        InputError: A file is not there, is no script, or its markup is wrong.
    """
    from scorebreath.live.console import LONGEST_TEXT
    from scorebreath.script.decode import decode
    from scorebreath_cli.performing.feeding import Whole

    texts: list[Whole | None] = []
    first: Marked | None = None
    for name in names:
        if name == STANDARD:
            texts.append(None)
            continue
        source = read_source(name)
        if source.compiled:
            raise InputError(f"{source.name}: is a {source.kind} already; `scorebreath play` plays it")
        text = decode(source.data, source.name)
        if len(text) > LONGEST_TEXT:
            raise InputError(
                f"{source.name}: {len(text)} characters, which is a day of speech; expected at most {LONGEST_TEXT}; "
                "through a pipe (-) there may be any number"
            )
        marked = text_of(source, compiler.options)
        first = first or marked
        texts.append(Whole(name=source.name, text=text))
    return texts, first


def _planned(wishes: Wishes, compiler: Compiler, first: Marked | None) -> Plan:
    """All that can be wrong is found before anything is opened.

    Raises:
        InputError: Names it.
    """
    from scorebreath.live.show import Setting
    from scorebreath.planning.planners import PLANNERS, open_planner
    from scorebreath.script.markup.marked import Marked
    from scorebreath_cli.performing.stage import Plan

    options = compiler.options
    wishes.engine.check()
    wishes.streams.check(json_lines=wishes.json_lines)
    wishes.controls.osc_endpoint()
    wishes.controls.mapping()
    if wishes.streams.to_stdout:
        check_stdout()
    parameters = options.parameters()
    model = options.model or DEFAULT_MODEL
    if model not in PLANNERS:
        open_planner(model, parameters, "en", lambda words: [1] * len(words))  # raises, and says which there are
    language = compiler.language(first or Marked(text=""))
    setting = Setting(
        voice=options.voice or DEFAULT_VOICE, model=model, language=language, parameters=parameters,
        states=options.begin(), cast=options.casting(), seed=seed(options.seed), markup=options.kind_of_markup(),
        breaths=Path(options.breaths) if options.breaths is not None else None, take=_take(wishes.take),
        lead=seconds("lead", options.lead, LEAD), tail=seconds("tail", options.tail, TAIL),
    )  # fmt: skip
    return Plan(
        setting=setting, engine=wishes.engine, streams=wishes.streams, controls=wishes.controls,
        preview=wishes.preview, json_lines=wishes.json_lines,
    )  # fmt: skip


def _take(given: str | None) -> Path | None:
    """A folder for a take: a performance is never written over.

    Raises:
        InputError: Something is there already.
    """
    if given is None:
        return None
    if given == STANDARD:
        raise InputError("--take -: a take is a folder; expected a name for a new one")
    path = Path(given)
    try:
        if (path / TAKE).exists():
            raise InputError(
                f"--take {given}: holds a take already, and takes are not written over; expected a new name"
            )
        if path.exists() and not path.is_dir():
            raise InputError(f"--take {given}: is a file; expected a name for a new folder")
        if path.is_dir() and any(path.iterdir()):
            raise InputError(f"--take {given}: is not empty; expected a name for a new folder")
    except ValueError as error:
        raise InputError(f"--take {given!r}: {error}") from None
    return path


def _performed(stage: Stage, texts: list[Whole | None], wishes: Wishes, teller: Teller, *, typing: bool) -> Status:
    from scorebreath_cli.performing.feeding import Feeder
    from scorebreath_cli.performing.performing import Performing
    from scorebreath_cli.performing.screen import can_draw

    drawn = wishes.screen is not False and not wishes.json_lines and can_draw()
    drawn = drawn and not (wishes.streams.to_stdout and sys.stdout.isatty())
    if wishes.screen and not drawn:
        teller.note("--screen: there is no terminal that a screen can be drawn on, or it is taken")
    keyboard = _keyboard(drawn=drawn, typing=typing)
    feeder = Feeder(texts, teller.note)
    performing = Performing(
        stage, feeder, teller, keyboard=keyboard, drawn=drawn, typing=typing,
        stay=wishes.stay or not texts, groups=wishes.json_lines or (keyboard is not None and not drawn),
    )  # fmt: skip
    if performing.run():
        return Status.INTERRUPTED
    return Status.INPUT if feeder.refused else Status.DONE


def _keyboard(*, drawn: bool, typing: bool) -> Keyboard | None:
    """Keys of a terminal: of stdin, or where that is text, of the one that the screen is on."""
    from scorebreath_cli.performing.keys import open_keyboard

    if typing:
        return open_keyboard(stdin=True, raw=drawn)
    return open_keyboard(stdin=False, raw=True) if drawn else None


def _last_words(stage: Stage, wishes: Wishes, teller: Teller, printer: Printer) -> None:
    """What was not told yet, and for programs the figures."""
    again = [message for message in teller.shown if message.event not in ("started", "group")]
    untold = not wishes.json_lines and stage.drawn
    teller.drain()
    if untold:
        for message in again[-SCREEN_KEPT:]:
            printer.note(message.text)
    if wishes.json_lines and stage.ended:
        printer.item("ended", stage.ended, "")


def _summary(ended: Mapping[str, Any], plan: Plan) -> str:
    """What was counted, for people."""
    groups = ended["groups"]
    said = f"{groups} group{'s' * (groups != 1)} said, {ended['late']} late"
    if ended["late"]:
        said += f" (by up to {ended['latest']:.3f} s)"
    counts = ((ended["unspoken"], "not spoken"), (ended["stalls"], "stalls"), (ended["engine"]["lost"], "sounds lost"))
    said += "".join(f", {number} {what}" for number, what in counts if number)
    return said + (f"; {plan.setting.take}" if plan.setting.take else "")
