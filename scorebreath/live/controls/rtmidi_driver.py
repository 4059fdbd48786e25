"""MIDI ports of this machine, by mido and python-rtmidi."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from scorebreath.errors import EnvironmentFailure, InputError, MissingExtraError, shortened
from scorebreath.live.controls.midi_ports import VIRTUAL, Direction, Input, Output

APIS: Mapping[str, str] = MappingProxyType(
    {"alsa": "LINUX_ALSA", "jack": "UNIX_JACK", "core": "MACOSX_CORE", "windows": "WINDOWS_MM"}
)
"""Systems of MIDI, and what rtmidi calls them."""
DUMMY = "RTMIDI_DUMMY"
SEQUENCER = Path("/dev/snd/seq")
"""What ALSA needs."""
AFRESH = 5.0
"""s between two tries, where there is no MIDI"""
_AT_A_TIME = 4096


@dataclass(frozen=True, slots=True, kw_only=True)
class PortNames:
    """The ports of this machine."""

    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


class RtMidi:
    """The driver by mido and python-rtmidi.

    It keeps a client of its own to ask for names: mido makes two for every question, which stops Python for 30 ms.
    Of a JACK server that died, clients go on telling the old names, and libjack crashes if a new one is tried beside
    them: until it is closed, such a controller is only silent.
    """

    def __init__(self, api: str = "", steady: Callable[[], float] = time.monotonic) -> None:
        """Load it.

        Args:
            api: One of `APIS`; empty: the first that works.
            steady: s on a clock that never jumps.

        Raises:
            MissingExtraError: python-rtmidi is not installed.
            InputError: Nobody knows such an API.
            EnvironmentFailure: It is not on this machine.
        """
        import mido

        if api:
            check_api(api)
        try:
            module = mido.Backend("mido.backends.rtmidi").module
        except ImportError:
            raise MissingExtraError("MIDI", "live") from None
        self._rtmidi, known = module.rtmidi, module.get_api_names()
        if api and APIS[api] not in known:
            there = ", ".join(name for name, called in APIS.items() if called in known) or "none"
            raise EnvironmentFailure(f"MIDI: this python-rtmidi has no {api} (it has {there})")
        name = APIS[api] if api else self._working(known)
        self._backend = mido.Backend("mido.backends.rtmidi", api=name)
        self._api = self._called(name)
        self._clients: dict[Direction, Any] = {}
        self._steady, self._asked, self._gone = steady, 0.0, ""

    def _called(self, name: str | None) -> int:
        return int(getattr(self._rtmidi, f"API_{name or 'UNSPECIFIED'}"))

    def _working(self, known: Iterable[str]) -> str | None:
        """The first API that can be used now; None: none of them, and rtmidi is to say why."""
        for name in known:
            if name == DUMMY or (name == APIS["alsa"] and not SEQUENCER.exists()):  # its library would complain aloud
                continue
            try:
                self._rtmidi.MidiIn(self._called(name)).delete()
            except OSError:
                continue
            return name
        return None

    def names(self, direction: Direction) -> tuple[str, ...]:
        """Ports there are now."""
        now = self._steady()
        if self._gone and now - self._asked < AFRESH:
            raise OSError(self._gone)
        self._asked = now
        try:
            if direction not in self._clients:
                kind = self._rtmidi.MidiIn if direction == "input" else self._rtmidi.MidiOut
                self._clients[direction] = kind(self._api)
            names = tuple(self._clients[direction].get_ports())
        except OSError as error:
            self._gone = str(error)
            raise
        self._gone = ""
        return names

    def forget(self) -> None:
        """Let go of the clients that ask for names."""
        for client in self._clients.values():
            client.delete()
        self._clients.clear()

    def open_input(self, name: str) -> Input:
        """Open an input."""
        client = self._rtmidi.MidiIn(self._api)
        try:
            client.open_port(client.get_ports().index(name))
        except (OSError, ValueError):  # it went between the look and now
            client.delete()
            raise OSError(f"{name!r} cannot be opened") from None
        return _PolledInput(client, name)

    def open_output(self, name: str) -> Output:
        """Open an output."""
        port: Output = self._backend.open_output(name)
        return port

    def open_virtual(self) -> Input:
        """Open our own input."""
        client = self._rtmidi.MidiIn(self._api, VIRTUAL)
        client.open_virtual_port(VIRTUAL)
        return _PolledInput(client, VIRTUAL)


class _PolledInput:
    """An input that is asked, and never calls.

    mido's inputs are called from the thread of MIDI, which for JACK is that of the sound: it would wait for Python's
    lock, and the sound with it; and closing one, which holds the lock and waits for that thread, could last for ever.
    """

    def __init__(self, client: Any, name: str) -> None:
        self._client, self.name = client, name

    def receive(self) -> list[Any]:
        from mido import Message

        messages: list[Any] = []
        while len(messages) < _AT_A_TIME and (found := self._client.get_message()):
            try:
                messages.append(Message.from_bytes(found[0]))
            except ValueError:  # no MIDI
                continue
        return messages

    def close(self) -> None:
        self._client.close_port()
        self._client.delete()


def check_api(api: str) -> None:
    """See that there is such a system of MIDI, on some machine.

    Raises:
        InputError: There is not.
    """
    if api not in APIS:
        raise InputError(f"no system of MIDI is called {shortened(api, 40)!r}; expected {', '.join(APIS)}")


def port_names(api: str = "") -> PortNames:
    """The MIDI ports that there are.

    Raises:
        MissingExtraError: python-rtmidi is not installed.
        EnvironmentFailure: This machine has no MIDI, or no such API.
    """
    driver = RtMidi(api)
    try:
        return PortNames(inputs=driver.names("input"), outputs=driver.names("output"))
    except OSError as error:
        raise EnvironmentFailure(f"MIDI: {error}") from None
    finally:
        driver.forget()
