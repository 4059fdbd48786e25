"""Groups made ready: planned, spoken, measured."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from scorebreath.compose.parts import closing
from scorebreath.compose.state import SpokenPart
from scorebreath.errors import ScorebreathError
from scorebreath.live.prompter import NOTHING, Prompter
from scorebreath.media.store import FolderStore, MediaStore
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup
from scorebreath.score.document import MediaInfo
from scorebreath.speech.model import SpeechRequest, Voice


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Prepared:
    """A breath group that is ready to be placed."""

    group: BreathGroup
    parts: tuple[SpokenPart, ...]
    """spoken; empty where the voice failed"""
    media: Mapping[str, MediaInfo]
    generation: int
    """of the plan; older ones are void"""
    problem: str = ""
    """why it cannot be spoken"""


class Preparer:
    """Plans and speaks the next group when asked; used by one thread at a time.

    Args:
        prompter: What is to be said.
        voices: Opens a voice by its name; the empty name is whoever began.
        parameters: Of whoever speaks with a voice.
        media: Where speech goes.
    """

    def __init__(
        self,
        prompter: Prompter,
        *,
        voices: Callable[[str], Voice],
        parameters: Callable[[str], Parameters],
        media: MediaStore,
    ) -> None:
        """Nothing is prepared yet."""
        self.prompter = prompter
        self.generation = 0
        self.speaking = False
        """whether a voice is at work"""
        self._voices, self._parameters, self._media = voices, parameters, media
        self._before = ""

    def work(self, flush: int = NOTHING) -> Prepared | None:
        """The next group, spoken; None where more text is needed. Takes as long as the voice does."""
        generation = self.generation
        group = self.prompter.next(flush)
        if group is None:
            return None
        self.speaking = True
        try:
            parts = self._speak(group, self._voices(group.voice), self._parameters(group.voice))
        except Exception as error:  # whatever a voice does, the others and the breath go on
            said = f"{error}" if isinstance(error, ScorebreathError) else f"{type(error).__name__}: {error}"
            said = said.partition("\n")[0]
            return Prepared(group=group, parts=(), media={}, generation=generation, problem=said)
        finally:
            self.speaking = False
        return Prepared(group=group, parts=parts, media=_media(parts), generation=generation)

    def _speak(self, group: BreathGroup, voice: Voice, parameters: Parameters) -> tuple[SpokenPart, ...]:
        spoken = []
        for part in group.parts:
            prosody = part.prosody
            request = SpeechRequest(
                text=part.spoken,
                closing=closing(part),
                rate=_within(parameters.prosody_rate * (prosody.rate if prosody else 1.0)),
                pitch=_within(parameters.prosody_pitch * (prosody.pitch if prosody else 1.0)),
                before=self._before,
            )
            speech = voice.speak(request)
            self._before = part.spoken.text
            media = self._media.put(speech.samples, speech.sample_rate, "speech")
            spoken.append(SpokenPart(part=part, speech=speech, media=media))
        return tuple(spoken)


def _within(ratio: float) -> float:
    return min(2.0, max(0.5, ratio))


def _media(parts: tuple[SpokenPart, ...]) -> dict[str, MediaInfo]:
    return {
        said.media: MediaInfo(
            path=FolderStore.path(said.media, "speech"), frames=len(said.speech.samples),
            sample_rate=said.speech.sample_rate, kind="speech",
        )
        for said in parts
    }  # fmt: skip
