"""Intonational phrases and accents, as every breathing model places them (A7, A8, A12)."""

from __future__ import annotations

import dataclasses
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.compose.models import MODELS
from scorebreath.compose.phrasing import CONTINUING, EDGES, HIGH, LOW, PAUSE, ROUNDING
from scorebreath.compose.wording import accented, owners
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.planning.model import Part
from scorebreath.score.document import Score
from scorebreath.score.events import Emotion, Pause, Phone, Phrase, Utterance, Word
from scorebreath.script.reader import read
from scorebreath.script.told import Told
from scorebreath.spans import SpokenText
from scorebreath.speech.assemble import silence
from scorebreath.speech.model import Speech
from scorebreath.speech.tone.voice import ToneVoice

EVERY = pytest.mark.parametrize("model", MODELS)
LONG = Parameters(length_utterance=40.0)
VERSE = "Es gingen zwei Parallelen\nins Endlose hinaus,\nzwei kerzengerade Seelen\nund aus solidem Haus.\n\nSie gingen."


def score(text: str, model: str = "natural", language: str = "en", poem: bool | None = None) -> Score:
    """Said by the tone voice, which falls silent for 150 ms at commas, and stresses every word."""
    return compile_text(
        text, voice=ToneVoice(), media=MemoryStore(), model=model, language=language, poem=poem,
        parameters=LONG if model != "natural" else None,
    )  # fmt: skip


def phrases(said: Score) -> list[tuple[str, int, str, str]]:
    return [(said.text[slice(*p.source)], p.break_index, p.tone, p.position) for p in said.of(Phrase)]


@EVERY
def test_a_phrase_ends_at_punctuation_and_says_whether_its_sentence_does(model: str) -> None:
    said = score("One, two; three went home. Did four come? Who came!\n\nYes.", model)
    assert phrases(said) == [
        ("One,", 4, CONTINUING, "internal"),
        ("two;", 4, CONTINUING, "internal"),
        ("three went home.", 5, LOW, "final"),
        ("Did four come?", 5, HIGH, "final"),
        ("Who came!", 6, LOW, "final"),
        ("Yes.", 6, LOW, "final"),
    ]
    kinds = [p.sentence_type for p in said.of(Phrase)]
    assert kinds == ["statement"] * 3 + ["question", "exclamation", "statement"]
    assert {(p.line, p.stanza) for p in said.of(Phrase)} == {(None, None)}


@EVERY
def test_lines_of_verse_are_phrases(model: str) -> None:
    said = score(VERSE, model, "de", poem=True)
    assert [(p.line, p.stanza) for p in said.of(Phrase)] == [(0, 0), (1, 0), (2, 0), (3, 0), (5, 1)]
    assert [(index, tone) for _, index, tone, _ in phrases(said)] == [(4, CONTINUING)] * 3 + [(6, LOW)] * 2
    prose = score(VERSE, model, "de", poem=False)
    assert len(phrases(prose)) < 5 + (model != "natural")
    assert {(p.line, p.stanza) for p in prose.of(Phrase)} == {(None, None)}


def test_the_paper_s_own_example_has_its_boundaries() -> None:
    """S3, table 2: 4 and `h-l%` behind "Parallelen" and behind "hinaus,"."""
    first, second, *_ = phrases(score(VERSE, language="de", poem=True))
    assert first == ("Es gingen zwei Parallelen", 4, "h-l%", "internal")
    assert second == ("ins Endlose hinaus,", 4, "h-l%", "internal")


@pytest.mark.parametrize(
    ("question", "tone"),
    [
        ("Who came?", LOW),
        ("Can you show me the way?", HIGH),
        ("And besides, what would be the use?", LOW),
        ("When she came, did you see her?", HIGH),
        ('He asked, "When?"', LOW),
        ('He asked: "When?"', LOW),
        ('Is he the one who asked, "What for?"', LOW),
        ('What he asked was, "Did you see her?"', HIGH),
        ('He asked "When?"', LOW),
        ('You heard, "who came"?', HIGH),
        ('What did you hear, "no"?', LOW),
        ("Where would you (or he) go?", LOW),
    ],
)
def test_questions_end_high_but_those_for_a_word_do_not(question: str, tone: str) -> None:
    assert [p.tone for p in score(question).of(Phrase)][-1] == tone


@pytest.mark.parametrize(("quoted", "tone"), [("Why?", LOW), ("Is it you?", HIGH)])
def test_a_question_quoted_within_a_sentence_begins_with_its_quotation(quoted: str, tone: str) -> None:
    assert [p.tone for p in score(f"He said “{quoted}” and left.").of(Phrase)] == [tone, LOW]


@EVERY
def test_how_a_sentence_began_is_known_in_its_later_groups(model: str) -> None:
    tail = " the very long and winding road that led them to the door of the old house by the sea at night" * 3
    last = [p.tone for p in score(f"What is{tail}?", model).of(Phrase)][-1]
    assert last == LOW
    assert [p.tone for p in score(f"It is late. Is it{tail}?", model).of(Phrase)][-1] == HIGH
    assert len(list(score(f"What is{tail}?", model).of(Utterance))) > 1


def test_marks_inside_a_sentence_have_their_own_tones() -> None:
    said = phrases(score("‘Come here!’ said she. ‘Did you?’ he said. ‘What for?’ he said. Well... no."))
    assert {text: tone for text, _, tone, where in said if where == "internal"} == {
        "‘Come here!’": LOW,
        "‘Did you?’": HIGH,
        "‘What for?’": LOW,
        "Well...": CONTINUING,
    }


def test_a_question_that_is_quoted_is_one_though_its_sentence_is_none() -> None:
    found = {p.tone: (p.sentence_type, p.position) for p in score("‘Did you?’ he said.").of(Phrase)}
    assert found == {HIGH: ("question", "internal"), LOW: ("statement", "final")}


def test_what_stands_before_a_quoted_question_is_none_of_it() -> None:
    text = "‘Idiot!’ said she, and went on, ‘Who are you?’"
    found = [(p.sentence_type, p.tone) for p in score(text).of(Phrase)]
    assert found == [
        ("statement", LOW), ("statement", CONTINUING), ("statement", CONTINUING), ("question", LOW),
    ]  # fmt: skip


def test_what_is_cried_out_within_a_question_does_not_ask() -> None:
    found = [(p.sentence_type, p.tone) for p in score("Did he cry ‘Fire!’ and ‘No.’ or not?").of(Phrase)]
    assert found == [("exclamation", LOW), ("statement", LOW), ("question", HIGH)]


def test_inner_silences_are_pauses_told_apart_from_final_ones() -> None:
    natural = score("One, two. Three.")
    inner = [p for p in natural.of(Pause) if p.id.endswith(".pause") and "phrase" in p.id]
    assert [p.kind for p in inner] == ["phrase"]
    papers = score("One, two. Three.\n\nFour.", "bernardet-2019")
    kinds = [p.kind for p in papers.of(Pause) if "phrase" in p.id]
    assert kinds == ["phrase", "sentence", "paragraph"]


MARY = """<maryxml version="0.4"><p><s>
<t accent="L+H*" pos="DT">the</t> <t accent="none" pos="NN">garden</t> <t pos="NN">gate</t>
<boundary breakindex="3" tone="L-"/> <t>was</t> <t>open</t> <boundary breakindex="5" tone="H-H%"/>
</s></p></maryxml>"""


def test_what_is_told_stands_in_place_of_what_is_found() -> None:
    said = score(MARY)
    (speech,) = said.of(Utterance)
    assert [(w.text.lower(), w.accent, w.tone.lower(), w.pos) for w in speech.words] == [
        ("the", True, "l+h*", "DT"),
        ("garden", False, "", "NN"),
        ("gate", False, "", "NN"),
        ("was", False, "", ""),
        ("open", False, "", ""),
    ]  # where tokens tell accents, those that tell none have none
    assert [(p.break_index, p.tone.lower()) for p in said.of(Phrase)] == [(3, "l-"), (5, "h-h%")]


def test_emphasis_accents_whatever_is_said() -> None:
    said = score('<speak>It was <emphasis level="strong">in the</emphasis> garden.</speak>')
    accents = {w.text: w.accent for one in said.of(Utterance) for w in one.words}
    assert accents == {"It": False, "was": False, "in": True, "the": True, "garden": True}


def spoken(*words: tuple[str, tuple[int, int] | None, int]) -> Speech:
    """Words with a phone of a stress each."""
    return dataclasses.replace(
        silence(8000),
        words=tuple(Word(text=t, onset=n / 2, duration=0.5, source=s) for n, (t, s, _) in enumerate(words)),
        phones=tuple(
            Phone(ipa="a", onset=n / 2, duration=0.5, stress=stress, word=n) for n, (_, _, stress) in enumerate(words)
        ),
    )


def written(text: str, **told: Told) -> Part:
    (sentence,) = read(text, language="en").sentences
    words = tuple(dataclasses.replace(word, told=told.get(word.text)) for word in sentence.words)
    return Part(
        source=sentence.source, spoken=SpokenText(text=text, runs=()), words=words, syllables=1,
        sentence_type="statement", ends_sentence=True,
    )  # fmt: skip


def test_an_accent_needs_a_content_word_that_the_voice_stresses() -> None:
    """As eSpeak NG says it: "went" without stress, "at it" as one word with some."""
    speech = spoken(("Alice", (0, 5), 1), ("went", (6, 10), 0), ("at it", (11, 16), 1), ("again", (17, 22), 1))
    assert [w.accent for w in accented(speech, written("Alice went at it again."), "en")] == [True, False, False, True]


def test_where_a_voice_gives_no_stress_content_words_bear_accents() -> None:
    speech = spoken(("Alice", (0, 5), 0), ("went", (6, 10), 0), ("at it", (11, 16), 2))
    assert [w.accent for w in accented(speech, written("Alice went at it."), "en")] == [True, True, False]


def test_without_a_table_stress_decides_alone() -> None:
    speech = spoken(("Alice", (0, 5), 1), ("went", (6, 10), 0), ("at it", (11, 16), 1))
    assert [w.accent for w in accented(speech, written("Alice went at it."), "xx")] == [True, False, True]


@pytest.mark.parametrize(
    ("told", "expected"),
    [
        ({"the": Told(accent="h*", pos="DT")}, (True, "h*", "DT")),
        ({"was": Told(accent="none")}, (False, "", "")),
        ({"was": Told(accent="none"), "the": Told(accent="l*")}, (True, "l*", "")),
        ({"was": Told(pos="VBD"), "the": Told(pos="DT")}, (False, "", "VBD")),
    ],
)
def test_what_is_told_of_one_of_merged_words_counts_for_both(
    told: dict[str, Told], expected: tuple[bool, str, str]
) -> None:
    speech = spoken(("was the", (0, 7), 0), ("garden", (8, 14), 1))
    word, garden = accented(speech, written("was the garden.", **told), "en")
    assert (word.accent, word.tone, word.pos) == expected
    assert garden.accent


def test_words_find_what_is_written() -> None:
    part = written("In 23 gardens - was the rose-tree.")
    names = ["In", "twenty", "three", "gardens", "was the", "rose-tree"]
    places = [(0, 2), (3, 5), (3, 5), (6, 13), (16, 23), (24, 33)]
    words = [Word(text=t, onset=0.0, duration=0.1, source=s) for t, s in zip(names, places, strict=True)]
    found = [[part.words[n].text for n in own] for own in owners(words, part.words)]
    assert found == [["In"], ["23"], ["23"], ["gardens"], ["was", "the"], ["rose", "tree"]]


def test_a_word_without_a_place_is_the_one_before() -> None:
    part = written("One two.")
    words = [
        Word(text=t, onset=0.0, duration=0.1, source=s) for t, s in (("One", (0, 3)), ("x", None), ("two", (4, 7)))
    ]
    assert [list(own) for own in owners(words, part.words)] == [[0], [0], [1]]
    assert owners(words, ()) == [range(0)] * 3


@EVERY
def test_another_way_of_speaking_cuts_no_phrase(model: str) -> None:
    said = score("<speak>I really <emphasis>love</emphasis> this little town :-) very much.</speak>", model)
    assert len(list(said.of(Utterance))) == 3
    assert phrases(said) == [("I really love this little town :-) very much.", 6, LOW, "final")]
    (whole,) = said.of(Phrase)
    first, *_, last = said.of(Utterance)
    assert whole.onset == first.onset
    assert whole.end == pytest.approx(last.onset + last.words[-1].onset + last.words[-1].duration, abs=2e-6)
    (smile,) = said.of(Emotion)
    assert (smile.onset, smile.phrases) == (whole.onset, (whole.id,))


@EVERY
def test_a_pause_between_utterances_ends_a_phrase(model: str) -> None:
    said = score("<speak>I really <break time='300ms'/> love <emphasis>this, yes</emphasis>, town.</speak>", model)
    assert [text for text, *_ in phrases(said)] == ["I really", "love this,", "yes,", "town."]


def test_a_question_is_told_by_its_beginning_in_another_utterance() -> None:
    said = score("<speak>And besides, what <emphasis>would</emphasis> be the use?</speak>")
    assert [p.tone for p in said.of(Phrase)] == [CONTINUING, LOW]


TEXTS = st.lists(
    st.tuples(
        st.sampled_from(["the", "garden", "who", "is", "23", "rose-tree", "Dr.", "it’s", "$5", "never", "e.g."]),
        st.sampled_from(["", "", "", "", ",", ";", " -", ".", "?", "!", "...", "\n", "\n\n", " _", ",\n", ".’"]),
    ),
    min_size=1,
    max_size=30,
)


@settings(max_examples=20, deadline=None)
@given(TEXTS, st.sampled_from(sorted(MODELS)), st.data())
def test_phrases_go_on_through_emphasis_and_cover_what_is_said(
    words: list[tuple[str, str]], model: str, data: st.DataObject
) -> None:
    """They cover every word of every utterance, ascending, without overlap."""
    marked = data.draw(st.lists(st.booleans(), min_size=len(words), max_size=len(words)))
    tagged = " ".join(
        f"<emphasis>{word}</emphasis>{mark}" if bold else word + mark
        for (word, mark), bold in zip(words, marked, strict=True)
    )
    said = score(f"<speak>It was {tagged}</speak>", model, poem=False)
    found = list(said.of(Phrase))
    for before, after in pairwise(found):
        assert before.end <= after.onset + 1e-9
        assert before.source[1] <= after.source[0] + 1
    for one in said.of(Utterance):
        for word in one.words:
            at = one.onset + word.onset
            (phrase,) = [p for p in found if p.onset - 1e-6 <= at < p.end - 1e-6]
            assert at + word.duration <= phrase.end + 2e-6
            assert word.source is not None and phrase.group == one.group
            assert phrase.source[0] <= word.source[0] and word.source[1] <= phrase.source[1]
    for phrase in found:
        inside = [u for u in said.of(Utterance) if phrase.onset - 1e-6 <= u.onset + 1e-6 < phrase.end]
        assert all(other.onset - one.end < ROUNDING for one, other in pairwise(inside))


@settings(max_examples=30, deadline=None)
@given(TEXTS, st.sampled_from(sorted(MODELS)), st.booleans())
def test_phrases_cover_what_is_said_and_never_overlap(words: list[tuple[str, str]], model: str, poem: bool) -> None:
    said = score("It was " + " ".join(word + mark for word, mark in words), model, poem=poem)
    found = list(said.of(Phrase))
    names = [event.id for event in said.events]
    assert len(names) == len(set(names))
    for before, after in pairwise(found):
        assert before.end <= after.onset + 1e-9
        assert before.source[1] <= after.source[0] + 1
    for one in said.of(Utterance):
        own = [p for p in found if one.onset - 1e-6 <= p.onset and p.end <= one.end + 1e-6]
        pauses = [p for p in said.of(Pause) if p.onset > one.onset and p.end < one.end]
        assert own and own[-1].end == pytest.approx(one.onset + one.words[-1].onset + one.words[-1].duration)
        for word in one.words:
            at = one.onset + word.onset
            (phrase,) = [p for p in own if p.onset - 1e-6 <= at < p.end - 1e-6]
            assert at + word.duration <= phrase.end + 2e-6
            assert word.source is not None and phrase.group == one.group
            assert phrase.source[0] <= word.source[0] and word.source[1] <= phrase.source[1]
        silent = [p for p in one.phones if not p.ipa and p.duration >= PAUSE - ROUNDING]
        assert [p.duration for p in pauses] == pytest.approx([p.duration for p in silent])
        assert all(any(abs(pause.onset - p.end) < 2e-6 for p in own) for pause in pauses)


@settings(max_examples=20, deadline=None)
@given(TEXTS, st.sampled_from(sorted(MODELS)))
def test_a_sentence_s_end_is_final_and_nothing_else(words: list[tuple[str, str]], model: str) -> None:
    text = "It was " + " ".join(word + mark for word, mark in words)
    script = read(text, language="en")
    finals = [p for p in score(text, model).of(Phrase) if p.position == "final"]
    assert [p.source[1] for p in finals] == [one.words[-1].source.end for one in script.sentences]
    assert [p.sentence_type for p in finals] == [one.type for one in script.sentences]
    assert all(p.break_index >= EDGES["sentence"].break_index for p in finals)


def test_phrases_are_the_same_whatever_comes_after() -> None:
    """Nothing that has been placed is changed by later text."""
    text = "One, two, three. Who came to see the garden? "
    first, whole = score(text), score(text + "And then they left, all of them.")
    assert phrases(whole)[: len(phrases(first)) - 1] == phrases(first)[:-1]
