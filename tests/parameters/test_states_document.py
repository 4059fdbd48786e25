"""docs/states.md says what the tables say."""

from __future__ import annotations

import re
from math import log10
from pathlib import Path

import pytest

from scorebreath.parameters.modifiers import Modifiers, modifiers
from scorebreath.parameters.presets import load_preset, names
from scorebreath.parameters.states import STATES
from scorebreath.parameters.table import Parameters

TEXT = (Path(__file__).resolve().parents[2] / "docs" / "states.md").read_text(encoding="utf-8")
ROWS = dict(re.findall(r"^\| `([a-z]+(?: [\d.]+)?)` \| ([-+.|\d ]+) \|$", TEXT, re.MULTILINE))
NOT_OF_A_PERSON = {"casual-human", "casual-tts", "formal-human", "formal-tts", "nose", "stylised"}


def shown(m: Modifiers) -> list[str]:
    depth = m.syllables * m.volume + max(0.0, m.start) * m.exhale_chance / 0.162
    whole = round(m.breath_db + 33.2 * log10(depth / (m.inspiration * (0.42 + 0.18 * m.syllables) / 0.60)))
    before = (m.rate, m.depth, m.fraction, m.syllables, m.inspiration, m.pause, m.thorax_share, m.nose_share)
    return [*(f"{value:.2f}" for value in before), f"{whole:+d}" if whole else "0", f"{m.variation:.2f}"]


def test_every_state_has_a_row_of_figures_and_one_of_words() -> None:
    assert {label.split()[0] for label in ROWS} == set(STATES)
    assert set(re.findall(r"^\| `([a-z]+)` \| [^|]*[a-z]{3}[^|]*\| [^|]*\|$", TEXT, re.MULTILINE)) >= set(STATES)


@pytest.mark.parametrize("label", ROWS)
def test_the_figures_are_the_tables(label: str) -> None:
    name, _, level = label.partition(" ")
    assert [cell.strip() for cell in ROWS[label].split("|")] == shown(
        modifiers(Parameters(), {name: float(level or 1)})
    )


def test_every_preset_of_a_person_is_listed_with_what_it_sets() -> None:
    told = dict(re.findall(r"^\| `([a-z-]+)` \| (`[a-z_]+ = .*`) \|$", TEXT, re.MULTILINE))
    assert set(told) == set(names()) - NOT_OF_A_PERSON
    for name, row in told.items():
        assert row == ", ".join(f"`{key} = {value}`" for key, value in load_preset(name).values.items())
