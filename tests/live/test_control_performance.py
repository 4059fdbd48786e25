"""OSC and MIDI in front of a real performance, on a clock that the test turns: what is sent becomes events."""

from __future__ import annotations

import pytest
from mido import Message

from scorebreath.live.console import Console
from scorebreath.live.controls.knobs import PATIENCE
from scorebreath.live.controls.mapping import FIRST_NOTE
from scorebreath.live.controls.midi_control import MidiControl
from scorebreath.live.controls.osc_server import OscServer
from scorebreath.live.controls.packets import Argument, read_packet, write_message
from scorebreath.live.controls.packets import Message as Packet
from scorebreath.live.desk import COMMANDS
from scorebreath.score.events import Command, Parameter, Utterance
from tests.live.desks import Clock
from tests.live.stages import Stage

HERE = ("127.0.0.1", 40000)


def test_knobs_and_packets_become_events() -> None:
    stage, clock = Stage(), Clock()
    desk = Console(stage.performance)
    server, midi = OscServer(desk), MidiControl(desk, steady=clock)

    def send(address: str, *arguments: Argument) -> list[Packet]:
        answers = server.receive(write_message(address, *arguments), HERE)
        return [message for answer in answers for packet in answer.packets for message in read_packet(packet)]

    def turn(value: int) -> None:
        midi.feed(Message("control_change", control=21, value=value))
        clock.now += PATIENCE
        midi.drain()
        stage.go(stage.now + 0.1)

    assert send("/scorebreath/say", "One, two, three. And four.") == []
    assert send("/scorebreath/nose_share", 0.5) == []
    stage.go(0.5)
    assert send("/scorebreath/nose_share")[0].arguments == (0.5,)
    for value in (127, 90, 60, 50):  # it meets the value between 90 and 60, and keeps its hold while moves wait
        turn(value)
    assert send("/scorebreath/nose_share")[0].arguments[0] == pytest.approx(50 / 127, abs=1e-6)
    assert send("/scorebreath/nose_share", 1.5)[0].address == "/scorebreath/error"
    midi.feed(Message("note_on", note=FIRST_NOTE + list(COMMANDS).index("end")))
    midi.drain()
    stage.go(120.0)
    assert stage.over
    events = stage.score().events
    moved = [event.value for event in events if isinstance(event, Parameter) and event.name == "nose_share"]
    assert moved == [0.5, round(60 / 127, 6), round(50 / 127, 6)]
    assert {event.name for event in events if isinstance(event, Command)} >= {"end"}
    words = [word.text for event in events if isinstance(event, Utterance) for word in event.words]
    assert words == ["One", "two", "three", "And", "four"]
    assert (server.report().failed, midi.report().failed) == (0, 0)
