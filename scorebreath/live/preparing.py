"""Groups made ready: planned, spoken, measured."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from scorebreath.compose.models import breathing_model
from scorebreath.compose.speaking import Speaking, media_info
from scorebreath.compose.state import SpokenPart
from scorebreath.errors import ScorebreathError
from scorebreath.live.prompter import NOTHING, Prompter
from scorebreath.media.store import MediaStore
from scorebreath.parameters.table import Parameters
from scorebreath.planning.model import BreathGroup
from scorebreath.score.document import MediaInfo
from scorebreath.speech.model import Voice


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
        self._speaking: dict[str, Speaking] = {}

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
        return Prepared(
            group=group, parts=parts, media={said.media: media_info(said) for said in parts}, generation=generation
        )

    def _speak(self, group: BreathGroup, voice: Voice, parameters: Parameters) -> tuple[SpokenPart, ...]:
        if group.voice not in self._speaking:
            plan = self.prompter.plan
            moved = breathing_model(plan.model).has_states
            self._speaking[group.voice] = Speaking(language=plan.language, moved=moved)
        how = self._speaking[group.voice]
        how.before = self._before
        said = [voice.speak(request) for request in how.requests(group, parameters)]
        self._before = how.before
        return how.spoken(group, said, parameters, self._media)
