"""The program: its commands as a table."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

import typer

from scorebreath_cli.commands.params import params
from scorebreath_cli.commands.presets import presets
from scorebreath_cli.commands.schema import schema

COMMANDS: tuple[tuple[Callable[..., Any], str, tuple[str, ...]], ...] = (
    (params, "Look", ("params", "params --preset casual-tts", "params --set nose_share=0.8 amplitude_sound_nose",
                      "params --json-schema > parameters.schema.json")),
    (presets, "Look", ("presets", "presets formal-tts", "render speech.txt -o out --preset formal-tts")),
    (schema, "Look", ("schema > score.schema.json",)),
)  # fmt: skip
"""Function (its name is the command's), panel of `--help`, examples."""

app = typer.Typer(
    name="scorebreath",
    help="Speech breathing for talking characters: text in; breath, voice and animation curves out.",
    epilog="[bold]Examples[/bold]\n\nscorebreath render speech.txt -o out\nscorebreath COMMAND --help",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"scorebreath {version('scorebreath')}")
        raise typer.Exit()


@app.callback()
def _scorebreath(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    pass


for _command, _panel, _examples in COMMANDS:
    app.command(
        rich_help_panel=_panel,
        epilog="\n".join(["[bold]Examples[/bold]\n", *(f"  scorebreath {example}" for example in _examples)]),
    )(_command)
