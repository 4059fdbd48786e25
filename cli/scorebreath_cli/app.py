"""The program: its commands as a table."""

from __future__ import annotations

import itertools
import sys
from collections.abc import Callable, Sequence
from typing import Annotated, Any, cast

import typer
from typer.core import TyperGroup

from scorebreath_cli import printers
from scorebreath_cli.commands.cache import cache
from scorebreath_cli.commands.compile import compile_
from scorebreath_cli.commands.curves import curves
from scorebreath_cli.commands.doctor import doctor
from scorebreath_cli.commands.explain import explain
from scorebreath_cli.commands.export import export
from scorebreath_cli.commands.formats import formats
from scorebreath_cli.commands.live import live
from scorebreath_cli.commands.norms import norms
from scorebreath_cli.commands.params import params
from scorebreath_cli.commands.play import play
from scorebreath_cli.commands.presets import presets
from scorebreath_cli.commands.render import render
from scorebreath_cli.commands.rigs import rigs
from scorebreath_cli.commands.schema import schema
from scorebreath_cli.commands.voices import voices
from scorebreath_cli.failures import Failure, Status, failure_of, tell
from scorebreath_cli.streams import silence

MAKE, PERFORM, LOOK = "Make", "Perform", "Look"
Examples = tuple[str, ...]
COMMANDS: tuple[tuple[str, Callable[..., None], str, Examples], ...] = (
    ("render", render, MAKE, (
        "scorebreath render speech.txt -o out",
        "scorebreath render chapter1.txt chapter2.txt -o book --voice espeak:en-us+f3",
        "scorebreath render poem.txt -o out --poem --language de --set nose_share=0.8",
        "scorebreath render poem.txt -o out --face albrecht-2002 --without gaze --rig arkit --rig livelink",
        "scorebreath render score.json -o out --engine scsynth --fps 30000/1001",
        "fortune | scorebreath render - -o - | aplay",
    )),
    ("compile", compile_, MAKE, (
        "scorebreath compile speech.txt -o score.json",
        "scorebreath compile speech.txt --model bernardet-2019 --set capacity_lung=64 -o score.json",
        "scorebreath compile speech.txt | scorebreath curves - --fps 24",
    )),
    ("curves", curves, MAKE, (
        "scorebreath curves score.json -o curves.csv --fps 60",
        "scorebreath curves score.json -o curves.json --fps 30000/1001",
        "scorebreath curves score.json -o face.csv --rig arkit --keys",
        "scorebreath curves score.json -o take_1_Face.csv --rig livelink",
        "scorebreath curves --describe --rig muscles",
        "scorebreath curves --describe",
    )),
    ("export", export, MAKE, (
        "scorebreath export score.json --to maryxml -o score.xml",
        "scorebreath export score.json --to curves.csv --fps 30 -o curves.csv",
    )),
    ("live", live, PERFORM, (
        "scorebreath live",
        "scorebreath live greeting.txt --take tonight --to vmc://192.168.1.7:39539",
        "llm 'Tell me about the sea' | scorebreath live - --to osc --to ws://127.0.0.1:8765",
        "scorebreath live --engine scsynth@127.0.0.1:57110 --midi nanoKONTROL --midi-map knobs.toml",
        "scorebreath live --devices",
        "scorebreath render tonight -o again",
    )),
    ("play", play, PERFORM, (
        "scorebreath play score.json",
        "scorebreath play tonight --start 30 --loop",
        "scorebreath play out --to livelink://192.168.1.7:11111 --preview",
        "scorebreath compile speech.txt -o score.json && scorebreath play score.json --engine scsynth",
    )),
    ("explain", explain, LOOK, (
        "scorebreath explain speech.txt",
        "scorebreath explain speech.txt --model bernardet-2017 --set length_utterance=12",
        "scorebreath explain score.json --json",
        "scorebreath explain speech.txt --face albrecht-2002",
    )),
    ("norms", norms, LOOK, (
        "scorebreath norms out",
        "scorebreath norms score.json --html norms.html",
        "scorebreath norms score.json --wav recording.wav --json",
        "scorebreath compile speech.txt --set style=spontaneous | scorebreath norms - --no-sound",
    )),
    ("params", params, LOOK, (
        "scorebreath params",
        "scorebreath params --preset casual-tts",
        "scorebreath params --set nose_share=0.8 amplitude_sound_nose",
        "scorebreath params --json-schema > parameters.schema.json",
    )),
    ("presets", presets, LOOK, (
        "scorebreath presets",
        "scorebreath presets formal-tts",
        "scorebreath render speech.txt -o out --preset formal-tts",
    )),
    ("voices", voices, LOOK, ("scorebreath voices", "scorebreath render speech.txt -o out --voice espeak:en-us+f3")),
    ("cache", cache, LOOK, (
        "scorebreath cache", "scorebreath cache --clear --voice piper:joe", "scorebreath cache --prune 500MB",
    )),
    ("rigs", rigs, LOOK, ("scorebreath rigs", "scorebreath curves --describe --rig arkit")),
    ("formats", formats, LOOK, ("scorebreath formats", "scorebreath formats --json")),
    ("schema", schema, LOOK, ("scorebreath schema > score.schema.json",)),
    ("doctor", doctor, LOOK, ("scorebreath doctor", "scorebreath doctor --sound --device hw:1")),
)  # fmt: skip
"""Name, function, panel of `--help`, examples."""

STATUSES = "0 done, 1 a bug of ours, 2 bad usage or input, 3 environment (engine, voice, disk), 130 interrupted"


_Complaint = cast("type[typer.BadParameter]", typer.BadParameter.__mro__[2])
"""Whatever is wrong with a command line; which library it comes from depends on typer's version."""


class _Commands(TyperGroup):
    """Tells bad usage as every other error is told: in one line, as JSON where `--json` is given."""

    def main(
        self, args: Sequence[str] | None = None, prog_name: str | None = None, *more: Any,
        standalone_mode: bool = True, **extra: Any,
    ) -> Any:  # fmt: skip
        """Run a command line; always ends in SystemExit unless `standalone_mode` is off."""
        words = sys.argv[1:] if args is None else list(args)
        try:
            status = super().main(args, prog_name, *more, **{**extra, "standalone_mode": False})
        except _Complaint as error:
            if not standalone_mode:
                raise
            if type(error).__name__ != "NoArgsIsHelpError":  # has shown the help already
                _complain(error, json_lines="--json" in itertools.takewhile(lambda word: word != "--", words))
            sys.exit(Status.INPUT)
        except typer.Abort:
            if not standalone_mode:
                raise
            sys.exit(Status.INTERRUPTED)
        except OSError as error:  # of `--help` and `--version`; a command tells its own
            if not standalone_mode:
                raise
            sys.exit(_unheard(error))
        if not standalone_mode:
            return status
        sys.exit(status or Status.DONE)


def _unheard(error: OSError) -> Status:
    """Help that cannot be shown: say so, unless its reader has just had enough."""
    failure = failure_of(error)
    if failure.status != Status.PIPE_CLOSED:
        sys.stderr.write(f"scorebreath: {failure.message}\n")
    silence()
    return failure.status


def _complain(error: typer.BadParameter, *, json_lines: bool) -> None:
    said = " ".join(error.format_message().split()).rstrip(".")
    command = error.ctx.command_path if error.ctx else "scorebreath"
    message = f"{said[:1].lower()}{said[1:]}; try `{command} --help`"
    tell(printers.make(json_lines), Failure(status=Status.INPUT, kind=type(error).__name__, message=message))


app = typer.Typer(
    name="scorebreath",
    cls=_Commands,
    help="Speech breathing for talking characters: text in; breath, voice and animation curves out.",
    epilog=f"[bold]Example[/bold]  scorebreath render speech.txt -o out\n\n[bold]Exit status[/bold]  {STATUSES}",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib import metadata

        try:
            found = metadata.version("scorebreath")
        except metadata.PackageNotFoundError:
            found = "(not installed)"
        typer.echo(f"scorebreath {found}")
        raise typer.Exit()


@app.callback()
def _scorebreath(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    pass


for _name, _command, _panel, _examples in COMMANDS:
    app.command(
        _name,
        rich_help_panel=_panel,
        epilog="\n".join(["[bold]Examples[/bold]\n", *(f"  {example}" for example in _examples)]),
    )(_command)
