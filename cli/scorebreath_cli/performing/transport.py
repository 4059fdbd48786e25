"""A finished Score under somebody's hands: it plays, waits, and jumps; used by one thread."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scorebreath.engine.live.sounder import Sounder
    from scorebreath.media.store import MediaStore
    from scorebreath.score.document import Score

WRAPPED = 0.5
"""s that a position goes back before that is a new round"""


class Transport:
    """Plays a Score.

    Args:
        score: Which.
        media: Its samples.
        sounder: What plays it.
        start: Second to begin at.
        loop: Whether to begin again at the end.
    """

    def __init__(self, score: Score, media: MediaStore, sounder: Sounder, *, start: float, loop: bool) -> None:
        """Nothing plays yet."""
        self._score, self._media, self._sounder = score, media, sounder
        self.loop = loop
        self.over = False
        """whether it came to its end"""
        self._at, self._since = start, 0.0  # position, and the Unix time at which it was there; 0: it stays there
        self._looping = False
        self._begun = 0.0
        self._stopped: threading.Event | None = None
        self._thread: threading.Thread | None = None
        self._failure: BaseException | None = None
        self._lock = threading.Lock()

    @property
    def playing(self) -> bool:
        """Whether it does."""
        return self._thread is not None

    @property
    def position(self) -> float:
        """Second of the Score that the engine is told to play now; from any thread."""
        with self._lock:
            moves = self._since > 0.0
            at = self._at + (time.time() - self._since if moves else 0.0)
        duration = self._score.duration
        return at % duration if moves and self._looping and at >= duration > 0.0 else min(at, duration)

    def play(self) -> None:
        """Go on from the position."""
        if self._thread is not None:
            return
        from scorebreath.engine.player import LEAD

        start = self.position
        start = 0.0 if start >= self._score.duration else start
        self.over, self._looping = False, self.loop
        self._hold(start)
        self._begun = time.time() + LEAD
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._run, args=(start, self._stopped), name="player", daemon=True)
        self._thread.start()

    def pause(self) -> None:
        """Stay where it is."""
        if self._thread is None or self._stopped is None:
            return
        at = self.position
        self._stopped.set()
        self._thread.join()
        self._thread = None
        self._hold(at)

    def seek(self, position: float) -> None:
        """Jump to a second, as near as there is one."""
        playing = self.playing
        self.pause()
        self._hold(min(max(0.0, position), self._score.duration))
        if playing:
            self.play()

    def look(self) -> None:
        """Look how far it is; often.

        Raises:
            ScorebreathError: A sound cannot be played.
        """
        if self._thread is not None and not self._thread.is_alive():
            self._thread = None
            if self._failure is not None:
                raise self._failure
            self._hold(0.0 if self.loop else self._score.duration)
            self.over = not self.loop
            if self.loop:
                self.play()

    def _run(self, start: float, stopped: threading.Event) -> None:
        from scorebreath.engine.player import play_score

        try:
            play_score(
                self._score, self._media, self._sounder, start=start, loop=self._looping, on_time=self._told,
                stopped=stopped,
            )  # fmt: skip
        except BaseException as error:  # raised again by whoever looks
            self._failure = error

    def _told(self, position: float) -> None:
        now = time.time()
        if now < self._begun:
            return
        with self._lock:
            wrapped = position < self._at + (now - self._since if self._since else 0.0) - WRAPPED
            self._at, self._since = position, now
        if wrapped and not self.loop and self._stopped is not None:
            self._at, self._since = self._score.duration, 0.0
            self._stopped.set()

    def _hold(self, position: float) -> None:
        with self._lock:
            self._at, self._since = position, 0.0
