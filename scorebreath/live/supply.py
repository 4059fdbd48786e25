"""The supply of a performance: what is ready to be placed, and what is asked of the backstage."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import replace

from scorebreath.live.backstage import Backstage
from scorebreath.live.preparing import Prepared, Preparer
from scorebreath.live.text import Text
from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup

READY = 3
"""Groups that are ready before they are needed: one is next, one shows the face what follows, one is in reserve."""


class Supply:
    """Groups that are ready, in order.

    Args:
        backstage: Where they are prepared.
        now: s.
    """

    def __init__(self, backstage: Backstage, now: float) -> None:
        """Nothing is ready."""
        self.ready: deque[Prepared] = deque()
        self.fed = now
        """s; when text came last"""
        self._backstage = backstage
        self._generation = 0

    @property
    def idle(self) -> bool:
        """Whether there is nothing to say, and nothing announced."""
        return not self.ready and self._backstage.idle

    @property
    def late(self) -> bool:
        """Whether there is something to say, but the voice is not ready with it."""
        return not self.ready and self._backstage.speaking

    def want(self, flush: int) -> None:
        """Have as many ready as are needed; how much of an unfinished text to take for them."""
        self._backstage.want(READY - len(self.ready), flush)

    def collect(self) -> list[Prepared]:
        """Take what has become ready.

        Returns:
            What the voice failed at.
        """
        made = [one for one in self._backstage.collect() if one.generation == self._generation]
        self.ready.extend(one for one in made if not one.problem)
        return [one for one in made if one.problem]

    def hear(self, text: Text, now: float) -> None:
        """There is something to say, behind what there is already."""
        self.fed = now
        self._backstage.tell(lambda preparer: preparer.prompter.texts.append(text))

    def go_on(self, text: Text, piece: str | None, now: float) -> None:
        """A text goes on; None: it is complete."""
        self.fed = now

        def read(_: Preparer) -> None:
            if piece is None:
                text.complete = True
            else:
                text.waiting.append(piece)

        self._backstage.tell(read)

    def said(self, group: BreathGroup) -> None:
        """A group will not be planned again."""
        self._backstage.tell(lambda preparer: preparer.prompter.done(group))

    def repeat(self, prepared: Prepared) -> None:
        """A group comes next, once more."""
        self.ready.appendleft(replace(prepared, generation=self._generation))

    def forget(self, *, blend: Blend, time: float) -> None:
        """Drop all that is still to be said."""
        self.ready.clear()
        self._generation += 1
        generation = self._generation

        def forget(preparer: Preparer) -> None:
            preparer.prompter.forget(blend=blend, time=time)
            preparer.generation = generation

        self._backstage.tell(forget)

    def plan_again(
        self,
        place: int | None,
        said: BreathGroup | None,
        *,
        keep: int,
        prefer: str | None,
        parameters: Parameters,
        cast: Mapping[str, Parameters],
        blend: Blend,
        time: float,
    ) -> None:
        """Have all planned anew that comes behind a place.

        Args:
            place: Of the first word, in the text; None: behind what stays.
            said: The group that was decided last.
            keep: Groups that are ready and stay.
            prefer: Voice whose text comes first; None: in order.
            parameters: To plan with.
            cast: Those of others.
            blend: The states of whoever speaks.
            time: When it begins, s.
        """
        kept = list(self.ready)[:keep]
        last = kept[-1].group if kept else said
        at = place if place is not None else last.source.end if last else 0
        self._generation += 1
        generation = self._generation
        self.ready = deque(replace(one, generation=generation) for one in kept)

        def again(preparer: Preparer) -> None:
            plan = replace(preparer.prompter.plan, parameters=parameters, cast=cast)
            preparer.generation = generation
            if prefer is None:
                preparer.prompter.again(at, plan=plan, blend=blend, time=time)
            else:
                preparer.prompter.prefer(prefer, at, plan=plan, blend=blend, time=time)

        self._backstage.tell(again)
