"""The hub: pictures of every body at a rate, to several targets, none of which can disturb the others.

Picture `n` shows the curves at `n / rate` seconds, whatever the clock did, so what was streamed equals what is sampled
afterwards. It is sent when that moment is heard, or `lead` earlier. Pictures that were missed, because the process
slept, are left out and counted, never sent in a burst.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from types import MappingProxyType

from scorebreath.curves.curve_set import CurveSet
from scorebreath.errors import InputError
from scorebreath.live.picture import EVERYBODY, Picture, Stream, Strip

HIGHEST = 1000
"""pictures a second"""
LONGEST_LEAD = 5.0
"""s"""
BACKWARD = 0.25
"""s that the clock goes back before that is taken for a jump to another place"""
AHEAD = 8
"""Pictures that are worked out together, while the curves stay."""
LONGEST_WAIT = 60
"""Pictures that a target in trouble is spared at most; twice as many each time, from one on."""
SAID_AGAIN = 600
"""Pictures before the same trouble of a target is reported again."""
NAME = "scorebreath"
Trouble = Callable[[str, str], None]
"""Told of a target that is in trouble: its name, what happened."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Count:
    """What became of a target's pictures."""

    sent: int = 0
    skipped: int = 0
    """missed by the clock, or spared while in trouble"""
    failed: int = 0


@dataclass(slots=True, kw_only=True)
class _Line:
    """A stream while it runs."""

    stream: Stream
    part: Fraction
    """of the sender's pictures that it gets"""
    count: Count = Count()
    last: int | None = None
    """number of the picture that it got last, or would have"""
    failures: int = 0
    """since it last worked"""
    spared: int = 0
    """pictures that it is still to be left alone"""
    said: int = -1
    """when its trouble was reported last, as a count of ticks"""

    def due(self, number: int) -> int:
        """How many of its own pictures came up to this number, since the last."""
        return 1 if self.last is None else math.floor(number * self.part) - math.floor(self.last * self.part)


class Sender:
    """Pictures on their way.

    Args:
        curves: The curves of every body as they are now; whoever began comes first. They must be valid up to `lead`
            past the clock.
        clock: Seconds of the performance that the engine is told to play now.
        start: Unix time at which second 0 is played; a function where that may change.
        streams: Where to.
        rate: Pictures of a body a second; exact, where it is a Fraction.
        lead: s by which pictures are sent before they are heard.
        latency: s from the engine's time to the ear: the engine's own and the output's.
        names: Body to what receivers know it by; others are `scorebreath`, `scorebreath-body2`, ...
        on_trouble: Told of targets in trouble, from the sender's thread.

    Raises:
        InputError: The rate or the lead is out of range.
    """

    def __init__(
        self, curves: Callable[[], Mapping[str, CurveSet]], clock: Callable[[], float],
        start: float | Callable[[], float], streams: Sequence[Stream], *, rate: float | Fraction = 60,
        lead: float = 0.0, latency: float = 0.0, names: Mapping[str, str] = MappingProxyType({}),
        on_trouble: Trouble = lambda name, message: None,
    ) -> None:  # fmt: skip
        """Look at the numbers; nothing is sent yet."""
        if not 0 < rate <= HIGHEST:
            raise InputError(f"rate={rate} must be above 0 and at most {HIGHEST} pictures a second")
        if not abs(lead) <= LONGEST_LEAD:
            raise InputError(f"lead={lead} must be in [-{LONGEST_LEAD:g}, {LONGEST_LEAD:g}] s")
        self._curves, self._clock, self._names, self._on_trouble = curves, clock, names, on_trouble
        self._start = start if callable(start) else lambda: start
        self._rate = Fraction(rate).limit_denominator(1_000_000)
        self._lead, self._latency = lead, latency
        self._lines = [_Line(stream=stream, part=_part(stream, self._rate)) for stream in streams]
        self._strips: dict[str, Strip] = {}
        self._last: int | None = None
        self._ticks = 0
        self._curves_said = False
        self._over = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def counts(self) -> tuple[Count, ...]:
        """What became of the pictures, for each of the streams in their order."""
        return tuple(line.count for line in self._lines)

    def tick(self, now: float) -> int:
        """Send the picture that is due, if one is.

        Args:
            now: What the clock says.

        Returns:
            How many pictures were sent, all targets together.
        """
        shown = now - self._latency + self._lead
        number = self._number(shown)
        if number < 0 or not self._is_new(number, shown):
            return 0
        self._last = number
        self._ticks += 1
        pictures = self._pictures(number)
        return sum(self._serve(line, number, pictures) for line in self._lines)

    def start(self) -> None:
        """Send from a thread of its own, from now on.

        Raises:
            InputError: It was started before.
        """
        if self._thread is not None:
            raise InputError("a sender is started once; make another")
        self._thread = threading.Thread(target=self._run, name="streams", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Send no more, and close the targets; does nothing the second time."""
        if self._over.is_set():
            return
        self._over.set()
        if self._thread is not None:
            self._thread.join(5.0)
        for line in self._lines:
            try:
                line.stream.target.close()
            except Exception as error:  # the others are to be closed all the same
                self._on_trouble(line.stream.target.name, f"cannot be closed: {error}")

    def _run(self) -> None:
        while not self._over.is_set():
            self.tick(self._clock())
            following = 0 if self._last is None else self._last + 1
            wait = float(following / self._rate) - (self._clock() - self._latency + self._lead)
            self._over.wait(min(max(wait, 0.0005), float(1 / self._rate), 0.1))

    def _number(self, seconds: float) -> int:
        """The last picture whose moment has come."""
        number = math.floor(seconds * self._rate)
        return number + (self.time(number + 1) <= seconds) - (self.time(number) > seconds)

    def time(self, number: int) -> float:
        """Seconds of the performance that a picture shows: divided, as offline."""
        return number * self._rate.denominator / self._rate.numerator

    def _is_new(self, number: int, shown: float) -> bool:
        if self._last is None or number > self._last:
            return True
        if self.time(self._last) - shown > BACKWARD:
            for line in self._lines:
                line.last = None
            return True
        return False

    def _pictures(self, number: int) -> list[Picture]:
        try:
            curves, start = dict(self._curves()), self._start()
        except Exception as error:  # a thread that ended here would freeze every character
            if not self._curves_said:
                self._on_trouble("curves", _told(error))
            self._curves_said = True
            return []
        self._curves_said = False
        time = self.time(number)
        return [
            Picture(
                body=body, name=self._names.get(body, f"{NAME}-{body}" if place else NAME), time=time,
                unix=start + time + self._latency, number=number, curves=each, strip=self._strip(body, each, number),
            )
            for place, (body, each) in enumerate(curves.items())
        ]  # fmt: skip

    def _strip(self, body: str, curves: CurveSet, number: int) -> Strip:
        """The strip that shows this picture: curves that stay are sampled ahead."""
        before = self._strips.get(body)
        stayed = before is not None and before.curves is curves
        if before is None or not stayed or self.time(number) not in before.times:
            before = Strip(curves, [self.time(number + each) for each in range(AHEAD if stayed else 1)])
            self._strips[body] = before
        return before

    def _serve(self, line: _Line, number: int, pictures: Sequence[Picture]) -> int:
        due = line.due(number)
        if due < 1:
            return 0
        line.last = number
        wanted = [picture for place, picture in enumerate(pictures) if _wants(line.stream, picture, place)]
        line.count = replace(line.count, skipped=line.count.skipped + (due - 1) * max(1, len(wanted)))
        if line.spared:
            line.spared -= 1
            line.count = replace(line.count, skipped=line.count.skipped + len(wanted))
            return 0
        sent = 0
        for picture in wanted:
            try:
                line.stream.target.send(picture)
            except Exception as error:  # whatever it is, the others are not to suffer
                self._failed(line, error)
                line.count = replace(line.count, failed=line.count.failed + 1)
                break
            sent += 1
        else:
            line.failures = 0
        line.count = replace(line.count, sent=line.count.sent + sent)
        return sent

    def _failed(self, line: _Line, error: Exception) -> None:
        line.spared = min(2**line.failures, LONGEST_WAIT) if line.failures < 16 else LONGEST_WAIT
        line.failures += 1
        if line.said < 0 or (line.failures == 1 and self._ticks - line.said >= SAID_AGAIN):
            line.said = self._ticks
            self._on_trouble(line.stream.target.name, _told(error))


def _part(stream: Stream, rate: Fraction) -> Fraction:
    if stream.rate is None:
        return Fraction(1)
    if not 0 < stream.rate <= HIGHEST:
        raise InputError(f"{stream.target.name}: rate={stream.rate:g} must be above 0 and at most {HIGHEST}")
    return min(Fraction(stream.rate).limit_denominator(1_000_000) / rate, Fraction(1))


def _wants(stream: Stream, picture: Picture, place: int) -> bool:
    return stream.body in (EVERYBODY, picture.body) or (not stream.body and place == 0)


def _told(error: Exception) -> str:
    return f"{error}" if isinstance(error, OSError) and str(error) else f"{type(error).__name__}: {error}"
