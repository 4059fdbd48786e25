"""Mappings: what is written is read again, the default follows the table, and every mistake is named with its place."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import EnvironmentFailure, InputError
from scorebreath.live.controls.mapping import FIRST_NOTE, SOURCES, Control, Mapping, Source, default_mapping
from scorebreath.live.controls.mapping_file import dumps_mapping, loads_mapping, read_mapping, write_mapping
from scorebreath.live.controls.scaling import CURVES, scale_of
from scorebreath.live.desk import COMMANDS
from scorebreath.parameters.table import Parameters, bounds, choices

WORDS = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=20)
NUMERIC = sorted(name for name in Parameters.model_fields if bounds(name))


@st.composite
def controls(draw: st.DrawFn) -> Control:
    source: Source = draw(st.sampled_from(sorted(SOURCES)))
    number = draw(st.integers(0, SOURCES[source] or 0))
    channel, body = draw(st.integers(0, 16)), draw(st.one_of(st.just(""), WORDS))
    if source == "note" or (source in ("cc", "cc14") and draw(st.booleans())):
        command = draw(st.sampled_from(["", *COMMANDS]))
        said = "" if command else draw(WORDS)
        return Control(source=source, number=number, channel=channel, command=command, say=said, body=body)
    name = draw(st.sampled_from(sorted(Parameters.model_fields)))
    low = high = None
    if limits := bounds(name):
        low, high = draw(st.lists(st.one_of(st.none(), st.floats(*limits)), min_size=2, max_size=2))
        ends = (limits[0] if low is None else low, limits[1] if high is None else high)
        low, high = (None, None) if abs(ends[0] - ends[1]) < 1e-4 else (low, high)
    return Control(
        source=source, number=number, channel=channel, parameter=name, low=low, high=high, body=body,
        curve=draw(st.sampled_from(sorted(CURVES))), takeover=draw(st.booleans()),
    )  # fmt: skip


@st.composite
def mappings(draw: st.DrawFn) -> Mapping:
    kept: list[Control] = []
    for control in draw(st.lists(controls(), max_size=8)):
        if not {one for other in kept for one in other.inputs()} & set(control.inputs()):
            kept.append(control)
    return Mapping(tuple(kept))


@given(mappings())
def test_what_is_written_is_read_again(mapping: Mapping) -> None:
    assert loads_mapping(dumps_mapping(mapping)) == mapping


def test_files(tmp_path: Path) -> None:
    path = tmp_path / "knobs.toml"
    write_mapping(default_mapping(), path)
    assert read_mapping(path) == default_mapping()
    write_mapping(Mapping(), path)
    assert read_mapping(path) == Mapping()
    assert [file.name for file in tmp_path.iterdir()] == ["knobs.toml"]
    with pytest.raises(EnvironmentFailure, match=r"none/knobs\.toml"):
        write_mapping(Mapping(), tmp_path / "none" / "knobs.toml")
    with pytest.raises(InputError, match="cannot be read"):
        read_mapping(tmp_path / "none.toml")
    path.write_bytes(b"a = '\xff'")
    with pytest.raises(InputError, match="byte 5: not UTF-8"):
        read_mapping(path)
    path.write_bytes(b"#" * 1_000_001)
    with pytest.raises(InputError, match="larger"):
        read_mapping(path)


def test_a_file_by_hand() -> None:
    mapping = loads_mapping(
        """
        [[control]]
        channel = 1
        cc = 74
        parameter = "nose_share"
        low = 0.2
        high = 0.8
        curve = "linear"
        takeover = true
        body = "body2"

        [[control]]
        note = 36
        command = "sigh"

        [[control]]
        note = 38
        say = "Well."

        [[control]]
        bend = true
        parameter = "prosody_pitch"
        takeover = false
        """
    )
    knob, sigh, said, bend = mapping.controls
    assert (knob.scale.value(0.0), knob.scale.value(0.5), knob.scale.value(1.0)) == (0.2, 0.5, 0.8)
    assert (knob.channel, knob.body, sigh.command, said.say, bend.source) == (1, "body2", "sigh", "Well.", "bend")


def test_the_default_is_the_table_s_column_and_a_key_for_every_command() -> None:
    mapping = default_mapping()
    numbers = {
        name: field.json_schema_extra["midi_cc"]
        for name, field in Parameters.model_fields.items()
        if isinstance(field.json_schema_extra, dict) and field.json_schema_extra["midi_cc"] is not None
    }
    assert {control.parameter: control.number for control in mapping.controls if control.parameter} == numbers
    keys = {control.command: control.number for control in mapping.controls if control.source == "note"}
    assert keys == {name: FIRST_NOTE + place for place, name in enumerate(COMMANDS)}
    assert all(
        control.source == ("cc14" if control.number < 32 else "cc") for control in mapping.controls if control.parameter
    )


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("[[control]", "line 1"),
        ("x = 1", "'x' is not understood"),
        ("control = 1", r"expected tables \[\[control\]\]"),
        ("control = [1]", r"expected tables \[\[control\]\]"),
        ("[[control]]\ncc = 1\nparamter = 'nose_share'", "control 1: 'paramter' .*did you mean parameter"),
        ("[[control]]\ncc = 1\nparameter = 'nose_shar'", "control 1: no parameter .*did you mean nose_share"),
        ("[[control]]\ncc = 1\ncommand = 'sig'", "control 1: no command .*did you mean sigh"),
        ("[[control]]\nparameter = 'nose_share'", "exactly one of cc"),
        ("[[control]]\ncc = 1\nnote = 1\ncommand = 'sigh'", "exactly one of cc"),
        ("[[control]]\ncc = 1", "exactly one of parameter, command and say"),
        ("[[control]]\ncc = 1\nsay = 'a'\ncommand = 'sigh'", "exactly one of parameter, command and say"),
        ("[[control]]\ncc = 128\nparameter = 'nose_share'", r"cc=128 must be a number in \[0, 127\]"),
        ("[[control]]\ncc = -1\nparameter = 'nose_share'", r"cc=-1"),
        ("[[control]]\ncc14 = 32\nparameter = 'nose_share'", r"cc14=32 must be a number in \[0, 31\]"),
        ("[[control]]\nchannel = 17\ncc = 1\nparameter = 'nose_share'", r"channel=17"),
        ("[[control]]\nchannel = 0\ncc = 1\nparameter = 'nose_share'", r"channel=0"),
        ("[[control]]\ncc = true\nparameter = 'nose_share'", "cc=True, expected a whole number"),
        ("[[control]]\ncc = 1.0\nparameter = 'nose_share'", "cc=1.0, expected a whole number"),
        ("[[control]]\ncc = 1\nparameter = 5", "parameter=5, expected a text"),
        ("[[control]]\npressure = false\nparameter = 'nose_share'", "pressure=false, expected true"),
        ("[[control]]\ncc = 1\nparameter = 'nose_share'\nlow = 'a'", "low=a, expected a number"),
        ("[[control]]\ncc = 1\nparameter = 'nose_share'\nlow = true", "low=True, expected a number"),
        ("[[control]]\ncc = 1\nparameter = 'nose_share'\nlow = -0.5", r"low=-0.5 must be a number in \[0, 1\]"),
        ("[[control]]\ncc = 1\nparameter = 'nose_share'\nhigh = nan", "high=nan"),
        ("[[control]]\ncc = 1\nparameter = 'nose_share'\nhigh = inf", "high=inf"),
        ("[[control]]\ncc = 1\nparameter = 'nose_share'\nlow = 0.5\nhigh = 0.5", "low and high are both 0.5"),
        (f"[[control]]\ncc = 1\nparameter = 'nose_share'\nlow = {'9' * 400}", "low=9+..., expected a number"),
        (f"[[control]]\ncc = {'9' * 5000}\nparameter = 'nose_share'", "mapping: "),
        ("[[control]]\ncc = 1\nparameter = 'style'\nlow = 0", "style is no number"),
        ("[[control]]\ncc = 1\nparameter = 'nose_share'\ncurve = 'round'", "curve='round', expected one of linear"),
        ("[[control]]\ncc = 1\ncommand = 'sigh'\ncurve = 'slow'", "are for parameters"),
        ("[[control]]\nnote = 1\nparameter = 'nose_share'", "a note moves no parameter"),
        ("[[control]]\nbend = true\ncommand = 'sigh'", "bend only moves parameters"),
        ("[[control]]\nnote = 1\ncommand = 'sigh'\n" * 2, "control 2: note 1 on any channel .*control 1"),
        ("[[control]]\ncc = 34\ncommand = 'sigh'\n[[control]]\ncc14 = 2\nparameter = 'age'", "control 2: cc14 2 .*l 1"),
        ("[[control]]\ncc = 1\nsay = 'b'\n[[control]]\nchannel = 3\ncc = 1\nsay = 'a'", "control 2: cc 1 on channel 3"),
        ("a = " + "[" * 100_000, "mapping: "),
    ],
)  # fmt: skip
def test_every_mistake_is_named(text: str, problem: str) -> None:
    with pytest.raises(InputError, match=problem) as caught:
        loads_mapping(text)
    assert str(caught.value).startswith("mapping: ")
    assert len(str(caught.value)) < 300


@given(st.text(max_size=200))
def test_any_text_is_a_mapping_or_one_error(text: str) -> None:
    try:
        loads_mapping(text)
    except InputError as error:
        assert str(error).startswith("mapping: ")


def test_what_is_learned_takes_the_place_of_what_was() -> None:
    learned = default_mapping().learned(Control(source="cc", channel=3, number=20, parameter="nose_share"))
    assert [str(control) for control in learned.controls if control.parameter == "nose_share"] == ["cc 20 on channel 3"]
    assert not [control for control in learned.controls if control.parameter == "abdomen_share"]  # it had number 20
    assert len(learned.controls) == len(default_mapping().controls) - 1


@pytest.mark.parametrize("name", sorted(Parameters.model_fields))
@pytest.mark.parametrize("curve", sorted(CURVES))
def test_a_way_through_a_parameter(name: str, curve: str) -> None:
    """Both ends are reached, it goes one way, stays in range, and finds its way back."""
    scale = scale_of(name, curve=curve)
    values = [scale.value(step / 127) for step in range(128)]
    for value in values:
        assert getattr(Parameters(**{name: value}), name) == value
        assert scale.value(scale.way(value)) == (pytest.approx(value, abs=2e-6) if bounds(name) else value)
    if limits := bounds(name):
        assert (values[0], values[-1]) == limits
        assert values == sorted(values, key=float)
        assert scale_of(name, limits[1], limits[0], curve).value(0.0) == limits[1]
    else:
        words = choices(name) or (False, True)
        assert list(dict.fromkeys(values)) == list(words)
        assert curve != "linear" or abs(values.count(words[0]) - 128 / len(words)) <= 1


@given(st.sampled_from(NUMERIC), st.sampled_from(sorted(CURVES)), st.floats(-0.5, 1.5), st.floats(-1e9, 1e9))
def test_nothing_leaves_the_range(name: str, curve: str, way: float, value: float) -> None:
    scale, limits = scale_of(name, curve=curve), bounds(name)
    assert limits
    assert limits[0] <= float(scale.value(way)) <= limits[1]
    assert 0.0 <= scale.way(value) <= 1.0
