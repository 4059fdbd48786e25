"""A finished Score played as it would be performed: from anywhere in it, once or over and over."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from threading import Event

from scorebreath.engine.live.sounder import Sounder
from scorebreath.engine.moves import AS_WRITTEN, Move, Ratios, moves
from scorebreath.engine.onsets import Onset, onsets
from scorebreath.errors import InputError
from scorebreath.media.store import MediaStore
from scorebreath.score.document import Score
from scorebreath_synthdefs.catalogue import SPEECH

LEAD = 0.5
"""s from the call to the first sound: media are made ready meanwhile."""
AHEAD = 4.0
"""s before its time that a sound is given to the sounder."""
FADE = 0.05
"""s in which what sounds fades out when playing is stopped."""
_STEP = 0.05  # s between looks


@dataclass(frozen=True, slots=True, kw_only=True)
class Pace:
    """Where time comes from; tests have a time of their own."""

    now: Callable[[], float] = time.time
    wait: Callable[[float], object] = time.sleep


def play_score(
    score: Score,
    media: MediaStore,
    sounder: Sounder,
    *,
    start: float = 0.0,
    loop: bool = False,
    on_time: Callable[[float], None] | None = None,
    stopped: Event | None = None,
    pace: Pace | None = None,
) -> bool:
    """Play a Score and come back when it is over, or was stopped.

    Speech that would sound at `start` is resumed in the middle; a breath is not. With `loop` the next round begins on
    the very frame on which the last one ends.

    Args:
        score: What to play.
        media: Its samples.
        sounder: What plays it; stays open.
        start: Seconds of the Score to begin at.
        loop: Whether to begin again, from 0, until it is stopped.
        on_time: Told every now and then which second of the Score is sounding.
        stopped: Set by whoever has heard enough.
        pace: Where time comes from.

    Returns:
        Whether it came to its end.

    Raises:
        InputError: `start` is not within the Score.
        ScoreError: A sound cannot be played.
    """
    if not 0 <= start < max(score.duration, 1e-6):
        raise InputError(f"start={start:g} must be in 0..{score.duration:g} s, within the score")
    if loop and score.duration <= 0:
        raise InputError("a score of no length cannot be played over and over")
    clock, over = pace or Pace(), stopped or Event()
    sounds, moved = onsets(score), moves(score)
    begin = clock.now() - sounder.start_unix + LEAD - start  # second of the performance at which the Score's 0 is
    rounds = _Rounds(sounder, media, sounds, moved, score.duration)
    first, number = start, 0
    while True:
        end = begin + score.duration
        rounds.begin(number, begin, first)
        while (now := clock.now() - sounder.start_unix) < end - (AHEAD if loop else 0.0):
            if over.is_set():
                sounder.hush(FADE)
                return False
            rounds.feed(now + AHEAD)
            if on_time is not None:
                on_time(_position(now - begin, score.duration, start, loop))
            clock.wait(_STEP)
        rounds.feed(end)
        if not loop:
            return True
        begin, first, number = end, 0.0, number + 1


def _position(since: float, duration: float, start: float, loop: bool) -> float:
    """The second of the Score that sounds; a round is given ahead of its time."""
    if loop and since < 0:
        return since % duration if since > -AHEAD - duration else 0.0
    return min(max(since, start if not loop else 0.0), duration)


class _Rounds:
    """Gives a sounder one round after the other, a few seconds ahead. It keeps what is left of one, so it changes."""

    def __init__(
        self, sounder: Sounder, media: MediaStore, sounds: Sequence[Onset], moved: Sequence[Move], duration: float
    ) -> None:
        self._sounder, self._media = sounder, media
        self._sounds, self._moved, self._duration = sounds, moved, duration
        self._coming: list[Onset | Move] = []

    def begin(self, number: int, begin: float, start: float) -> None:
        """A round whose second 0 is at `begin`, from `start` on."""
        heard = [one for sound in self._sounds if (one := seek(sound, start)) is not None and one.time < self._duration]
        placed = [
            replace(
                one,
                time=begin + one.time,
                event=one.event if number == 0 else f"{one.event}~{number}",
                cut=None if one.cut is None else replace(one.cut, time=begin + one.cut.time),
            )
            for one in heard
        ]
        resumed = [replace(one, time=begin + one.time) for one in seek_moves(self._moved, start)]
        self._coming = sorted([*resumed, *placed], key=_time)

    def feed(self, until: float) -> None:
        """Give what begins before a time."""
        count = sum(one.time < until for one in self._coming)
        due, self._coming = self._coming[:count], self._coming[count:]
        for one in due:
            if isinstance(one, Move):
                self._sounder.move(one.time, one.body, one.after, one.glide)
        sounds = [one for one in due if isinstance(one, Onset)]
        if sounds:
            self._sounder.play(sounds, self._media)


def seek(sound: Onset, start: float) -> Onset | None:
    """What is left of a sound for whoever begins at `start`: all, speech from its middle, or nothing."""
    if sound.time >= start:
        return sound
    if sound.instrument != SPEECH or sound.end <= start:
        return None
    gone = start - sound.time
    controls = {**sound.controls, "start": sound.controls.get("start", 0.0) + gone}
    return replace(sound, time=start, duration=sound.duration - gone, controls=controls)


def seek_moves(moved: Sequence[Move], start: float) -> Iterator[Move]:
    """Moves from `start` on, after those that come to what was in force then."""
    before = [move for move in moved if move.time < start]
    ratios = Ratios(before)
    last = {move.body: move for move in before}
    for body in sorted({move.body for move in moved}):
        heard = ratios.at(body, start)
        yield Move(time=start, glide=0.0, body=body, before=AS_WRITTEN, after=heard)
        if body in last and start < last[body].time + last[body].glide:
            left = last[body].time + last[body].glide - start
            yield Move(time=start, glide=left, body=body, before=heard, after=last[body].after)
    yield from (move for move in moved if move.time >= start)


def _time(one: Onset | Move) -> float:
    return one.time
