"""MIDI ports by mido: what there is, and one that is opened again whenever it comes back."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol

from scorebreath.errors import EnvironmentFailure, InputError, MissingExtraError

Direction = Literal["input", "output"]
VIRTUAL = "scorebreath"
"""Our own port, that other programs connect to."""
_ADDRESS = re.compile(r" \d+:\d+$")
"""of ALSA: another one each time that a device is plugged in"""


class Port(Protocol):
    """An open port of mido's."""

    name: str

    def close(self) -> None:
        """Let go of it."""

    def send(self, message: Any) -> None:
        """Send, where it is an output."""


class Driver(Protocol):
    """Where ports come from."""

    def names(self, direction: Direction) -> tuple[str, ...]:
        """Ports there are now; OSError: the system of MIDI is gone."""

    def open(self, direction: Direction, name: str, hears: Callable[[Any], None] | None) -> Port:
        """Open one; OSError: it cannot be opened."""

    def open_virtual(self, hears: Callable[[Any], None]) -> Port:
        """Open our own input; OSError: it cannot be opened."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PortNames:
    """The ports of this machine."""

    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


class RtMidi:
    """The driver by python-rtmidi.

    It keeps a client of its own to ask for names: mido makes two for every question, which stops Python for 30 ms.
    """

    def __init__(self, api: str = "") -> None:
        """Load it.

        Args:
            api: `UNIX_JACK`, `LINUX_ALSA`, `MACOSX_CORE`, `WINDOWS_MM`; empty: the first that works.

        Raises:
            MissingExtraError: python-rtmidi is not installed.
            EnvironmentFailure: There is no such API.
        """
        import mido

        self._backend = mido.Backend("mido.backends.rtmidi", api=api or None)
        try:
            self._module = self._backend.module
        except ImportError:
            raise MissingExtraError("MIDI", "live") from None
        known = self._module.get_api_names()
        if api and api not in known:
            raise EnvironmentFailure(f"MIDI: no API is called {api!r} (there are {', '.join(known)})")
        self._api = api
        self._clients: dict[Direction, Any] = {}

    def names(self, direction: Direction) -> tuple[str, ...]:
        """Ports there are now."""
        if direction not in self._clients:
            rtmidi = self._module.rtmidi
            kind = rtmidi.MidiIn if direction == "input" else rtmidi.MidiOut
            self._clients[direction] = kind(getattr(rtmidi, f"API_{self._api or 'UNSPECIFIED'}"))
        return tuple(self._clients[direction].get_ports())

    def forget(self) -> None:
        """Ask with a new client next time: the old one may belong to a server that is gone."""
        for client in self._clients.values():
            client.delete()
        self._clients.clear()

    def open(self, direction: Direction, name: str, hears: Callable[[Any], None] | None) -> Port:
        """Open a port."""
        port: Port = (
            self._backend.open_input(name, callback=hears) if direction == "input" else self._backend.open_output(name)
        )
        return port

    def open_virtual(self, hears: Callable[[Any], None]) -> Port:
        """Open our own input."""
        port: Port = self._backend.open_input(VIRTUAL, virtual=True, client_name=VIRTUAL, callback=hears)
        return port


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

    def __init__(
        self,
        driver: Driver,
        direction: Direction,
        wanted: str,
        said: Callable[[str], None],
        hears: Callable[[Any], None] | None = None,
    ) -> None:
        """Keep a port open; `poll` does it.

        Args:
            driver: Where it comes from.
            direction: Which way.
            wanted: Its name, or a part of it.
            said: Told when it comes and goes.
            hears: Told of every message, where it is an input.
        """
        self._driver, self._direction, self._wanted, self._said, self._hears = driver, direction, wanted, said, hears
        self._port: Port | None = None
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
        if self._port and self._name not in names:
            self.close()
            self._say(f"MIDI {self._direction} {self._name_before!r} is gone; waiting for it")
        if self._port:
            return False
        name = find_port(self._wanted, names)
        if name is None:
            return False
        try:
            self._port = self._driver.open(self._direction, name, self._hears)
        except OSError as error:
            self._say(f"MIDI {self._direction} {name!r} cannot be opened: {error}")
            return False
        self._name = name
        self._say(f"MIDI {self._direction} {name!r} is open")
        return True

    def send(self, message: Any) -> None:
        """Send a message, if it is there; what cannot be sent is lost."""
        if self._port:
            try:
                self._port.send(message)
            except OSError as error:
                self._say(f"MIDI {self._direction} {self._name!r}: {error}")

    def close(self) -> None:
        """Let go of it."""
        port, self._port = self._port, None
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
