"""`natural`: the optimum, its release, and what it takes for a boundary."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import replace
from importlib.resources import files
from itertools import accumulate, combinations
from math import exp, log

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from scorebreath.parameters.table import Parameters
from scorebreath.planning import natural, sites
from scorebreath.planning.lattice import Lattice
from scorebreath.planning.model import BreathGroup, plan
from scorebreath.planning.natural import Natural
from scorebreath.planning.sites import FORBIDDEN, HABITS, Boundary, FunctionWords, boundary, function_words
from scorebreath.planning.starts import Start, most_syllables, start
from scorebreath.planning.syllables import vowel_counter
from scorebreath.planning.units import Unit, UnitReader
from scorebreath.score.document import Site
from scorebreath.script.reader import read
from tests.planning.written import sentences

READING = HABITS["reading"]
SITES: tuple[Site, ...] = ("sentence", "semicolon", "comma", "clause", "phrase", "word")


def units(text: str) -> list[Unit]:
    reader = UnitReader(vowel_counter, 44)
    return [unit for sentence in sentences(text) for unit in reader.read(sentence)]


def groups(text: str, **values: float) -> list[BreathGroup]:
    return list(plan(Natural(Parameters(**values), "en", vowel_counter), sentences(text)))


BODIES = tuple(
    start(preferred, most, volume) for preferred, most, volume in ((5.0, 9, 0.04), (7.0, 16, 0.01), (12.0, 30, 0.02))
)
"""Starts of three kinds: out of breath, brief, at ease; MUCH is passed after 6, 24 and 12 syllables."""
Stretch = list[tuple[int, Boundary, Start]]


def stretch_of(rows: list[tuple[int, Site, float, int]]) -> Stretch:
    return [
        (syllables, Boundary(site, -log(probability), -log(1.0 - probability)), BODIES[body])
        for syllables, site, probability, body in rows
    ]


def by_definition(stretch: Stretch, first: Start, ends: tuple[int, ...]) -> float:
    """Cost of a plan, straight from what `lattice` says it is."""
    cost, begin, body, recovering = 0.0, 0, first, False
    for end in ends:
        syllables = sum(unit[0] for unit in stretch[begin:end])
        if syllables > body.most and end - begin > 1:
            return float("inf")
        length = body.tired if recovering else body.fresh
        cost += length[min(syllables, body.most)] + stretch[end - 1][1].breathing
        for passed in range(begin + 1, end):
            if sum(unit[0] for unit in stretch[begin:passed]) >= body.budget:
                cost += stretch[passed - 1][1].passing
        begin, body, recovering = end, stretch[end - 1][2], syllables > body.much
    return cost


def every_plan(size: int) -> Iterator[tuple[int, ...]]:
    for cuts in range(size):
        for ends in combinations(range(1, size), cuts):
            yield (*ends, size)


def lattice_of(stretch: Stretch, first: Start) -> Lattice:
    lattice = Lattice(first)
    for syllables, found, body in stretch:
        lattice.add(syllables, found, body)
    return lattice


def cost_of(lattice: Lattice, ends: list[int]) -> float:
    cost, recovering = 0.0, False
    for begin, end in zip([0, *ends], ends, strict=False):
        cost += lattice.cost(begin, end, recovering=recovering)
        recovering = lattice.tires(begin, end)
    return cost


bodies = st.integers(0, len(BODIES) - 1)
few = st.lists(
    st.tuples(st.integers(1, 9), st.sampled_from(SITES), st.floats(0.01, 0.99), bodies), min_size=1, max_size=11
)


@settings(max_examples=150, deadline=None)
@given(rows=few, body=bodies, forbidden=st.sets(st.integers(0, 10), max_size=4))
def test_the_lattice_finds_what_brute_force_finds(
    rows: list[tuple[int, Site, float, int]], body: int, forbidden: set[int]
) -> None:
    """With a body of its own at every node, recovery after long groups, and places where no breath may fall."""
    stretch = [
        (syllables, Boundary(found.site, FORBIDDEN, 0.0) if place in forbidden else found, where)
        for place, (syllables, found, where) in enumerate(stretch_of(rows))
    ]
    lattice = lattice_of(stretch, BODIES[body])
    costs = {ends: by_definition(stretch, BODIES[body], ends) for ends in every_plan(len(stretch))}
    found = lattice.plan()
    assert lattice.best() == pytest.approx(min(costs.values()))
    assert costs[tuple(found)] == pytest.approx(min(costs.values()))
    assert cost_of(lattice, found) == pytest.approx(costs[tuple(found)])


many = st.lists(
    st.tuples(st.integers(1, 6), st.sampled_from(SITES), st.sampled_from([0.001, 0.05, 0.35, 0.6, 0.95])),
    min_size=30,
    max_size=150,
)


@settings(max_examples=100, deadline=None)
@given(rows=many, body=bodies, changes=st.lists(st.tuples(st.integers(0, 149), bodies), max_size=6))
@example(rows=[(1, "sentence", 0.001)] * 40, body=0, changes=[])
def test_what_is_settled_early_is_what_the_whole_text_would_settle(
    rows: list[tuple[int, Site, float]], body: int, changes: list[tuple[int, int]]
) -> None:
    """Cutting off the certain beginning again and again gives a plan as cheap as one search over everything."""
    now, stretch = body, []
    for place, row in enumerate(rows):
        now = dict(changes).get(place, now)
        stretch += stretch_of([(*row, now)])
    whole, rolling = Lattice(BODIES[body]), Lattice(BODIES[body])
    ends: list[int] = [0]
    for syllables, found, where in stretch:
        for lattice in (whole, rolling):
            lattice.add(syllables, found, where)
        while rolling.certain():
            ends.append(ends[-1] + rolling.plan()[0])
            rolling.reroot()
    ends += [ends[-1] + end for end in rolling.plan()]
    assert ends[-1] == len(stretch)
    # `whole` closes, too, but never forgets: compare with a search that looks at every start.
    assert cost_of(whole, ends[1:]) == pytest.approx(exhaustive(stretch, BODIES[body]))
    assert whole.best() == pytest.approx(exhaustive(stretch, BODIES[body]))


def exhaustive(stretch: Stretch, first: Start) -> float:
    """The cheapest plan's cost by plain dynamic programming over (node, recovering), nothing ever closed."""
    lattice = lattice_of(stretch, first)
    best: list[dict[bool, float]] = [{False: 0.0}]
    for end in range(1, len(stretch) + 1):
        here: dict[bool, float] = {}
        for begin in range(max(0, end - 31), end):
            for recovering, before in best[begin].items():
                cost = before + lattice.cost(begin, end, recovering=recovering)
                tired = lattice.tires(begin, end)
                here[tired] = min(here.get(tired, float("inf")), cost)
        best.append(here)
    return min(best[-1].values())


def test_certain_groups_come_before_the_paragraph_is_over() -> None:
    """A sentence or two later, where the sentences are as long as a breath: the next one might have been "Yes."."""
    planner = Natural(Parameters(), "en", vowel_counter)
    text = "The old man went down to the harbour every morning before the sun was up. " * 6
    released = [len(list(planner.feed(sentence))) for sentence in sentences(text)]
    known = list(accumulate(released))
    assert all(count >= sentence - 2 for sentence, count in enumerate(known, 1))
    assert known[-1] == 5


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
    ("he ran because it rained", "ran", "clause", READING.readiness["clause"]),
    ("he ran and it rained", "ran", "clause", READING.readiness["clause"]),
    ("bread and butter, too", "bread", "phrase", READING.readiness["phrase"]),
    ("ate after he ran", "ate", "clause", READING.readiness["clause"]),
    ("ate after lunch today", "ate", "phrase", READING.readiness["phrase"]),
    ("old men in boats", "men", "phrase", READING.readiness["phrase"]),
    ("old men row boats", "men", "word", READING.readiness["word"]),
    ("the house", "the", "word", READING.clinging),
    ("because he ran", "because", "word", READING.clinging),
    ("ran, because it rained", "ran", "comma", READING.comma_clause),
    ("ran, slept well", "ran", "comma", READING.readiness["comma"]),
    ("ran_ slept well", "ran", "marker", READING.readiness["marker"]),
    ("ran, _ slept well", "_", "marker", READING.readiness["marker"]),
    ("ran; slept", "ran", "semicolon", READING.readiness["semicolon"]),
    ("He ran. She slept", "ran", "sentence", READING.readiness["sentence"]),
)


@pytest.mark.parametrize(("text", "after", "site", "probability"), SITES_OF)
def test_what_follows_a_word(
    text: str, after: str, site: Site, probability: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sites, "NEAR", ())
    found = units(text)
    index = next(i for i, unit in enumerate(found) if unit.words[0].text == after)
    actual = boundary(found, index, function_words("en"))
    assert actual.site == site
    pull = READING.sentence_pull if site == "sentence" else 0.0
    assert actual[1:] == pytest.approx((-log(probability) - pull, -log(1.0 - probability)))


def test_most_sentences_end_with_a_breath_though_two_would_fit() -> None:
    text = "The men came home late in the evening from the sea. The dogs ran out to meet them, as dogs do. " * 12
    found = groups(text)
    ends = sum(group.ends_sentence for group in found)
    passed = sum(part.ends_sentence for group in found for part in group.parts[:-1])
    assert ends / (ends + passed) >= 0.7


def test_places_near_punctuation_are_less_ready() -> None:
    found = units("Old men row boats here, now and then.")
    ready = [
        exp(-boundary(found, place, function_words("en")).breathing) / READING.readiness["word"] for place in range(4)
    ]
    assert ready == pytest.approx([0.1, 0.35, 0.35, 0.1])


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
        assert actual.breathing == pytest.approx(-log(READING.clinging))
    plain = text.replace("-", "").replace("\N{HYPHEN}", "").replace("\N{EN DASH}", "")
    found = [unit for sentence in read(plain, language=language).sentences for unit in reader.read(sentence)]
    bare = boundary(found, index, function_words(language))
    assert bare.breathing < -log(READING.clinging) or before.lower() in ("vor", "mittel")


@pytest.mark.parametrize(
    ("text", "index", "site", "probability"),
    [
        ("it is 2 in. tall now", 2, "word", READING.readiness["word"]),
        ("it is 2 in. tall now", 3, "word", READING.readiness["word"]),
        ("men row 2 in boats now", 2, "phrase", READING.readiness["phrase"]),
        ("saw Dr. Smith now", 1, "word", READING.clinging),
    ],
)
def test_what_is_said_otherwise_is_no_function_word(
    text: str, index: int, site: Site, probability: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sites, "NEAR", ())
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
    assert [READING.readiness[site] for site in order] == sorted(
        (READING.readiness[site] for site in order), reverse=True
    )


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


def test_settling_early_does_not_change_the_plan_of_a_long_paragraph(monkeypatch: pytest.MonkeyPatch) -> None:
    """Many breaths of text with punctuation: the bounded window never has to force a cut."""
    sentence = (
        "The old man went down to the harbour, where the boats lay, and looked at the sea; then he went home again. "
    )
    text = (sentence + "He slept. " + sentence.replace("harbour", "long and quiet beach")) * 12
    even = replace(READING, variation=0.0, unevenness=0.0, length=1.0)
    monkeypatch.setattr(natural, "HABITS", {"reading": even})
    planner = Natural(Parameters(), "en", vowel_counter)
    whole = Lattice(start(18.0, 44, 0.009, spread=even.spread, budget=even.budget))
    everything = units(text)
    for index, unit in enumerate(everything):
        whole.add(unit.syllables, boundary(everything, index, function_words("en")))
    assert whole.syllables > 3 * natural.WINDOW * whole.most
    expected = [everything[end - 1].end for end in whole.plan()]
    assert [group.source.end for group in plan(planner, sentences(text))] == expected
