"""The sentence: text is read, planned, spoken, and composed into a Score."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from importlib import metadata

from scorebreath.compose.models import breathing_model
from scorebreath.compose.speaking import Speaking, media_info
from scorebreath.compose.state import Places, Spoken
from scorebreath.ensemble import BODY, Ensemble, Performer
from scorebreath.media.recordings import Recordings
from scorebreath.media.store import FolderStore, MediaStore
from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, SyllableCounter, plan
from scorebreath.planning.planners import open_planner
from scorebreath.score.document import Group, MediaInfo, Score
from scorebreath.score.events import Event, Expiration, Hold, Inspiration
from scorebreath.script import emoticons
from scorebreath.script.emotional import with_breathing
from scorebreath.script.marks import StateMark
from scorebreath.script.markup.marked import Marked, Markup, marked
from scorebreath.script.model import Script, Sentence
from scorebreath.script.reader import read
from scorebreath.speech.model import SpeechRequest, Voice

SENTENCES_AT_ONCE = 200
"""whose syllables a voice is asked for together"""

Progress = Callable[[float], None]


def compile_text(
    text: str | Marked,
    *,
    voice: Voice,
    media: MediaStore,
    parameters: Parameters | None = None,
    model: str = "natural",
    language: str | None = None,
    poem: bool | None = None,
    seed: int = 0,
    lead: float = 0.5,
    tail: float = 1.0,
    file: str = "",
    markup: Markup = "auto",
    states: Mapping[str, float] | None = None,
    voices: Callable[[str], Voice] | None = None,
    cast: Mapping[str, Parameters] | None = None,
    recordings: Recordings | None = None,
    on_progress: Progress | None = None,
) -> Score:
    """Turn a text into a Score.

    Args:
        text: What is to be said; or with its markup taken out already, by `script.markup.marked`.
        voice: Who says it.
        media: Where the speech goes.
        parameters: Defaults where nothing is given.
        model: `natural`, `bernardet-2017` or `bernardet-2019`.
        language: BCP 47 primary language; None: what the text's markup says, or the only one the voice speaks, or
            English.
        poem: Whether line ends are phrase edges; None: as the text looks.
        seed: Of every chance.
        lead: Time before the first breath, s.
        tail: Time after the body has come back to rest, s.
        file: Name of the text, for messages.
        markup: What stands in the text besides words: `tags`, `ssml`, `maryxml`, `none`; `auto`: as it looks.
        states: States the body is in from the beginning, with their intensities (`parameters.states`); none fades by
            itself.
        voices: Opens a voice by its name, for texts that change the voice; the caller closes it.
        cast: Parameters of those who speak with another voice, by the voice's name; else as the first one's.
        recordings: The user's own breaths, in `media`.
        on_progress: Told the fraction of the text that is done, 0..1.

    Returns:
        The Score; its samples are in `media`. The body that begins is `body`, others are `body2`, `body3`, ...

    Raises:
        InputError: The text, a parameter or a name is wrong.
        VoiceError: The voice failed.
    """
    p = parameters or Parameters()
    breathing = breathing_model(model)
    if language is None:
        text = text if isinstance(text, Marked) else marked(text, markup=markup, file=file)
        language = text.language or voice.details.language or None
    script = read(text, language=language, poem=poem, file=file, markup=markup)
    begun = begin_states(states or {})
    ensemble = Ensemble(
        breathing=breathing, voice=voice, voices=voices, parameters=p, cast=cast or {}, language=script.language,
        seed=seed, recordings=recordings,
    )  # fmt: skip
    ensemble.begin(lead, begun)
    groups: list[Group] = []
    sounds: dict[str, MediaInfo] = {}
    planned = plan_script(script, parameters=p, model=model, count=voice.syllables, states=begun, seed=seed, cast=cast)
    for spoken in speak(planned, ensemble.performer, media, language=script.language, moved=breathing.has_states):
        who = ensemble.step(spoken)
        groups.append(group_of(spoken, who.state.body))
        sounds.update((said.media, media_info(said)) for said in spoken.parts)
        if on_progress:
            on_progress(min(1.0, spoken.group.source.end / len(script.text)))
    if not groups:
        ensemble.act(script.marks)
    end = ensemble.finish(tail)
    events = tuple(ensemble.events())
    return Score(
        made_by=made_by(),
        seed=seed,
        language=script.language,
        model=model,
        text=script.text,
        duration=end,
        bodies=tuple(who.body() for who in ensemble.performers.values()),
        media=sounds | breath_media(events, recordings),
        groups=tuple(groups),
        events=events,
    )


def begin_states(states: Mapping[str, float]) -> tuple[StateMark, ...]:
    """Marks that put a body into states from the beginning and keep it there; a tag in the text can end them."""
    return tuple(
        StateMark(at=0, written=f"state {name}", name=name, intensity=intensity, ramp=0.0, held=True)
        for name, intensity in states.items()
    )


def plan_script(
    script: Script,
    *,
    parameters: Parameters,
    model: str,
    count: SyllableCounter,
    states: Sequence[StateMark] = (),
    seed: int = 0,
    cast: Mapping[str, Parameters] | None = None,
) -> Iterator[BreathGroup]:
    """Breath groups of a script, as the model's planner cuts them (the papers' planners count with pyphen).

    Where the model has states, emotions move the breath (`emotion_breath`).
    """
    if breathing_model(model).has_states:
        script = with_breathing(script, parameters.emotion_breath, states)
    blend = Blend()
    for mark in states:
        blend, _ = blend.changed(0.0, mark.name, mark.intensity, mark.ramp, held=mark.held)
    planner = open_planner(
        model, parameters, script.language, count, poem=script.poem, blend=blend, seed=seed, body=BODY, cast=cast
    )
    return plan(planner, _counted(script.sentences, count))


def _counted(sentences: Sequence[Sentence], count: SyllableCounter) -> Iterator[Sentence]:
    """The sentences, their words counted many at a time: a voice that speaks answers a question only in between."""
    for first in range(0, len(sentences), SENTENCES_AT_ONCE):
        block = sentences[first : first + SENTENCES_AT_ONCE]
        count([spoken for sentence in block for word in sentence.words for spoken in word.words])
        yield from block


def speak(
    groups: Iterable[BreathGroup],
    performer: Callable[[str], Performer],
    media: MediaStore,
    *,
    language: str,
    moved: bool,
) -> Iterator[Spoken]:
    """Have each group spoken by its performer, its samples put into `media`.

    A voice works ahead of whoever takes what it says.

    Args:
        groups: In their order.
        performer: Who speaks with a voice, by its name.
        media: Where samples go.
        language: BCP 47.
        moved: Whether emotions and effort move the voice.
    """
    places = Places()
    numbers = itertools.count(1)
    speaking: dict[str, Speaking] = {}
    for name, run in itertools.groupby(groups, key=lambda group: group.voice):
        who = performer(name)
        how = speaking.setdefault(name, Speaking(language=language, moved=moved))
        how.before = ""
        waiting: deque[BreathGroup] = deque()
        said = iter(who.voice.speak_all(_requests(run, waiting, how, who.state.parameters)))
        while True:
            first = next(said, None)
            if first is None:
                break
            group = waiting.popleft()
            speeches = [first, *itertools.islice(said, len(group.parts) - 1)]
            yield Spoken(
                group=group,
                id=f"{BODY}.g{next(numbers)}",
                place=places.key(emoticons.without(group.text)),
                parts=how.spoken(group, speeches, who.state.parameters, media),
            )


def _requests(
    groups: Iterable[BreathGroup], waiting: deque[BreathGroup], how: Speaking, parameters: Parameters
) -> Iterator[SpeechRequest]:
    for group in groups:
        waiting.append(group)
        yield from how.requests(group, parameters)


def made_by() -> str:
    """Name and version of this program, as Scores carry it."""
    try:
        return f"scorebreath {metadata.version('scorebreath')}"
    except metadata.PackageNotFoundError:
        return "scorebreath"


def group_of(spoken: Spoken, body: str) -> Group:
    """A group as the Score has it."""
    group = spoken.group
    return Group(
        id=spoken.id,
        body=body,
        source=(group.source.start, group.source.end),
        text=group.text,
        syllables=group.syllables,
        sentence_type=group.sentence_type,
        cut=group.cut,
    )


def breath_media(events: Iterable[Event], recordings: Recordings | None) -> dict[str, MediaInfo]:
    """The recordings that some event sounds with."""
    if recordings is None:
        return {}
    noises = (event.noise for event in events if isinstance(event, Inspiration | Expiration | Hold))
    used = {source for noise in noises if noise for source in (noise.source, noise.source_nose)}
    takes = {take.sha: take for kind in recordings.takes.values() for take in kind if take.sha in used}
    return {
        sha: MediaInfo(
            path=FolderStore.path(sha, "breath"), frames=take.frames, sample_rate=take.sample_rate, kind="breath"
        )
        for sha, take in takes.items()
    }
