"""The sentence: text in, Score out; the same Score whoever asks, whenever, and however the text arrives."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path

import pytest

from scorebreath.compose.models import MODELS, breathing_model
from scorebreath.ensemble import Ensemble
from scorebreath.errors import InputError
from scorebreath.media.store import FolderStore, MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text, speak
from scorebreath.planning.model import BreathGroup
from scorebreath.planning.planners import open_planner
from scorebreath.score.codec import dumps, loads
from scorebreath.score.document import Score
from scorebreath.score.events import Expiration, Hold, Inspiration, Utterance
from scorebreath.score.files import check_media
from scorebreath.script.reader import Reader
from scorebreath.speech.model import Voice
from scorebreath.speech.voices import open_voice

TEXT = (
    "Good evening. Low pressure moves in from the west tonight, and with it comes a band of heavy rain. "
    "By morning the rain will have reached the coast; inland, it stays dry until noon. "
    "Will it last? Not for long, since high pressure builds behind it.\n\n"
    "Tomorrow the wind turns north. Temperatures fall by 6 degrees, and there may be frost in the valleys."
)


@pytest.fixture(name="voice")
def tone() -> Iterator[Voice]:
    voice = open_voice("tone", "en")
    yield voice
    voice.close()


def compiled(voice: Voice, text: str = TEXT, model: str = "natural", seed: int = 0) -> Score:
    return compile_text(text, voice=voice, media=MemoryStore(), model=model, seed=seed)


@pytest.mark.parametrize("model", MODELS)
def test_a_compile_is_the_same_twice_and_survives_its_file(voice: Voice, model: str) -> None:
    once, again = compiled(voice, model=model), compiled(voice, model=model)
    assert dumps(once) == dumps(again)
    assert loads(dumps(once)) == once
    assert once.model == model


@pytest.mark.parametrize("model", MODELS)
def test_every_word_is_said_once_in_order(voice: Voice, model: str) -> None:
    score = compiled(voice, model=model)
    assert score.groups[0].source[0] == 0
    assert score.groups[-1].source[1] == len(TEXT)
    for before, after in zip(score.groups, score.groups[1:], strict=False):
        assert TEXT[before.source[1] : after.source[0]].strip() == ""
    assert all(TEXT[slice(*group.source)] == group.text for group in score.groups)
    spoken = [word.source for utterance in score.of(Utterance) for word in utterance.words if word.source]
    assert spoken == sorted(spoken)
    assert "".join(TEXT[a:b] for a, b in spoken).count("pressure") == 2


@pytest.mark.parametrize("model", MODELS)
def test_a_group_is_a_breath_and_what_is_said_on_it(voice: Voice, model: str) -> None:
    score = compiled(voice, model=model)
    for group in score.groups:
        mine = [event for event in score.events if event.group == group.id]
        breath = next(event for event in mine if isinstance(event, Inspiration))
        speech = next(event for event in mine if isinstance(event, Utterance))
        out = next(event for event in mine if isinstance(event, Expiration))
        assert breath.end <= speech.onset + 1e-6
        assert (out.onset, out.duration) == (speech.onset, speech.duration)
        assert speech.media in score.media
    assert max(event.end for event in score.events) == pytest.approx(score.duration)


def said(score: Score) -> list[str]:
    return [word.text for utterance in score.of(Utterance) for word in utterance.words]


def test_seeds_move_breaths_and_nothing_said(voice: Voice) -> None:
    one, two = compiled(voice, seed=1), compiled(voice, seed=2)
    assert one.text == two.text
    assert said(one) == said(two)
    assert [e.duration for e in one.of(Inspiration)] != [e.duration for e in two.of(Inspiration)]


def test_an_inserted_sentence_changes_no_other_draws(voice: Voice) -> None:
    inserted = TEXT.replace("Will it last?", "Nobody minds that at all. Will it last?")

    def draws(score: Score) -> dict[str, tuple[int, float]]:
        text = {group.id: group.text for group in score.groups}
        return {
            text[e.group]: (e.noise.seed, e.duration) for e in score.of(Inspiration) if e.noise and e.group is not None
        }

    before, after = draws(compiled(voice)), draws(compiled(voice, text=inserted))
    shared = before.keys() & after.keys()
    assert len(shared) >= len(before) - 2
    assert {key: before[key][0] for key in shared} == {key: after[key][0] for key in shared}
    # lengths also follow the lungs, which carry over what the group before has left
    earlier = [key for key in shared if TEXT.index(key) < TEXT.index("Will it last?")]
    assert earlier and all(after[key] == before[key] for key in earlier)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("size", [1, 7, 100])
def test_text_that_arrives_in_pieces_makes_the_same_events(voice: Voice, model: str, size: int) -> None:
    whole = compiled(voice, model=model)
    breathing, p = breathing_model(model), Parameters()
    reader, planner = Reader(language="en", poem=False), open_planner(model, p, "en", voice.syllables)

    def arriving() -> Iterator[BreathGroup]:
        for at in range(0, len(TEXT), size):
            for sentence in reader.feed(TEXT[at : at + size]):
                yield from planner.feed(sentence)
        for sentence in reader.finish():
            yield from planner.feed(sentence)
        yield from planner.finish()

    ensemble = Ensemble(
        breathing=breathing, voice=voice, voices=None, parameters=p, cast={}, language="en", seed=0, recordings=None
    )
    ensemble.begin(0.5, ())
    for spoken in speak(arriving(), ensemble.performer, MemoryStore(), language="en", moved=True):
        ensemble.step(spoken)
    assert ensemble.finish(1.0) == whole.duration
    assert tuple(ensemble.events()) == whole.events


def test_lungs_are_accounted_for_from_the_first_breath_to_the_last(voice: Voice) -> None:
    score = compiled(voice)
    volume, time = score.bodies[0].person.resting_volume, 0.0
    breathing = [e for e in score.events if isinstance(e, (Inspiration, Expiration, Hold))]
    for event in sorted(breathing, key=lambda e: (e.onset, e.end)):
        assert event.onset == pytest.approx(time, abs=5e-6)
        before = event.volume if isinstance(event, Hold) else event.from_volume
        assert before == volume
        volume = event.volume if isinstance(event, Hold) else event.to_volume
        time = event.end
    assert volume == score.bodies[0].person.resting_volume


def test_parameters_set_by_hand_are_the_scores_provenance(voice: Voice) -> None:
    p = Parameters(nose_share=1.0, prosody_loudness=50.0)
    score = compile_text(TEXT, voice=voice, media=MemoryStore(), parameters=p)
    assert score.bodies[0].parameters == {"nose_share": 1.0, "prosody_loudness": 50.0}
    assert {e.sound_mouth for e in score.of(Inspiration)} == {0.0}
    assert {e.gain_db for e in score.of(Utterance)} == {-6.0206}


def test_media_lie_where_the_score_says(voice: Voice, tmp_path: Path) -> None:
    media = FolderStore(tmp_path)
    score = compile_text(TEXT, voice=voice, media=media)
    check_media(score, media)
    assert all((tmp_path / info.path).is_file() for info in score.media.values())
    broken = dataclasses.replace(next(iter(score.media.values())), frames=1)
    with pytest.raises(Exception, match="frames"):
        check_media(dataclasses.replace(score, media=dict.fromkeys(score.media, broken)), media)


def test_progress_rises_to_the_end(voice: Voice) -> None:
    told: list[float] = []
    compile_text(TEXT, voice=voice, media=MemoryStore(), on_progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0


@pytest.mark.parametrize("text", ["", "  \n ", "... !!! ---", "_ _", "🙂🙂" * 3][:4])
def test_nothing_to_say_is_one_clear_error(voice: Voice, text: str) -> None:
    with pytest.raises(InputError, match="speak"):
        compiled(voice, text=text)


def test_an_unknown_model_is_refused(voice: Voice) -> None:
    with pytest.raises(InputError, match="bernardet-2019"):
        compiled(voice, model="bernardet-2018")


def test_a_text_is_read_in_the_only_language_of_its_voice() -> None:
    """Unless somebody says another; a voice of any language leaves it English."""
    text = "Der Mann geht um 3."
    with open_voice("espeak:de", "de") as german, open_voice("tone", "en") as tone:
        own = compile_text(text, voice=german, media=MemoryStore())
        assert own.language == "de" and not next(own.of(Utterance)).words[0].accent
        assert compile_text(text, voice=german, media=MemoryStore(), language="en").language == "en"
        told = "<speak version='1.1' xmlns='http://www.w3.org/2001/10/synthesis' xml:lang='en'>One.</speak>"
        assert compile_text(told, voice=german, media=MemoryStore()).language == "en"
        assert compile_text(text, voice=tone, media=MemoryStore()).language == "en"
