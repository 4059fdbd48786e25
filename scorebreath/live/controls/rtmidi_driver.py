"""MIDI ports of this machine, by mido and python-rtmidi."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from scorebreath.errors import EnvironmentFailure, MissingExtraError
from scorebreath.live.controls.midi_ports import VIRTUAL, Direction, Input, Output

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
            api: `UNIX_JACK`, `LINUX_ALSA`, `MACOSX_CORE`, `WINDOWS_MM`; empty: the first that works.
            steady: s on a clock that never jumps.

        Raises:
            MissingExtraError: python-rtmidi is not installed.
            EnvironmentFailure: There is no such API.
        """
        import mido

        self._backend = mido.Backend("mido.backends.rtmidi", api=api or None)
        try:
            module = self._backend.module
        except ImportError:
            raise MissingExtraError("MIDI", "live") from None
        known = module.get_api_names()
        if api and api not in known:
            raise EnvironmentFailure(f"MIDI: no API is called {api!r} (there are {', '.join(known)})")
        self._rtmidi = module.rtmidi
        self._api = getattr(self._rtmidi, f"API_{api or 'UNSPECIFIED'}")
        self._clients: dict[Direction, Any] = {}
        self._steady, self._asked, self._gone = steady, 0.0, ""

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
