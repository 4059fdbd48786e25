"""`natural`: the optimum, its release, and what it takes for a boundary."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from importlib.resources import files
from itertools import combinations
from math import log

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from scorebreath.parameters.table import Parameters
from scorebreath.planning import natural
from scorebreath.planning.lattice import Lattice
from scorebreath.planning.model import BreathGroup, plan
from scorebreath.planning.natural import Natural, length_costs, most_syllables
from scorebreath.planning.sites import (
    CLINGING,
    COMMA_CLAUSE,
    READINESS,
    SUSPENDED,
    Boundary,
    FunctionWords,
    boundary,
    function_words,
)
from scorebreath.planning.syllables import vowel_counter
from scorebreath.planning.units import Unit, UnitReader
from scorebreath.score.document import Site
from scorebreath.script.reader import read
from tests.planning.written import sentences

SITES: tuple[Site, ...] = ("sentence", "semicolon", "comma", "clause", "phrase", "word")
stretches = st.lists(
    st.tuples(st.integers(1, 9), st.sampled_from(SITES), st.floats(0.01, 0.99)), min_size=1, max_size=11
)


def units(text: str) -> list[Unit]:
    reader = UnitReader(vowel_counter, 44)
    return [unit for sentence in sentences(text) for unit in reader.read(sentence)]


def groups(text: str, **values: float) -> list[BreathGroup]:
    return list(plan(Natural(Parameters(**values), "en", vowel_counter), sentences(text)))


def by_definition(
    stretch: list[tuple[int, Site, float]], ends: tuple[int, ...], length: list[float], budget: float
) -> float:
    """Cost of a plan, straight from what `lattice` says it is."""
    cost, start = 0.0, 0
    for end in ends:
        syllables = sum(unit[0] for unit in stretch[start:end])
        if syllables >= len(length) and end - start > 1:
            return float("inf")
        cost += length[min(syllables, len(length) - 1)] - log(stretch[end - 1][2])
        for passed in range(start + 1, end):
            if sum(unit[0] for unit in stretch[start:passed]) >= budget:
                cost -= log(1.0 - stretch[passed - 1][2])
        start = end
    return cost


def every_plan(size: int) -> Iterator[tuple[int, ...]]:
    for cuts in range(size):
        for ends in combinations(range(1, size), cuts):
            yield (*ends, size)


@settings(max_examples=60, deadline=None)
@given(stretch=stretches, preferred=st.floats(1, 20), most=st.integers(5, 30), share=st.floats(0.1, 1.0))
def test_the_lattice_finds_what_brute_force_finds(
    stretch: list[tuple[int, Site, float]], preferred: float, most: int, share: float
) -> None:
    length, budget = length_costs(preferred, most, 0.01), share * preferred
    lattice = Lattice(length, budget)
    for syllables, site, probability in stretch:
        lattice.add(syllables, Boundary(site, -log(probability), -log(1.0 - probability)))
    costs = {ends: by_definition(stretch, ends, length, budget) for ends in every_plan(len(stretch))}
    found = tuple(lattice.plan())
    assert lattice.best() == pytest.approx(min(costs.values()))
    assert costs[found] == pytest.approx(min(costs.values()))
    starts = (0, *found)
    assert sum(map(lattice.cost, starts, found)) == pytest.approx(costs[found])


long_stretches = st.lists(
    st.tuples(st.integers(1, 6), st.sampled_from(SITES), st.sampled_from([0.001, 0.05, 0.35, 0.6, 0.95])),
    min_size=30,
    max_size=150,
)


@settings(max_examples=60, deadline=None)
@given(stretch=long_stretches, preferred=st.floats(4, 20), share=st.floats(0.2, 0.8))
@example(stretch=[(1, "sentence", 0.001)] * 40, preferred=5.0, share=0.20000000000000004)
def test_what_is_settled_early_is_what_the_whole_text_would_settle(
    stretch: list[tuple[int, Site, float]], preferred: float, share: float
) -> None:
    """Cutting off the certain beginning again and again gives a plan as cheap as one search over everything."""
    length, budget = length_costs(preferred, 30, 0.01), share * preferred
    whole, rolling = Lattice(length, budget), Lattice(length, budget)
    ends: list[int] = [0]
    for syllables, site, probability in stretch:
        for lattice in (whole, rolling):
            lattice.add(syllables, Boundary(site, -log(probability), -log(1.0 - probability)))
        while rolling.certain():
            first = rolling.plan()[0]
            ends.append(ends[-1] + first)
            rolling.reroot(first)
    ends += [ends[-1] + end for end in rolling.plan()] if len(rolling) else []
    assert ends[-1] == len(stretch)
    assert sum(map(whole.cost, ends, ends[1:])) == pytest.approx(whole.best())


def test_certain_groups_come_before_the_paragraph_is_over() -> None:
    """One sentence later, where the sentences are as long as a breath: the next one might have been "Yes."."""
    planner = Natural(Parameters(), "en", vowel_counter)
    text = "The old man went down to the harbour every morning before the sun was up. " * 6
    released = [len(list(planner.feed(sentence))) for sentence in sentences(text)]
    assert released == [0, 1, 1, 1, 1, 1]


def test_a_very_short_sentence_shares_a_breath() -> None:
    text = "Yes. The old man went down to the harbour this morning. He saw the boats come in with the tide. No."
    assert all(group.syllables > 3 for group in groups(text))


def test_the_breath_bounds_a_group() -> None:
    text = "The boat and the net and the sail and the oar and the rope " * 12
    for values in ({}, {"volume_per_syllable": 0.02}, {"prosody_rate": 0.5}, {"capacity_lung": 30.0}):
        most = most_syllables(Parameters(**values))
        assert max(group.syllables for group in groups(text, length_utterance=100.0, **values)) <= most
    assert most_syllables(Parameters(prosody_rate=0.5)) == 29  # (12.5 - 0.42 - 0.06) s / (1/2.5 + 0.01) s


def test_longer_preferred_groups_are_longer() -> None:
    text = "The men came home, and the women sang, and the dogs ran out, and the cats slept on, and all was well. " * 5
    counts = [len(groups(text, norm_syllables=norm)) for norm in (6.0, 12.0, 24.0)]
    assert counts[0] > counts[1] > counts[2]


SITES_OF: tuple[tuple[str, str, Site, float], ...] = (
    ("he ran because it rained", "ran", "clause", READINESS["clause"]),
    ("he ran and it rained", "ran", "clause", READINESS["clause"]),
    ("bread and butter, too", "bread", "phrase", READINESS["phrase"]),
    ("ate after he ran", "ate", "clause", READINESS["clause"]),
    ("ate after lunch today", "ate", "phrase", READINESS["phrase"]),
    ("old men in boats", "men", "phrase", READINESS["phrase"]),
    ("old men row boats", "men", "word", READINESS["word"]),
    ("the house", "the", "word", CLINGING),
    ("because he ran", "because", "word", CLINGING),
    ("ran, because it rained", "ran", "comma", COMMA_CLAUSE),
    ("ran, slept well", "ran", "comma", READINESS["comma"]),
    ("ran_ slept well", "ran", "marker", READINESS["marker"]),
    ("ran, _ slept well", "_", "marker", READINESS["marker"]),
    ("ran; slept", "ran", "semicolon", READINESS["semicolon"]),
    ("He ran. She slept", "ran", "sentence", READINESS["sentence"]),
)


@pytest.mark.parametrize(("text", "after", "site", "probability"), SITES_OF)
def test_what_follows_a_word(text: str, after: str, site: Site, probability: float) -> None:
    found = units(text)
    index = next(i for i, unit in enumerate(found) if unit.words[0].text == after)
    actual = boundary(found, index, function_words("en"))
    assert actual.site == site
    assert actual[1:] == pytest.approx((-log(probability), -log(1.0 - probability)))


def test_german_clauses_open_too() -> None:
    found = units("Er lief weil es regnete")
    assert boundary(found, 1, function_words("de-AT")).site == "clause"
    assert boundary(found, 1, function_words("fr")).site == "word"


@pytest.mark.parametrize(
    ("text", "language", "before"),
    [
        ("die Planungs- und Bauphase beginnt", "de", "Planungs"),
        ("die Bauplanung und -ausführung der Stadt", "de", "Bauplanung"),
        ("die Haupt-, Mittel- oder Zwischensätze hier", "de", "Mittel"),
        ("die Vor- bzw. Nachteile hier", "de", "Vor"),
        ("zwei- bis dreimal so", "de", "zwei"),
        ("Vor- & Nachteile hier", "de", "Vor"),
        ("the pre- and post-war years", "en", "pre"),
        ("a first\N{HYPHEN} to third-grade class", "en", "first"),
        ("a mid\N{EN DASH} or long-term plan", "en", "mid"),
    ],
)
def test_a_pair_of_compounds_that_share_a_half_is_not_parted(text: str, language: str, before: str) -> None:
    """Neither before the word between them nor behind it."""
    reader = UnitReader(vowel_counter, 44)
    found = [unit for sentence in read(text, language=language).sentences for unit in reader.read(sentence)]
    index = next(i for i, unit in enumerate(found) if unit.words[0].text == before)
    for place in (index, index + 1):
        actual = boundary(found, place, function_words(language))
        assert actual.site == "word"
        assert actual.breathing == pytest.approx(-log(SUSPENDED))
    plain = text.replace("-", "").replace("\N{HYPHEN}", "").replace("\N{EN DASH}", "")
    found = [unit for sentence in read(plain, language=language).sentences for unit in reader.read(sentence)]
    bare = boundary(found, index, function_words(language))
    assert bare.breathing < -log(SUSPENDED) or before.lower() in ("vor", "mittel")


@pytest.mark.parametrize(
    ("text", "index", "site", "probability"),
    [
        ("it is 2 in. tall now", 2, "word", READINESS["word"]),
        ("it is 2 in. tall now", 3, "word", READINESS["word"]),
        ("men row 2 in boats now", 2, "phrase", READINESS["phrase"]),
        ("saw Dr. Smith now", 1, "word", CLINGING),
    ],
)
def test_what_is_said_otherwise_is_no_function_word(text: str, index: int, site: Site, probability: float) -> None:
    reader = UnitReader(vowel_counter, 44)
    found = [unit for sentence in read(text).sentences for unit in reader.read(sentence)]
    actual = boundary(found, index, function_words("en"))
    assert actual.site == site
    assert actual.breathing == pytest.approx(-log(probability))


def test_a_dash_before_a_conjunction_is_no_shared_half() -> None:
    reader = UnitReader(vowel_counter, 44)
    found = [unit for one in read("He went home - and then slept").sentences for unit in reader.read(one)]
    assert boundary(found, 2, function_words("en")).site == "semicolon"


def test_every_table_of_function_words_is_sound() -> None:
    tables = [table for table in files("scorebreath.planning").joinpath("tables").iterdir() if table.name[0] != "_"]
    assert {table.name for table in tables} >= {"en.toml", "de.toml"}
    for table in tables:
        rows = tomllib.loads(table.read_text(encoding="utf-8"))
        assert set(rows) <= set(FunctionWords.__dataclass_fields__)
        for name, lines in rows.items():
            words = " ".join(lines).split()
            assert words, name
            assert len(words) == len(set(words)), (table.name, name)
            assert all(word == word.lower() and "'" not in word for word in words)
        openers = [set(" ".join(rows[name]).split()) for name in ("clause", "coordinators", "before_subject", "phrase")]
        for one, other in combinations(openers[:3], 2):
            assert not one & other, table.name


def test_weights_follow_the_order_of_strength() -> None:
    order: tuple[Site, ...] = ("paragraph", "sentence", "semicolon", "comma", "clause", "phrase", "word")
    assert [READINESS[site] for site in order] == sorted((READINESS[site] for site in order), reverse=True)


def test_verse_is_breathed_at_line_ends() -> None:
    poem = "The moon has risen,\nthe golden stars are shining\nin heaven bright and clear;\nthe wood stands black"
    poem += " and\nsilent,\n\nand from the meadows"
    found = UnitReader(vowel_counter, 44, poem=True)
    lines = [unit.words[0].text for s in sentences(poem, poem=True) for unit in found.read(s) if unit.ends_line]
    assert lines == ["risen", "shining", "clear", "and"]
    comma = boundary(units("risen, the"), 0, function_words("en"))
    reader = UnitReader(vowel_counter, 44, poem=True)
    verse = [unit for s in sentences("risen,\nthe", poem=True) for unit in reader.read(s)]
    assert boundary(verse, 0, function_words("en")).breathing < comma.breathing


def test_settling_early_does_not_change_the_plan_of_a_long_paragraph() -> None:
    """Many breaths of text with punctuation: the bounded window never has to force a cut."""
    sentence = (
        "The old man went down to the harbour, where the boats lay, and looked at the sea; then he went home again. "
    )
    text = (sentence + "He slept. " + sentence.replace("harbour", "long and quiet beach")) * 12
    planner = Natural(Parameters(), "en", vowel_counter)
    whole = Lattice(length_costs(planner.preferred, planner.most, 0.009), natural.BUDGET * planner.preferred)
    everything = units(text)
    for index, unit in enumerate(everything):
        whole.add(unit.syllables, boundary(everything, index, function_words("en")))
    assert whole.syllables > 3 * natural.WINDOW * planner.most
    expected = [everything[end - 1].end for end in whole.plan()]
    assert [group.source.end for group in plan(planner, sentences(text))] == expected
