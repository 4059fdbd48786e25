"""A recording made into a Score: its words in time, and a body that breathes where the recording is silent.

The transcript is read as any script. Where the recording is silent says where groups end (`planning.heard`); the
speech stays where it was spoken, and each breath is fitted into the silence before it (`compose.fitting`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

from scorebreath.compose.models import breathing_model
from scorebreath.compose.speaking import Speaking, media_info
from scorebreath.compose.state import KeptBreath, Places, Room, Spoken
from scorebreath.ensemble import BODY, Ensemble
from scorebreath.errors import InputError
from scorebreath.media.recordings import RATE as BREATH_RATE
from scorebreath.media.recordings import Recordings
from scorebreath.media.store import FolderStore, MediaStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import begin_states, breath_media, group_of, made_by
from scorebreath.planning.heard import LEAST, Heard, Silence, choose
from scorebreath.planning.model import BreathGroup, plan
from scorebreath.planning.starts import preferred_syllables
from scorebreath.score.document import Group, MediaInfo, Score
from scorebreath.script import emoticons
from scorebreath.script.emotional import with_breathing
from scorebreath.script.marks import Act, Mark, NoBreath, ProsodyMark, VoiceMark
from scorebreath.script.markup.marked import Marked, Markup
from scorebreath.script.model import Edge, Script, ScriptWord
from scorebreath.script.reader import read
from scorebreath.signal.breaths import TARGET_DB, at_target
from scorebreath.signal.resample import resample
from scorebreath.spans import Span
from scorebreath.speech.recording.listen import Gap, Listened, listen
from scorebreath.speech.recording.model import Progress, Take, Written
from scorebreath.speech.recording.voice import RecordedVoice
from scorebreath.units import snap

OwnBreaths = Literal["keep", "replace"]
"""What becomes of breaths that are heard in the recording: they stay, or others are drawn in their stead."""
FIRST, ENOUGH = 1.0, 0.7
"""s before the first word, in which the first breath is drawn: as it wants to be, and as it still can be"""
TELLS: tuple[type[Mark], ...] = (Act, NoBreath, ProsodyMark, VoiceMark)
"""Marks that ask for what only a voice that speaks now can do."""
PHRASE_ENDS: frozenset[Edge] = frozenset({"paragraph", "sentence", "semicolon", "comma", "line"})

Tell = Callable[[str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Recorded:
    """A Score, and what was heard for it."""

    score: Score
    heard: Listened
    offset: float
    """s by which the recording begins after the Score"""


def compile_recording(
    take: Take,
    text: str | Marked,
    *,
    media: MediaStore,
    parameters: Parameters | None = None,
    model: str = "natural",
    language: str = "en",
    poem: bool | None = None,
    seed: int = 0,
    lead: float = 0.5,
    tail: float = 1.0,
    file: str = "",
    markup: Markup = "auto",
    textgrid: Path | None = None,
    words: Path | None = None,
    own_breaths: OwnBreaths = "keep",
    states: Mapping[str, float] | None = None,
    recordings: Recordings | None = None,
    tell: Tell = lambda _: None,
    on_progress: Progress | None = None,
) -> Recorded:
    """Turn a recording and its transcript into a Score.

    Args:
        take: The recording, by `speech.recording.sound.load_take`.
        text: Its transcript; what its markup asks a voice to do is left out, and that is told.
        media: Where the speech goes.
        parameters: Defaults where nothing is given; `emotion_voice` counts only where it is set.
        model: A breathing model.
        language: BCP 47.
        poem: Whether line ends are phrase edges; None: as the text looks.
        seed: Of every chance.
        lead: Time before the first breath, s, at least.
        tail: Time after the body has come back to rest, s.
        file: Name of the transcript, for messages.
        markup: As for `pipeline.compile_text`.
        textgrid: A Praat TextGrid that says where the words are.
        words: A JSON file that does.
        own_breaths: Whether breaths that are heard stay.
        states: States the body is in from the beginning.
        recordings: The user's own breaths, in `media`.
        tell: Told what was heard, left out, or done to the sound, a line at a time.
        on_progress: Told the fraction of the listening that is done, 0..1.

    Returns:
        The Score. Where the recording begins with time for a breath, its times are the recording's own.

    Raises:
        InputError: The recording, its transcript, or a file about them is wrong, or they do not belong together.
        VoiceError: eSpeak NG, which counts syllables, is not installed.
    """
    p = _own(parameters or Parameters())
    breathing = breathing_model(model)
    script = _bare(read(text, language=language, poem=poem, file=file, markup=markup), tell)
    written = transcript(script)
    if not written:
        raise InputError(f"{file or 'transcript'}: says nothing; expected what is said in {take.path}")
    for note in take.notes:
        tell(note)
    heard = listen(take, written, language, textgrid=textgrid, words=words, on_progress=on_progress)
    for note in (*heard.notes, *map(str, heard.mismatches)):
        tell(note)
    begun = begin_states(states or {})
    if breathing.has_states:
        script = with_breathing(script, p.emotion_breath, begun)
    with RecordedVoice(take, heard, written, language) as voice:
        stage = _Stage(take=take, heard=heard, voice=voice, media=media, keep=own_breaths == "keep")
        stage.offset = _offset(heard, lead, keep=stage.keep)
        ensemble = Ensemble(
            breathing=breathing, voice=voice, voices=None, parameters=p, cast={}, language=script.language, seed=seed,
            recordings=recordings,
        )  # fmt: skip
        first = stage.room(0, None)
        ensemble.begin(max(0.0, min(lead, (first.breath or first).onset - (0.0 if first.breath else FIRST))), begun)
        planner = Heard(_places(heard, written, voice, p), voice.syllables, poem=script.poem)
        speaking = Speaking(language=script.language, moved=breathing.has_states)
        groups: list[Group] = []
        sounds: dict[str, MediaInfo] = {}
        planned = list(plan(planner, script.sentences))
        for spoken in _spoken(planned, stage, speaking, p):
            who = ensemble.step(spoken)
            groups.append(group_of(spoken, who.state.body))
            sounds.update((said.media, media_info(said)) for said in spoken.parts)
        end = ensemble.finish(tail)
        bodies = tuple(who.body() for who in ensemble.performers.values())
    events = tuple(ensemble.events())
    score = Score(
        made_by=made_by(), seed=seed, language=script.language, model=model, text=script.text, duration=end,
        bodies=bodies, media=sounds | stage.kept | breath_media(events, recordings), groups=tuple(groups),
        events=events,
    )  # fmt: skip
    return Recorded(score=score, heard=heard, offset=stage.offset)


def _offset(heard: Listened, lead: float, *, keep: bool) -> float:
    """How much later the recording begins than the Score: not at all where it leaves time for the first breath.

    A breath that is kept was drawn already; another one needs `ENOUGH`, and has `FIRST` and the lead if it must wait.
    """
    onset = heard.words[0].start
    first = heard.gaps[0]
    if onset >= ENOUGH or (keep and first.before is None and first.breath is not None):
        return 0.0
    return snap(lead + FIRST - onset)


def transcript(script: Script) -> list[Written]:
    """The words of a script, for whoever looks for them in a recording."""
    return [
        Written(
            text=word.text,
            spoken=word.words,
            source=word.source,
            bare=_bare_span(script.text, word),
            phrase_ends=word.edge in PHRASE_ENDS,
        )
        for sentence in script.sentences
        for word in sentence.words
    ]


def _bare_span(text: str, word: ScriptWord) -> Span:
    """Where a word stands without its punctuation; with it, where it is written otherwise than it is called."""
    at = text.find(word.text, word.source.start, word.source.end) if word.text else -1
    return word.source if at < 0 else Span(at, at + len(word.text))


def _own(p: Parameters) -> Parameters:
    """Emotions do not move a recorded voice, which has them already, unless somebody asks for it."""
    return p if "emotion_voice" in p.model_fields_set else p.model_copy(update={"emotion_voice": 0.0})


def _bare(script: Script, tell: Tell) -> Script:
    """A script without what only a voice that speaks now can do."""
    left = [mark.written for mark in script.marks if isinstance(mark, TELLS)]
    if not left:
        return script
    shown = ", ".join(dict.fromkeys(left))
    tell(f"left out, since the recording is what it is: {shown[:200]}")

    def kept(marks: Sequence[Mark]) -> tuple[Mark, ...]:
        return tuple(mark for mark in marks if not isinstance(mark, TELLS))

    sentences = tuple(
        replace(
            sentence, before=kept(sentence.before),
            words=tuple(replace(word, after=kept(word.after)) for word in sentence.words),
        )
        for sentence in script.sentences
    )  # fmt: skip
    return replace(script, sentences=sentences, marks=kept(script.marks))


def _places(heard: Listened, written: Sequence[Written], voice: RecordedVoice, p: Parameters) -> dict[int, str]:
    """Where groups end: the silences that were chosen."""
    spoken = [word for one in written for word in one.spoken]
    counts = dict(zip(spoken, voice.syllables(spoken), strict=True))
    said = [sum(counts[word] for word in one.spoken) for one in written]
    silences: list[Silence] = []
    first = 0
    for gap in heard.gaps:
        place = _last_written(heard, gap)
        if gap.before is None or place is None or gap.end - gap.start < LEAST or _first_written(heard, gap) is None:
            continue
        syllables = float(sum(said[first : place + 1]))
        silences.append(
            Silence(
                place=written[place].source.start, duration=gap.end - gap.start, syllables=syllables,
                breath=gap.breath is not None,
            )
        )  # fmt: skip
        first = place + 1
    return choose(silences, float(sum(said[first:])), preferred_syllables(p))


def _last_written(heard: Listened, gap: Gap) -> int | None:
    """Place in the transcript of the last written word before a silence."""
    before = heard.words[: (gap.before or 0) + 1] if gap.before is not None else ()
    return next((word.word for word in reversed(before) if word.word is not None), None)


def _first_written(heard: Listened, gap: Gap) -> int | None:
    """Place of the first written word behind it."""
    behind = heard.words[gap.before + 1 :] if gap.before is not None else heard.words
    return next((word.word for word in behind if word.word is not None), None)


@dataclass(slots=True, kw_only=True)
class _Stage:
    """What a recording leaves to its body."""

    take: Take
    heard: Listened
    voice: RecordedVoice
    media: MediaStore
    keep: bool
    offset: float = 0.0
    """s by which the recording begins after the Score"""
    kept: dict[str, MediaInfo] = field(default_factory=dict)
    """breaths of the recording, by their names"""

    def room(self, first: int, following: int | None) -> Room:
        """The room of a group.

        Args:
            first: Place of its first heard word.
            following: Place of the first one of the group behind it; None: it is the last.
        """
        words = self.heard.words
        gap = next((gap for gap in self.heard.gaps if gap.before == (first - 1 if first else None)), None)
        silence = None
        if following is not None:
            silence = snap(self._cut(words[following].start) - self._cut(words[following - 1].end))
        return Room(onset=snap(self._cut(words[first].start) + self.offset), silence=silence, breath=self._breath(gap))

    def _cut(self, time: float) -> float:
        """The time of the frame where the recording is cut, s."""
        return round(time * self.take.sample_rate) / self.take.sample_rate

    def _breath(self, gap: Gap | None) -> KeptBreath | None:
        if gap is None or gap.breath is None or not self.keep:
            return None
        rate = self.take.sample_rate
        start, end = gap.breath.start, gap.breath.end
        sound = resample(self.take.samples[round(start * rate) : round(end * rate)], rate, BREATH_RATE)
        made, gain = at_target(sound, BREATH_RATE)
        sha = self.media.put(made, BREATH_RATE, "breath")
        self.kept[sha] = MediaInfo(
            path=FolderStore.path(sha, "breath"), frames=len(made), sample_rate=BREATH_RATE, kind="breath"
        )
        level = TARGET_DB - gain - self.voice.reference_db
        return KeptBreath(onset=snap(start + self.offset), duration=snap(end - start), media=sha, level_db=snap(level))


def _spoken(groups: Sequence[BreathGroup], stage: _Stage, speaking: Speaking, p: Parameters) -> Iterator[Spoken]:
    """Each group as it was recorded, with the room it leaves."""
    places = Places()
    spans = [stage.voice.span(group.source) for group in groups]
    for number, group in enumerate(groups):
        first, last = spans[number]
        if first == last:
            continue
        following = next((span[0] for span in spans[number + 1 :] if span[0] < span[1]), None)
        said = [stage.voice.speak(request) for request in speaking.requests(group, p)]
        yield Spoken(
            group=group, id=f"{BODY}.g{number + 1}", place=places.key(emoticons.without(group.text)),
            parts=speaking.spoken(group, said, p, stage.media), room=stage.room(first, following),
        )  # fmt: skip
