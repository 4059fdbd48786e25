"""A Score's breathing beside what is published about people's."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from scorebreath.curves.curve_set import curves
from scorebreath.curves.performed import performed
from scorebreath.report.norms.figures import Array, Circumstances, Word, circumstances
from scorebreath.report.norms.listening import Heard, Samples, listen
from scorebreath.report.norms.material import Material
from scorebreath.report.norms.row import Result, result
from scorebreath.report.norms.table import ROWS
from scorebreath.score.document import Person, Score
from scorebreath.score.events import State


@dataclass(frozen=True, slots=True, kw_only=True)
class Norms:
    """Every row of the table for one body of a Score."""

    body: str
    """whose breathing"""
    person: Person
    who: Circumstances
    """which figures apply"""
    states: tuple[str, ...]
    """names of the breathing states in the Score: what they change shows as outside"""
    duration: float
    """s, of the Score"""
    groups: int
    """breath groups: what is said on one inspiration each"""
    heard: Heard | None
    """what was measured in the sound, if there was any"""
    results: tuple[Result, ...]
    """one for each row, in the table's order"""

    @property
    def values(self) -> Mapping[str, Array]:
        """The measured numbers of each row, by its name: (n,), or (n, 2) of a relation."""
        return MappingProxyType({each.row.name: each.values for each in self.results})

    def __getitem__(self, name: str) -> Result:
        """The result of the row of that name.

        Raises:
            KeyError: There is no such row.
        """
        for each in self.results:
            if each.row.name == name:
                return each
        raise KeyError(name)

    @property
    def counts(self) -> Mapping[Word, int]:
        """How many rows have each verdict."""
        counted = Counter(each.verdict.word for each in self.results)
        words: tuple[Word, ...] = ("within", "outside", "no figure to compare", "too few")
        return MappingProxyType({word: counted[word] for word in words})


def norms(
    score: Score,
    sound: Heard | Path | Samples | None = None,
    rate: float | None = None,
    body: str | None = None,
) -> Norms:
    """Measure a Score's breathing, and compare it with published human ranges.

    Style, age, posture, loudness (from the body's parameters), the model and the route of the breaths choose which
    figures apply. A Score with few breaths, or none, gives `too few`.

    Args:
        score: Any Score.
        sound: Where breaths are listened to: a sound file, samples (n,) or (n, channels) whose time 0 is the Score's,
            or what `listen` measured; None: the rows about sound are left at `too few`.
        rate: Of samples, Hz.
        body: Whose breathing; may be left out where the Score has one body.

    Returns:
        All rows; `Norms.values` has the arrays they were worked out from. Takes time linear in the Score.

    Raises:
        InputError: There is no such body, or it must be named; samples without a rate; a file that is no sound.
        ScoreError: Breaths or utterances of the body overlap.
    """
    curve_set = curves(score, body)
    chosen = next(each for each in score.bodies if each.id == curve_set.body)
    done = performed(score)
    heard = sound if sound is None or isinstance(sound, Heard) else listen(done, sound, rate, chosen.id)
    material = Material(done, chosen, curve_set, circumstances(done, chosen), heard)
    return Norms(
        body=chosen.id,
        person=chosen.person,
        who=material.who,
        states=tuple(sorted({event.name for event in done.of(State, chosen.id)})),
        duration=score.duration,
        groups=len(material.first),
        heard=heard,
        results=tuple(result(row, material) for row in ROWS),
    )
