"""The sentence: text is read, planned, spoken, and composed into a Score."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Sequence
from importlib import metadata

from scorebreath.compose.models import breathing_model
from scorebreath.compose.parts import closing
from scorebreath.compose.state import BodyState, Places, Spoken
from scorebreath.media.store import FolderStore, MediaStore
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, SyllableCounter, plan
from scorebreath.planning.planners import open_planner
from scorebreath.score.document import Body, Group, MediaInfo, Score, VoiceInfo
from scorebreath.score.events import Event, Pause
from scorebreath.script.model import Script, Sentence
from scorebreath.script.reader import read
from scorebreath.speech.model import Speech, SpeechRequest, Voice
from scorebreath.units import snap

BODY = "body"
"""Id of the only body of a compiled text."""

SENTENCES_AT_ONCE = 200
"""whose syllables a voice is asked for together"""

Progress = Callable[[float], None]


def compile_text(
    text: str,
    *,
    voice: Voice,
    media: MediaStore,
    parameters: Parameters | None = None,
    model: str = "natural",
    language: str = "en",
    poem: bool | None = None,
    seed: int = 0,
    lead: float = 0.5,
    tail: float = 1.0,
    file: str = "",
    on_progress: Progress | None = None,
) -> Score:
    """Turn a text into a Score.

    Args:
        text: What is to be said.
        voice: Who says it.
        media: Where the speech goes.
        parameters: Defaults where nothing is given.
        model: `natural`, `bernardet-2017` or `bernardet-2019`.
        language: BCP 47 primary language.
        poem: Whether line ends are phrase edges; None: as the text looks.
        seed: Of every chance.
        lead: Silence before the first breath, s.
        tail: Silence after the last event, s.
        file: Name of the text, for messages.
        on_progress: Told the fraction of the text that is done, 0..1.

    Returns:
        The Score; its samples are in `media`.

    Raises:
        InputError: The text, a parameter or a name is wrong.
        VoiceError: The voice failed.
    """
    p = parameters or Parameters()
    breathing = breathing_model(model)
    script = read(text, language=language, poem=poem, file=file)
    state = BodyState(body=BODY, seed=seed, parameters=p, person=breathing.person(p), time=snap(lead), volume=0.0)
    state = dataclasses.replace(state, volume=state.person.resting_volume)
    groups: list[Group] = []
    events: list[Event] = [_silence("start", 0.0, state.time)]
    sounds: dict[str, MediaInfo] = {}
    planned = plan_script(script, parameters=p, model=model, count=voice.syllables)
    for spoken in speak(planned, voice, media, p):
        groups.append(_group(spoken))
        sounds[spoken.media] = _media_info(spoken)
        state, placed = breathing.step(state, spoken)
        events += placed
        if on_progress:
            on_progress(spoken.group.source.end / len(script.text))
    state, placed = breathing.finish(state)
    events += [*placed, _silence("end", state.time, snap(tail))]
    details = voice.details
    return Score(
        made_by=made_by(),
        seed=seed,
        language=script.language,
        model=model,
        text=script.text,
        duration=snap(state.time + snap(tail)),
        bodies=(
            Body(
                id=BODY,
                voice=VoiceInfo(
                    engine=details.engine,
                    voice=details.voice,
                    version=details.version,
                    licence=details.licence,
                    sample_rate=details.sample_rate,
                    reference_db=snap(voice.reference_db),
                ),
                person=state.person,
                parameters=p.set_by_hand(),
            ),
        ),
        media=sounds,
        groups=tuple(groups),
        events=tuple(events),
    )


def plan_script(script: Script, *, parameters: Parameters, model: str, count: SyllableCounter) -> Iterator[BreathGroup]:
    """Breath groups of a script, as the model's planner cuts them (the papers' planners count with pyphen)."""
    planner = open_planner(model, parameters, script.language, count, poem=script.poem)
    return plan(planner, _counted(script.sentences, count))


def _counted(sentences: Sequence[Sentence], count: SyllableCounter) -> Iterator[Sentence]:
    """The sentences, their words counted many at a time: a voice that speaks answers a question only in between."""
    for first in range(0, len(sentences), SENTENCES_AT_ONCE):
        block = sentences[first : first + SENTENCES_AT_ONCE]
        count([spoken for sentence in block for word in sentence.words for spoken in word.words])
        yield from block


def speak(groups: Iterable[BreathGroup], voice: Voice, media: MediaStore, parameters: Parameters) -> Iterator[Spoken]:
    """Have each group spoken, its samples put into `media`; the voice works ahead of whoever takes them."""
    waiting: list[BreathGroup] = []

    def requests() -> Iterator[SpeechRequest]:
        before = ""
        for group in groups:
            waiting.append(group)
            yield SpeechRequest(
                text=group.spoken,
                closing=closing(group),
                rate=parameters.prosody_rate,
                pitch=parameters.prosody_pitch,
                before=before,
            )
            before = group.spoken.text

    places = Places()
    for number, speech in enumerate(voice.speak_all(requests()), 1):
        group = waiting.pop(0)
        name = media.put(speech.samples, speech.sample_rate, "speech")
        yield Spoken(group=group, id=f"{BODY}.g{number}", place=places.key(group.text), speech=speech, media=name)


def made_by() -> str:
    """Name and version of this program, as Scores carry it."""
    try:
        return f"scorebreath {metadata.version('scorebreath')}"
    except metadata.PackageNotFoundError:
        return "scorebreath"


def _group(spoken: Spoken) -> Group:
    group = spoken.group
    return Group(
        id=spoken.id,
        body=BODY,
        source=(group.source.start, group.source.end),
        text=group.text,
        syllables=group.syllables,
        sentence_type=group.sentence_type,
        cut=group.cut,
    )


def _media_info(spoken: Spoken) -> MediaInfo:
    speech: Speech = spoken.speech
    return MediaInfo(
        path=FolderStore.path(spoken.media, "speech"),
        frames=len(speech.samples),
        sample_rate=speech.sample_rate,
        kind="speech",
    )


def _silence(kind: str, onset: float, duration: float) -> Pause:
    return Pause(
        id=f"{BODY}.{kind}",
        body=BODY,
        onset=onset,
        duration=duration,
        rule=f"silence: {kind}",
        kind="start" if kind == "start" else "end",
    )
