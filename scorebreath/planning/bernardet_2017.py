"""Breath groups after the flow chart of Bernardet et al. 2017 (S2, Fig. 3).

    loop over syllables in the text
        until nr syllables >= target_syllables
           or nr syllables > nr remaining words                                                           (B17, X9)
    split into pre and post at the word count                                                             (B18)
    search for the next "." and "_"                                                                       (B19, X8)
    "." or "_" beyond the urgency limit?  yes: break at word                                              (B20, X6)
        no: pos_particle < pos_sentence: break at underscore; pos_sentence < pos_particle: at sentence    (B21, X7)
    chunk <- pre; text <- post; send the chunk to TTS                                                     (B22)

Where it differs from the 2019 bullets, and how it is read here:

- X6, "or" is meant: one marker beyond the limit is enough to break at the word. A marker that does not occur is not
  beyond anything, or a text without "_" could never be broken at its full stops. A search must end: a marker farther
  than twice the limit does not occur. So a group needs no more than that of the text after it.
- X7: the nearer marker wins, and "." in a tie.
- X8: only what comes next is searched.
- X9, taken literally: words that are left after the one just counted. Both sides of the comparison only meet
  near the end of the text (with fewer words left than `target_syllables`), where it moves the split point forward.
"""

from __future__ import annotations

from collections.abc import Sequence

from scorebreath.parameters.derive import derive
from scorebreath.parameters.table import Parameters
from scorebreath.planning.chunker import Chunker, Cut, cut_at
from scorebreath.planning.markers import LONGEST_WORD, Marker, ahead, known
from scorebreath.planning.model import SyllableCounter
from scorebreath.planning.obedient import obey
from scorebreath.planning.units import Unit

NAME = "bernardet-2017"
SEARCH = 2.0
"""How far the search for a marker goes, in urgency limits."""


class Bernardet2017(Chunker):
    """The flow chart.

    Args:
        parameters: `length_utterance` is target_syllables; `urgency_limit` in characters; `period_marker`.
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
        """One round of the chart."""
        stepped = self._loop_over_syllables(text, over)
        if stepped is None:
            return None
        split, why = stepped
        found = self._search_for_next(text, split, over)
        if found is None:
            return None
        at_word, at_markers = [(split, 0)], [(marker.count, marker.distance) for marker in found]
        beyond = [marker for marker in found if marker.distance > self._limit]
        if beyond:
            return cut_at(text, at_word + at_markers, f"{why}X6: {beyond[0]}, beyond {self._limit:g}: break at word")
        if not found:
            return cut_at(text, at_word, f"{why}no '.' or '_' in {SEARCH * self._limit:g} characters: break at word")
        order = ", before ".join(str(marker) for marker in found)
        return cut_at(text, at_markers + at_word, f"{why}X7: {order}, within {self._limit:g}")

    def _loop_over_syllables(self, text: Sequence[Unit], over: bool) -> tuple[int, str] | None:
        """Words before the split point, and why it lies there; None where more text could move it."""
        syllables = 0
        for words, unit in enumerate(text, 1):
            syllables += unit.syllables
            if syllables >= self._target:
                return words, f"{NAME} "
            remaining = len(text) - words
            if syllables > remaining:
                if not over:
                    return None
                return words, f"{NAME} X9: {syllables} syllables, {remaining} words left; "
        raise AssertionError("a unit has at least one syllable, and after the last one no words remain")

    def _search_for_next(self, text: Sequence[Unit], split: int, over: bool) -> list[Marker] | None:
        """The next "." and the next "_", nearest first, as many as the decision needs; None if it needs more text."""
        found: list[Marker] = []
        reach = SEARCH * self._limit
        for marker in ahead(text, split, self._period, reach):
            if not any(marker.kind == other.kind for other in found):
                found.append(marker)
                if len(found) == 2 or marker.distance > self._limit:
                    return found
        return found if over or known(text, split) > reach else None
