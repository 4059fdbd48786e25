"""The table of addresses: everything in the tables of parameters and commands is reached, answers, and is bounded."""

from __future__ import annotations

import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.errors import InputError, ParameterError
from scorebreath.live.controls.addresses import VERBS, Kind, hint, resolve, table
from scorebreath.live.controls.arguments import setting, tidy
from scorebreath.live.controls.limits import Listeners
from scorebreath.live.controls.osc_actions import Actions
from scorebreath.live.controls.packets import Argument, Message, read_packet
from scorebreath.live.desk import COMMANDS, Setting
from scorebreath.parameters.table import Parameters, bounds, choices
from tests.live.desks import ToyDesk

HERE = ("127.0.0.1", 40000)
NAMES = sorted(Parameters.model_fields)


def send(desk: ToyDesk, address: str, *arguments: Argument) -> list[Message]:
    """What is answered."""
    answers = Actions(desk, Listeners()).do(Message(address=address, arguments=arguments), HERE, 0.0)
    assert all(answer.to == HERE for answer in answers)
    return [message for answer in answers for packet in answer.packets for message in read_packet(packet)]


def sendable(value: Setting) -> Argument:
    """As it comes out of a 32-bit float."""
    return struct.unpack("f", struct.pack("f", value))[0] if isinstance(value, float) else value


def some_value(name: str) -> st.SearchStrategy[Setting]:
    if limits := bounds(name):
        return st.one_of(st.sampled_from(limits), st.floats(*limits))
    return st.sampled_from(choices(name)) if choices(name) else st.booleans()


def test_the_table_holds_every_parameter_verb_and_command_once() -> None:
    rows = table()
    kinds: dict[Kind, set[str]] = {"parameter": set(), "verb": set(), "command": set()}
    for row in rows:
        assert resolve(row.address, ()) == row.place
        assert row.about
        kinds[row.place.kind].add(row.place.name)
    assert kinds == {"parameter": set(Parameters.model_fields), "verb": set(VERBS), "command": set(COMMANDS)}
    assert len(rows) == len({row.address for row in rows}) == sum(map(len, kinds.values()))


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=25)
@given(data=st.data())
def test_every_parameter_is_set_and_answers(name: str, data: st.DataObject) -> None:
    desk = ToyDesk("body", "body2")
    value = data.draw(some_value(name))
    assert send(desk, f"/scorebreath/body2/{name}", sendable(value)) == []
    (answer,) = send(desk, f"/scorebreath/body2/{name}")
    assert answer.address == f"/scorebreath/body2/{name}"
    (said,) = answer.arguments
    kept = desk.value(name, "body2")
    assert said == (pytest.approx(kept, rel=1e-6) if isinstance(kept, float) else kept)
    assert kept == (pytest.approx(value, rel=1e-6, abs=1e-30) if isinstance(value, float) else value)
    assert desk.values("body").get(name) == ToyDesk().values().get(name)


@pytest.mark.parametrize("name", NAMES)
def test_an_answer_sent_back_changes_nothing(name: str) -> None:
    desk = ToyDesk()
    for value in bounds(name) or choices(name) or (True, False):
        desk.set(name, value)
        (answer,) = send(desk, f"/scorebreath/{name}")
        send(desk, f"/scorebreath/{name}", *answer.arguments)
        assert desk.value(name) == value
    send(desk, f"/scorebreath/{name}", None)
    assert desk.moves()[-1] == (name, None)
    send(desk, "/scorebreath/reset", name)
    assert desk.moves()[-1] == (name, None)


@pytest.mark.parametrize("name", NAMES)
def test_every_parameter_refuses_what_is_outside(name: str) -> None:
    wrong: list[Argument] = ["rubbish", float("nan"), float("inf"), -1e9, 2**60, "9" * 100]
    if limits := bounds(name):
        wrong += [limits[0] - 0.01, limits[1] + 0.01]
    for value in wrong:
        desk = ToyDesk()
        with pytest.raises(InputError, match=name):
            send(desk, f"/scorebreath/{name}", value)
        assert desk.moves() == []


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_every_command_is_reached(name: str) -> None:
    desk = ToyDesk("body", "body2")
    for address in (f"/scorebreath/command/{name}", f"/scorebreath/{name}", f"/scorebreath/body2/command/{name}"):
        assert send(desk, address) == []
        assert send(desk, address, 1.0) == []
        assert send(desk, address, 0) == []  # the button is let go
    done = [call for call in desk.calls if call[0] == "command"]
    assert done == [("command", name, body) for body in ("", "", "", "", "body2", "body2")]


def test_a_parameter_without_one_value_answers_nil_which_changes_nothing() -> None:
    desk = ToyDesk()
    assert "vital_capacity" not in desk.values()
    (answer,) = send(desk, "/scorebreath/vital_capacity")
    assert answer == Message(address="/scorebreath/vital_capacity", arguments=(None,))
    send(desk, answer.address, *answer.arguments)
    assert desk.moves() == [("vital_capacity", None)]


def test_texts() -> None:
    desk = ToyDesk("body", "body2")
    send(desk, "/scorebreath/say", "Grüße, 息。")
    send(desk, "/scorebreath/cut", "Stop")
    send(desk, "/scorebreath/body2/say", "I", "have", 3, "dogs.")
    send(desk, "/scorebreath/stream", "Once up")
    send(desk, "/scorebreath/stream", "on a time")
    send(desk, "/scorebreath/stream/end")
    send(desk, "/scorebreath/body2/stream/end", 1)
    assert desk.calls == [
        ("say", "Grüße, 息。", ""), ("cut", "Stop", ""), ("say", "I have 3 dogs.", "body2"), ("stream", "Once up", ""),
        ("stream", "on a time", ""), ("end_stream", ""), ("end_stream", "body2"),
    ]  # fmt: skip


def test_a_glide_goes_with_the_value() -> None:
    desk = ToyDesk()
    send(desk, "/scorebreath/nose_share", 0.5, 2)
    assert desk.calls == [("set", "nose_share", 0.5, "", 2.0)]
    for glide in (-1, 61, float("nan"), "slow", None):
        with pytest.raises(InputError, match="glide"):
            send(desk, "/scorebreath/nose_share", 0.5, glide)


def test_all_values_come_in_packets_that_pass_any_network() -> None:
    desk = ToyDesk("body", "body2")
    desk.set("style", "spontaneous", body="body2")
    answers = Actions(desk, Listeners()).do(Message(address="/scorebreath/body2/values"), HERE, 0.0)
    packets = [packet for answer in answers for packet in answer.packets]
    assert max(map(len, packets)) <= 1400
    got = {message.address: message.arguments[0] for packet in packets for message in read_packet(packet)}
    assert set(got) == {f"/scorebreath/body2/{name}" for name in desk.values("body2")}
    assert got["/scorebreath/body2/style"] == "spontaneous"
    assert {m.address for m in send(desk, "/scorebreath/values")} == {f"/scorebreath/{n}" for n in desk.values()}
    assert send(desk, "/scorebreath/bodies")[0].arguments == ("body", "body2")
    assert send(desk, "/scorebreath/ping", 7) == [Message(address="/scorebreath/pong", arguments=(7,))]


@pytest.mark.parametrize(
    ("address", "arguments", "problem"),
    [
        ("/scorebreath/nose_shar", (1,), "no such address"),
        ("/scorebreath/body3/nose_share", (1,), "no such address"),
        ("/scorebreath/body/ping", (), "no such address"),
        ("/other/nose_share", (1,), "begins with /scorebreath/"),
        ("/scorebreath/", (), "no such address"),
        ("/scorebreath/nose_share", (0.5, 0.1, 3), "3 arguments, expected 2"),
        ("/scorebreath/sigh", ("now",), "expected no argument"),
        ("/scorebreath/sigh", (1, 1), "2 arguments, expected 1"),
        ("/scorebreath/say", (), "expected a text"),
        ("/scorebreath/say", ("[broken",), "without end"),
        ("/scorebreath/reset", ("nose_shar",), "did you mean nose_share"),
        ("/scorebreath/listen", (0,), "port 0"),
        ("/scorebreath/listen", (70000,), "port 70000"),
        ("/scorebreath/listen", ("x",), "port 'x'"),
        ("/scorebreath/unlisten", (float("inf"),), "port inf"),
    ],
)
def test_what_is_wrong_is_said(address: str, arguments: tuple[Argument, ...], problem: str) -> None:
    with pytest.raises(InputError, match=problem):
        send(ToyDesk(), address, *arguments)


def test_a_wrong_address_gets_a_hint() -> None:
    bodies = ["body", "body2"]
    assert hint("/scorebreath/body2/nose_shar", bodies).startswith("; did you mean nose_share")
    assert hint("/scorebreath/nose_shar", bodies).startswith("; did you mean nose_share")
    assert hint("/scorebreath/command/nosuch", bodies) == ""
    assert hint("/scorebreath/comand/sigh", bodies).startswith("; there are body, body2")
    assert hint("/scorebreath/body3/sigh", bodies) == "; there are body, body2; did you mean body or body2?"
    assert hint("/scorebreath/body2/ping", bodies) == "; it is for everybody"
    assert hint("/scorebreath/" + "q" * 5000, bodies) == ""


@given(st.floats(width=32, allow_nan=False, allow_infinity=False), st.floats(-1e6, 1e6))
def test_tidy_keeps_32_bit_floats_and_everything_finer(narrow: float, wide: float) -> None:
    assert struct.pack("f", tidy(narrow)) == struct.pack("f", narrow) or tidy(narrow) == pytest.approx(narrow, rel=1e-6)
    assert tidy(wide) == pytest.approx(wide, rel=1e-6)


@given(st.integers(-10_000_000, 10_000_000))
def test_tidy_gives_back_the_decimal(places: int) -> None:
    """Seven digits are the same before and after 32 bits, so no range is missed by a rounding."""
    meant = places / 1e6 if abs(places) < 1_000_000 else places / 1e5
    sent = struct.unpack("f", struct.pack("f", round(meant, 5)))[0]
    assert tidy(sent) == round(meant, 5)


def test_choices_by_place_and_flags_by_half() -> None:
    assert [setting("style", place) for place in (0, 1.0)] == list(choices("style"))
    assert [setting("face_gaze", way) for way in (0, 0.49, 0.5, 1, True, "off")] == [
        False,
        False,
        True,
        True,
        True,
        False,
    ]
    for wrong in (0.5, 2, -1):
        with pytest.raises(ParameterError, match="style"):
            setting("style", wrong)
