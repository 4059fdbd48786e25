"""The options that several commands share, each in one place."""

from __future__ import annotations

from typing import Annotated

import typer

COMPILING = "Compiling"
BREATHS = "Compiling: silences and breaths"
RECORDING = "Compiling: a recording (--voice recording:FILE)"
FACE = "Compiling: the face"
SOUND = "Sound and curves"


def _names(kind: str, incomplete: str) -> list[str]:
    """Names for shell completion; what cannot be had completes nothing."""
    try:
        from scorebreath_cli import choices

        names = choices.CHOICES[kind]()
    except Exception:  # a shell waits for words, not for our troubles
        return []
    return [name for name in names if name.startswith(incomplete)]


def complete_models(incomplete: str) -> list[str]:
    """Planners."""
    return _names("models", incomplete)


def complete_presets(incomplete: str) -> list[str]:
    """Presets of ours."""
    return _names("presets", incomplete)


def complete_voices(incomplete: str) -> list[str]:
    """Voices."""
    return _names("voices", incomplete)


def complete_states(incomplete: str) -> list[str]:
    """Breathing states."""
    return _names("states", incomplete)


def complete_markups(incomplete: str) -> list[str]:
    """Kinds of markup."""
    return _names("markups", incomplete)


def complete_faces(incomplete: str) -> list[str]:
    """Ways a face can behave."""
    return _names("faces", incomplete)


def complete_parts(incomplete: str) -> list[str]:
    """Parts of a face, each but those that stand before it already."""
    before, comma, last = incomplete.rpartition(",")
    named = before.split(",")
    return [f"{before}{comma}{part}" for part in _names("parts", last) if part not in named]


def complete_rigs(incomplete: str) -> list[str]:
    """Characters whose shapes are known."""
    return _names("rigs", incomplete)


def complete_formats(incomplete: str) -> list[str]:
    """Formats that a score can be written in."""
    return _names("formats", incomplete)


def complete_engines(incomplete: str) -> list[str]:
    """Sound engines."""
    return _names("engines", incomplete)


def complete_live_engines(incomplete: str) -> list[str]:
    """Engines that play as things happen."""
    return _names("live_engines", incomplete)


def complete_targets(incomplete: str) -> list[str]:
    """Where curves can go."""
    return _names("targets", incomplete)


def complete_parameters(incomplete: str) -> list[str]:
    """Parameters."""
    return _names("parameters", incomplete)


def complete_assignments(incomplete: str) -> list[str]:
    """Parameters, up to where the value begins."""
    return _names("assignments", incomplete)


Voice = Annotated[
    str | None,
    typer.Option(
        "--voice", metavar="NAME", help="Who speaks: espeak by default; see `scorebreath voices`.",
        autocompletion=complete_voices, rich_help_panel=COMPILING,
    ),
]  # fmt: skip
Model = Annotated[
    str | None,
    typer.Option(
        "--model", metavar="NAME", help="Who plans the breaths: natural (default), bernardet-2017 or bernardet-2019.",
        autocompletion=complete_models, rich_help_panel=COMPILING,
    ),
]  # fmt: skip
Preset = Annotated[
    list[str] | None,
    typer.Option(
        "--preset", metavar="NAME|FILE",
        help="A set of parameters: one of `scorebreath presets`, or a .toml file; of several the later ones win.",
        autocompletion=complete_presets, rich_help_panel=COMPILING,
    ),
]  # fmt: skip
Assign = Annotated[
    list[str] | None,
    typer.Option(
        "--set", metavar="NAME=VALUE", help="Set one of `scorebreath params`; may be repeated.",
        autocompletion=complete_assignments, rich_help_panel=COMPILING,
    ),
]  # fmt: skip
State = Annotated[
    list[str] | None,
    typer.Option(
        "--state", metavar="NAME[=INTENSITY]",
        help="A state the body is in from the beginning, such as anxious=0.8; may be repeated.",
        autocompletion=complete_states, rich_help_panel=COMPILING,
    ),
]  # fmt: skip
Cast = Annotated[
    list[str] | None,
    typer.Option(
        "--cast", metavar="VOICE=PRESET",
        help="Who speaks with a voice that the text changes to, such as espeak:en-us+f3=woman; may be repeated.",
        rich_help_panel=COMPILING,
    ),
]  # fmt: skip
Markup = Annotated[
    str | None,
    typer.Option(
        "--markup", metavar="KIND", help="What stands in the text: tags, ssml, maryxml, none; auto by default.",
        autocompletion=complete_markups, rich_help_panel=COMPILING,
    ),
]  # fmt: skip
Breaths = Annotated[
    str | None,
    typer.Option(
        "--breaths", metavar="DIR", help="Your own recordings of breaths: mouth.wav, nose.wav, sigh.wav ... there.",
        rich_help_panel=BREATHS,
    ),
]  # fmt: skip
Seed = Annotated[
    int | None,
    typer.Option("--seed", metavar="N", help="Another seed, other chances; 0 by default.", rich_help_panel=COMPILING),
]
Language = Annotated[
    str | None,
    typer.Option(
        "--language", metavar="CODE",
        help="Language of the text, such as de; by default what the text says, or the voice's own, or en.",
        rich_help_panel=COMPILING,
    ),
]  # fmt: skip
Poem = Annotated[
    bool | None,
    typer.Option(
        "--poem/--prose", help="Whether line ends are phrase edges; by default as the text looks.",
        rich_help_panel=COMPILING,
    ),
]  # fmt: skip
Lead = Annotated[
    float | None,
    typer.Option(
        "--lead", metavar="SECONDS", help="Time before the first breath; 0.5 by default.", rich_help_panel=BREATHS
    ),
]
Tail = Annotated[
    float | None,
    typer.Option(
        "--tail",
        metavar="SECONDS",
        help="Silence after the body has come back to rest; 1 by default.",
        rich_help_panel=BREATHS,
    ),
]
BreathSound = Annotated[
    bool | None,
    typer.Option(
        "--breath-sound/--no-breath-sound", help="Whether breaths are heard; no time changes.",
        rich_help_panel=BREATHS,
    ),
]  # fmt: skip
BreathMotion = Annotated[
    bool | None,
    typer.Option(
        "--breath-motion/--no-breath-motion", help="Whether breaths are seen; no time changes.",
        rich_help_panel=BREATHS,
    ),
]  # fmt: skip
Transcript = Annotated[
    str | None,
    typer.Option("--transcript", metavar="FILE", help="What the recording says, in place of SCRIPT.",
                 rich_help_panel=RECORDING),
]  # fmt: skip
TextGrid = Annotated[
    str | None,
    typer.Option("--textgrid", metavar="FILE", help="A Praat TextGrid that says where its words, and phones, are.",
                 rich_help_panel=RECORDING),
]  # fmt: skip
Words = Annotated[
    str | None,
    typer.Option("--words", metavar="FILE", help="A JSON file with word, start and end, as Whisper writes it.",
                 rich_help_panel=RECORDING),
]  # fmt: skip
OwnBreaths = Annotated[
    str | None,
    typer.Option("--own-breaths", metavar="WHAT", help="Breaths that are heard in it: keep (default), or replace.",
                 rich_help_panel=RECORDING),
]  # fmt: skip
Face = Annotated[
    str | None,
    typer.Option(
        "--face", metavar="NAME",
        help="How the face behaves: restrained (default), as people do; albrecht-2002, at the rates of that paper.",
        autocompletion=complete_faces, rich_help_panel=FACE,
    ),
]  # fmt: skip
Without = Annotated[
    list[str] | None,
    typer.Option(
        "--without", metavar="PART,...",
        help="What the face leaves out, nothing else changing: blinks, brows, head, gaze, emotion; may be repeated.",
        autocompletion=complete_parts, rich_help_panel=FACE,
    ),
]  # fmt: skip

Engine = Annotated[
    str,
    typer.Option("--engine", metavar="NAME", help="What makes the sound: embedded, or an installed scsynth.",
                 autocompletion=complete_engines, rich_help_panel=SOUND),
]  # fmt: skip
Loudness = Annotated[
    float | None,
    typer.Option("--loudness", metavar="LUFS", help="How loud mix.wav is: -16, -23 ...; peaks stay below -1 dBTP.",
                 rich_help_panel=SOUND),
]  # fmt: skip
Stems = Annotated[
    bool,
    typer.Option("--stems", help="Write stems/speech.wav and stems/breath.wav as well: together they are mix.wav.",
                 rich_help_panel=SOUND),
]  # fmt: skip
Rate = Annotated[
    int, typer.Option("--rate", metavar="HZ", help="Samples per second of mix.wav.", rich_help_panel=SOUND)
]
Fps = Annotated[
    str,
    typer.Option("--fps", metavar="RATE", help="Frames per second of the curves: 60, 29.97 or 30000/1001.",
                 rich_help_panel=SOUND),
]  # fmt: skip
Rigs = Annotated[
    list[str] | None,
    typer.Option(
        "--rig", metavar="NAME|FILE",
        help="Write NAME.csv, too: the curves as a character's own shapes, see `scorebreath rigs`; may be repeated.",
        autocompletion=complete_rigs, rich_help_panel=SOUND,
    ),
]  # fmt: skip

NoCache = Annotated[
    bool,
    typer.Option(
        "--no-cache", help="Speak everything anew, and keep nothing of it; see `scorebreath cache`.",
        rich_help_panel=COMPILING,
    ),
]  # fmt: skip

Force = Annotated[bool, typer.Option("--force", "-f", help="Replace output that is there already.")]
Json = Annotated[bool, typer.Option("--json", help="Tell what happens as one JSON object a line, on stdout.")]
Debug = Annotated[bool, typer.Option("--debug", envvar="SCOREBREATH_DEBUG", help="Show tracebacks.")]
