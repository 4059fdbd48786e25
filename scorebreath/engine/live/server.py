"""Sounds as they happen, on any engine: threads around a conductor, and an engine that comes back when it dies."""

from __future__ import annotations

import itertools
import queue
import shutil
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from scorebreath.engine.live import orders
from scorebreath.engine.live.backend import Backend
from scorebreath.engine.live.conductor import Conductor, Played
from scorebreath.engine.live.journal import Journal
from scorebreath.engine.live.orders import Mix
from scorebreath.engine.live.shelf import Shelf
from scorebreath.engine.live.sounder import LOOKAHEAD, Trouble
from scorebreath.engine.live.status import Status
from scorebreath.engine.live.timing import AT_ONCE, LiveClock
from scorebreath.engine.onsets import Onset
from scorebreath.engine.osc import bundle, message
from scorebreath.errors import EngineError, EnvironmentFailure, InputError, ScorebreathError
from scorebreath.media.store import MediaStore
from scorebreath.score.performing import Heard
from scorebreath_synthdefs.catalogue import LOOK_AHEAD, MOVER, PLACE, SPEECH, master_name

LOAD = 5.0
"""s that an engine may take to load something."""
_GLANCE = 0.1  # s between looks after the engine
_AGAIN = (0.0, 0.2, 0.5, 1.0, 2.0)  # s before each attempt to have it back; the last for all that follow
_PATIENCE = 3.0  # s that threads get to end
Job = tuple[Sequence[Onset], MediaStore, int]


class LiveServer:
    """A `Sounder` on an engine that runs; use it as a context manager.

    Args:
        backend: The engine.
        mix: How sounds leave it.
        lookahead: Seconds before its time that it is told of a sound.
        journal: Told of every bundle.
        on_trouble: Told what goes wrong, and that it is mended.
        now: The Unix time, for tests.

    Raises:
        EngineError: The engine does not come.
        InputError: A setting is out of range.
    """

    def __init__(
        self,
        backend: Backend,
        *,
        mix: Mix | None = None,
        lookahead: float = LOOKAHEAD,
        journal: Journal | None = None,
        on_trouble: Trouble = lambda _: None,
        now: Callable[[], float] = time.time,
    ) -> None:
        """Have the engine run and set the stage."""
        if not 0.02 <= lookahead <= 10:
            raise InputError(f"lookahead={lookahead:g} must be in 0.02..10 s")
        self.mix = mix or Mix()
        if self.mix.channels not in {1, 2}:
            raise InputError(f"channels={self.mix.channels} must be 1 or 2")
        self._backend, self._now, self._told = backend, now, on_trouble
        self._folder = Path(tempfile.mkdtemp(prefix="scorebreath-live-"))
        self._lock = threading.RLock()
        self._woken, self._over = threading.Condition(self._lock), threading.Event()
        self._jobs: queue.Queue[Job | None] = queue.Queue()
        self._sync = itertools.count(1)
        self._known = {MOVER, PLACE, master_name(self.mix.channels, self.mix.limited)}
        self._generation = self._restarts = 0
        try:
            self._rate = backend.start()
            self._shelf = Shelf(self._folder, backend.layout, self._rate)
            self._conductor = Conductor(
                clock=LiveClock(start=now(), sample_rate=self._rate),
                layout=backend.layout, mix=self.mix, send=self._send, now=now, lookahead=lookahead, journal=journal,
                dropped=self._drop, lost=self._speech_lost,
            )  # fmt: skip
            self._teach(self._known)
            self._conductor.engine_began(backend.layout, self._rate)
        except BaseException:
            backend.close()
            shutil.rmtree(self._folder, ignore_errors=True)
            raise
        self._threads = [
            threading.Thread(target=run, name=f"engine-{name}", daemon=True)
            for name, run in (("bundles", self._pump), ("media", self._work), ("watch", self._watch))
        ]
        for thread in self._threads:
            thread.start()

    @property
    def start_unix(self) -> float:
        """Unix time of the performance's second 0."""
        return self._conductor.clock.start

    @property
    def latency(self) -> float:
        """Seconds by which the limiter is late."""
        return LOOK_AHEAD if self.mix.limited else 0.0

    @property
    def output_latency(self) -> float:
        """Seconds from the engine's output to the speaker, as far as the device says."""
        return self._backend.output_latency

    @property
    def sample_rate(self) -> int:
        """Of the engine, Hz."""
        return self._rate

    def begin(self, start_unix: float) -> None:
        """Say when second 0 is; before anything is played."""
        with self._lock:
            self._conductor.clock = LiveClock(start=start_unix, sample_rate=self._rate)

    def play(self, sounds: Sequence[Onset], media: MediaStore) -> None:
        """Sounds that are to come; what has no media waits for nothing."""
        if self._over.is_set():
            return
        with self._lock:
            known = [one for one in sounds if one.media is None and one.instrument in self._known]
            for sound in known:
                self._conductor.play(Played(sound))
            self._woken.notify_all()
            rest = [one for one in sounds if one.media is not None or one.instrument not in self._known]
            if rest:
                self._jobs.put((rest, media, self._generation))

    def cut(self, time: float, targets: Iterable[str], fade: float) -> None:
        """The sounds of these events end."""
        with self._woken:
            self._conductor.cut(time, tuple(targets), fade)
            self._woken.notify_all()

    def move(self, time: float, body: str, heard: Heard, glide: float) -> None:
        """A body's sounds are moved."""
        with self._woken:
            self._conductor.move(time, body, heard, glide)
            self._woken.notify_all()

    def hush(self, fade: float) -> None:
        """What sounds fades out, and what was given is dropped."""
        with self._woken:
            self._generation += 1
            self._conductor.hush(fade)
            self._woken.notify_all()

    def panic(self) -> None:
        """Silence at once; what is being made ready is dropped, too."""
        with self._woken:
            self._generation += 1
            self._conductor.panic()

    def pan(self, body: str, pan: float) -> None:
        """Put a body between the speakers.

        Raises:
            InputError: Not between -1 and 1.
        """
        if not -1 <= pan <= 1:
            raise InputError(f"pan={pan:g} must be in -1..1")
        with self._lock:
            self._conductor.pan(body, pan)

    def status(self) -> Status:
        """How it does."""
        with self._lock:
            tally = self._conductor.tally
            return Status(
                alive=self._conductor.alive and not self._over.is_set(),
                engine=self._backend.name,
                sample_rate=self._rate,
                latency=self.latency,
                sent=tally.sent,
                late=self._backend.late,
                late_sent=tally.late_sent,
                lost=tally.lost,
                restarts=self._restarts,
                waiting=self._conductor.waiting + self._jobs.qsize(),
                lead_min=tally.lead_min,
                lead_mean=tally.lead_mean,
            )

    def close(self) -> None:
        """Silence, and the end of everything that is ours."""
        if self._over.is_set():
            return
        with self._woken:
            self._conductor.panic()
            self._over.set()
            self._woken.notify_all()
        self._jobs.put(None)
        for thread in self._threads:
            thread.join(_PATIENCE)
        self._backend.close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def __enter__(self) -> LiveServer:
        """Itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close."""
        self.close()

    def _send(self, tag: int, messages: Sequence[bytes]) -> None:
        self._backend.send(bundle(tag, messages))

    def _pump(self) -> None:
        """Send what is due, as long as there is anything."""
        while not self._over.is_set():
            with self._woken:
                try:
                    following = self._conductor.pump(self._now())
                except Exception as error:  # one thing that cannot be sent must not silence the rest
                    self._told(f"a bundle is lost: {error}")
                    self._conductor.tally.lost += 1
                    continue
                wait = _GLANCE if following is None else min(_GLANCE, max(0.0, following - self._now()))
                if wait > 0 and not self._over.is_set():
                    self._woken.wait(wait)

    def _work(self) -> None:
        """Make media ready, away from whoever plays them."""
        while (job := self._jobs.get()) is not None and not self._over.is_set():
            sounds, media, generation = job
            try:
                self._teach({sound.instrument for sound in sounds} - self._known)
            except EngineError as error:
                self._told(str(error))
            for sound in sounds:
                if generation != self._generation or self._over.is_set():
                    break
                try:
                    self._prepare(sound, media, generation)
                except (ScorebreathError, OSError) as error:
                    self._lose(f"a sound of {sound.event!r} is lost: {error}")

    def _prepare(self, sound: Onset, media: MediaStore, generation: int) -> None:
        played = Played(sound)
        if sound.media is not None:
            played.file = self._shelf.file(sound.media, sound.media_duration, media)
            played.buffer = self._shelf.buffer()
            if self._conductor.alive and not self._load(played):
                self._shelf.release(played)
                if self._conductor.alive and not self._backend.trouble():
                    raise EngineError(f"the engine does not load {played.file}")
                self._lose(f"a sound of {sound.event!r} is lost: the engine is away")
                return
        with self._woken:
            if generation == self._generation:
                self._conductor.play(played)
                self._woken.notify_all()
            else:
                self._drop(played)

    def _load(self, played: Played) -> bool:
        if played.buffer is None:  # dropped meanwhile
            return True
        order = message("/b_allocRead", played.buffer, str(self._folder / played.file), 0, 0)
        return self._backend.done(order, "/done", ("/b_allocRead", played.buffer), LOAD)

    def _drop(self, played: Played) -> None:
        """A sound is over: forget its samples."""
        if played.buffer is not None:
            if self._conductor.alive:
                self._send(AT_ONCE, [message("/b_free", played.buffer)])
            self._shelf.release(played)

    def _teach(self, names: Iterable[str]) -> None:
        """Give the engine instruments, and wait until it has them."""
        names = sorted(names)
        if not names:
            return
        for name in names:
            self._backend.send(orders.instrument(name))
        number = next(self._sync)
        if not self._backend.done(message("/sync", number), "/synced", (number,), LOAD):
            raise EngineError(f"the {self._backend.name} engine does not take its instruments")
        self._known |= set(names)

    def _speech_lost(self, sound: Onset) -> None:
        """Words that are not heard are worth a message; breaths are only counted."""
        if sound.instrument == SPEECH:
            why = "it came too late" if self._conductor.alive else "the engine is away"
            self._told(f"a sound of {sound.event!r} is lost: {why}")

    def _lose(self, what: str) -> None:
        with self._lock:
            self._conductor.tally.lost += 1
        self._told(what)

    def _watch(self) -> None:
        """Look after the engine, and have it back when it is gone."""
        while not self._over.wait(_GLANCE):
            trouble = self._backend.trouble()
            if not trouble:
                continue
            with self._lock:
                self._conductor.engine_ended(self._now())
            self._told(f"the {self._backend.name} engine {trouble}; it is started again")
            for attempt in itertools.count():
                if self._over.wait(_AGAIN[min(attempt, len(_AGAIN) - 1)]):
                    return
                try:
                    self._restart()
                    break
                except EnvironmentFailure as error:
                    if attempt == len(_AGAIN) - 1:
                        self._told(f"it does not come back, and is tried again and again: {error}")

    def _restart(self) -> None:
        rate = self._backend.start()
        if rate != self._rate:
            raise EngineError(f"the engine comes back at {rate} Hz instead of {self._rate} Hz")
        self._teach(self._known)
        loaded: set[int] = set()
        while True:
            with self._woken:
                here = [one for one in self._conductor.here if one.node is None and one.buffer is not None]
                wanted = [one for one in here if id(one) not in loaded]
                if not wanted:
                    self._conductor.engine_began(self._backend.layout, rate)
                    self._restarts += 1
                    self._woken.notify_all()
                    break
            for played in wanted:
                if not self._load(played):
                    raise EngineError(f"the engine does not load {played.file}")
                loaded.add(id(played))
        self._told(f"the {self._backend.name} engine is back")
