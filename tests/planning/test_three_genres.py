"""`natural` on three genres, spoken by the default voice, against what people do (physiology 1.1, 1.2; B52).

A group lasts from the inspiration's onset to the last phone. What it is compared with is a cut at fixed length: at the
first word end after as many syllables as the natural groups have on average. `pytest -s` shows the numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import mean, stdev

import pytest

from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.planning.model import plan
from scorebreath.planning.planners import open_planner
from scorebreath.planning.sites import boundary, function_words
from scorebreath.planning.units import Unit, UnitReader
from scorebreath.score.document import Score, Site
from scorebreath.score.events import Inspiration, Utterance
from scorebreath.script.reader import read
from scorebreath.speech.model import Voice
from scorebreath.speech.voices import open_voice

EXAMPLES = Path(__file__).parents[2] / "examples"
GENRES = ("forecast", "radio_chat", "prose")
SPOKEN = 6000
"""characters of a genre that are spoken; the boundaries are counted in all of it"""
PUNCTUATED: tuple[Site, ...] = ("text end", "paragraph", "sentence", "semicolon", "comma")


@dataclass(frozen=True)
class Breaths:
    """Where the breaths of a genre fall."""

    sites: list[Site]
    syllables: list[int]
    inside: int

    @property
    def punctuated(self) -> float:
        return sum(site in PUNCTUATED for site in self.sites) / len(self.sites)

    @property
    def grammatical(self) -> float:
        return sum(site in (*PUNCTUATED, "clause") for site in self.sites) / len(self.sites)

    def __str__(self) -> str:
        return (
            f"{len(self.sites):4} groups of {mean(self.syllables):4.1f} ± {stdev(self.syllables):4.1f} syllables, "
            f"{self.punctuated:6.1%} at punctuation, {self.grammatical:6.1%} there or before a clause"
        )


@pytest.fixture(scope="module")
def voice() -> Iterator[Voice]:
    with open_voice("espeak", "en") as opened:
        yield opened


def compiled(voice: Voice, genre: str, style: str = "reading") -> Score:
    text = (EXAMPLES / f"{genre}.txt").read_text(encoding="utf-8")
    end = text.rfind("\n\n", 0, SPOKEN) if len(text) > SPOKEN else len(text)
    return compile_text(text[:end], voice=voice, media=MemoryStore(), parameters=Parameters(style=style))


def lasting(score: Score) -> list[float]:
    """From the onset of a group's breath to the end of the last of its parts, s."""
    onsets = {event.group: event.onset for event in score.of(Inspiration) if event.kind != "tidal"}
    ends = {event.group: event.end for event in score.of(Utterance)}
    return [end - onsets[group] for group, end in ends.items()]


def units(voice: Voice, genre: str) -> list[Unit]:
    script = read((EXAMPLES / f"{genre}.txt").read_text(encoding="utf-8"), language="en")
    reader = UnitReader(voice.syllables, 44)
    return [unit for sentence in script.sentences for unit in reader.read(sentence)]


def breaths(text: Sequence[Unit], ends: Sequence[int]) -> Breaths:
    """Cuts at some places of the text, judged by the words and marks there, not by what a planner says of them."""
    small = function_words("en")
    places = {unit.end: index for index, unit in enumerate(text)}
    cuts = [places[end] for end in ends if end in places]
    starts = [0, *(cut + 1 for cut in cuts)]
    return Breaths(
        sites=[boundary(text, cut, small).site for cut in cuts],
        syllables=[sum(u.syllables for u in text[start : cut + 1]) for start, cut in zip(starts, cuts, strict=False)],
        inside=len(ends) - len(cuts),
    )


def fixed_length(text: Sequence[Unit], syllables: float) -> list[int]:
    ends, count = [], 0
    for unit in text:
        count += unit.syllables
        if count >= syllables:
            ends.append(unit.end)
            count = 0
    return ends if ends and ends[-1] == text[-1].end else [*ends, text[-1].end]


@pytest.mark.parametrize("genre", GENRES)
def test_groups_last_as_long_as_peoples(voice: Voice, genre: str) -> None:
    times = lasting(compiled(voice, genre))
    print(f"\n{genre}: {mean(times):.2f} s, SD {stdev(times):.2f}, {min(times):.2f}-{max(times):.2f} s")  # noqa: T201
    assert 3.3 <= mean(times) <= 4.8
    assert 1.0 <= stdev(times) <= 2.2
    assert min(times) >= 0.3
    assert max(times) <= 12.6


def test_groups_of_spontaneous_speech_are_longer(voice: Voice) -> None:
    """Physiology 1.1 (Wang et al. 2010): 4.88 s, SD 1.93, after 4.05 s, SD 1.5 in reading."""
    reading, spontaneous = (lasting(compiled(voice, "prose", style)) for style in ("reading", "spontaneous"))
    print(f"\nspontaneous prose: {mean(spontaneous):.2f} s, SD {stdev(spontaneous):.2f}")  # noqa: T201
    assert 4.2 <= mean(spontaneous) <= 5.1
    assert mean(spontaneous) > mean(reading)
    assert stdev(spontaneous) > stdev(reading)
    assert max(spontaneous) <= 12.6


@pytest.mark.parametrize("seed", range(3))
def test_breaths_of_spontaneous_speech_fall_inside_clauses_too(voice: Voice, seed: int) -> None:
    """Physiology 1.2, 10: 60-90 % at punctuation, the rest at phrase and word edges; never inside a word."""
    text = units(voice, "prose")
    script = read((EXAMPLES / "prose.txt").read_text(encoding="utf-8"), language="en")
    planner = open_planner("natural", Parameters(style="spontaneous"), "en", voice.syllables, seed=seed)
    ours = breaths(text, [group.source.end for group in plan(planner, script.sentences)])
    print(f"\nspontaneous prose, seed {seed}\n  natural      {ours}")  # noqa: T201
    assert ours.inside == 0
    assert 0.6 <= ours.punctuated <= 0.9
    assert ours.grammatical <= 0.93


@pytest.mark.parametrize("genre", GENRES)
def test_breaths_fall_where_peoples_do(voice: Voice, genre: str) -> None:
    text = units(voice, genre)
    script = read((EXAMPLES / f"{genre}.txt").read_text(encoding="utf-8"), language="en")
    planner = open_planner("natural", Parameters(), "en", voice.syllables)
    ours = breaths(text, [group.source.end for group in plan(planner, script.sentences)])
    fixed = breaths(text, fixed_length(text, mean(ours.syllables)))
    print(f"\n{genre}\n  natural      {ours}\n  fixed length {fixed}")  # noqa: T201
    assert ours.inside == 0
    assert ours.punctuated >= 0.9
    assert ours.grammatical >= 0.97
    assert fixed.punctuated < 0.5 < ours.punctuated
