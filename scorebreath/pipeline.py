"""The sentence: text is read, planned, spoken, and composed into a Score."""

from __future__ import annotations

import dataclasses
import itertools
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from importlib import metadata

from scorebreath.compose.models import BreathingModel, breathing_model
from scorebreath.compose.parts import closing
from scorebreath.compose.state import BodyState, Places, Spoken, SpokenPart
from scorebreath.errors import InputError
from scorebreath.expression.express import express
from scorebreath.expression.state import FaceState, Placed
from scorebreath.media.recordings import Recordings
from scorebreath.media.store import FolderStore, MediaStore
from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, SyllableCounter, plan
from scorebreath.planning.planners import open_planner
from scorebreath.score.document import Body, Group, MediaInfo, Score, VoiceInfo
from scorebreath.score.events import Event, Expiration, Hold, Inspiration, Pause
from scorebreath.script.marks import EmotionMark, StateMark
from scorebreath.script.markup.marked import Markup
from scorebreath.script.model import Script, Sentence
from scorebreath.script.reader import read
from scorebreath.speech.model import Speech, SpeechRequest, Voice
from scorebreath.units import snap

BODY = "body"
"""Id of the only body of a compiled text."""

SENTENCES_AT_ONCE = 200
"""whose syllables a voice is asked for together"""

Progress = Callable[[float], None]


@dataclasses.dataclass(slots=True, kw_only=True)
class _Performer:
    """A body of the Score while it is being composed."""

    voice: Voice
    state: BodyState
    face: FaceState
    events: list[Event]

    def go_on(self, done: tuple[BodyState, list[Event]], spoken: Spoken | None = None) -> None:
        """Take what compose has placed, and let the face answer to it."""
        self.state, placed = done
        self.events += placed
        self._express(placed, spoken)

    def end(self, time: float) -> None:
        """All is over."""
        self._express([], None, over=time)

    def _express(self, placed: list[Event], spoken: Spoken | None, over: float | None = None) -> None:
        place = spoken.place if spoken else f"rest@{self.state.waits}"
        marks = emotions_in(spoken.group) if spoken else ()
        self.face, shown = express(self.face, Placed(events=tuple(placed), place=place, marks=marks), over=over)
        self.events += shown


def compile_text(
    text: str,
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
        text: What is to be said.
        voice: Who says it.
        media: Where the speech goes.
        parameters: Defaults where nothing is given.
        model: `natural`, `bernardet-2017` or `bernardet-2019`.
        language: BCP 47 primary language; None: what the text's markup says, or English.
        poem: Whether line ends are phrase edges; None: as the text looks.
        seed: Of every chance.
        lead: Time before the first breath, s.
        tail: Time after the body has come back to rest, s.
        file: Name of the text, for messages.
        markup: What stands in the text besides words: `tags`, `ssml`, `none`; `auto`: as it looks.
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
    script = read(text, language=language, poem=poem, file=file, markup=markup)
    begun = begin_states(states or {})
    performers: dict[str, _Performer] = {}

    def performer(name: str) -> _Performer:
        """Who speaks with a voice; somebody new breathes at rest until now."""
        if name not in performers:
            known = cast.get(name, p) if cast else p
            who = BODY if not performers else f"{BODY}{len(performers) + 1}"
            performers[name] = _enter(
                who,
                voice if not name else _opened(voices, name),
                known,
                breathing,
                seed=seed,
                language=script.language,
                recordings=recordings,
            )
        return performers[name]

    main = performer("")
    clock = snap(lead)
    main.events.append(_silence("start", 0.0, clock))
    main.go_on(breathing.act(main.state, begun, "begin"))
    groups: list[Group] = []
    sounds: dict[str, MediaInfo] = {}
    planned = plan_script(script, parameters=p, model=model, count=voice.syllables, states=begun, seed=seed, cast=cast)
    performed = speak(planned, lambda name: performer(name).voice, media, lambda name: performer(name).state.parameters)
    for spoken in performed:
        who = performer(spoken.group.voice)
        groups.append(_group(spoken, who.state.body))
        sounds.update((said.media, _media_info(said)) for said in spoken.parts)
        who.go_on(breathing.rest(who.state, clock, "rest"))
        who.go_on(breathing.step(who.state, spoken), spoken)
        clock = who.state.time
        if on_progress:
            on_progress(min(1.0, spoken.group.source.end / len(script.text)))
    if not groups:
        main.go_on(breathing.rest(main.state, clock, "rest"))
        main.go_on(breathing.act(main.state, script.marks, "act"))
    clock = max(who.state.time for who in performers.values())
    for who in performers.values():
        who.go_on(breathing.rest(who.state, clock, "rest"))
        who.go_on(breathing.finish(who.state, snap(tail)))
    end = max(who.state.time for who in performers.values())
    main.events.append(_silence("end", clock, snap(end - clock)))
    for who in performers.values():
        who.go_on(breathing.rest(who.state, end, "rest"))
        who.end(end)
    events = tuple(event for who in performers.values() for event in who.events)
    return Score(
        made_by=made_by(),
        seed=seed,
        language=script.language,
        model=model,
        text=script.text,
        duration=end,
        bodies=tuple(_body(who) for who in performers.values()),
        media=sounds | _breath_media(events, recordings),
        groups=tuple(groups),
        events=events,
    )


def begin_states(states: Mapping[str, float]) -> tuple[StateMark, ...]:
    """Marks that put a body into states from the beginning and keep it there; a tag in the text can end them."""
    return tuple(
        StateMark(at=0, written=f"state {name}", name=name, intensity=intensity, ramp=0.0, held=True)
        for name, intensity in states.items()
    )


def _enter(
    who: str,
    voice: Voice,
    p: Parameters,
    breathing: BreathingModel,
    *,
    seed: int,
    language: str,
    recordings: Recordings | None,
) -> _Performer:
    person = breathing.person(p)
    state = BodyState(
        body=who,
        seed=seed,
        parameters=p,
        person=person,
        time=0.0,
        volume=person.resting_volume,
        recordings=recordings,
    )
    face = FaceState(body=who, seed=seed, parameters=p, language=language)
    return _Performer(voice=voice, state=state, face=face, events=[])


def _opened(voices: Callable[[str], Voice] | None, name: str) -> Voice:
    if voices is None:
        raise InputError(f"the text changes to the voice {name!r}, and nobody opens voices here; pass `voices`")
    try:
        return voices(name)
    except InputError as error:
        raise InputError(f"the text changes to the voice {name!r}: {error}") from None


def _body(who: _Performer) -> Body:
    details = who.voice.details
    return Body(
        id=who.state.body,
        voice=VoiceInfo(
            engine=details.engine,
            voice=details.voice,
            version=details.version,
            licence=details.licence,
            sample_rate=details.sample_rate,
            reference_db=snap(who.voice.reference_db),
        ),
        person=who.state.person,
        parameters=who.state.parameters.set_by_hand(),
    )


def emotions_in(group: BreathGroup) -> tuple[EmotionMark, ...]:
    """Emotions that the text asks for before, in and behind a group, in its order."""
    inner = (mark for word in group.words[:-1] for mark in word.after)
    return tuple(mark for mark in (*group.before, *inner, *group.after) if isinstance(mark, EmotionMark))


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
    """Breath groups of a script, as the model's planner cuts them (the papers' planners count with pyphen)."""
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
    voice_of: Callable[[str], Voice],
    media: MediaStore,
    parameters_of: Callable[[str], Parameters],
) -> Iterator[Spoken]:
    """Have each group spoken, its samples put into `media`; a voice works ahead of whoever takes what it says."""
    places = Places()
    numbers = itertools.count(1)
    for name, run in itertools.groupby(groups, key=lambda group: group.voice):
        voice = voice_of(name)
        waiting: deque[BreathGroup] = deque()
        said = iter(voice.speak_all(_requests(run, waiting, parameters_of(name))))
        while True:
            first = next(said, None)
            if first is None:
                break
            group = waiting.popleft()
            speeches = [first, *itertools.islice(said, len(group.parts) - 1)]
            yield Spoken(
                group=group,
                id=f"{BODY}.g{next(numbers)}",
                place=places.key(group.text),
                parts=tuple(
                    SpokenPart(part=part, speech=speech, media=media.put(speech.samples, speech.sample_rate, "speech"))
                    for part, speech in zip(group.parts, speeches, strict=True)
                ),
            )


def _requests(
    groups: Iterable[BreathGroup], waiting: deque[BreathGroup], parameters: Parameters
) -> Iterator[SpeechRequest]:
    before = ""
    for group in groups:
        waiting.append(group)
        for part in group.parts:
            prosody = part.prosody
            yield SpeechRequest(
                text=part.spoken,
                closing=closing(part),
                rate=_within(parameters.prosody_rate * (prosody.rate if prosody else 1.0)),
                pitch=_within(parameters.prosody_pitch * (prosody.pitch if prosody else 1.0)),
                before=before,
            )
            before = part.spoken.text


def _within(ratio: float) -> float:
    """What a voice can do."""
    return min(2.0, max(0.5, ratio))


def made_by() -> str:
    """Name and version of this program, as Scores carry it."""
    try:
        return f"scorebreath {metadata.version('scorebreath')}"
    except metadata.PackageNotFoundError:
        return "scorebreath"


def _group(spoken: Spoken, body: str) -> Group:
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


def _media_info(said: SpokenPart) -> MediaInfo:
    speech: Speech = said.speech
    return MediaInfo(
        path=FolderStore.path(said.media, "speech"),
        frames=len(speech.samples),
        sample_rate=speech.sample_rate,
        kind="speech",
    )


def _breath_media(events: Iterable[Event], recordings: Recordings | None) -> dict[str, MediaInfo]:
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


def _silence(kind: str, onset: float, duration: float) -> Pause:
    return Pause(
        id=f"{BODY}.{kind}",
        body=BODY,
        onset=onset,
        duration=duration,
        rule=f"silence: {kind}",
        kind="start" if kind == "start" else "end",
    )
