"""What plays sounds as they happen, whichever engine it is."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Protocol

from scorebreath.engine.live.status import Status
from scorebreath.engine.onsets import Onset
from scorebreath.media.store import MediaStore
from scorebreath.score.performing import Heard

LOOKAHEAD = 0.15
"""s before its time that the engine is told of a sound."""
Trouble = Callable[[str], None]
"""Told what goes wrong, and that it is mended; from any thread; must return at once."""


class Sounder(Protocol):
    """Plays sounds at their times. Safe to call from any thread; nothing but `close` waits for anybody.

    Second t of the performance sounds at Unix time `start_unix + t`, and is heard `latency` and the device's own
    latency later.

    Nothing is ever sent for the past. What is given too late happens `MARGIN` from now where that is still of use:
    speech (as long as it would not be over), moves, and cuts; breaths do not happen, and are counted as lost.
    """

    @property
    def start_unix(self) -> float:
        """Unix time of the performance's second 0."""

    @property
    def latency(self) -> float:
        """Seconds from a sound's time to the engine's output."""

    @property
    def output_latency(self) -> float:
        """Seconds from the engine's output to the speaker, as far as the device says; 0 where it does not."""

    @property
    def sample_rate(self) -> int:
        """Of the engine, Hz."""

    def begin(self, start_unix: float) -> None:
        """Say when second 0 is; before anything is played. Without it, second 0 is when the sounder was made."""

    def play(self, sounds: Sequence[Onset], media: MediaStore) -> None:
        """Sounds that are to come, in order of time; their media are read, made ready and loaded meanwhile."""

    def cut(self, time: float, targets: Iterable[str], fade: float) -> None:
        """The sounds of these events end at a time, played already or not, as a `cut` event has it."""

    def move(self, time: float, body: str, heard: Heard, glide: float) -> None:
        """What a body's sounds are moved to, as a `parameter` event has it; of a body in order of time."""

    def hush(self, fade: float) -> None:
        """What sounds fades out in so many seconds, from now, and nothing more of what was given begins."""

    def panic(self) -> None:
        """Silence at once, and nothing more of what was given."""

    def pan(self, body: str, pan: float) -> None:
        """Put a body between the speakers: -1 left, 0 in both alike, 1 right."""

    def status(self) -> Status:
        """How it does."""

    def close(self) -> None:
        """Silence, and the end of an engine that is ours. Returns within seconds, whatever the engine does."""
