"""`scorebreath norms`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scorebreath_cli import options as o
from scorebreath_cli import printers
from scorebreath_cli.failures import Status, reporting
from scorebreath_cli.settings import DEFAULT_ENGINE, check_engine

if TYPE_CHECKING:
    from scorebreath.media.store import MediaStore
    from scorebreath.report.norms import Heard, Norms
    from scorebreath.score.document import Score
    from scorebreath_cli.printers import Printer

MIX = "mix.wav"
"""The sound that `render` puts beside a Score."""


def norms(
    *,
    score: Annotated[
        str,
        typer.Argument(
            metavar="SCORE|TAKE|DIR", help="A score, the folder of a take or of a rendering, or - for stdin."
        ),
    ],
    html: Annotated[
        str | None, typer.Option("--html", metavar="FILE", help="Write a page with every distribution as well.")
    ] = None,
    wav: Annotated[
        str | None,
        typer.Option(
            "--wav", metavar="FILE", help="Where the breaths are listened to.",
            show_default="mix.wav beside the score, or some breaths rendered for it",
        ),
    ] = None,
    sound: Annotated[
        bool, typer.Option("--sound/--no-sound", help="Whether the breaths are listened to at all.")
    ] = True,
    body: Annotated[
        str | None, typer.Option("--body", metavar="ID", help="Whose breathing, where the score has several bodies.")
    ] = None,
    engine: o.Engine = DEFAULT_ENGINE,
    force: o.Force = False,
    json_lines: o.Json = False,
    debug: o.Debug = False,
) -> None:  # fmt: skip
    """Compare a score's breathing with published human ranges: groups, timing, places, lungs, the sound of the breaths.

    Each row shows what the score has, what is published and by whom, and a verdict. Style, age, posture and model of
    the score choose the figures that apply; figures of ours are called scorebreath.
    """
    with reporting(lambda: printers.make(json_lines, score), debug=debug) as printer:
        from scorebreath.errors import InputError
        from scorebreath_cli.inputs import load_score, read_source
        from scorebreath_cli.outputs import STANDARD, behind, refuse_existing, refuse_own_input

        check_engine(engine)
        if wav is not None and not sound:
            raise InputError("--wav and --no-sound contradict each other; expected one of them")
        given = _score_in(score)
        page = None
        if html is not None:
            if html == STANDARD:
                raise InputError("--html -: the table goes to stdout; expected a file for the page")
            page = behind(Path(html))
            refuse_own_input(given, [page])
            if wav is not None:
                refuse_own_input(wav, [page])
            refuse_existing(page.parent, (page.name,), force=force)
        loaded, media = load_score(read_source(given))
        if body is None and len(loaded.bodies) > 1:
            raise InputError(
                f"{given}: has several bodies; expected --body with one of {', '.join(b.id for b in loaded.bodies)}"
            )
        heard = None
        if sound:
            heard = _heard(loaded, media, given=given, wav=wav, body=body, engine=engine, printer=printer)
        from scorebreath.report.norms import norms as compare

        found = compare(loaded, heard, body=body)
        _tell(printer, found, json_lines=json_lines)
        if page is not None:
            _write(printer, page, loaded, found)
        from scorebreath.report.norms.words import summary

        printer.done(Status.DONE, summary(found), **{word.replace(" ", "_"): n for word, n in found.counts.items()})


def _score_in(given: str) -> str:
    """The Score in a rendering's folder; any other input as it is."""
    from scorebreath_cli.outputs import SCORE, STANDARD

    try:
        inside = Path(given) / SCORE
        return str(inside) if given != STANDARD and inside.is_file() else given
    except ValueError:  # no path at all: told where it is read
        return given


def _heard(
    score: Score, media: MediaStore, *, given: str, wav: str | None, body: str | None, engine: str, printer: Printer
) -> Heard | None:
    """What is heard of the breaths; None, and a note, where nothing can be."""
    from scorebreath.curves.curve_set import curves
    from scorebreath.errors import EnvironmentFailure
    from scorebreath.report.norms import listen

    whose = curves(score, body).body  # names the bodies where one must be chosen
    if wav is not None:
        heard = listen(score, Path(wav), body=whose)
        if (other := _of_another(heard.seconds, score.duration)) is not None:
            printer.note(f"{wav}: {other}; is it of this score?")
        return heard
    if (mix := _mix_beside(given)) is not None:
        heard = listen(score, mix, body=whose)
        if (other := _of_another(heard.seconds, score.duration)) is None:
            return heard
        printer.note(f"{mix}: {other}; it is left alone, and breaths are rendered")
    try:
        return _rendered(score, media, whose, engine, printer)
    except EnvironmentFailure as error:
        printer.note(f"the breaths are not listened to: {error}")
        return None


def _mix_beside(given: str) -> Path | None:
    from scorebreath_cli.outputs import STANDARD

    if given == STANDARD:
        return None
    path = Path(given)
    mix = (path if path.is_dir() else path.parent) / MIX
    return mix if mix.is_file() else None


def _of_another(seconds: float, duration: float) -> str | None:
    """What to say of a sound that is not as long as its Score."""
    from scorebreath.units import plain

    if abs(seconds - duration) < 0.01:
        return None
    return f"is {plain(round(seconds, 3))} s long, the score {plain(duration)} s"


def _rendered(score: Score, media: MediaStore, body: str, engine: str, printer: Printer) -> Heard:
    """Some of the breaths, rendered by themselves; the speech's level is as the Score tells it."""
    from tempfile import TemporaryDirectory

    from scorebreath.engine.offline import render
    from scorebreath.report.norms import breaths_alone, listen, speech_level

    alone = breaths_alone(score, body)
    with TemporaryDirectory(prefix="scorebreath-") as folder:
        path = Path(folder) / MIX
        with path.open("wb") as stream:
            render(alone, media, stream, engine=engine, on_progress=printer.progress)
        return listen(alone, path, body=body, speech_db=speech_level(score, body))


def _tell(printer: Printer, found: Norms, *, json_lines: bool) -> None:
    from scorebreath.report.norms import words

    said = words.about_said(found)
    printer.item("about", words.about(found), " \N{MIDDLE DOT} ".join(said))
    if json_lines:
        printer.table("norm", [words.event(each) for each in found.results], ())
        return
    printer.table("norm", [words.line(each) for each in found.results], words.COLUMNS, ("published",))
    for each in found.results:
        if said_why := words.why(each):
            printer.item("why", {}, f"outside: {each.row.title}: {said_why}")


def _write(printer: Printer, page: Path, score: Score, found: Norms) -> None:
    from scorebreath.report.norms.page import write_page
    from scorebreath_cli.outputs import staged_file

    with staged_file(page) as part, part.open("wb") as stream:
        write_page(stream, score, found)
    printer.written(str(page), page.stat().st_size)
