"""Breath groups after the bullets of Bernardet et al. 2019 (S1, 3.2; the same list stands in S2, 2.2).

- Step through the text until the number of syllables given by length_utterance is reached (B16).
- Map the position back onto the text (B18).
- Search the text forward and backward for the pause markers period (".") and underscore ("_") (B19, X8).
- If the position of both, in characters, is larger than urgency_limit, define the pause at the word boundary (B20, X6).
- Otherwise define it at a pause marker, with the priorities "." > "_" (B21, X7).
- The chunk is the utterance; what remains is the new text (B22).

Where it differs from the 2017 chart, and how it is read here:

- X6, "both" is meant: the pause is at the word only where no marker lies within the limit. One that does not occur is
  farther than any limit.
- X7: priority, not distance: "." wins over a nearer "_". Only markers within the limit count, or the limit would limit
  nothing. Of two "." (or two "_") the nearer one wins, and ahead before behind when both are equally far.
- X8: both directions. A marker at the very start would leave an empty chunk and does not count.
- X9: there is no guard at the end of the text. If the text is over before length_utterance syllables, it is the chunk.
"""

from __future__ import annotations

from collections.abc import Sequence

from scorebreath.parameters.derive import derive
from scorebreath.parameters.table import Parameters
from scorebreath.planning.chunker import Chunker, Cut, cut_at
from scorebreath.planning.markers import LONGEST_WORD, Marker, ahead, behind, known
from scorebreath.planning.model import SyllableCounter
from scorebreath.planning.obedient import obey
from scorebreath.planning.units import Unit

NAME = "bernardet-2019"
PRIORITIES = (".", "_")


class Bernardet2019(Chunker):
    """The bullets.

    Args:
        parameters: `length_utterance` in syllables; `urgency_limit` in characters; `period_marker`.
        count: Counts syllables; the paper's own way is hyphenation (`syllables.pyphen_counter`).
        poem: Whether lines are lines of verse.
    """

    def __init__(self, parameters: Parameters, count: SyllableCounter, poem: bool = False) -> None:
        """Start with an empty text."""
        super().__init__(count, LONGEST_WORD, poem)
        low = derive(parameters)
        self._target = low.length_utterance
        self._limit = low.urgency_limit
        self._period = parameters.period_marker

    def cut(self, text: Sequence[Unit], over: bool) -> Cut | None:
        """One round, where the markup asks for nothing else."""
        return obey(text, self._round(text, over), over, NAME)

    def _round(self, text: Sequence[Unit], over: bool) -> Cut | None:
        """One round of the bullets."""
        split, syllables = self._step(text)
        if syllables < self._target:
            rule = f"{NAME} X9: the text is over after {syllables} of {self._target:g} syllables"
            return cut_at(text, [(len(text), 0.0)], rule) if over else None
        found = self._search(text, split, over)
        if found is None:
            return None
        at_word, at_markers = [(split, 0)], [(marker.count, abs(marker.distance)) for marker in found]
        if not found:
            return cut_at(text, at_word, f"{NAME} X6: no '.' or '_' within {self._limit:g} characters: break at word")
        order = ", before ".join(str(marker) for marker in found)
        return cut_at(text, at_markers + at_word, f"{NAME} X7: {order}, within {self._limit:g}")

    def _step(self, text: Sequence[Unit]) -> tuple[int, int]:
        """Words before the split point, and their syllables."""
        syllables = 0
        for words, unit in enumerate(text, 1):
            syllables += unit.syllables
            if syllables >= self._target:
                return words, syllables
        return len(text), syllables

    def _search(self, text: Sequence[Unit], split: int, over: bool) -> list[Marker] | None:
        """The nearest marker of each kind in each direction, within the limit, best first.

        Ahead it ends at the first ".", and no farther than the "." behind: nothing beyond has a higher priority.
        None where more text could bring a better one.
        """
        nearest: dict[tuple[str, bool], Marker] = {}
        reach, certain = self._limit, over
        for marker in behind(text, split, self._period, self._limit):
            nearest.setdefault((marker.kind, False), marker)
            if marker.kind == PRIORITIES[0]:
                reach = -marker.distance
                break
        for marker in ahead(text, split, self._period, reach):
            nearest.setdefault((marker.kind, True), marker)
            if marker.kind == PRIORITIES[0]:
                certain = True
                break
        return sorted(nearest.values(), key=_rank) if certain or known(text, split) > reach else None


def _rank(marker: Marker) -> tuple[int, int, bool]:
    """Priority, then distance, then ahead before behind."""
    return PRIORITIES.index(marker.kind), abs(marker.distance), marker.distance < 0
