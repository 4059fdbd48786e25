"""Emotions of a whole text: S3's poem and its English line, their breath, and what the text itself asks for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest

from scorebreath.compose.natural import surprise
from scorebreath.curves import curves
from scorebreath.curves.channels import CHANNELS
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import begin_states, compile_text, plan_script
from scorebreath.planning.syllables import pyphen_counter
from scorebreath.score.document import Score
from scorebreath.score.events import Blink, Emotion, Hold, Inspiration, Marker, Phrase, State, Utterance, WarningEvent
from scorebreath.script.emotional import breathing, with_breathing
from scorebreath.script.marks import EmotionMark, StateMark
from scorebreath.script.model import Script
from scorebreath.script.reader import read
from scorebreath.script.sentence import hanging
from scorebreath.speech.model import Voice
from scorebreath.speech.voices import open_voice

EXAMPLES = Path(__file__).parents[2] / "examples"
POEM = (EXAMPLES / "parallelen_emoticons.txt").read_text(encoding="utf-8")
PLAIN = (EXAMPLES / "parallelen.txt").read_text(encoding="utf-8")
HALL = "Hi! ;-) Can you show me the way to the conference hall? :-)"
MODELS = ("natural", "bernardet-2017", "bernardet-2019")


@pytest.fixture(scope="module", name="german")
def espeak_german() -> Iterator[Voice]:
    with open_voice("espeak:de", "de") as voice:
        yield voice


@pytest.fixture(scope="module", name="english")
def espeak_english() -> Iterator[Voice]:
    with open_voice("espeak:en-us", "en") as voice:
        yield voice


@pytest.fixture(scope="module", name="poem", params=MODELS)
def compiled(request: pytest.FixtureRequest, german: Voice) -> Score:
    return compile_text(POEM, voice=german, media=MemoryStore(), language="de", model=request.param)


def felt(score: Score) -> list[Emotion]:
    return sorted(score.of(Emotion), key=lambda emotion: emotion.onset + emotion.apex)


def text_of(score: Score, emotion: Emotion) -> list[str]:
    phrases = {phrase.id: phrase for phrase in score.of(Phrase)}
    return [score.text[slice(*phrases[each].source)] for each in emotion.phrases]


def times(score: Score, word: str, number: int = 0) -> tuple[float, float]:
    """When a word is said, the n-th of that name."""
    said = sorted(
        (u.onset + w.onset, u.onset + w.onset + w.duration)
        for u in score.of(Utterance)
        for w in u.words
        if w.text.strip(".,:;!?").lower() == word.lower()
    )
    return said[number]


def test_the_poem_smiles_where_the_paper_says(poem: Score) -> None:
    """A40-A44; S3 Table 1."""
    kidding, *others = felt(poem)
    assert (kidding.name, kidding.intensity) == ("kidding", 1.0)
    assert kidding.onset == pytest.approx(times(poem, "ins")[0], abs=0.03)
    assert kidding.onset + kidding.apex == pytest.approx(times(poem, "ins")[1], abs=0.03)
    assert kidding.end == pytest.approx(times(poem, "hinaus")[1], abs=0.03)
    (wink,) = [event for event in poem.of(Blink) if event.left != event.right and event.rule.startswith("A40")]
    assert wink.onset + wink.close == pytest.approx(kidding.onset + kidding.apex)
    first, second = [emotion for emotion in others if emotion.name == "sad"]
    assert text_of(poem, first) == ["Sie wollten sich nicht :-( schneiden"]
    before, after = text_of(poem, second)
    assert "bis an ihr seliges Grab:".endswith(before)  # bernardet-2017 breathes before "Grab"
    assert len(before) == 24 or poem.model == "bernardet-2017"
    assert after == "Das war nun einmal der beiden"
    assert second.onset + second.apex == pytest.approx(times(poem, "Grab")[1], abs=0.03)
    assert [emotion.name for emotion in others] == ["sad", "sad", "surprised", "surprised", "happy"]
    last = others[-1]
    assert last.onset + last.apex == pytest.approx(times(poem, "Seraphim")[1], abs=0.03)
    assert last.duration - last.apex == pytest.approx(min(0.5, poem.duration - last.onset - last.apex), abs=0.02)


def test_no_emotion_of_the_poem_steps(poem: Score) -> None:
    """Sampled: it never changes faster than its least ramp allows."""
    rate = 200
    times = np.arange(int(poem.duration * rate) + 1) / rate
    shown = curves(poem).sample(times, [f"emotion_{name}" for name in ("kidding", "sad", "surprised", "happy")])
    assert (shown.max(axis=0) > 0.97).all()
    assert np.abs(np.diff(shown, axis=0)).max() <= 1.0 / (0.15 * rate) + 1e-6
    assert not shown[0].any()
    assert not shown[-1].any()


@pytest.mark.parametrize("model", MODELS)
def test_emoticons_change_no_breath_group(model: str) -> None:
    """A11: with the breath left alone, the poem is planned as if they were not there."""
    count = pyphen_counter("de")
    planned = [
        [
            [word.text for word in group.words]
            for group in plan_script(
                read(text, language="de"), parameters=Parameters(emotion_breath=0.0), model=model, count=count
            )
        ]
        for text in (POEM, PLAIN, POEM.replace(":-(", "😭").replace(";-)", "😉").replace(":-o", "o_o"))
    ]
    assert planned[0] == planned[1] == planned[2]


def test_the_papers_models_are_not_moved(german: Voice) -> None:
    scores = [
        compile_text(
            POEM, voice=german, media=MemoryStore(), language="de", model="bernardet-2019",
            parameters=Parameters(emotion_breath=share),
        )
        for share in (0.0, 1.0)
    ]  # fmt: skip
    assert scores[0].events == scores[1].events
    assert not [event for event in scores[1].events if isinstance(event, State | WarningEvent)]


def test_the_english_line_winks_and_smiles(english: Voice) -> None:
    """S3 6.2, figure 3."""
    score = compile_text(HALL, voice=english, media=MemoryStore())
    kidding, happy = felt(score)
    assert (kidding.name, happy.name) == ("kidding", "happy")
    assert len(kidding.phrases) == 2
    assert kidding.onset + kidding.apex == pytest.approx(times(score, "hi")[1], abs=0.03)
    assert [event.rule for event in score.of(Blink) if event.left == 0.0] == ["A40: winks at ;-)"]
    assert happy.onset + happy.apex == pytest.approx(times(score, "hall")[1], abs=0.03)
    assert len({event.id for event in score.events}) == len(score.events)


def test_an_emotion_belongs_to_whoever_spoke(english: Voice) -> None:
    text = "I am glad. :-) [voice other] I am not at all. :-( [/voice] Well, that is sad."
    score = compile_text(text, voice=english, media=MemoryStore(), voices=lambda _: english)
    assert sorted((emotion.body, emotion.name) for emotion in score.of(Emotion)) == [
        ("body", "happy"),
        ("body2", "sad"),
    ]
    (sad,) = [emotion for emotion in score.of(Emotion) if emotion.body == "body2"]
    assert sad.duration - sad.apex == pytest.approx(0.5)
    for body in score.bodies:
        assert not _left_on(event for event in score.of(State) if event.body == body.id)


def _left_on(states: Iterator[State]) -> set[str]:
    last = {state.name: state.target for state in sorted(states, key=lambda state: state.onset)}
    return {name for name, target in last.items() if target}


def test_the_breath_goes_with_the_emotion_and_comes_back(german: Voice) -> None:
    """B60."""
    score = compile_text(POEM, voice=german, media=MemoryStore(), language="de")
    assert not _left_on(iter(score.of(State)))
    assert {state.name for state in score.of(State)} == {"kidding", "sad", "surprised", "happy"}
    assert {state.target for state in score.of(State)} == {0.0, 0.6}
    still = compile_text(
        POEM, voice=german, media=MemoryStore(), language="de", parameters=Parameters(emotion_breath=0.0)
    )
    assert not list(still.of(State))
    before = [event.end for event in score.of(Inspiration)]
    held = [event for event in score.of(Hold) if event.rule == "physiology 4.2: holds at surprise"]
    assert held
    assert all(min(abs(event.onset - end) for end in before) < 1e-5 for event in held)
    assert not [event for event in still.of(Hold) if event.kind == "held"]


@pytest.mark.parametrize("seed", range(5))
def test_the_breath_is_held_at_surprise_whatever_chance_says(english: Voice, seed: int) -> None:
    text = "I thought so too. :-o But then the door opened by itself, and nobody was there."
    for share, surely in ((0.6, True), (0.0, False)):
        score = compile_text(
            text, voice=english, media=MemoryStore(), seed=seed, parameters=Parameters(emotion_breath=share)
        )
        (group,) = [one for one in score.groups if "But" in one.text]
        (said,) = [event for event in score.of(Utterance) if "But" in {word.text for word in event.words}]
        held = [event for event in score.of(Hold) if event.kind == "held" and event.end <= said.onset + 1e-5]
        assert group.text
        assert bool(held) == surely


def test_where_surprise_is_before_a_group() -> None:
    def how_much(text: str) -> float:
        p, count = Parameters(emotion_breath=0.5), pyphen_counter("en")
        groups = plan_script(read(text), parameters=p, model="natural", count=count)
        return surprise(p, next(groups))

    assert how_much("😯 But then, it was so.") == 0.4
    assert how_much("But :-o then, it was so.") == 0.5
    assert how_much("But then, :-o it was so.") == 0.5
    assert how_much("But then, it was :-o so.") == 0.0
    assert how_much("But :-) then, it was so.") == 0.0


def states(script: Script) -> list[tuple[str, float, str]]:
    """Changes of state: name, intensity, the word before."""
    shown = []
    before = ""
    for sentence in script.sentences:
        shown += [(mark.name, mark.intensity, before) for mark in sentence.before if isinstance(mark, StateMark)]
        for word in sentence.words:
            before = word.text
            shown += [(mark.name, mark.intensity, before) for mark in word.after if isinstance(mark, StateMark)]
    return shown


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("So it :-) is, I see.", [("happy", 0.5, ""), ("happy", 0.0, "is")]),
        ("So it is. And :-| it was. It is.", [("disgusted", 0.5, "is"), ("disgusted", 0.0, "was")]),
        ("So it is, 😨 I see, and so.", [("anxious", 0.5, ""), ("anxious", 0.0, "see")]),
        ("So it is. :-)", [("happy", 0.5, ""), ("happy", 0.0, "is")]),
        (":-) So it is, I see.", [("happy", 0.5, ""), ("happy", 0.0, "is")]),
        ("So :-) it is. :-( Now then.", [("sad", 0.5, ""), ("sad", 0.0, "then")]),
        ("So :-) it is. 😔 Now then.", [("happy", 0.5, ""), ("sad", 0.35, "is"), ("sad", 0.0, "then")]),
        ("So 😢 it is. :-( Now then.", [("sad", 0.5, ""), ("sad", 0.0, "then")]),
        ("So 🙂 it 😢 is.", [("sad", 0.4, ""), ("sad", 0.0, "is")]),
        ("[state calm] So :-) it is. [/state] Now :-) so.",
         [("calm", 1.0, ""), ("neutral", 1.0, "is"), ("happy", 0.5, "is"), ("happy", 0.0, "so")]),
        ("So :-) it [calm 0.2] is. Now :-) so.", [("calm", 0.2, "it")]),
        ("[exertion] So :-) it is.", [("exertion", 1.0, ""), ("happy", 0.5, ""), ("happy", 0.0, "is")]),
        ("So it is. :-) [state sad] Now so.", [("happy", 0.5, ""), ("happy", 0.0, "is"), ("sad", 1.0, "is")]),
        ("So it is. :-) [/state] Now so.",
         [("happy", 0.5, ""), ("neutral", 1.0, "is"), ("happy", 0.5, "is"), ("happy", 0.0, "so")]),
        ("So it :-) is. [voice b] Well now. :-( [/voice] I see.",
         [("happy", 0.5, ""), ("happy", 0.0, "is"), ("sad", 0.5, "is"), ("sad", 0.0, "now")]),
        ("Well. [voice b] I. :-( [/voice] So.", [("sad", 0.5, "Well"), ("sad", 0.0, "I")]),
        ("So it is. :-) [pause 6] Now so.", [("happy", 0.5, ""), ("happy", 0.0, "is")]),
        ("So it is. [pause 6] :-) Now so.", [("happy", 0.5, "is"), ("happy", 0.0, "so")]),
        ("So it is. :-) [pause 1] Now so.", [("happy", 0.5, ""), ("happy", 0.0, "so")]),
        ("So it is.", []),
    ],
)  # fmt: skip
def test_states_of_emotions(text: str, expected: Sequence[tuple[str, float, str]]) -> None:
    script = read(text)
    moved = with_breathing(script, 0.5)
    assert states(moved) == list(expected)
    assert [mark for mark in moved.marks if isinstance(mark, EmotionMark)] == [
        mark for mark in script.marks if isinstance(mark, EmotionMark)
    ]
    assert list(moved.marks) == [mark for sentence in moved.sentences for mark in hanging(sentence)]
    assert [mark.at for mark in moved.marks] == sorted(mark.at for mark in moved.marks)
    assert with_breathing(script, 0.0) == script
    assert tuple(breathing(iter(script.sentences), 0.5)) == moved.sentences


def test_states_from_the_beginning_are_the_users() -> None:
    script = read("So :-) it is.")
    assert with_breathing(script, 0.5, begin_states({"sad": 1.0})) == script
    assert states(with_breathing(script, 0.5, begin_states({"fatigue": 1.0})))


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("sign", ["SIGN", "SIGN [pause 0.5]", "SIGN [breath]"])
def test_before_a_long_rest_it_is_what_was_said_that_is_felt(english: Voice, model: str, sign: str) -> None:
    """A42; the order of the text decides."""
    for mark, name in ((":-)", "happy"), ("[emotion happy]", "happy"), (";-)", "kidding")):
        text = f"Hello there. {sign.replace('SIGN', mark)} [pause 6] Second one."
        score = compile_text(text, voice=english, media=MemoryStore(), model=model)
        (emotion,) = felt(score)
        assert emotion.name == name
        assert text_of(score, emotion) == ["Hello there."]
        assert emotion.onset + emotion.apex == pytest.approx(times(score, "there")[1], abs=0.03)
        winks = [event for event in score.of(Blink) if event.rule.startswith("A40")]
        assert all(wink.onset < times(score, "there")[1] for wink in winks)
        assert len(winks) == (name == "kidding")


@pytest.mark.parametrize("model", MODELS)
def test_behind_a_long_rest_it_is_what_will_be_said_that_is_felt(english: Voice, model: str) -> None:
    score = compile_text("Hello. [pause 6] :-) Second one. So.", voice=english, media=MemoryStore(), model=model)
    (emotion,) = felt(score)
    assert text_of(score, emotion) == ["Second one."]
    assert emotion.onset + emotion.apex == pytest.approx(times(score, "second")[0], abs=0.03)
    both = "Hello. :-) [pause 6] :-( Second one."
    score = compile_text(both, voice=english, media=MemoryStore(), model=model)
    assert [(each.name, text_of(score, each)) for each in felt(score)] == [
        ("happy", ["Hello."]), ("sad", ["Second one."]),
    ]  # fmt: skip


def test_before_a_rest_of_ssml_it_is_what_was_said_that_is_felt(english: Voice) -> None:
    text = "<speak>Hello :-). <break time='6s'/> Second one.</speak>"
    score = compile_text(text, voice=english, media=MemoryStore())
    (emotion,) = felt(score)
    assert text_of(score, emotion)[0].startswith("Hello")
    assert len(emotion.phrases) == 1


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(
    "text",
    [
        "Hello SIGN there, my dear old friend SIGN. It is SIGN, I see, a fine day! SIGN So are we.",
        "SIGN Well now. SIGN [sigh] So it was SIGN [mark a] [pause 0.3] and it is. SIGN [mark b]",
        "He said “no SIGN” again (and SIGN again). SIGN [breath] Then “SIGN go” it was.",
    ],
)
def test_without_their_share_of_the_breath_emoticons_change_none(english: Voice, model: str, text: str) -> None:
    """Chance knows the words alone."""

    def breath(written: str) -> list[tuple[object, ...]]:
        p = Parameters(emotion_breath=0.0, emotion_voice=0.0)
        score = compile_text(written, voice=english, media=MemoryStore(), model=model, parameters=p, seed=3)
        shown = [*score.of(Inspiration), *score.of(Hold), *score.of(Utterance), *score.of(Marker)]
        return [
            (event.onset, event.duration, getattr(event, "volume", None), getattr(event, "noise", None))
            for event in sorted(shown, key=lambda event: event.id)
        ]

    assert breath(text.replace("SIGN", ":-)")) == breath(" ".join(_bare(text).split()))


def _bare(text: str) -> str:
    """A text without its places for signs."""
    for written, bare in ((" SIGN", ""), ("SIGN ", ""), ("SIGN", "")):
        text = text.replace(written, bare)
    return text


def test_a_state_of_one_voice_goes_with_its_phrase(english: Voice) -> None:
    text = "One is good. :-) <voice name='other'>Two is not. :-(</voice> Three."
    score = compile_text(f"<speak>{text}</speak>", voice=english, media=MemoryStore(), voices=lambda _: english)
    for body, name, first in (("body", "happy", "one"), ("body2", "sad", "two")):
        on, off = [state for state in score.of(State) if state.body == body and state.name == name]
        phrase = next(phrase for phrase in score.of(Utterance) if phrase.words[0].text.lower() == first)
        assert (on.target > 0.0, off.target) == (True, 0.0)
        assert on.onset <= phrase.onset
        assert off.onset >= phrase.end


def test_a_state_ends_for_the_voice_that_has_it(english: Voice) -> None:
    text = "[sad] One is bad. [sad 0] [voice other] Two is not. [/voice] Three."
    score = compile_text(text, voice=english, media=MemoryStore(), voices=lambda _: english)
    assert {state.body for state in score.of(State)} == {"body"}
    assert not _left_on(iter(score.of(State)))


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(("text", "names"), [(":-)", ["happy"]), ("[sigh] ;-) :-(", ["kidding", "sad"])])
def test_a_face_needs_no_words_to_feel(text: str, names: list[str], model: str) -> None:
    with open_voice("tone", "en") as voice:
        score = compile_text(text, voice=voice, media=MemoryStore(), model=model, tail=0.0)
    felt = list(score.of(Emotion))
    assert [event.name for event in felt] == names
    assert all(event.apex == 0.5 and event.duration == 1.0 for event in felt)
    assert max(event.end for event in felt) <= score.duration
    assert [event.right for event in score.of(Blink) if event.left == 0.0] == [1.0] * ("kidding" in names)


@pytest.mark.parametrize("seed", [54, 57, 59])
def test_no_blink_comes_into_the_way_of_a_wink_without_words(seed: int) -> None:
    with open_voice("tone", "en") as voice:
        score = compile_text(";-) :-( ;-)", voice=voice, media=MemoryStore(), seed=seed)
    blinks = list(score.of(Blink))
    winks = [event for event in blinks if event.left == 0.0]
    assert len(winks) == 2
    for wink in winks:
        assert [other for other in blinks if other.onset < wink.end and wink.onset < other.end] == [wink]


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("It was so (:D) then we left.", "It was so then we left."),
        ("It was so [:-)] then we left.", "It was so then we left."),
        ("It was so ( :-) ) then we left.", "It was so then we left."),
        ("It was so (:-)) then we left.", "It was so then we left."),
        ("It was so :-). then we left.", "It was so then we left."),
        ("It was so :-) . then we left.", "It was so then we left."),
        ("It was so :-). Then we left.", "It was so. Then we left."),
        ("It was so :-)! then we left.", "It was so then we left."),
        ("It was so :-)... then we left.", "It was so then we left."),
        ("It was so.:-) Then we left.", "It was so. Then we left."),
        ("It was so.😃 Then we left.", "It was so. Then we left."),
        ("Was it so?😃 Then we left.", "Was it so? Then we left."),
        ("We laughed (again :-)) and left.", "We laughed (again) and left."),
        ("It was fun :-)) and we left.", "It was fun and we left."),
    ],
)
def test_marks_around_an_emoticon_make_no_phrase(text: str, plain: str, english: Voice) -> None:
    """A9, and the brackets of a remark that one ends stay a pair."""
    p = Parameters(emotion_voice=0.0)
    written, bare = (compile_text(each, voice=english, media=MemoryStore(), parameters=p) for each in (text, plain))
    assert [e.name for e in written.of(Emotion)] == ["happy"]
    assert len(list(written.of(Phrase))) == len(list(bare.of(Phrase)))
    assert [said.duration for said in written.of(Utterance)] == [said.duration for said in bare.of(Utterance)]


CROWDED = (
    "Really?! :-o Bob :-( maps; Pop ;-) pumps >:-< Mum? :-o No! Why? :-) Er, uhm, [pause 0.8] peppermint 😱 bumped "
    "[gasp] me. Am I? :-P [sigh] Yes."
)


@pytest.mark.parametrize(("often", "seed"), [(3, 3), (1, 0)])
def test_a_crowd_of_emotions_ends_and_keeps_the_speeds(often: int, seed: int, english: Voice) -> None:
    """A blink that no wink leaves room for comes later, and is not tried at one place for ever."""
    text = " ".join([CROWDED] * often)
    p = Parameters(prosody_rate=2.0)
    score = compile_text(text, voice=english, media=MemoryStore(), parameters=p, seed=seed)
    table = [channel for channel in CHANNELS if channel.speed]
    values = curves(score).sample(np.arange(0, score.duration, 1 / 500), [channel.name for channel in table])
    fastest = np.abs(np.diff(values, axis=0)).max(axis=0) * 500
    assert all(speed <= (channel.speed or 0.0) for channel, speed in zip(table, fastest, strict=True))


def test_a_sign_between_words_that_the_voice_merges_stands_between_them(english: Voice) -> None:
    """eSpeak says "I am" and "in the" as one word each; the climax is within it, at a phone's boundary (A19, A41)."""
    score = compile_text("I :-) am happy; we were in :-( the garden.", voice=english, media=MemoryStore())
    merged = [(said, word) for said in score.of(Utterance) for word in said.words if " " in word.text]
    assert [word.text for _, word in merged] == ["I am", "in the"]
    for (said, word), feeling in zip(merged, felt(score), strict=True):
        begin = said.onset + word.onset
        climax = feeling.onset + feeling.apex
        assert begin + 0.02 < climax < begin + word.duration - 0.02
        edges = [said.onset + phone.onset for phone in said.phones]
        assert min(abs(climax - edge) for edge in edges) < 2e-6
