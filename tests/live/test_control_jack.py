"""Real MIDI, through JACK: virtual ports, 14 bits, feedback, and a controller that is pulled out and put back."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from mido import Backend, Message

from scorebreath.errors import EnvironmentFailure
from scorebreath.live.controls.mapping import FIRST_NOTE, default_mapping
from scorebreath.live.controls.midi import MidiServer
from scorebreath.live.controls.rtmidi_driver import APIS, port_names
from scorebreath.live.desk import COMMANDS
from tests.jackd import Jack, end, jack_server
from tests.live.desks import ToyDesk

rtmidi = pytest.importorskip("rtmidi", reason="python-rtmidi is not installed")
pytestmark = pytest.mark.jack

API = "jack"


@pytest.fixture(scope="module")
def jack() -> Iterator[Jack]:
    with jack_server() as server:
        yield server


def backend() -> Any:
    return Backend("mido.backends.rtmidi", api=APIS[API])


def wait(until: Callable[[], bool], again: Callable[[], None] = lambda: None) -> None:
    """Wait until it is so; `again` is done before every look, since JACK takes a moment to connect."""
    limit = time.monotonic() + 20.0
    again()
    while not until():
        assert time.monotonic() < limit, "it never came true"
        time.sleep(0.02)
        again()


def cc(number: int, value: int) -> Message:
    return Message("control_change", control=number, value=value)


def test_a_controller_is_heard_and_told(jack: Jack) -> None:
    desk, heard = ToyDesk(), list[list[int]]()
    knobs = backend().open_output("knobs", virtual=True, client_name="knobs")
    lights = rtmidi.MidiIn(rtmidi.API_UNIX_JACK, "lights")
    lights.open_virtual_port("lights")

    def listen() -> None:
        while found := lights.get_message():
            heard.append(found[0])

    try:
        names = port_names(API)
        assert "knobs:knobs" in names.inputs and "lights:lights" in names.outputs
        with MidiServer(desk, port="knobs", output="lights", api=API) as server:
            assert server.ports == ("knobs:knobs", "lights:lights")

            def turn(value: int) -> None:
                knobs.send(cc(21, value))
                knobs.send(cc(53, 5))

            wait(lambda: server.control.report().waiting > 0, lambda: turn(0))
            wait(lambda: desk.value("nose_share") == pytest.approx((80 << 7 | 5) / 16383, abs=1e-6), lambda: turn(80))
            knobs.send(Message("note_on", note=FIRST_NOTE + 1))
            wait(lambda: ("command", "go", "") in desk.calls)
            wait(lambda: len(heard) >= len(default_mapping().controls) - len(COMMANDS), listen)  # all of them, at first
            heard.clear()
            desk.set("nose_share", 1.0)
            wait(lambda: heard == [cc(21, 127).bytes(), cc(53, 127).bytes()], listen)
    finally:
        knobs.close()
        lights.delete()


def test_it_is_unplugged_and_plugged_in_again(jack: Jack) -> None:
    desk, said = ToyDesk(), list[str]()
    knobs = backend().open_output("plug", virtual=True, client_name="plug")
    with MidiServer(desk, port="plug", api=API, said=said.append) as server:
        note = Message("note_on", note=FIRST_NOTE + 7)
        wait(lambda: ("command", "sigh", "") in desk.calls, lambda: knobs.send(note))
        knobs.close()
        wait(lambda: server.ports == () and "gone" in said[-1])
        desk.calls.clear()
        desk.set("nose_share", 0.5)  # nothing else is disturbed
        assert desk.value("nose_share") == 0.5
        knobs = backend().open_output("plug", virtual=True, client_name="plug")
        wait(lambda: server.ports == ("plug:plug",) and "is open" in said[-1])
        wait(lambda: ("command", "sigh", "") in desk.calls, lambda: knobs.send(note))
    knobs.close()


@pytest.mark.parametrize("api", [API, ""])
def test_others_connect_to_our_own_port(jack: Jack, api: str) -> None:
    """Where JACK is the only system there is, it need not be named."""
    if not api and Path("/dev/snd/seq").exists():
        pytest.skip("there is ALSA, which comes first")
    desk = ToyDesk()
    with MidiServer(desk, api=api):
        out = backend().open_output("scorebreath:scorebreath")
        note = Message("note_on", note=FIRST_NOTE)
        wait(lambda: ("command", "pause", "") in desk.calls, lambda: out.send(note))
        out.close()
    assert "scorebreath:scorebreath" not in port_names(API).outputs


def test_the_server_of_midi_dies() -> None:
    """The controller is silent then; everything else goes on, ends, and says why it cannot begin again."""
    desk = ToyDesk()
    with jack_server() as jack:
        knobs = backend().open_output("plug", virtual=True, client_name="plug")
        with MidiServer(desk, port="plug", api=API) as server:
            sigh = Message("note_on", note=FIRST_NOTE + 7)
            wait(lambda: ("command", "sigh", "") in desk.calls, lambda: knobs.send(sigh))
            end(jack.process)
            looks = server.control.report().received
            desk.set("nose_share", 0.5)
            time.sleep(0.6)  # it looks for its port twice
            assert server.control.report().received == looks
        knobs.close()
        with pytest.raises(EnvironmentFailure, match="MIDI"):
            port_names(API)
        with pytest.raises(EnvironmentFailure, match="MIDI"):
            MidiServer(desk, api=API).start()
    assert desk.heard_by == 0
