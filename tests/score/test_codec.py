"""The Score's one canonical form: what goes out comes back, and nothing else comes in."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

import jsonschema
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scorebreath.errors import ScoreError
from scorebreath.score.codec import decode_event, dump_event, dumps, encode, json_schema, loads, parse_json
from scorebreath.score.document import Score
from scorebreath.score.events import EVENTS, Level, Phone, Pitch, Trapezoid, Unknown, Utterance, Word

from .strategies import scores

slow = settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])


@slow
@given(scores())
def test_what_is_saved_is_what_is_loaded(score: Score) -> None:
    data = dumps(score)
    again = loads(data)
    assert again == score
    assert dumps(again) == data


@slow
@given(scores())
def test_every_score_obeys_the_schema(score: Score) -> None:
    jsonschema.Draft202012Validator(json_schema()).validate(json.loads(dumps(score)))


def test_the_schema_names_every_type_of_event() -> None:
    schema = json_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    listed = {item["$ref"].rsplit("/", 1)[1] for item in schema["properties"]["events"]["items"]["anyOf"]}
    assert listed == {kind.__name__ for kind, _ in EVENTS.values()} | {"Unknown"}


@slow
@given(scores(), st.data())
def test_a_broken_file_is_one_score_error(score: Score, data: st.DataObject) -> None:
    whole = dumps(score)
    cut = data.draw(st.integers(0, len(whole) - 3))
    with pytest.raises(ScoreError):
        loads(whole[:cut])


@settings(max_examples=200)
@given(st.binary(max_size=200))
def test_any_bytes_are_a_score_error(data: bytes) -> None:
    with pytest.raises(ScoreError):
        loads(data)


@slow
@given(scores(), st.data())
def test_a_flipped_byte_never_escapes(score: Score, data: st.DataObject) -> None:
    whole = bytearray(dumps(score))
    whole[data.draw(st.integers(0, len(whole) - 1))] = data.draw(st.integers(0, 255))
    try:
        loads(bytes(whole))
    except ScoreError as error:
        assert "Traceback" not in str(error)


EVENT: dict[str, Any] = {"type": "marker", "id": "e", "body": "body", "onset": 1.0, "duration": 0.0, "name": "a"}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"onset": 0.1234567}, "multiple of 1e-6"),
        ({"onset": -0.0}, "multiple of 1e-6"),
        ({"onset": 1e300}, "in [0, 1000000000]"),
        ({"onset": "1.0"}, "onset"),
        ({"onset": True}, "onset"),
        ({"nmae": 1}, "nmae"),
        ({"x": {}}, "unknown field"),
        ({"name": None}, "name"),
        ({"type": "dance"}, "'dance' is not one of"),
        ({"type": None}, "type"),
    ],
)
def test_each_wrong_field_is_named(change: dict[str, Any], said: str) -> None:
    with pytest.raises(ScoreError, match="event") as caught:
        decode_event({**EVENT, **change})
    assert said in str(caught.value)


def test_unknown_extensions_are_kept() -> None:
    event = decode_event({**EVENT, "x_note": {"a": [1, 2]}})
    assert json.loads(dump_event(event))["x_note"] == {"a": [1, 2]}
    plain = {"type": "x_dance", "id": "e", "body": "body", "onset": 1.0, "duration": 0.0, "step": [1], "x_y": 2}
    stranger = decode_event(plain)
    assert isinstance(stranger, Unknown)
    assert json.loads(dump_event(stranger)) == plain


def test_another_version_names_the_version_needed() -> None:
    with pytest.raises(ScoreError, match=r"needs a scorebreath that reads scorebreath\.score/7"):
        loads(b'{"schema":"scorebreath.score/7"}')


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b'{"schema":"a","schema":"b"}', "stands twice"),
        (rb'{"text":"Wh\ud800re"}', "half of a surrogate pair"),
        (rb'{"schema":"x\udc00"}', "half of a surrogate pair"),
        (b'{"schema": NaN}', "NaN is not a number"),
        (b"[" * 100_000, "nested too deeply"),
        (b'{\n "schema" "x"}', "f.json:2:11: broken JSON"),
        (b"[]", "is not a score"),
        (b'{"schema":"scorebreath.score/1","events":3}', "events: expected a list"),
        (b'{"schema":"scorebreath.score/1"}', "made_by"),
        (b'{"schema":' + b"9" * 5000 + b"}", "digits"),
    ],
)
def test_hostile_files_get_one_clear_line(data: bytes, said: str) -> None:
    with pytest.raises(ScoreError) as caught:
        loads(data, "f.json")
    assert said in str(caught.value)
    assert "f.json" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_numbers_become_floats_whatever_they_came_as() -> None:
    given_ints = Trapezoid(attack=1, hold=np.float64(0.5), release=0)
    assert [type(v) for v in (given_ints.attack, given_ints.hold, given_ints.release)] == [float] * 3
    assert Pitch(step=0.005, hertz=(0, 100.5)).hertz == (0.0, 100.5)
    with pytest.raises(ScoreError, match="finite multiples"):
        Pitch(step=0.005, hertz=(float("nan"),))
    with pytest.raises(ScoreError, match="Phone"):
        Phone(ipa="a", onset=float("inf"), duration=0.1)


def test_a_phone_is_of_a_word_that_is_there() -> None:
    word = Word(text="so", onset=0.0, duration=0.2)
    phones = tuple(Phone(ipa="o", onset=0.1 * n, duration=0.1, word=n) for n in range(2))
    spoken = Utterance(
        id="u", body="body", onset=0.0, duration=0.2, media="m", gain_db=0.0, closing="final", words=(word, word),
        phones=phones, pitch=Pitch(step=0.01, hertz=()), level=Level(step=0.01, db=()),
    )  # fmt: skip
    for words, said in (
        ((word,), r"phones\[1\]\.word=1 must be in \[0, 0\]"),
        ((), r"phones\[0\]\.word=0 must be left"),
    ):
        with pytest.raises(ScoreError, match=said):
            dataclasses.replace(spoken, words=words)
    with pytest.raises(ScoreError, match=r"Phone\.word=-1"):
        Phone(ipa="o", onset=0.0, duration=0.1, word=-1)
    plain = encode(spoken)
    plain["phones"][1]["word"] = 999
    with pytest.raises(ScoreError, match=r"f\.json: events\[4\]: .*phones\[1\]\.word=999 must be in \[0, 1\]"):
        decode_event(plain, "events[4]", "f.json")


def test_escaped_halves_that_meet_are_a_character() -> None:
    assert parse_json(rb'{"text":"\ud83d\ude00"}') == {"text": "\N{GRINNING FACE}"}
