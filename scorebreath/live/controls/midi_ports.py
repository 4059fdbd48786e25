"""MIDI ports by mido: what there is, and one that is opened again whenever it comes back."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol

from scorebreath.errors import EnvironmentFailure, InputError, MissingExtraError

Direction = Literal["input", "output"]
VIRTUAL = "scorebreath"
"""Our own port, that other programs connect to."""
AFRESH = 5.0
"""s between two tries, where there is no MIDI"""
_AT_A_TIME = 4096
_ADDRESS = re.compile(r" \d+:\d+$")
"""of ALSA: another one each time that a device is plugged in"""


class Input(Protocol):
    """An open input."""

    name: str

    def receive(self) -> list[Any]:
        """Messages of mido's that came since the last time, without waiting."""

    def close(self) -> None:
        """Let go of it."""


class Output(Protocol):
    """An open output."""

    name: str

    def send(self, message: Any) -> None:
        """Send one message."""

    def close(self) -> None:
        """Let go of it."""


class Driver(Protocol):
    """Where ports come from. Everything here may raise OSError: the port, or the system of MIDI, is gone."""

    def names(self, direction: Direction) -> tuple[str, ...]:
        """Ports there are now."""

    def open_input(self, name: str) -> Input:
        """Open one."""

    def open_output(self, name: str) -> Output:
        """Open one."""

    def open_virtual(self) -> Input:
        """Open an input of our own, that other programs connect to."""


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


def find_port(wanted: str, names: Sequence[str]) -> str | None:
    """The port somebody means: by its name, then without ALSA's numbers, then by a part of it in any case.

    >>> find_port("nano", ["Through 14:0", "nanoKONTROL:nanoKONTROL MIDI 1 24:0"])
    'nanoKONTROL:nanoKONTROL MIDI 1 24:0'
    """
    others = [name for name in names if name.partition(":")[0] != VIRTUAL]
    tests: tuple[Callable[[str], bool], ...] = (
        lambda name: name == wanted,
        lambda name: _ADDRESS.sub("", name) == _ADDRESS.sub("", wanted),
        lambda name: wanted.lower() in name.lower(),
    )
    return next((name for test in tests for name in others if test(name)), None)


class KeptPort:
    """A port that may be unplugged and plugged in again."""

    def __init__(self, driver: Driver, direction: Direction, wanted: str, said: Callable[[str], None]) -> None:
        """Keep a port open; `poll` does it.

        Args:
            driver: Where it comes from.
            direction: Which way.
            wanted: Its name, or a part of it.
            said: Told when it comes and goes.
        """
        self._driver, self._direction, self._wanted, self._said = driver, direction, wanted, said
        self._input: Input | None = None
        self._output: Output | None = None
        self._name = self._name_before = ""
        self._trouble = ""

    @property
    def name(self) -> str:
        """The port that is open; empty: none is."""
        return self._name

    def open_now(self) -> None:
        """Open it, for the first time.

        Raises:
            InputError: There is none; names those there are.
            EnvironmentFailure: This machine has no MIDI.
        """
        try:
            names = self._driver.names(self._direction)
        except OSError as error:
            raise EnvironmentFailure(f"MIDI: {error}") from None
        if find_port(self._wanted, names) is None:
            there = ", ".join(map(repr, names)) or "none"
            raise InputError(f"no MIDI {self._direction} is called {self._wanted!r} (there are: {there})")
        self.poll()

    def poll(self) -> bool:
        """Look whether it is there; opens or closes it, and says so. Returns whether it has just come."""
        try:
            names: tuple[str, ...] = self._driver.names(self._direction)
        except OSError:
            names = ()
        if self._name and self._name not in names:
            self.close()
            self._say(f"MIDI {self._direction} {self._name_before!r} is gone; waiting for it")
        if self._name:
            return False
        name = find_port(self._wanted, names)
        if name is None:
            return False
        try:
            if self._direction == "input":
                self._input = self._driver.open_input(name)
            else:
                self._output = self._driver.open_output(name)
        except OSError as error:
            self._say(f"MIDI {self._direction} {name!r} cannot be opened: {error}")
            return False
        self._name = name
        self._say(f"MIDI {self._direction} {name!r} is open")
        return True

    def receive(self) -> list[Any]:
        """Messages that came since the last time; none, while it is away."""
        return self._input.receive() if self._input else []

    def send(self, message: Any) -> None:
        """Send a message, if it is there; what cannot be sent is lost."""
        if self._output:
            try:
                self._output.send(message)
            except OSError as error:
                self._say(f"MIDI {self._direction} {self._name!r}: {error}")

    def close(self) -> None:
        """Let go of it."""
        port = self._input or self._output
        self._input = self._output = None
        self._name_before, self._name = self._name, ""
        if port:
            try:
                port.close()
            except OSError as error:
                self._say(f"MIDI {self._direction} {self._name_before!r}: {error}")

    def _say(self, text: str) -> None:
        """Say it, once as long as it is the same."""
        if text != self._trouble:
            self._trouble = text
            self._said(text)
