"""A desk without a performance: it keeps what it is told, checks as a real one does, and tells who listens."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any

from scorebreath.errors import InputError
from scorebreath.live.desk import COMMANDS, Change, Setting
from scorebreath.parameters.derive import derive
from scorebreath.parameters.table import Parameters


class ToyDesk:
    """Every call is in `calls`; parameters are moved at once, and safely from any thread."""

    def __init__(self, *bodies: str) -> None:
        self.bodies = bodies or ("body",)
        self.calls: list[tuple[Any, ...]] = []
        self._parameters = {body: Parameters() for body in self.bodies}
        self._listeners: list[Change] = []
        self._lock = threading.RLock()

    def say(self, text: str, *, body: str = "", cut_in: bool = False) -> None:
        self._check(body)
        if "[broken" in text:
            raise InputError("1:1: a tag without end")
        self.calls.append(("cut" if cut_in else "say", text, body))

    def stream(self, piece: str, *, body: str = "") -> None:
        self._check(body)
        self.calls.append(("stream", piece, body))

    def end_stream(self, *, body: str = "") -> None:
        self._check(body)
        self.calls.append(("end_stream", body))

    def command(self, name: str, *, body: str = "") -> None:
        self._check(body)
        if name not in COMMANDS:
            raise InputError(f"no command is called {name!r}")
        self.calls.append(("command", name, body))
        if name == "reset":
            for parameter in Parameters.model_fields:
                self.set(parameter, None, body=body)

    def set(self, name: str, value: Setting | None, *, body: str = "", glide: float | None = None) -> None:
        self._check(body)
        with self._lock:
            self.calls.append(("set", name, value, body, glide))
            for one in (body,) if body else self.bodies:
                self._parameters[one] = self._parameters[one].with_values({name: value})
                now = self.values(one).get(name)
                if now is not None:
                    for changed in self._listeners:
                        changed(one, name, now)

    def values(self, body: str = "") -> Mapping[str, Setting]:
        self._check(body)
        with self._lock:
            parameters = self._parameters[body or self.bodies[0]]
        found = {name: getattr(parameters, name) for name in Parameters.model_fields} | asdict(derive(parameters))
        return {name: value for name, value in found.items() if value is not None}

    def listen(self, changed: Change) -> Callable[[], None]:
        self._listeners.append(changed)
        return lambda: self._listeners.remove(changed)

    @property
    def heard_by(self) -> int:
        """How many listen."""
        return len(self._listeners)

    def value(self, name: str, body: str = "") -> Setting:
        return self.values(body)[name]

    def told(self) -> int:
        """How many parameters have one value."""
        return len(self.values())

    def moves(self) -> list[tuple[str, Setting | None]]:
        """Name and value of every move."""
        return [(call[1], call[2]) for call in self.calls if call[0] == "set"]

    def _check(self, body: str) -> None:
        if body and body not in self.bodies:
            raise InputError(f"no body is called {body!r}")


class BrokenDesk(ToyDesk):
    """A desk with a bug in it."""

    def set(self, name: str, value: Setting | None, *, body: str = "", glide: float | None = None) -> None:
        raise ZeroDivisionError("a bug")


class Clock:
    """A clock that tests turn."""

    def __init__(self, now: float = 100.0) -> None:
        self.now = now

    def __call__(self) -> float:
        return self.now
