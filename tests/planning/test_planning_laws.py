"""What holds for every planner, every text and every setting."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.errors import InputError
from scorebreath.parameters.table import Parameters
from scorebreath.planning.chunker import MOST_CANDIDATES
from scorebreath.planning.explain import explain
from scorebreath.planning.model import BreathGroup, plan
from scorebreath.planning.planners import PLANNERS, open_planner
from scorebreath.planning.starts import most_syllables
from scorebreath.planning.syllables import vowel_counter
from tests.planning.written import at_once, sentences, windows

WORDS = (
    *("a", "the", "and", "because", "house", "river", "Dr.", "3.14", "well-known", "over-and-over-again", "snake_case"),
    *("extraordinarily", "_soft", "(so", "he", "of", "strength", "idea", "...and", "naïve", "Übergänge", "!", "e.g."),
)
MARKS = ("", "", "", "", ".", ",", ";", "?", "!", "_", ", _", "...", " —")
GAPS = (" ", " ", " ", " ", "\n", "\n\n", "   ")


@st.composite
def texts(draw: st.DrawFn) -> str:
    tokens = draw(
        st.lists(
            st.tuples(st.sampled_from(WORDS), st.sampled_from(MARKS), st.sampled_from(GAPS)), min_size=1, max_size=120
        )
    )
    return "".join(word + mark + gap for word, mark, gap in tokens).rstrip("\n ")


settings_of_planners = st.builds(
    Parameters,
    norm_syllables=st.floats(2, 30),
    capacity_lung=st.floats(20, 150),
    urgency_limit=st.none() | st.floats(0, 90),
    period_marker=st.sampled_from(["bare", "sentence"]),
    volume_per_syllable=st.floats(0.005, 0.03),
)


def groups(model: str, parameters: Parameters, text: str, poem: bool = False) -> list[BreathGroup]:
    return list(plan(open_planner(model, parameters, "en", vowel_counter, poem=poem), sentences(text, poem)))


@pytest.mark.parametrize("model", PLANNERS)
@settings(max_examples=60, deadline=None)
@given(text=texts(), parameters=settings_of_planners, poem=st.booleans())
def test_no_word_is_lost_or_said_twice(model: str, text: str, parameters: Parameters, poem: bool) -> None:
    given_words = [word for sentence in sentences(text, poem) for word in sentence.words]
    found = groups(model, parameters, text, poem)
    assert [word for group in found for word in group.words] == given_words
    assert all(group.words for group in found)
    assert [group.index for group in found] == list(range(len(found)))
    ends = [0]
    for group in found:
        assert ends[-1] <= group.source.start < group.source.end
        assert group.text == group.source.cut(text)
        assert not text[ends[-1] : group.source.start].strip()
        ends.append(group.source.end)
    assert not text[ends[-1] :].strip()


@pytest.mark.parametrize("model", PLANNERS)
@settings(max_examples=60, deadline=None)
@given(text=texts(), parameters=settings_of_planners, size=st.integers(1, 9))
def test_how_text_arrives_changes_nothing(model: str, text: str, parameters: Parameters, size: int) -> None:
    whole = sentences(text)
    once = at_once(open_planner(model, parameters, "en", vowel_counter), whole)
    assert groups(model, parameters, text) == once
    pieces = windows(whole, size)
    streamed = list(plan(open_planner(model, parameters, "en", vowel_counter), pieces))
    assert streamed == once


@pytest.mark.parametrize("model", PLANNERS)
@settings(max_examples=40, deadline=None)
@given(text=texts(), parameters=settings_of_planners)
def test_every_cut_has_its_reason(model: str, text: str, parameters: Parameters) -> None:
    found = groups(model, parameters, text)
    for group, row in zip(found, explain(found, text), strict=True):
        candidates = group.cut.candidates
        assert 1 <= len(candidates) <= MOST_CANDIDATES
        assert (candidates[0].position, candidates[0].site) == (group.source.end, group.cut.site)
        assert len({candidate.position for candidate in candidates}) == len(candidates)
        assert group.cut.rule.startswith(model)
        assert (row.text, row.syllables, row.rule) == (group.text, group.syllables, group.cut.rule)
        assert [shown.chosen for shown in row.candidates] == [True] + [False] * (len(candidates) - 1)
        shown = row.candidates[0].ending.split()
        assert shown == text[: group.source.end].split()[-len(shown) :] or shown == [text[: group.source.end][-24:]]
    assert [group.cut.site == "text end" for group in found] == [False] * (len(found) - 1) + [True]


@pytest.mark.parametrize("model", PLANNERS)
def test_what_is_said_leads_back_to_the_text(model: str) -> None:
    text = "The well-known Dr. Black _ said so, twice; did he? Yes!\n\n“No,” said she, and laughed."
    for group in groups(model, Parameters(norm_syllables=4.0), text):
        assert "_" not in group.spoken.text
        assert "  " not in group.spoken.text
        for run in group.spoken.runs:
            said = group.spoken.text[run.start : run.end]
            assert group.source.start <= run.source.start < run.source.end <= group.source.end
            assert said.strip("-") in run.source.cut(text)
        assert group.spoken.text.replace(" ", "") == group.text.replace(" ", "").replace("_", "").replace("\n", "")


@pytest.mark.parametrize("model", PLANNERS)
@settings(max_examples=30, deadline=None)
@given(text=texts(), parameters=settings_of_planners)
def test_a_group_is_of_the_sentence_its_last_word_is_of(model: str, text: str, parameters: Parameters) -> None:
    whole = sentences(text)
    kinds = {word.source: sentence.type for sentence in whole for word in sentence.words}
    ends = {sentence.words[-1].source for sentence in whole}
    for group in groups(model, parameters, text):
        last = group.words[-1].source
        assert (group.sentence_type, group.ends_sentence) == (kinds[last], last in ends)


def test_a_sentence_cut_off_by_its_window_does_not_end() -> None:
    whole = sentences("Did the old man go home to the old red house by the river? He did so at noon with all his men!")
    cut_off = [replace(whole[0], complete=False), whole[1]]
    planner = open_planner("natural", Parameters(), "en", vowel_counter)
    found = list(plan(planner, cut_off))
    assert [(group.sentence_type, group.ends_sentence) for group in found] == [
        ("question", False),
        ("exclamation", True),
    ]


@pytest.mark.parametrize("model", PLANNERS)
@pytest.mark.parametrize("written", [" ", "-", "\n"])
def test_endless_text_comes_out_as_it_goes_in(model: str, written: str) -> None:
    """Without any punctuation, as single words or one compound: bounded memory, and no group beyond every breath."""
    text = written.join(["bread"] * 1500)
    planner = open_planner(model, Parameters(), "en", vowel_counter)
    arrived = released = 0
    syllables: list[int] = []
    for piece in windows(sentences(text), 50):
        arrived += len(piece.words)
        for group in planner.feed(piece):
            released += len(group.words)
            syllables.append(group.syllables)
        assert arrived - released < 300
    syllables += [group.syllables for group in planner.finish()]
    assert sum(syllables) == 1500
    assert max(syllables) <= 60


def test_a_planner_may_be_asked_again_after_the_end() -> None:
    planner = open_planner("natural", Parameters(), "en", vowel_counter)
    first = [*planner.feed(sentences("One line.")[0]), *planner.finish()]
    second = [*planner.feed(sentences("Another one.")[0]), *planner.finish()]
    assert [(group.index, group.text) for group in first + second] == [(0, "One line."), (1, "Another one.")]


def test_syllables_are_asked_once_a_sentence_and_once_a_word() -> None:
    asked: list[Sequence[str]] = []

    def count(words: Sequence[str]) -> list[int]:
        asked.append(list(words))
        return [1] * len(words)

    planner = open_planner("natural", Parameters(), "en", count)
    for sentence in sentences("The cat and the dog. The cat slept. The dog and the cat."):
        list(planner.feed(sentence))
    assert asked == [["The", "cat", "and", "the", "dog"], ["slept"]]


def test_no_text_gives_no_groups() -> None:
    for model in PLANNERS:
        assert list(plan(open_planner(model, Parameters(), "en", vowel_counter), [])) == []


def test_an_unknown_model_names_the_known_ones() -> None:
    with pytest.raises(InputError, match=r"model='nature' must be one of natural, bernardet-2017, bernardet-2019"):
        open_planner("nature", Parameters(), "en", vowel_counter)


@settings(max_examples=50, deadline=None)
@given(text=texts(), parameters=settings_of_planners)
def test_natural_never_exceeds_the_breath_and_cuts_paragraphs(text: str, parameters: Parameters) -> None:
    """All but those before 3 syllables or less that come within 1.5 s (7 syllables) of the last breath."""
    most = most_syllables(parameters)
    found = groups("natural", parameters, text)
    for group in found:
        assert group.syllables <= most or len({word.edge for word in group.words[:-1]} - {"joint"}) == 0
        before = 0
        for part in group.parts[:-1]:
            before += part.syllables
            assert part.words[-1].edge != "paragraph" or before <= 7
        if any(part.site == "paragraph" for part in group.parts[1:]):
            assert group.syllables <= 7 + 3
        assert group.cut.candidates[0].cost == min(candidate.cost for candidate in group.cut.candidates)
