"""The laws of knobs: 14 bits of two halves, takeover without jumps, floods thinned, on a clock that tests turn."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mido import Message

from scorebreath.live.controls.knobs import FINE, PATIENCE, WINDOW, Grip, Learner, Move, Reader, touch_of
from scorebreath.live.controls.mapping import Control, Mapping

WIDE = Control(source="cc14", number=2, parameter="nose_share")
NARROW = Control(source="cc", number=70, parameter="capacity_lung")
PEDAL = Control(source="cc", number=64, command="sigh")
KEY = Control(source="note", number=36, command="gasp")
PRESSURE = Control(source="pressure", parameter="speaking_loudness")
BEND = Control(source="bend", channel=2, parameter="prosody_pitch")
ALL = Mapping((WIDE, NARROW, PEDAL, KEY, PRESSURE, BEND))


def cc(number: int, value: int, channel: int = 1) -> Message:
    return Message("control_change", channel=channel - 1, control=number, value=value)


def feed(reader: Reader, now: float, *messages: Message) -> None:
    for message in messages:
        touch = touch_of(message)
        assert touch
        reader.feed(touch, now)


def ways(reader: Reader) -> dict[Control, float]:
    return {move.control: move.way for move in reader.take()[0]}


@given(st.integers(0, FINE))
def test_two_halves_are_one_value_as_soon_as_both_are_there(value: int) -> None:
    reader = Reader(ALL)
    feed(reader, 1.0, cc(2, value >> 7))
    reader.expire(1.0 + PATIENCE * 0.9)
    assert ways(reader) == {}
    feed(reader, 1.019, cc(34, value & 127))
    assert ways(reader) == {WIDE: value / FINE}
    reader.expire(9.0)
    assert ways(reader) == {}


@given(st.integers(0, 127))
def test_a_first_half_alone_is_taken_when_its_time_is_over(value: int) -> None:
    reader = Reader(ALL)
    feed(reader, 1.0, cc(2, value))
    reader.expire(1.0 + PATIENCE)
    assert ways(reader) == {WIDE: value / 127}
    reader.expire(9.0)
    assert ways(reader) == {}


def test_halves_of_two_channels_are_not_mixed_and_a_second_half_may_move_alone() -> None:
    reader = Reader(ALL)
    feed(reader, 0.0, cc(34, 99))
    assert ways(reader) == {}  # a half without the other says nothing
    feed(reader, 0.0, cc(2, 10, channel=1), cc(2, 90, channel=5), cc(34, 3, channel=1))
    assert ways(reader) == {WIDE: (10 << 7 | 3) / FINE}
    feed(reader, 0.001, cc(34, 4, channel=5))
    assert ways(reader) == {WIDE: (90 << 7 | 4) / FINE}
    feed(reader, 5.0, cc(34, 5, channel=5))
    assert ways(reader) == {WIDE: (90 << 7 | 5) / FINE}


def test_every_kind_of_control() -> None:
    reader = Reader(ALL)
    feed(
        reader,
        0.0,
        cc(70, 127),
        Message("aftertouch", channel=3, value=127),
        Message("pitchwheel", channel=1, pitch=8191),
    )
    feed(reader, 0.0, Message("note_on", note=36, velocity=1), Message("note_off", note=36), cc(64, 127))
    moves, presses = reader.take()
    assert {move.control: move.way for move in moves} == {NARROW: 1.0, PRESSURE: 1.0, BEND: 1.0}
    assert presses == (KEY, PEDAL)
    feed(reader, 0.0, Message("pitchwheel", channel=0, pitch=5), cc(99, 1), Message("note_on", note=37))
    assert reader.take() == ((), ())
    for other in (Message("program_change"), Message("sysex", data=[1] * 1000), Message("clock"), Message("polytouch")):
        assert touch_of(other) is None


def test_a_pedal_acts_once_when_it_goes_down_and_a_key_whenever_it_is_pressed() -> None:
    reader = Reader(ALL)
    done = 0
    for value in (10, 63, 64, 90, 127, 64, 63, 127, 0):
        feed(reader, 0.0, cc(64, value))
        done += len(reader.take()[1])
    assert done == 2
    for velocity in (5, 0, 5, 5):
        feed(reader, 0.0, Message("note_on", note=36, velocity=velocity))
        done += len(reader.take()[1])
    assert done == 5


def test_a_flood_is_the_last_value_of_each() -> None:
    reader = Reader(ALL)
    for number in range(10_000):
        feed(reader, 0.0, cc(70, number % 128), cc(2, number % 128), cc(34, number % 100), cc(64, number % 2 * 127))
    moves, presses = reader.take()
    assert moves == (
        Move(control=NARROW, channel=1, way=15 / 127, raw=15, fine=False),
        Move(control=WIDE, channel=1, way=(15 << 7 | 99) / FINE, raw=15 << 7 | 99, fine=True),
    )
    assert presses == (PEDAL,)


PLACES = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=60)


@given(PLACES, st.floats(0.0, 1.0), st.lists(st.one_of(st.none(), st.floats(0.0, 1.0)), min_size=60, max_size=60))
def test_no_jump_is_larger_than_the_window_or_the_knob_s_own_step(
    places: list[float], value: float, others: list[float | None]
) -> None:
    """However the knob goes, and whoever else moves the value in between."""
    grip, before = Grip(), None
    for place, other in zip(places, others, strict=False):
        if other is not None:
            value, grip.holds = other, False
        if grip.meets(place, value):
            step = abs(place - before) if before is not None else 0.0
            assert abs(place - value) <= max(WINDOW, step) + 1e-6
            value = place
        before = place


@given(st.integers(0, 127), st.integers(1, 40), st.booleans())
def test_a_sweep_over_the_whole_way_catches_up(start: int, step: int, down: bool) -> None:
    grip, value, caught = Grip(), start / 127, False
    sweep = [*range(0, 127, step), 127]
    for place in reversed(sweep) if down else sweep:
        held = grip.meets(place / 127, value)
        assert held or not caught  # once it has hold, it keeps it
        caught = held
        value = place / 127 if held else value
    assert caught
    assert value == (0.0 if down else 1.0)


def test_a_knob_that_stays_on_one_side_never_takes_over() -> None:
    grip = Grip()
    assert not any(grip.meets(place / 127, 0.9) for place in (0, 30, 90, 20, 110))
    assert grip.meets(113 / 127, 0.9)


@pytest.mark.parametrize(
    ("sent", "wanted"),
    [
        ([cc(74, 5, channel=4)], ("cc", 74, 4)),
        ([cc(11, 5), cc(43, 9)], ("cc14", 11, 1)),
        ([Message("aftertouch", channel=6, value=3)], ("pressure", 0, 7)),
        ([Message("pitchwheel", channel=6, pitch=3)], ("bend", 0, 7)),
        ([cc(11, 5), cc(12, 9), cc(44, 9)], ("cc14", 12, 1)),
        ([Message("note_on", note=3), cc(80, 1)], ("cc", 80, 1)),
    ],
)
def test_the_next_knob_is_learned(sent: list[Message], wanted: tuple[str, int, int]) -> None:
    learner = Learner(parameter="nose_share", body="body2")
    found = []
    for message in sent:
        touch = touch_of(message)
        assert touch
        found.append(learner.offer(touch, 1.0))
    (control,) = [one for one in found if one]
    assert (control.source, control.number, control.channel) == wanted
    assert (control.parameter, control.body) == ("nose_share", "body2")


def test_a_knob_without_a_second_half_is_learned_with_7_bits() -> None:
    learner = Learner(parameter="nose_share")
    touch = touch_of(cc(11, 5))
    assert touch and learner.offer(touch, 1.0) is None
    assert learner.expire(1.0 + PATIENCE / 2) is None
    found = learner.expire(1.0 + PATIENCE)
    assert found and (found.source, found.number) == ("cc", 11)


def test_the_next_key_or_pedal_is_learned_for_a_command() -> None:
    for message, wanted in ((Message("note_on", channel=9, note=40), ("note", 40, 10)), (cc(64, 127), ("cc", 64, 1))):
        learner = Learner(command="sigh")
        ignored = touch_of(cc(64, 3))
        touch = touch_of(message)
        assert ignored and touch and learner.offer(ignored, 0.0) is None
        found = learner.offer(touch, 0.0)
        assert found and (found.source, found.number, found.channel, found.command) == (*wanted, "sigh")
