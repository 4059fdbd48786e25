"""The figure of our pages: its drawing, its looks, and the script that poses it, for whichever page shows it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib.resources import files

from scorebreath.score.acting import EMOTIONS

CHANNELS = (
    "lung_volume", "thorax", "abdomen", "shoulder", "nostril_flare", "mouth_open", "airflow",
    "jaw_open", "lip_close", "lip_round", "lip_spread", "lip_tuck", "tongue_tip",
    "head_pitch", "head_yaw", "head_roll", "eye_pitch", "eye_yaw", "lid_left", "lid_right",
    "brow_left", "brow_right", "brow_frown", "wrinkle_forehead", "wrinkle_glabella",
    *(f"emotion_{name}" for name in EMOTIONS),
    "speech_level", "breath_level",
)  # fmt: skip
"""What is drawn."""


def drawing() -> str:
    """The figure at no pose yet, as SVG; its ids begin with nothing, so a page with several renames them."""
    return _static("figure.svg")


def style() -> str:
    """The colours of our pages, by day and by night, and the looks of the figure."""
    return _static("figure.css")


def script() -> str:
    """Defines `figureIn(svg, prefix)`: a function that poses a drawing."""
    return _static("face.js") + _static("figure.js")


def filled(template: str, parts: Mapping[str, str]) -> Iterator[str]:
    """A page in pieces: `{{name}}` stands for a part, and nothing that looks so inside a part does.

    >>> "".join(filled("<h1>{{title}}</h1>", {"title": "{{title}}"}))
    '<h1>{{title}}</h1>'
    """
    for number, piece in enumerate(template.replace("}}", "{{").split("{{")):
        yield parts[piece] if number % 2 else piece


def _static(name: str) -> str:
    return (files("scorebreath.report") / "static" / name).read_text(encoding="utf-8")
