"""Knobs and keys on a desk: takeover, learning, and what goes back to the controller. Knows no ports."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from scorebreath.errors import InputError, ScorebreathError
from scorebreath.live.controls.feedback import Feedback
from scorebreath.live.controls.knobs import Grip, Learner, Move, Reader, touch_of
from scorebreath.live.controls.mapping import Control, Mapping, default_mapping
from scorebreath.live.desk import Desk, Setting

Said = Callable[[str], None]
"""Told what people should know, in a sentence."""
_MOST_ECHOES = 64
_SAME = 2e-6
"""Two values that are one on the grid of millionths."""


@dataclass(slots=True, kw_only=True)
class MidiReport:
    """What has been met, counted."""

    received: int = 0
    """messages"""
    moved: int = 0
    """values set"""
    waiting: int = 0
    """moves of knobs that had not met their values"""
    pressed: int = 0
    refused: int = 0
    """by the desk"""
    failed: int = 0
    """moves and presses at which the desk failed: our bug"""


class MidiControl:
    """Turns messages into moves of a desk. `feed` may be called by any thread, `drain` by one at a time."""

    def __init__(
        self,
        desk: Desk,
        mapping: Mapping | None = None,
        *,
        said: Said = lambda text: None,
        learned: Callable[[Control], None] = lambda control: None,
        steady: Callable[[], float] = time.monotonic,
    ) -> None:
        """Put knobs on a desk.

        Args:
            desk: What is moved.
            mapping: Which knob does what; the default mapping, if none is given.
            said: Told what people should know.
            learned: Told of every control that was learned.
            steady: s on a clock that never jumps.
        """
        self._desk, self._said, self._learned, self._steady = desk, said, learned, steady
        self._lock = threading.Lock()
        self._mapping = mapping or default_mapping()
        self._reader = Reader(self._mapping)
        self._grips: dict[Control, Grip] = {}
        self._echoes: dict[tuple[str, str], deque[tuple[Setting, Control]]] = {}
        self._feedback = Feedback()
        self._learner: Learner | None = None
        self._news: list[Control] = []
        self._counts = MidiReport()
        self._bodies = desk.bodies  # asked for outside our lock only: the desk may hold its own while it tells us
        self._unlisten = desk.listen(self._changed)

    @property
    def mapping(self) -> Mapping:
        """The mapping in force, with what was learned."""
        return self._mapping

    def report(self) -> MidiReport:
        """What it has met so far."""
        return MidiReport(**{name: getattr(self._counts, name) for name in MidiReport.__slots__})

    def close(self) -> None:
        """Hear no more of the desk."""
        self._unlisten()

    def learn(self, parameter: str = "", *, command: str = "", body: str = "") -> None:
        """Bind the next knob that is moved to a parameter, or the next key that is pressed to a command.

        Raises:
            InputError: There is no such parameter, command or body.
        """
        Control(source="cc", parameter=parameter, command=command, body=body)  # checks the names
        if body and body not in self._desk.bodies:
            raise InputError(f"no body is called {body!r} (there are {', '.join(self._desk.bodies)})")
        with self._lock:
            self._learner = Learner(parameter=parameter, command=command, body=body)

    def forget_learning(self) -> None:
        """Learn nothing, after all."""
        with self._lock:
            self._learner = None

    def feed(self, message: object) -> None:
        """Take in a message of mido's."""
        touch = touch_of(message)
        with self._lock:
            self._counts.received += 1
            if touch is None:
                return
            now = self._steady()
            if self._learner:
                self._bind(self._learner.offer(touch, now))
            else:
                self._reader.feed(touch, now)

    def drain(self) -> list[object]:
        """Do what was moved and pressed since the last time; returns messages for the controller."""
        bodies = self._desk.bodies
        with self._lock:
            self._bodies = bodies
            now = self._steady()
            if self._learner:
                self._bind(self._learner.expire(now))
            self._reader.expire(now)
            moves, presses = self._reader.take()
            news, self._news = self._news, []
        for control in news:
            self._learned(control)
        for move in moves:
            self._attempt(move.control, lambda move=move: self._move(move))  # type: ignore[misc]
        for control in presses:
            self._attempt(control, lambda control=control: self._press(control))  # type: ignore[misc]
        with self._lock:
            return self._feedback.messages(self._mapping, bodies[0] if bodies else "")

    def refresh(self) -> None:
        """Tell the controller everything at the next drain: it has just come."""
        for body in self._desk.bodies:
            try:
                values = self._desk.values(body)
            except Exception as error:  # a desk that fails must not take the other controls with it
                self._counts.failed += 1
                self._said(f"MIDI: {type(error).__name__}: {error}")
                continue
            with self._lock:
                for name, value in values.items():
                    self._feedback.changed(body, name, value, None)

    def _attempt(self, control: Control, does: Callable[[], None]) -> None:
        try:
            does()
        except ScorebreathError as error:
            self._counts.refused += 1
            self._said(f"MIDI: {control}: {error}")
        except Exception as error:  # a desk that fails must not take the other controls with it
            self._counts.failed += 1
            self._said(f"MIDI: {control}: {type(error).__name__}: {error}")

    def _move(self, move: Move) -> None:
        control = move.control
        scale = control.scale
        value = scale.value(move.way)
        with self._lock:
            grip = self._grips.setdefault(control, Grip(holds=not control.takeover))
            if self._feedback.returned(move):
                grip.before = move.way
                return
            held = grip.holds
        current = None if held else self._desk.values(control.body).get(control.parameter)
        with self._lock:
            if current is not None and scale.same(move.way, current):
                grip.holds = True
            if not grip.meets(move.way, move.way if current is None else scale.way(current)):
                self._counts.waiting += 1
                return
            bodies = (control.body,) if control.body else self._bodies
            for body in bodies:
                echoes = self._echoes.setdefault((body, control.parameter), deque(maxlen=_MOST_ECHOES))
                echoes.append((value, control))
        try:
            self._desk.set(control.parameter, value, body=control.body)
        except Exception:
            with self._lock:
                for body in bodies:
                    self._echoes[body, control.parameter].clear()
            raise
        self._counts.moved += 1

    def _press(self, control: Control) -> None:
        if control.command:
            self._desk.command(control.command, body=control.body)
        else:
            self._desk.say(control.say, body=control.body)
        self._counts.pressed += 1

    def _bind(self, control: Control | None) -> None:
        if control is None:
            return
        self._learner = None
        self._mapping = self._mapping.learned(control)
        self._reader = Reader(self._mapping)
        kept = set(self._mapping.controls)
        self._grips = {one: grip for one, grip in self._grips.items() if one in kept}
        self._news.append(control)

    def _changed(self, body: str, name: str, value: Setting) -> None:
        """Told by the desk, by any thread: was it us? If not, whoever holds the value has lost it."""
        with self._lock:
            mover = self._mover(body, name, value)
            for control, grip in self._grips.items():
                if control.parameter == name and control != mover and concerns(control, body, self._bodies):
                    grip.holds = not control.takeover
            self._feedback.changed(body, name, value, mover)

    def _mover(self, body: str, name: str, value: Setting) -> Control | None:
        echoes = self._echoes.get((body, name))
        if not echoes:
            return None
        for place, (sent, control) in enumerate(echoes):
            if _same(sent, value):
                for _ in range(place + 1):
                    echoes.popleft()
                return control
        echoes.clear()
        return None


def concerns(control: Control, body: str, bodies: tuple[str, ...]) -> bool:
    """Whether a change of a body is one of what a control shows: of its body, or, for all, of the one that began."""
    return not body or body == (control.body or (bodies[0] if bodies else ""))


def _same(one: Setting, other: Setting) -> bool:
    if isinstance(one, str) or isinstance(other, str):
        return one == other
    return abs(one - other) <= _SAME
