"""What the markup asks for, between groups and inside them; any breathing model's."""

from __future__ import annotations

from dataclasses import replace

from scorebreath.compose import acts
from scorebreath.compose.acts import asked
from scorebreath.compose.placer import Placer
from scorebreath.compose.state import SpokenPart
from scorebreath.score.events import Utterance
from scorebreath.script.marks import Act, BreathingMark, EmotionMark, Mark, NamedMark, StateMark
from scorebreath.units import snap


def before(placer: Placer, marks: tuple[Mark, ...]) -> tuple[Act | None, list[NamedMark]]:
    """Place what stands before a group.

    Returns:
        The last act, if it is a breath: it becomes the group's inspiration. And the names that wait for its speech.
    """
    last = next((mark for mark in reversed(marks) if isinstance(mark, Act) and mark.name != "pause"), None)
    breath = last if last is not None and last.name in ("breath", "gasp") else None
    named: list[NamedMark] = []
    for number, mark in enumerate(bodily(marks)):
        if isinstance(mark, NamedMark):
            named.append(mark)
        elif mark is not breath:
            if isinstance(mark, Act):
                _name(placer, named)
            heed(placer, mark, f"before{number}")
    return breath, named


def bodily(marks: tuple[Mark, ...]) -> tuple[Mark, ...]:
    """Without what is only the face's: numbers in keys of chance must not count that."""
    return tuple(mark for mark in marks if not isinstance(mark, EmotionMark))


def heed(placer: Placer, mark: Mark, key: str) -> None:
    """Do now what one mark asks for."""
    if isinstance(mark, StateMark):
        placer.change(mark, placer.time)
        placer.feel()
    elif isinstance(mark, BreathingMark):
        placer.state = replace(placer.state, breathing=mark)
    elif isinstance(mark, NamedMark):
        placer.marker(mark, placer.time)
    elif isinstance(mark, Act):
        base = placer.chances
        placer.chances = replace(base, place=f"{base.place}/{key}")
        acts.perform(placer, mark.name, asked(mark))
        placer.chances = base


def _name(placer: Placer, named: list[NamedMark]) -> None:
    for mark in named:
        placer.marker(mark, placer.time)
    named.clear()


def names_first(placer: Placer, marks: tuple[Mark, ...]) -> tuple[Mark, ...]:
    """Names right behind the last word stand where it ends; the marks that are left."""
    marks = bodily(marks)
    count = next((n for n, mark in enumerate(marks) if not isinstance(mark, NamedMark)), len(marks))
    for mark in marks[:count]:
        heed(placer, mark, "")
    return marks[count:]


def after(placer: Placer, marks: tuple[Mark, ...]) -> None:
    """What stands behind the last word of all."""
    for number, mark in enumerate(bodily(marks)):
        heed(placer, mark, f"after{number}")


def inside(placer: Placer, speech: Utterance, said: SpokenPart) -> None:
    """Marks between the words of a part: they happen where the next word begins."""
    for word in said.part.words:
        for mark in word.after:
            if word is said.part.words[-1] or not isinstance(mark, (NamedMark, StateMark, BreathingMark)):
                continue
            at = next((w.onset for w in speech.words if w.source and w.source[0] >= mark.at), speech.duration)
            onset = snap(speech.onset + at)
            if isinstance(mark, NamedMark):
                placer.marker(mark, onset)
            elif isinstance(mark, StateMark):
                placer.change(mark, onset)
            else:
                placer.state = replace(placer.state, breathing=mark)
