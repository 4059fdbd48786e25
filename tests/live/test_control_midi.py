"""Knobs on a desk: every command by its key, takeover, learning, feedback without loops, ports that come and go."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mido import Message

from scorebreath.errors import EnvironmentFailure, InputError, MissingExtraError
from scorebreath.live.controls.knobs import PATIENCE, WINDOW
from scorebreath.live.controls.mapping import FIRST_NOTE, Control, Mapping, default_mapping
from scorebreath.live.controls.midi import MidiServer
from scorebreath.live.controls.midi_control import MidiControl
from scorebreath.live.controls.midi_ports import Direction, find_port
from scorebreath.live.controls.rtmidi_driver import RtMidi
from scorebreath.live.desk import COMMANDS, Setting
from scorebreath.parameters.table import Parameters, bounds
from tests.live.desks import BrokenDesk, Clock, ToyDesk

NOSE = Control(source="cc", number=70, parameter="nose_share")
BELLY = Control(source="cc14", number=3, parameter="abdomen_share")


def cc(number: int, value: int, channel: int = 1) -> Message:
    return Message("control_change", channel=channel - 1, control=number, value=value)


def turn(control: MidiControl, number: int, *values: int) -> None:
    """Turn a knob slowly: everything is done in between."""
    for value in values:
        control.feed(cc(number, value))
        control.drain()


def wait(until: Callable[[], bool]) -> None:
    end = time.monotonic() + 20.0
    while not until():
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.002)


@pytest.mark.parametrize("place", range(len(COMMANDS)))
def test_every_command_has_its_key(place: int) -> None:
    desk = ToyDesk()
    control = MidiControl(desk)
    control.feed(Message("note_on", channel=9, note=FIRST_NOTE + place, velocity=90))
    control.feed(Message("note_off", channel=9, note=FIRST_NOTE + place))
    control.drain()
    assert [call for call in desk.calls if call[0] == "command"] == [("command", list(COMMANDS)[place], "")]


@pytest.mark.parametrize("control", [c for c in default_mapping().controls if c.parameter], ids=lambda c: c.parameter)
def test_every_knob_of_the_default_reaches_both_ends(control: Control) -> None:
    desk, clock = ToyDesk(), Clock()
    midi = MidiControl(desk, steady=clock)

    def go(value: int) -> Setting:
        midi.feed(cc(control.number, value))
        if control.source == "cc14":
            midi.feed(cc(control.number + 32, value))
        midi.drain()
        return desk.value(control.parameter)

    go(0)
    ends = (go(127), go(0), go(127))
    lowest, highest = bounds(control.parameter) or (False, True)
    assert ends == (highest, lowest, highest)


def test_a_knob_waits_until_it_meets_the_value() -> None:
    desk = ToyDesk()
    desk.set("nose_share", 0.5)
    midi = MidiControl(desk, Mapping((NOSE,)))
    turn(midi, 70, 10, 30, 50)
    assert desk.moves() == [("nose_share", 0.5)]
    turn(midi, 70, 63, 127)
    assert [value for _, value in desk.moves()[1:]] == [pytest.approx(63 / 127, abs=1e-6), 1.0]
    assert (midi.report().waiting, midi.report().moved) == (3, 2)
    desk.set("nose_share", 0.2)  # somebody else's hand
    turn(midi, 70, 120, 100)
    assert desk.value("nose_share") == 0.2
    turn(midi, 70, 20)
    assert desk.value("nose_share") == pytest.approx(20 / 127, abs=1e-6)


def test_without_takeover_the_value_follows_at_once() -> None:
    desk = ToyDesk()
    midi = MidiControl(desk, Mapping((Control(source="cc", number=70, parameter="nose_share", takeover=False),)))
    turn(midi, 70, 127)
    desk.set("nose_share", 0.2)
    turn(midi, 70, 126)
    assert desk.value("nose_share") == pytest.approx(126 / 127, abs=1e-6)


MOVES = st.lists(st.tuples(st.sampled_from(["knob", "other"]), st.integers(0, 127)), max_size=60)


@given(MOVES, st.sampled_from(["linear", "slow", "fast"]), st.booleans())
def test_a_value_never_jumps_farther_than_the_window_or_the_knob(
    moves: list[tuple[str, int]], curve: str, reverse: bool
) -> None:
    ends = (1.0, 0.0) if reverse else (0.0, 1.0)
    knob = Control(source="cc", number=70, parameter="nose_share", curve=curve, low=ends[0], high=ends[1])
    desk = ToyDesk()
    midi = MidiControl(desk, Mapping((knob,)))
    before = None
    for who, place in moves:
        value = desk.value("nose_share")
        if who == "other":
            desk.set("nose_share", place / 127)
            continue
        turn(midi, 70, place)
        now = desk.value("nose_share")
        if now != value:
            step = 0.0 if before is None else abs(place - before) / 127
            assert abs(knob.scale.way(now) - knob.scale.way(value)) <= max(WINDOW, step) + 2e-3  # the roots of 1e-6
            assert now == knob.scale.value(place / 127)
        before = place


def test_a_parameter_without_one_value_follows_its_knob_at_once() -> None:
    desk = ToyDesk()
    midi = MidiControl(desk, Mapping((Control(source="cc", number=70, parameter="vital_capacity"),)))
    turn(midi, 70, 127)
    assert desk.value("vital_capacity") == 9.0
    turn(midi, 70, 126, 0)
    assert desk.value("vital_capacity") == 0.5


def test_words_and_flags_by_zones() -> None:
    desk = ToyDesk()
    style = Control(source="cc", number=70, parameter="style")
    midi = MidiControl(desk, Mapping((style, Control(source="cc", number=71, parameter="face_gaze"))))
    turn(midi, 70, 0, 63, 64, 127)
    assert desk.value("style") == "spontaneous"
    turn(midi, 71, 127, 64, 63)
    assert desk.value("face_gaze") is False


def test_another_knob_for_the_same_value_loses_it() -> None:
    desk = ToyDesk()
    midi = MidiControl(desk, Mapping((NOSE, Control(source="cc", number=71, parameter="nose_share"))))
    turn(midi, 70, 0, 127)
    turn(midi, 71, 127, 20)
    assert desk.value("nose_share") == pytest.approx(20 / 127, abs=1e-6)
    turn(midi, 70, 120)
    assert desk.value("nose_share") == pytest.approx(20 / 127, abs=1e-6)


def test_bodies_have_their_own_knobs() -> None:
    desk = ToyDesk("ann", "bob")
    midi = MidiControl(
        desk, Mapping((NOSE, Control(source="cc", number=71, parameter="nose_share", body="bob", takeover=False)))
    )
    turn(midi, 71, 127)
    assert (desk.value("nose_share", "ann"), desk.value("nose_share", "bob")) == (0.35, 1.0)
    turn(midi, 70, 0, 64)
    assert desk.value("nose_share", "ann") == desk.value("nose_share", "bob") == pytest.approx(64 / 127, abs=1e-6)
    desk.set("nose_share", 0.9, body="bob")  # the knob of all shows ann: it keeps its hold
    turn(midi, 70, 70)
    assert desk.value("nose_share", "bob") == pytest.approx(70 / 127, abs=1e-6)


def test_a_desk_that_does_things_later_does_not_shake_the_hold() -> None:
    """A performance may take a moves up a moment after it was told."""

    class Later(ToyDesk):
        def set(self, name: str, value: Setting | None, *, body: str = "", glide: float | None = None) -> None:
            kept.append((name, value))

    kept: list[tuple[str, Any]] = []
    desk = Later()
    midi = MidiControl(desk, Mapping((NOSE,)))
    turn(midi, 70, 44, 60, 61)
    for name, value in kept:
        ToyDesk.set(desk, name, value)
    turn(midi, 70, 100)
    assert len(kept) == 4
    ToyDesk.set(desk, "nose_share", 0.1)
    turn(midi, 70, 99)
    assert len(kept) == 4


def test_learning_binds_the_next_knob_and_moves_nothing() -> None:
    desk, clock = ToyDesk("ann", "bob"), Clock()
    told: list[Control] = []
    midi = MidiControl(desk, steady=clock, learned=told.append)
    midi.learn("nose_share", body="bob")
    turn(midi, 20, 99)
    assert desk.calls == [] and told == []
    clock.now += PATIENCE
    midi.drain()
    assert told == [Control(source="cc", number=20, channel=1, parameter="nose_share", body="bob")]
    assert told[0] in midi.mapping.controls
    turn(midi, 20, 0, 127)
    assert (desk.value("nose_share", "bob"), desk.value("abdomen_share")) == (1.0, 0.35)
    midi.learn(command="sigh")
    midi.feed(Message("note_on", note=90))
    midi.feed(Message("note_on", note=90))
    midi.drain()
    assert desk.calls[-1] == ("command", "sigh", "")
    midi.learn("age")
    midi.forget_learning()
    turn(midi, 20, 126)
    assert desk.moves()[-1][0] == "nose_share"
    for wrong in ({"parameter": "nose_shar"}, {"command": "sig"}, {}, {"parameter": "age", "body": "carl"}):
        with pytest.raises(InputError):
            midi.learn(**wrong)


def test_what_the_desk_refuses_is_said() -> None:
    said: list[str] = []
    key = Control(source="note", number=1, say="[broken")
    midi = MidiControl(
        ToyDesk(), Mapping((key, Control(source="note", number=2, command="sigh", body="carl"))), said=said.append
    )
    for note in (1, 2):
        midi.feed(Message("note_on", note=note))
    midi.drain()
    assert ["note 1" in said[0], "carl" in said[1], midi.report().refused] == [True, True, 2]
    broken = MidiControl(BrokenDesk(), Mapping((NOSE,)), said=said.append)
    turn(broken, 70, 0, 127)
    assert (broken.report().failed, "ZeroDivisionError" in said[2]) == (1, True)


def test_a_flood_is_thinned() -> None:
    desk = ToyDesk()
    midi = MidiControl(desk, Mapping((NOSE,)))
    turn(midi, 70, 0, 127)
    done = len(desk.calls)
    for number in range(20_000):
        midi.feed(cc(70, number % 128))
    midi.drain()
    assert len(desk.calls) == done + 1
    assert desk.value("nose_share") == pytest.approx((19_999 % 128) / 127, abs=1e-6)
    assert midi.report().received == 20_002


def test_feedback_tells_what_others_moved() -> None:
    desk = ToyDesk()
    bend = Control(source="bend", channel=4, parameter="prosody_rate")
    midi = MidiControl(desk, Mapping((NOSE, BELLY, bend, Control(source="pressure", parameter="age"))))
    assert midi.drain() == []
    desk.set("nose_share", 0.1)
    desk.set("nose_share", 1.0)
    desk.set("abdomen_share", 1.0)
    desk.set("prosody_rate", 2.0)
    desk.set("age", 50.0)
    assert midi.drain() == [cc(70, 127), cc(3, 127), cc(35, 127), Message("pitchwheel", channel=3, pitch=8191)]
    assert midi.drain() == []
    turn(midi, 70, 127)
    midi.feed(cc(70, 100))
    assert midi.drain() == []  # who moves it needs not to be told
    midi.refresh()
    assert cc(70, 100) in midi.drain()


def test_feedback_goes_where_the_knob_was_heard() -> None:
    desk = ToyDesk()
    midi = MidiControl(desk, Mapping((NOSE,)))
    midi.feed(cc(70, 3, channel=7))
    midi.drain()
    desk.set("nose_share", 0.0)
    assert midi.drain() == [cc(70, 0, channel=7)]


@given(st.lists(st.tuples(st.sampled_from(["nose_share", "abdomen_share"]), st.floats(0.0, 1.0)), max_size=8))
def test_a_loop_of_feedback_moves_nothing(moves: list[tuple[str, float]]) -> None:
    """An output wired to the input, as controllers that repeat what they hear: values stay exactly as set."""
    desk, clock = ToyDesk(), Clock()
    midi = MidiControl(desk, Mapping((NOSE, BELLY)), steady=clock)
    for name, value in moves:
        desk.set(name, value)
        expected, calls = dict(desk.values()), len(desk.calls)
        for _ in range(5):
            back = midi.drain()
            for message in back:
                midi.feed(message)
        assert back == []
        assert (desk.values(), len(desk.calls)) == (expected, calls)


class Wire:
    """Ports that tests plug in and out."""

    def __init__(self, *names: str) -> None:
        self.there = list(names)
        self.open_ports: list[Plug] = []
        self.broken = False

    def names(self, direction: Direction) -> tuple[str, ...]:
        if self.broken:
            raise OSError("the system of MIDI is gone")
        return tuple(self.there)

    def open_input(self, name: str) -> Plug:
        self.open_ports.append(Plug(self, name))
        return self.open_ports[-1]

    def open_output(self, name: str) -> Plug:
        return self.open_input(name)

    def open_virtual(self) -> Plug:
        return self.open_input("scorebreath")

    def play(self, message: Message) -> None:
        for port in self.open_ports:
            port.coming.append(message)


class Plug:
    def __init__(self, wire: Wire, name: str) -> None:
        self.wire, self.name = wire, name
        self.coming: list[Any] = []
        self.sent: list[Any] = []

    def receive(self) -> list[Any]:
        come, self.coming = self.coming, []
        return come

    def close(self) -> None:
        self.wire.open_ports.remove(self)

    def send(self, message: Any) -> None:
        self.sent.append(message)


def threads() -> list[threading.Thread]:
    return [thread for thread in threading.enumerate() if thread.name == "midi"]


def test_a_controller_is_unplugged_and_plugged_in_again() -> None:
    wire, desk, said = Wire("Knobs:Knobs MIDI 1 24:0"), ToyDesk(), list[str]()
    server = MidiServer(desk, port="knobs", output="knobs", mapping=Mapping((NOSE,)), said=said.append, driver=wire)
    with server:
        wire.play(cc(70, 0))
        wait(lambda: server.control.report().waiting == 1)
        wire.play(cc(70, 127))
        wait(lambda: desk.value("nose_share") == 1.0)
        wire.there = []
        wait(lambda: server.ports == ())
        desk.set("nose_share", 0.25)
        wire.there = ["Knobs:Knobs MIDI 1 28:0"]
        wait(lambda: len(server.ports) == 2)
        output = wire.open_ports[-1]
        wait(lambda: cc(70, 32) in output.sent)  # it is told how things stand
        wire.play(cc(70, 33))
        wait(lambda: desk.value("nose_share") != 0.25)
        wire.play(cc(70, 0))
        wait(lambda: desk.value("nose_share") == 0.0)
        wire.broken = True
        wait(lambda: server.ports == ())
        wire.broken = False
        wait(lambda: len(server.ports) == 2)
    assert wire.open_ports == []
    assert desk.heard_by == 0
    assert threads() == []
    assert [("open" in text, "gone" in text) for text in said[::2]] == [(True, False), (False, True)] * 2 + [
        (True, False)
    ]


def test_a_port_that_is_not_there() -> None:
    wire, desk = Wire("Other 20:0"), ToyDesk()
    with pytest.raises(InputError, match=r"'knobs' \(there are: 'Other 20:0'\)"):
        MidiServer(desk, port="knobs", driver=wire).start()
    assert (desk.heard_by, wire.open_ports, threads()) == (0, [], [])
    with MidiServer(desk, port="knobs", wait=True, driver=wire) as server:
        assert server.ports == ()
        wire.there.append("Knobs 21:0")
        wait(lambda: server.ports == ("Knobs 21:0",))
    wire.broken = True
    with pytest.raises(EnvironmentFailure, match="gone"):
        MidiServer(desk, port="knobs", driver=wire).start()


def test_a_port_of_our_own() -> None:
    wire, desk = Wire(), ToyDesk()
    server = MidiServer(desk, driver=wire)
    for _ in range(2):
        server.start()
        server.start()
        assert server.ports == ("scorebreath",)
        wire.play(Message("note_on", note=FIRST_NOTE))
        wait(lambda: desk.calls == [("command", "pause", "")])
        desk.calls.clear()
        server.stop()
        server.stop()
        assert (wire.open_ports, desk.heard_by, threads()) == ([], 0, [])


def test_names_of_ports() -> None:
    names = ["scorebreath:scorebreath 130:0", "A:A MIDI 1 20:0", "AB:AB MIDI 1 21:0"]
    assert find_port("AB:AB MIDI 1 33:0", names) == names[2]
    assert find_port("a:a midi", names) == names[1]
    assert find_port("AB:AB MIDI 1 21:0", names) == names[2]
    assert find_port("scorebreath", names) is None  # never to ourselves


def test_without_rtmidi_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in [name for name in sys.modules if name.startswith("mido.backends.rtmidi")]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "rtmidi", None)
    with pytest.raises(MissingExtraError, match=r"scorebreath\[live\]"):
        RtMidi()


def test_an_api_that_is_none() -> None:
    pytest.importorskip("rtmidi", reason="python-rtmidi is not installed")
    with pytest.raises(InputError, match="'none'; expected alsa, jack"):
        RtMidi("none")
    with pytest.raises(EnvironmentFailure, match="has no windows"):
        RtMidi("windows" if sys.platform != "win32" else "alsa")


def test_values_out_of_a_knob_s_part_stay_until_it_is_met() -> None:
    desk = ToyDesk()
    desk.set("nose_share", 0.05)
    part = Control(source="cc", number=70, parameter="nose_share", low=0.2, high=0.8)
    midi = MidiControl(desk, Mapping((part,)))
    turn(midi, 70, 100, 50)
    assert desk.value("nose_share") == 0.05
    turn(midi, 70, 0)
    assert desk.value("nose_share") == 0.2
    assert Parameters(nose_share=0.2)
