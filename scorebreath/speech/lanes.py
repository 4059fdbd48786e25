"""Worker processes that take turns, so that an engine that uses one core speaks on several."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from scorebreath.speech.worker import Answer, Worker

Wanted = TypeVar("Wanted")


@dataclass(frozen=True, slots=True, kw_only=True)
class Turns:
    """When which worker works."""

    ahead: int
    """requests each has before it while one answer is waited for"""
    starts: int
    """request of one run at which the others are started"""
    works: int
    """request from which on they are given work: until then they get ready, which short texts need not wait for"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Question:
    """What a worker is asked."""

    fields: Mapping[str, Any]
    deadline: float
    """s that the answer may take"""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Asked(Generic[Wanted]):
    wanted: Wanted
    worker: Worker
    ticket: int


class Lanes:
    """Several workers of one voice, started when first needed."""

    def __init__(self, command: Sequence[str], name: str, count: int, turns: Turns) -> None:
        """Nothing is started yet.

        Args:
            command: Program and arguments of each.
            name: The voice's, for messages.
            count: How many.
            turns: When they work.
        """
        self.workers = [Worker(command, name) for _ in range(count)]
        self._turns = turns

    @property
    def first(self) -> Worker:
        """The one that answers single questions."""
        return self.workers[0]

    @property
    def pids(self) -> tuple[int, ...]:
        """Process ids of those that live."""
        return tuple(worker.pid for worker in self.workers if worker.pid is not None)

    def ask(self, question: Question) -> Answer:
        """One question to the first worker.

        Raises:
            VoiceError: As `Worker.receive`.
        """
        return self.first.receive(self.first.send(question.fields, deadline=question.deadline))

    def in_turn(
        self, wanted: Iterable[Wanted], question: Callable[[Wanted], Question]
    ) -> Iterator[tuple[Wanted, Answer]]:
        """Answers in order, each worker up to `Turns.ahead` requests ahead of what is taken.

        Args:
            wanted: What is asked for, taken only as it is needed.
            question: Of one of them.

        Raises:
            VoiceError: As `Worker.receive`.
        """
        asked: deque[_Asked[Wanted]] = deque()
        count = len(self.workers)
        try:
            for index, one in enumerate(wanted):
                if index == self._turns.starts:
                    for worker in self.workers[1:]:
                        worker.start()
                lanes = count if index >= self._turns.works else 1
                worker, told = self.workers[index % lanes], question(one)
                asked.append(_Asked(wanted=one, worker=worker, ticket=worker.send(told.fields, deadline=told.deadline)))
                if len(asked) > self._turns.ahead * lanes:
                    yield _answered(asked.popleft())
            while asked:
                yield _answered(asked.popleft())
        finally:
            for left in asked:
                left.worker.forget(left.ticket)

    def close(self) -> None:
        """End them all."""
        for worker in self.workers:
            worker.close()


def _answered(asked: _Asked[Wanted]) -> tuple[Wanted, Answer]:
    return asked.wanted, asked.worker.receive(asked.ticket)
