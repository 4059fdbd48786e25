"""A MIDI controller in front of a desk: its ports, and one thread."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from types import TracebackType
from typing import Any, Self

from scorebreath.errors import EnvironmentFailure
from scorebreath.live.controls.mapping import Control, Mapping
from scorebreath.live.controls.midi_control import MidiControl, Said
from scorebreath.live.controls.midi_ports import Driver, Input, KeptPort
from scorebreath.live.controls.rtmidi_driver import RtMidi
from scorebreath.live.desk import Desk

LOOKING = 0.25
"""s between two looks whether ports come or go"""
LEAST = 0.004
"""s between two looks at what came: of a flood of messages, this many a second at most are done for each control"""


class MidiServer:
    """Opens a controller, or a port of our own for others to connect to, and does what it says."""

    def __init__(
        self,
        desk: Desk,
        *,
        port: str = "",
        output: str = "",
        mapping: Mapping | None = None,
        wait: bool = False,
        api: str = "",
        said: Said = lambda text: None,
        learned: Callable[[Control], None] = lambda control: None,
        driver: Driver | None = None,
    ) -> None:
        """Prepare; `start` begins.

        Args:
            desk: What is moved.
            port: Name of an input, or a part of it; empty: our own, `scorebreath`.
            output: Name of an output, or a part of it, that values are told to; empty: none.
            mapping: Which knob does what; None: the default.
            wait: Whether ports that are not there yet are waited for.
            api: As `RtMidi` takes it.
            said: Told, by any thread, what people should know.
            learned: Told of every control that was learned.
            driver: Where ports come from; None: python-rtmidi.
        """
        self._desk, self._wanted, self._output_wanted, self._wait, self._api = desk, port, output, wait, api
        self._mapping, self._said, self._learned, self._driver = mapping, said, learned, driver
        self._stopping = False
        self._thread: threading.Thread | None = None
        self._kept: list[KeptPort] = []
        self._own: Input | None = None
        self.control: MidiControl
        """learning, the mapping and the counts; once started"""

    @property
    def ports(self) -> tuple[str, ...]:
        """Ports that are open now."""
        own = (self._own.name,) if self._own else ()
        return (*own, *(kept.name for kept in self._kept if kept.name))

    def start(self) -> None:
        """Open the ports and begin.

        Raises:
            MissingExtraError: python-rtmidi is not installed.
            EnvironmentFailure: This machine has no MIDI, or no ports of our own.
            InputError: There is no such port, and it is not to be waited for.
        """
        if self._thread:
            return
        driver = self._driver or RtMidi(self._api)
        self.control = MidiControl(self._desk, self._mapping, said=self._said, learned=self._learned)
        try:
            self._open(driver)
        except Exception:
            self._close(driver)
            raise
        self._stopping = False
        self._thread = threading.Thread(target=self._serve, args=(driver,), name="midi", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Close the ports and end the thread; does nothing the second time."""
        if not self._thread:
            return
        self._stopping = True
        self._thread.join()
        self._thread = None

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def _open(self, driver: Driver) -> None:
        if self._wanted:
            self._kept.append(KeptPort(driver, "input", self._wanted, self._said))
        else:
            try:
                self._own = driver.open_virtual()
            except (OSError, RuntimeError) as error:  # there are none on Windows
                raise EnvironmentFailure(f"MIDI: no port of our own can be opened: {error}") from None
        if self._output_wanted:
            self._kept.append(KeptPort(driver, "output", self._output_wanted, self._said))
        for kept in self._kept:
            if self._wait:
                kept.poll()
            else:
                kept.open_now()
        self.control.refresh()

    def _close(self, driver: Driver) -> None:
        self.control.close()
        for kept in self._kept:
            kept.close()
        if self._own:
            self._own.close()
        self._kept, self._own = [], None
        if isinstance(driver, RtMidi):
            driver.forget()

    def _serve(self, driver: Driver) -> None:
        looked = time.monotonic()
        while not self._stopping:
            for message in self._received():
                self.control.feed(message)
            for message in self.control.drain():
                for kept in self._kept:
                    kept.send(message)
            now = time.monotonic()
            if self._kept and now - looked >= LOOKING:
                looked = now
                come = [kept.poll() for kept in self._kept]  # every one is looked at
                if any(come):
                    self.control.refresh()
            time.sleep(LEAST)
        self._close(driver)

    def _received(self) -> Iterator[Any]:
        if self._own:
            yield from self._own.receive()
        for kept in self._kept:
            yield from kept.receive()
