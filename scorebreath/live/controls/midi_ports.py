"""MIDI ports: where they come from, and one that is opened again whenever it comes back."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any, Literal, Protocol

from scorebreath.errors import EnvironmentFailure, InputError

Direction = Literal["input", "output"]
VIRTUAL = "scorebreath"
"""Our own port, that other programs connect to."""
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
