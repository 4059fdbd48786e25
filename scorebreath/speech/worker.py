"""Requests to a worker process that may die or hang: a deadline for each, one restart, then a clear error."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from threading import RLock
from typing import Any

from scorebreath.errors import VoiceError
from scorebreath.speech.process import Process, start
from scorebreath.speech.wire import pack

TRIES = 2
"""A request that a fresh worker fails at as well is given up."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """What a worker said."""

    fields: dict[str, Any]
    payload: bytes


@dataclass(slots=True, kw_only=True)
class _Asked:
    """A request without an answer yet. It counts its failures, so unlike most values here it changes."""

    message: bytes
    deadline: float
    failures: int = 0
    wanted: bool = True


class Worker:
    """A queue of requests to one process, started when first needed.

    The process answers in order; answers may be collected in any order. Safe to use from several threads.
    """

    def __init__(self, command: Sequence[str], name: str) -> None:
        """Nothing is started yet.

        Args:
            command: Program and arguments of the process.
            name: The voice, for messages.
        """
        self._command, self._name = tuple(command), name
        self._lock = RLock()
        self._process: Process | None = None
        self._asked: dict[int, _Asked] = {}
        self._answered: dict[int, Answer | VoiceError] = {}
        self._tickets = 0
        self._closed = False

    @property
    def pid(self) -> int | None:
        """Id of the live process, or None."""
        return self._process.pid if self._process else None

    def start(self) -> None:
        """Start the process now, so that it gets ready while we do something else."""
        with self._lock:
            self._live()

    def send(self, fields: Mapping[str, Any], payload: bytes = b"", *, deadline: float) -> int:
        """Ask without waiting for the answer.

        Args:
            fields: What JSON can hold.
            payload: Bytes that go with it.
            deadline: s the answer may take once it is waited for.

        Returns:
            A ticket for `receive`.

        Raises:
            VoiceError: The process cannot be started, or `close` was called.
        """
        with self._lock:
            process = self._live()
            self._tickets += 1
            asked = _Asked(message=pack({**fields, "ticket": self._tickets}, payload), deadline=deadline)
            self._asked[self._tickets] = asked
            with self._unbroken():
                process.write(asked.message, deadline)
            return self._tickets

    def receive(self, ticket: int) -> Answer:
        """Wait for an answer.

        Raises:
            VoiceError: The process crashed or missed the deadline, twice, or says that it cannot.
        """
        with self._lock:
            while ticket not in self._answered:
                if ticket not in self._asked:
                    raise VoiceError(f"voice {self._name} was closed")
                self._collect()
            answer = self._answered.pop(ticket)
        if isinstance(answer, VoiceError):
            raise answer
        if "error" in answer.fields:
            raise VoiceError(f"voice {self._name}: {answer.fields['error']}")
        return answer

    def forget(self, ticket: int) -> None:
        """Nobody wants this answer any more."""
        with self._lock:
            self._answered.pop(ticket, None)
            if ticket in self._asked:
                self._asked[ticket].wanted = False

    def close(self) -> None:
        """End the process; what was asked stays unanswered."""
        with self._lock:
            self._closed = True
            self._asked.clear()
            self._stop()

    def _live(self) -> Process:
        """The process; a new one is told all that is still open."""
        if self._closed:
            raise VoiceError(f"voice {self._name} was closed")
        if self._process is None:
            self._process = start(self._command)
            for asked in self._asked.values():
                self._process.write(asked.message, asked.deadline)
        return self._process

    def _stop(self) -> None:
        if self._process is not None:
            self._process.end()
            self._process = None

    @contextmanager
    def _unbroken(self) -> Iterator[None]:
        """An interrupt (Ctrl-C) in the middle of a message leaves a stream that makes no sense: start anew."""
        try:
            yield
        except BaseException:
            self._stop()
            raise

    def _collect(self) -> None:
        """Take the next answer, or count a failure against the oldest request: that one was being worked on."""
        process = self._live()
        oldest, asked = next(iter(self._asked.items()))
        with self._unbroken():
            message = process.read(asked.deadline)
        if message is not None:
            fields, payload = message
            ticket = fields.pop("ticket", None)
            answered = self._asked.pop(ticket, None)
            if answered is not None and answered.wanted:
                self._answered[ticket] = Answer(fields=fields, payload=payload)
            return
        reason = process.why()
        self._stop()
        asked.failures += 1
        if asked.failures >= TRIES or not asked.wanted:
            del self._asked[oldest]
            if asked.wanted:
                self._answered[oldest] = VoiceError(f"voice {self._name}, {TRIES} times: {reason}")
