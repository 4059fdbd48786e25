"""What a voice is asked for the parts of a breath group, and what is made of what it says: rate, pitch, melody, effort.

Emotions move the voice as they move the breath (A58): each phrase by its strongest, a part by the mean of its words.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from scorebreath.compose.parts import closing
from scorebreath.compose.sentences import opening_left, sentences_of
from scorebreath.compose.state import SpokenPart
from scorebreath.media.store import FolderStore, MediaStore
from scorebreath.parameters.derive import derive
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup, Part
from scorebreath.score.document import MediaInfo, Site
from scorebreath.score.events import Closing
from scorebreath.script import emotions
from scorebreath.script.emotional import ENDS, ahead, rest
from scorebreath.script.emotions import VoiceChange
from scorebreath.script.marks import EmotionMark, Mark
from scorebreath.speech.model import Speech, SpeechRequest
from scorebreath.speech.prosody.shape import Manner, shape
from scorebreath.units import decibels, snap

PARAGRAPH = 0.2
"""Share of its fall by which the pitch begins higher after a paragraph (physiology 5: a reset of 120 %)."""
UNMOVED = VoiceChange()


@dataclass(slots=True, kw_only=True)
class Speaking:
    """Goes through what is said, group by group; asks ahead of what is answered.

    Args:
        language: BCP 47.
        moved: Whether emotions and effort move the voice: the papers' models leave it as it is.
    """

    language: str
    moved: bool
    before: str = ""
    """what the voice was asked for last"""
    _opening: tuple[str, ...] = ()
    _site: Site = "text end"

    def requests(self, group: BreathGroup, p: Parameters) -> Iterator[SpeechRequest]:
        """One for each part."""
        for part, change in zip(group.parts, self._change(group, p), strict=True):
            prosody = part.prosody
            yield SpeechRequest(
                text=part.spoken,
                closing=closing(part),
                rate=_within(p.prosody_rate * (prosody.rate if prosody else 1.0) * change.rate),
                pitch=_within(p.prosody_pitch * (prosody.pitch if prosody else 1.0) * 2.0 ** (change.pitch / 12.0)),
                before=self.before,
            )
            self.before = part.spoken.text

    def spoken(
        self, group: BreathGroup, said: Sequence[Speech], p: Parameters, media: MediaStore
    ) -> tuple[SpokenPart, ...]:
        """The parts of a group as they are to be heard, their samples in `media`; groups come in their order.

        Args:
            group: It.
            said: What the voice said, one for each part.
            p: As it was asked with.
            media: Where samples go.
        """
        sentences = sentences_of(group.parts, self._opening)
        changes = self._change(group, p)
        manners, place = [], 0
        for part, change in zip(group.parts, changes, strict=True):
            place += len(part.words)
            rises = bool(sentences) and sentences[place - 1].rises(self.language)
            manners.append(self._manner(part, change, p, rises=rises))
        self._opening, self._site = opening_left(group.parts, sentences), group.cut.site
        return tuple(
            SpokenPart(
                part=part, speech=shaped.speech, gain_db=snap(change.effort + shaped.gain_db),
                media=media.put(shaped.speech.samples, shaped.speech.sample_rate, "speech"),
            )
            for part, shaped, change in zip(group.parts, shape(said, manners), changes, strict=True)
        )  # fmt: skip

    def _change(self, group: BreathGroup, p: Parameters) -> tuple[VoiceChange, ...]:
        """What its emotions do to each part."""
        if not self.moved or not p.emotion_voice:
            return (UNMOVED,) * len(group.parts)
        return moved_by(group, p.emotion_voice)

    def _manner(self, part: Part, change: VoiceChange, p: Parameters, *, rises: bool) -> Manner:
        ends: Closing = closing(part)
        louder = decibels(derive(p).prosody_loudness / 100.0) + change.effort
        louder += part.prosody.volume_db if part.prosody else 0.0
        return Manner(
            slope=p.declination,
            by_length=p.declination_share,
            reset=p.declination_reset,
            lift=PARAGRAPH if self._site == "paragraph" else 0.0,
            ending=p.question_rise if rises else -p.final_lowering if ends != "continuing" else 0.0,
            range=change.range,
            louder=louder * p.vocal_effort if self.moved and abs(louder) > 1e-6 else 0.0,
            per_pressure=p.pressure_pitch,
            sex=p.sex,
        )


def moved_by(group: BreathGroup, share: float) -> tuple[VoiceChange, ...]:
    """What the emotions of a group do to the voice in each of its parts.

    Args:
        group: With its marks.
        share: How much a full emotion moves it, 0..1.
    """
    felt = list(_felt(ahead(group.before)))
    out = []
    for part in group.parts:
        felt += _felt(part.before)
        total, words = UNMOVED, 0
        for word in part.words:
            words += 1
            felt += _felt(word.after)
            if word.edge in ENDS or word is part.words[-1]:
                total = total.with_(_strongest(felt).by(share * words / len(part.words)))
                parted = rest(word.after)
                felt = list(_felt(word.after if parted is None else word.after[parted:]))
                words = 0
        out.append(total)
    return tuple(out)


def _felt(marks: Sequence[Mark]) -> Iterator[EmotionMark]:
    return (mark for mark in marks if isinstance(mark, EmotionMark))


def _strongest(felt: Sequence[EmotionMark]) -> VoiceChange:
    if not felt:
        return UNMOVED
    best = max(reversed(felt), key=lambda mark: mark.intensity)
    return emotions.rows()[best.name].voice.by(best.intensity)


def media_info(said: SpokenPart) -> MediaInfo:
    """What a Score says about the samples of a part."""
    speech = said.speech
    return MediaInfo(
        path=FolderStore.path(said.media, "speech"), frames=len(speech.samples), sample_rate=speech.sample_rate,
        kind="speech",
    )  # fmt: skip


def _within(ratio: float) -> float:
    """What a voice can do."""
    return min(2.0, max(0.5, ratio))
