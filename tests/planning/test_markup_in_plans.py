"""What the markup asks for: where groups must end and must not, what divides them, what stays in force."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, Part, Planner, plan
from scorebreath.planning.planners import PLANNERS, open_planner
from scorebreath.planning.syllables import vowel_counter
from scorebreath.script.marks import (
    DIVIDING,
    Act,
    ActName,
    BreathingMark,
    Mark,
    NamedMark,
    NoBreath,
    ProsodyMark,
    StateMark,
    VoiceMark,
)
from scorebreath.script.model import Sentence
from tests.planning.written import at_once, sentences, windows

Marks = dict[int, tuple[Mark, ...]]
"""By word: what stands behind it; -1: before the first."""


def marked(text: str, marks: Marks) -> list[Sentence]:
    found, place = [], 0
    for sentence in sentences(text):
        words = []
        for word in sentence.words:
            words.append(replace(word, after=marks.get(place, ())))
            place += 1
        found.append(replace(sentence, words=tuple(words)))
    if -1 in marks and found:
        found[0] = replace(found[0], before=marks[-1])
    return found


def groups(model: str, text: str, marks: Marks, **values: float) -> list[BreathGroup]:
    return list(plan(open_planner(model, Parameters(**values), "en", vowel_counter), marked(text, marks)))


def act(name: ActName, seconds: float | None = None) -> Act:
    return Act(at=0, written=f"[{name}]", name=name, seconds=seconds)


NO_BREATH = NoBreath(at=0, written="[no-breath]")
FOX = "The quick brown fox jumps over the lazy old dog and runs home."
MODELS = tuple(PLANNERS)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", sorted(DIVIDING))
def test_a_group_ends_before_a_breath_or_a_sound_of_one(model: str, name: ActName) -> None:
    mark = act(name)
    first, second = groups(model, FOX, {4: (mark,)})
    assert first.text == "The quick brown fox jumps"
    assert (first.cut.site, first.cut.candidates[0].site, first.after) == ("tag", "tag", ())
    assert f"[{name}]" in first.cut.rule
    assert first.cut.rule.startswith(model)
    assert (second.before, second.after, second.cut.site) == ((mark,), (), "text end")


@pytest.mark.parametrize("model", MODELS)
def test_another_voice_begins_a_group_and_stays_in_force(model: str) -> None:
    marks: Marks = {2: (VoiceMark(at=0, written="[voice anna]", voice="anna"),), 9: (act("breath"),)}
    found = groups(model, FOX, marks)
    assert [(group.text.split()[0], group.voice) for group in found] == [("The", ""), ("fox", "anna"), ("and", "anna")]


@pytest.mark.parametrize("model", MODELS)
def test_marks_at_the_ends_of_the_text(model: str) -> None:
    first, last = NamedMark(at=0, written="<mark/>", name="a"), act("exhale")
    found = groups(model, FOX, {-1: (first,), 12: (last,)})
    assert (found[0].before, found[-1].after) == ((first,), (last,))
    assert found[-1].cut.site == "text end"


@pytest.mark.parametrize("model", MODELS)
def test_marks_go_to_the_next_group_wherever_the_cut_was(model: str) -> None:
    """A mark behind every word: at an edge it goes on, inside it divides or stays."""
    text = "He ran home, and she sat by the sea. " * 6
    marks: Marks = {place: (NamedMark(at=place, written="<mark/>", name=str(place)),) for place in range(54)}
    found = groups(model, text, marks)
    assert len(found) > 2
    last = -1
    for group in found:
        expected = marks[last] if last >= 0 else ()
        assert group.before == expected
        last += len(group.words)
    assert found[-1].after == marks[53]


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(
    "mark", [act("pause", 0.2), act("hold", 0.5), act("sniff"), ProsodyMark(at=0, written="<prosody>", rate=0.8)]
)
def test_what_parts_a_group(model: str, mark: Mark) -> None:
    named = NamedMark(at=0, written="<mark/>", name="here")
    (group,) = groups(model, FOX, {2: (named,), 4: (mark, named)}, length_utterance=40.0)
    one, other = group.parts
    assert (one.source.cut(FOX), other.source.cut(FOX)) == ("The quick brown fox jumps", FOX[26:])
    assert (one.before, other.before, other.site) == ((), (mark, named), "word")
    assert one.words[2].after == (named,)
    assert (one.prosody, other.prosody) == (None, mark if isinstance(mark, ProsodyMark) else None)
    whole(group)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(
    "mark",
    [
        NamedMark(at=0, written="<mark/>", name="a"),
        StateMark(at=0, written="[state calm]", name="calm", intensity=1.0, ramp=1.0),
        BreathingMark(at=0, written="<amazon>", level_db=3.0),
        NO_BREATH,
    ],
)
def test_what_does_not_part_a_group(model: str, mark: Mark) -> None:
    (group,) = groups(model, FOX, {4: (mark,)}, length_utterance=40.0)
    assert len(group.parts) == 1
    assert group.words[4].after == (mark,)


@pytest.mark.parametrize("model", MODELS)
def test_prosody_stays_in_force_across_groups(model: str) -> None:
    slow, plain = ProsodyMark(at=0, written="<prosody>", rate=0.7), ProsodyMark(at=0, written="</prosody>")
    found = groups(model, FOX, {-1: (slow,), 4: (act("breath"),), 7: (plain,)}, length_utterance=40.0)
    assert [[part.prosody for part in group.parts] for group in found] == [[slow], [slow, plain]]


@pytest.mark.parametrize("model", MODELS)
def test_marks_inside_joined_words_count(model: str) -> None:
    found = groups(model, "A well-known dog ran by here now.", {1: (act("laugh"),)})
    assert [group.text for group in found] == ["A well-", "known dog ran by here now."]
    (group,) = groups(model, "A well-known dog ran by here now.", {1: (act("pause", 0.1),)}, length_utterance=40.0)
    assert [part.spoken.text for part in group.parts] == ["A well-", "known dog ran by here now."]
    assert group.parts[0].syllables == 2
    whole(group)


def test_a_forbidden_breath_is_taken_elsewhere() -> None:
    text = (
        "The old man went to the harbour in the morning, and the boats lay quiet on the water of the bay, while the "
        "women sang in the houses by the shore of the sea, and the children slept in the heat of the afternoon."
    )
    commas = [place for place, word in enumerate(sentences(text)[0].words) if word.edge == "comma"]
    free = groups("natural", text, {}, length_utterance=14.0)
    assert [group.words[-1].text for group in free] == ["morning", "bay", "sea", "afternoon"]
    held = groups("natural", text, {commas[1]: (NO_BREATH,)}, length_utterance=14.0)
    ends = [group.words[-1].text for group in held]
    assert len(ends) > 2
    assert "bay" not in ends


def test_a_paragraph_may_end_without_a_breath() -> None:
    text = "The old man went home\n\nand slept until the evening."
    assert len(groups("natural", text, {})) == 2
    (group,) = groups("natural", text, {4: (NO_BREATH,)})
    assert len(groups("natural", "the bread\n\nextraordinarily", {1: (NO_BREATH,)})) == 1
    assert [part.site for part in group.parts[1:]] == ["paragraph"]


@pytest.mark.parametrize("model", ["bernardet-2017", "bernardet-2019"])
def test_the_papers_models_cut_at_the_next_word_then(model: str) -> None:
    text = "The cat sat on the mat and the dog lay in the sun all day, and then they both ran off to eat and to drink"
    (split,) = {len(groups(model, text, {}, length_utterance=10.0)[0].words)}
    found = groups(model, text, {split - 1: (NO_BREATH,), split: (NO_BREATH,)}, length_utterance=10.0)
    assert len(found[0].words) == split + 2
    assert "[no-breath]" in found[0].cut.rule
    assert found[0].cut.candidates[0].position == found[0].source.end
    again = groups(model, text, {split - 1: (NO_BREATH,), split: (act("sigh"),)}, length_utterance=10.0)
    assert (len(again[0].words), again[0].cut.site) == (split + 1, "tag")


@pytest.mark.parametrize("model", MODELS)
def test_a_breath_cannot_be_forbidden_for_ever(model: str) -> None:
    found = groups(model, "bread " * 300, dict.fromkeys(range(300), (NO_BREATH,)))
    assert max(group.syllables for group in found) <= 60


def test_where_a_breath_is_asked_for_and_forbidden_it_is_taken() -> None:
    for model in MODELS:
        assert len(groups(model, FOX, {4: (NO_BREATH, act("breath"))})) == 2


def test_a_long_pause_is_a_place_to_breathe() -> None:
    text = "The old man went down to the harbour with the other men of the village on that day."
    free = groups("natural", text, {})
    assert all(len(group.words) != 9 for group in free)
    paused = groups("natural", text, {8: (act("pause", 0.5),)})
    assert (paused[0].words[-1].text, paused[0].cut.site) == ("with", "marker")
    assert [group.text for group in groups("natural", text, {8: (act("pause", 0.2),)})] == [one.text for one in free]


def test_natural_parts_sentences_the_papers_models_do_not() -> None:
    text = "Yes. He ran home. No."
    (group,) = groups("natural", text, {}, length_utterance=30.0)
    said = [(part.source.cut(text), part.site) for part in group.parts]
    assert said == [("Yes.", "word"), ("He ran home.", "sentence"), ("No.", "sentence")]
    whole(group)
    for model in MODELS[1:]:
        found = groups(model, text, {}, length_utterance=30.0, urgency_limit=0.0)
        assert any(any(word.edge == "sentence" for word in one.words[:-1]) for one in found)
        assert all(len(one.parts) == 1 for one in found)


def test_short_lines_of_a_dialogue_do_not_gasp_each() -> None:
    text = "Yes.\n\nNo.\n\nYes?\n\nNo!\n\nThe old man went to the harbour this morning.\n\nNo."
    found = groups("natural", text, {})
    assert [[part.source.cut(text) for part in group.parts] for group in found] == [
        ["Yes.", "No.", "Yes?", "No!"],
        ["The old man went to the harbour this morning."],
        ["No."],
    ]
    assert [part.site for part in found[0].parts[1:]] == ["paragraph"] * 3
    assert found[0].cut.rule.startswith("natural: no breath 3 syllables after the last")
    assert len(groups("natural", text, {0: (act("breath"),)})) == 4
    assert [len(group.parts) for group in groups("natural", "Yes.\n\nNo.\n\nYes.", {}, prosody_rate=0.5)] == [3]


acts = st.sampled_from(
    [
        act("breath"),
        act("sigh"),
        act("laugh"),
        act("sniff"),
        act("hold"),
        act("pause", 0.6),
        NO_BREATH,
        NO_BREATH,
        ProsodyMark(at=0, written="<p>", rate=1.5),
        VoiceMark(at=0, written="<v>", voice="b"),
        StateMark(at=0, written="[state]", name="anxious", intensity=0.7, ramp=2.0),
        StateMark(at=0, written="[state]", name="exertion", intensity=1.0, ramp=0.0),
        BreathingMark(at=0, written="<b>", frequency=2.0),
    ]
)
words = st.lists(
    st.tuples(
        st.sampled_from(["bread", "well-known", "the", "because", "extraordinarily", "Dr."]),
        st.sampled_from(["", "", "", ",", ".", ";", "?"]),
        st.sampled_from([" ", " ", " ", "\n\n"]),
        st.lists(acts, max_size=2),
    ),
    min_size=1,
    max_size=60,
)


@pytest.mark.parametrize("model", MODELS)
@settings(max_examples=60, deadline=None)
@given(
    tokens=words, sparse=st.integers(1, 6), size=st.integers(1, 7), style=st.sampled_from(["reading", "spontaneous"])
)
def test_laws_of_markup(
    model: str, tokens: list[tuple[str, str, str, list[Mark]]], sparse: int, size: int, style: str
) -> None:
    text = "".join(word + mark + gap for word, mark, gap, _ in tokens).rstrip()
    place, marks = 0, Marks()
    for number, (word, _, _, some) in enumerate(tokens):
        place += word.count("-") + 1
        if some and number % sparse == 0:
            marks[place - 1] = tuple(some)
    given_sentences = marked(text, marks)

    def planner() -> Planner:
        return open_planner(model, Parameters(style=style), "en", vowel_counter)

    found = list(plan(planner(), given_sentences))
    once = at_once(planner(), given_sentences)
    assert found == once
    assert list(plan(planner(), windows(given_sentences, size))) == once
    all_words = [word for sentence in given_sentences for word in sentence.words]
    assert [word for group in found for word in group.words] == all_words
    voice, prosody = "", None
    for group, following in zip(found, [*found[1:], None], strict=True):
        whole(group)
        for mark in group.before:
            voice = mark.voice if isinstance(mark, VoiceMark) else voice
        assert group.voice == voice
        for part in group.parts:
            for mark in part.before or (group.before if part is group.parts[0] else ()):
                prosody = mark if isinstance(mark, ProsodyMark) else prosody
            assert part.prosody == prosody
        assert not any(divides(word.after) for word in group.words[:-1])
        behind = group.words[-1].after
        assert behind == (following.before if following else group.after)
        if following and any(isinstance(mark, NoBreath) for mark in behind) and not divides(behind):
            assert all(
                any(isinstance(mark, NoBreath) for mark in word.after) or word.edge == "joint" for word in group.words
            )


def divides(marks: Sequence[Mark]) -> bool:
    return any(isinstance(mark, VoiceMark) or (isinstance(mark, Act) and mark.name in DIVIDING) for mark in marks)


def whole(group: BreathGroup) -> None:
    """Its parts together are the group."""
    parts: Sequence[Part] = group.parts
    assert tuple(word for part in parts for word in part.words) == group.words
    assert sum(part.syllables for part in parts) == group.syllables
    assert (parts[0].source.start, parts[-1].source.end) == group.source
    assert (parts[-1].sentence_type, parts[-1].ends_sentence) == (group.sentence_type, group.ends_sentence)
    assert parts[0].before == ()
    for part in parts:
        assert [run.source for run in part.spoken.runs] == [word.source for word in part.words if word.spoken.text]


@pytest.mark.parametrize("model", MODELS)
def test_pauses_too_long_to_hold_the_breath_end_a_group(model: str) -> None:
    text = "The old man rowed out to the island before noon."

    def count(*seconds: float) -> int:
        return len(groups(model, text, {4: tuple(act("pause", each) for each in seconds)}))

    assert count(9.0) == 2
    assert count(2.0, 2.0, 2.0) == 2
    if model != "natural":  # to natural a shorter pause is a likely place
        assert count(1.0, 1.0) == count()
