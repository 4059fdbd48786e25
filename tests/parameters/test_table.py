"""The table of parameters: every row complete, every refusal clear, Eq. 1 exact."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import ParameterError
from scorebreath.parameters.assign import parse_assignment
from scorebreath.parameters.derive import LowLevel, derive
from scorebreath.parameters.faces import Face
from scorebreath.parameters.presets import load_preset, names
from scorebreath.parameters.table import Parameters, bounds, osc_address

ROWS = Parameters.model_fields
NUMBERS = [name for name in ROWS if bounds(name)]


@pytest.mark.parametrize("name", ROWS)
def test_every_row_says_what_it_is(name: str) -> None:
    row = ROWS[name]
    extra = row.json_schema_extra
    assert isinstance(extra, dict)
    assert row.description
    assert extra["source"]
    assert extra["level"] in ("abstract", "low", "person", "natural", "voice", "face", "output")
    assert osc_address(name).startswith("/scorebreath/")
    if row.default is not None and bounds(name):
        low, high = bounds(name) or (0.0, 0.0)
        assert low <= row.default <= high


def test_every_parameter_of_b25_to_b39_is_there() -> None:
    cited = " ".join(str(row.json_schema_extra["source"]) for row in ROWS.values() if isinstance(row.json_schema_extra, dict))  # fmt: skip  # noqa: E501
    missing = [f"B{n}" for n in range(25, 40) if f"B{n}" not in cited]
    assert missing == []


def test_no_controller_serves_two_parameters() -> None:
    numbers = [row.json_schema_extra["midi_cc"] for row in ROWS.values() if isinstance(row.json_schema_extra, dict)]
    used = [number for number in numbers if isinstance(number, int)]
    assert len(set(used)) == len(used)
    # 6, 38, 96-101 belong to (N)RPN; 0 and 32 to banks; 120-127 to the mode of the receiver
    assert not set(used) & {0, 6, 32, 38, *range(96, 102), *range(120, 128)}


@pytest.mark.parametrize("name", NUMBERS)
def test_every_range_is_kept_and_named(name: str) -> None:
    low, high = bounds(name) or (0.0, 0.0)
    for value in (low, high):
        assert getattr(Parameters(**{name: value}), name) == value
    refused: tuple[object, ...] = (
        math.nextafter(low, -math.inf), math.nextafter(high, math.inf), math.nan, math.inf, "x", True,
    )  # fmt: skip
    for wrong in refused:
        with pytest.raises(ParameterError, match=name) as caught:
            Parameters(**{name: wrong})
        assert f"[{low:g}, {high:g}]" in str(caught.value)


def test_an_unknown_name_is_refused_with_the_nearest() -> None:
    with pytest.raises(ParameterError, match="did you mean 'nose_share'"):
        Parameters(noseshare=1.0)


def test_eq_1_with_the_figures_of_the_issue() -> None:
    low = derive(Parameters(capacity_lung=64.0, speaking_loudness=100.0, norm_syllables=20.0))
    assert (low.length_utterance, low.urgency_limit, low.length_inspiration) == (16.0, 32.0, 0.64)


@given(st.data())
def test_shares_divide_and_a_hand_set_value_stays(data: st.DataObject) -> None:
    values = {
        name: data.draw(st.floats(*(bounds(name) or (0.0, 1.0))), label=name)
        for name in (
            "nose_share",
            "abdomen_share",
            "capacity_lung",
            "opening_inspiration_channels",
            "speaking_loudness",
        )
    }
    low = derive(Parameters(**values))
    assert low.amplitude_sound_nose + low.amplitude_sound_mouth == pytest.approx(1.0)
    assert low.volume_thorax + low.volume_abdomen == pytest.approx(values["capacity_lung"] / 100)
    opening = values["opening_inspiration_channels"]
    assert low.amplitude_nostril_flare + low.amplitude_mouth_open == pytest.approx(opening)
    assert low.urgency_limit == 2 * low.length_utterance
    assert low.prosody_loudness == values["speaking_loudness"]
    chosen = data.draw(st.sampled_from([name for name in LowLevel.__annotations__ if name in ROWS]))
    by_hand = (bounds(chosen) or (1.0, 1.0))[0]
    set_once = Parameters(**values, **{chosen: by_hand})
    assert getattr(derive(set_once), chosen) == by_hand
    moved = set_once.with_values({"nose_share": 0.9, "capacity_lung": 90.0, "speaking_loudness": 50.0})
    assert getattr(derive(moved), chosen) == by_hand
    assert derive(set_once.with_values({chosen: None})) == low


def test_every_derived_parameter_can_be_set_by_hand() -> None:
    derived = {name for name in ROWS if ROWS[name].default is None} - set(Face.__annotations__)
    assert derived == set(LowLevel.__annotations__) | {"vital_capacity", "resting_volume", "vocal_tract_length"}


@pytest.mark.parametrize("name", names())
def test_every_preset_loads_and_says_why(name: str) -> None:
    preset = load_preset(name)
    assert preset.description
    assert preset.source
    assert Parameters(**preset.values).set_by_hand() == dict(preset.values)


def test_the_design_advice_of_the_study_is_there() -> None:
    # B62: with a synthetic voice breaths are heard in formal talk only, with a human one in casual talk only.
    heard = {
        name: load_preset(name).values["breath_sound"] for name in names() if name.startswith(("casual", "formal"))
    }
    assert heard == {"casual-human": True, "casual-tts": False, "formal-human": False, "formal-tts": True}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("nose_share", "expected NAME=VALUE"),
        ("nose_share=", "must be a number"),
        ("breath_sound=perhaps", "true or false"),
        ("nose_share=1e999", "must be a number"),
        ("=3", "no parameter is called ''"),
        ("period_marker=none", "'bare' or 'sentence'"),
        ("sex=1", "sex='1' must be 'male' or 'female'"),
        ("posture=sitting", "'upright' or 'reclined' or 'supine'"),
        ("condition=", "'none' or 'parkinson' or 'copd'"),
    ],
)
def test_bad_assignments_are_refused(text: str, said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        parse_assignment(text)


def test_user_presets_come_from_files(tmp_path: pytest.TempPathFactory) -> None:
    path = str(tmp_path) + "/mine.toml"
    for content, said in [
        ("[parameters]\nnose_share = 2.0", r"\[0, 1\]"),
        ("[parameters\n", "mine.toml"),
        ("colour = 'red'", "colour"),
        ("parameters = 3", "parameters"),
        ("description = 1", "description"),
    ]:
        with open(path, "w", encoding="utf-8") as stream:  # noqa: PTH123
            stream.write(content)
        with pytest.raises(ParameterError, match=said):
            load_preset(path)
    with open(path, "w", encoding="utf-8") as stream:  # noqa: PTH123
        stream.write("[parameters]\nnose_share = 0.5\n")
    assert load_preset(path).values == {"nose_share": 0.5}
    with pytest.raises(ParameterError, match="there are athlete, belly, casual-human"):
        load_preset("no-such")
