"""The table of states: every row complete, the figures of physiology 4.2, names people type, docs/states.md."""

from __future__ import annotations

import re
from dataclasses import fields
from math import log10
from pathlib import Path

import pytest

from scorebreath.equations.breath import mix_level
from scorebreath.errors import InputError
from scorebreath.parameters.columns import COLUMNS, deviations
from scorebreath.parameters.modifiers import Modifiers, modifiers
from scorebreath.parameters.presets import load_preset, names
from scorebreath.parameters.states import STATES, find_state
from scorebreath.parameters.table import Parameters

NAMES = (
    "neutral", "calm", "happy", "laughing", "kidding", "sad", "crying", "angry", "surprised", "disgusted", "anxious",
    "exertion", "fatigue",
)  # fmt: skip

TABLE_4_2 = """
    neutral     1.00  1.00  .40  1.00  1.00  1.00  .65  .35    0  .15
    calm        0.80  1.15  .36  1.10  1.15  1.20  .50  .70   -4  .10
    happy       1.10  1.10  .42  1.00  0.95  0.90  .60  .45   +1  .20
    laughing    1.15  1.35  .28  0.75  0.75  0.90  .50  .10   +4  .30
    kidding     1.05  1.05  .40  0.95  0.95  1.05  .60  .45   +1  .20
    sad         0.90  0.90  .38  0.85  1.10  1.35  .60  .55   -2  .25
    crying      1.15  0.90  .48  0.55  1.30  1.20  .75  .45   +3  .40
    angry       1.25  1.25  .46  0.85  0.80  0.75  .75  .60   +5  .15
    surprised   1.10  1.45  .40  0.70  0.65  1.10  .80  .05   +6  .25
    disgusted   0.95  0.75  .36  0.85  0.85  1.20  .65  .10    0  .25
    anxious     1.35  0.85  .45  0.70  0.75  0.85  .85  .25   +3  .35
    exertion/2  1.80  2.00  .45  0.60  0.80  1.10  .65  .10  +10  .12
    exertion    2.80  4.50  .48  0.30  0.65  1.10  .70  .00  +14  .12
    fatigue     0.95  0.95  .42  0.80  1.15  1.40  .55  .40   +2  .25
"""
TEN = ("rate", "depth", "fraction", "syllables", "inspiration", "pause", "thorax_share", "nose_share", "total_db", "variation")  # fmt: skip  # noqa: E501
ROWS = {line.split()[0]: dict(zip(TEN, map(float, line.split()[1:]), strict=True)) for line in TABLE_4_2.split("\n")[1:-1]}  # fmt: skip  # noqa: E501

SIGNATURES: list[tuple[str, str, float, float]] = [
    ("calm", "rest_pause", 0.6, 0.6),
    ("happy", "brightness", 1.05, 1.05),
    ("laughing", "laugh_chance", 0.3, 1.0),
    ("kidding", "puff_chance", 0.5, 0.5),
    ("sad", "sigh_interval", 45.0, 45.0),
    ("crying", "saccades", 3, 3),
    ("angry", "delay", 0.5, 0.9),
    ("surprised", "gasp_chance", 0.3, 1.0),
    ("surprised", "hold_chance", 0.2, 1.0),
    ("surprised", "hold_length", 0.3, 0.8),
    ("disgusted", "hold_length", 0.5, 1.2),
    ("disgusted", "exhale_chance", 0.1, 1.0),
    ("anxious", "hold_chance", 0.05, 0.5),
    ("anxious", "tremor", 0.03, 0.03),
    ("exertion", "exhale_chance", 0.8, 1.0),
    ("fatigue", "sigh_interval", 60.0, 60.0),
    ("fatigue", "start", -0.06, -0.06),
]


def whole_db(m: Modifiers) -> float:
    """By how much a speech breath is louder in all: what its flow does (physiology 3.1), its way, and the rest."""
    depth = m.syllables * m.volume + m.exhale_chance * 0.12 / 0.162
    length = m.inspiration * (0.42 + 0.18 * m.syllables) / 0.60
    way = mix_level(1.0 - m.nose_share, m.nose_share) - mix_level(0.65, 0.35)
    return m.breath_db + 33.2 * log10(depth / length) + way


def test_all_states_are_there_neutral_first() -> None:
    assert tuple(STATES) == NAMES
    assert len(STATES) == len(NAMES)


def test_columns_are_the_modifiers_and_their_defaults() -> None:
    assert list(COLUMNS) == [field.name for field in fields(Modifiers)]
    assert {name: column.neutral for name, column in COLUMNS.items()} == {
        field.name: field.default for field in fields(Modifiers)
    }


@pytest.mark.parametrize("name", NAMES)
def test_every_row_is_complete_and_says_why(name: str) -> None:
    row = STATES[name]
    assert row.name == name
    assert len(row.description) > 10
    assert "physiology" in row.source or "e;" in row.source
    assert row.kind == ("body" if name in ("exertion", "fatigue") else "mood")
    assert row.recovery == (45.0 if name == "exertion" else 0.0)
    assert row.anchors[-1][0] == 1.0
    for _, values in row.anchors:
        assert set(values) == set(COLUMNS)


@pytest.mark.parametrize("name", ROWS)
def test_the_figures_of_physiology_4_2(name: str) -> None:
    state, half = name.removesuffix("/2"), name.endswith("/2")
    m = modifiers(Parameters(), {state: 0.5 if half else 1.0})
    for column in TEN:
        given = whole_db(m) if column == "total_db" else getattr(m, column)
        assert given == pytest.approx(ROWS[name][column], abs=0.06 if column == "total_db" else 1e-9), column


@pytest.mark.parametrize(("name", "column", "low", "high"), SIGNATURES)
def test_the_signatures_of_physiology_4_2(name: str, column: str, low: float, high: float) -> None:
    assert low <= getattr(modifiers(Parameters(), {name: 1.0}), column) <= high


def test_angry_nostrils_are_wide_open() -> None:
    m = modifiers(Parameters(), {"angry": 1.0})
    assert m.flare * m.nose_share * Parameters().opening_inspiration_channels == pytest.approx(1.0, abs=0.02)


def test_heavy_exertion_ends_where_people_were_measured() -> None:
    # physiology 1.5, exhaustion: 42-51 breaths a minute, 2.6-3.05 L; 4.2: 40-50 a minute, 2-3 L
    m, p = modifiers(Parameters(), {"exertion": 1.0}), Parameters()
    assert 40 <= m.rate * p.resting_rate <= 50
    assert 2.0 <= m.depth * p.tidal_volume * 5.10 <= 3.0


@pytest.mark.parametrize("name", NAMES)
def test_every_other_word_finds_its_state(name: str) -> None:
    for alias in (name, *STATES[name].aliases):
        assert find_state(alias) is STATES[name]
        assert find_state(alias.upper().replace("-", " ")) is STATES[name]


def test_no_word_means_two_states() -> None:
    words = [word for row in STATES.values() for word in (row.name, *row.aliases)]
    assert len(set(words)) == len(words)


@pytest.mark.parametrize(
    ("word", "state"),
    [
        ("joy", "happy"), ("wink", "kidding"), ("fear", "anxious"), ("fearful", "anxious"), ("afraid", "anxious"),
        ("exhausted", "exertion"), ("tired", "fatigue"), ("out_of_breath", "exertion"),
    ],
)  # fmt: skip
def test_words_people_type(word: str, state: str) -> None:
    assert find_state(word).name == state


@pytest.mark.parametrize(("wrong", "meant"), [("anxius", "anxious"), ("hapy", "happy"), ("exersion", "exertion")])
def test_an_unknown_state_names_what_may_be_meant(wrong: str, meant: str) -> None:
    with pytest.raises(
        InputError, match=f"no state is called '{wrong}'; did you mean .*{meant}.*there are neutral, calm"
    ):
        find_state(wrong)
    with pytest.raises(InputError, match=wrong):
        modifiers(Parameters(), {wrong: 0.5})


@pytest.mark.parametrize("bad", [{"colour": 1.0}, {"rate": "fast"}, {"rate": True}, {"rate": 9.0}, {"tremor": -0.1}])
def test_a_broken_row_is_found(bad: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=f"a row: {next(iter(bad))}"):
        deviations(bad, "a row")


TEXT = (Path(__file__).resolve().parents[2] / "docs" / "states.md").read_text(encoding="utf-8")
FIGURES = dict(re.findall(r"^\| `([a-z]+(?: [\d.]+)?)` \| ([-+.|\d ]+) \|$", TEXT, re.MULTILINE))
NOT_OF_A_PERSON = {"casual-human", "casual-tts", "formal-human", "formal-tts", "nose", "stylised"}


def shown(m: Modifiers) -> list[str]:
    before = (m.rate, m.depth, m.fraction, m.syllables, m.inspiration, m.pause, m.thorax_share, m.nose_share)
    whole = round(whole_db(m))
    return [*(f"{value:.2f}" for value in before), f"{whole:+d}" if whole else "0", f"{m.variation:.2f}"]


def test_every_state_has_a_row_of_figures_and_one_of_words() -> None:
    assert {label.split()[0] for label in FIGURES} == set(STATES)
    assert set(re.findall(r"^\| `([a-z]+)` \| [^|]*[a-z]{3}[^|]*\| [^|]*\|$", TEXT, re.MULTILINE)) >= set(STATES)


@pytest.mark.parametrize("label", FIGURES)
def test_the_figures_are_the_tables(label: str) -> None:
    name, _, level = label.partition(" ")
    assert [cell.strip() for cell in FIGURES[label].split("|")] == shown(
        modifiers(Parameters(), {name: float(level or 1)})
    )


def test_every_preset_of_a_person_is_listed_with_what_it_sets() -> None:
    told = dict(re.findall(r"^\| `([a-z-]+)` \| (`[a-z_]+ = .*`) \|$", TEXT, re.MULTILINE))
    assert set(told) == set(names()) - NOT_OF_A_PERSON
    for name, row in told.items():
        assert row == ", ".join(f"`{key} = {value}`" for key, value in load_preset(name).values.items())
