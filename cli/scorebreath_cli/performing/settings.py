"""Options of performing as given, and what they mean; whatever is wrong with them is said before anything is opened."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from scorebreath.errors import InputError, did_you_mean, shortened

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

    from scorebreath.engine.live.backend import Device
    from scorebreath.engine.live.journal import Journal
    from scorebreath.engine.live.server import LiveServer
    from scorebreath.live.controls.mapping import Mapping

LONGEST_LATENCY = 5.0
"""s"""
OWN_PORT = "own"
"""What `--midi` calls a port of ours."""
_ENDPOINT = re.compile(r"(?:(?P<host>\[[0-9a-fA-F:.]+\]|[^:\s\[\]]+):)?(?P<port>\d{1,5})\Z")


@dataclass(frozen=True, slots=True, kw_only=True)
class EngineOptions:
    """What sounds, and on what."""

    engine: str
    device: str | None = None
    rate: int | None = None
    """Hz; None: the device's own"""
    lookahead: float | None = None
    """s"""
    output_latency: float | None = None
    """s; None: as the device says"""

    def check(self) -> None:
        """Refuse what is wrong.

        Raises:
            InputError: Names it.
        """
        from scorebreath.engine.live.making import NAMES, backend_named
        from scorebreath.engine.rates import check_sample_rate

        if self.rate is not None:
            check_sample_rate(self.rate)
        if self.lookahead is not None and not 0.02 <= self.lookahead <= 10:
            raise InputError(f"--lookahead {self.lookahead:g}: must be in [0.02, 10] s")
        if self.output_latency is not None and not 0.0 <= self.output_latency <= LONGEST_LATENCY:
            raise InputError(f"--output-latency {self.output_latency:g}: must be in [0, {LONGEST_LATENCY:g}] s")
        if self.rate is not None and self.engine.startswith("scsynth@"):
            raise InputError(f"--rate {self.rate}: {self.engine} runs already, at a rate of its own")
        try:
            backend_named(self.engine, self.as_device())
        except InputError as error:
            known = [name for name in NAMES if name.isalpha()]
            hint = did_you_mean(self.engine.partition(":")[0], known) if "must be one of" in str(error) else ""
            raise InputError(f"{error}{hint}") from None

    def open(self, *, journal: Journal | None, on_trouble: Callable[[str], None]) -> LiveServer:
        """An engine that is ready to play.

        Raises:
            EngineError: It does not come.
        """
        from scorebreath.engine.live.making import sounder_named
        from scorebreath.engine.live.sounder import LOOKAHEAD

        return sounder_named(
            self.engine, device=self.as_device(), lookahead=self.lookahead or LOOKAHEAD, journal=journal,
            on_trouble=on_trouble,
        )  # fmt: skip

    def latency(self, sounder: LiveServer) -> float:
        """Seconds from a sound's time to the ear."""
        return sounder.latency + (sounder.output_latency if self.output_latency is None else self.output_latency)

    def as_device(self) -> Device | None:
        """What an engine of ours is to play on; None: the usual one."""
        from scorebreath.engine.live.backend import Device

        if self.device is None and self.rate is None:
            return None
        return Device(name=self.device or "", sample_rate=self.rate or 0)


@dataclass(frozen=True, slots=True, kw_only=True)
class StreamOptions:
    """Where curves go."""

    targets: tuple[str, ...] = ()
    rate: str = "60"
    """pictures of a body a second, as given"""
    lead: float = 0.0
    """s"""

    def check(self, *, json_lines: bool) -> Fraction:
        """Refuse what is wrong; the rate.

        Raises:
            InputError: Names it.
        """
        from scorebreath.live.streams.addresses import parse
        from scorebreath.live.streams.sender import HIGHEST, LONGEST_LEAD
        from scorebreath_cli.settings import rate_of

        rate = rate_of("--curve-rate", self.rate, HIGHEST)
        if not 0.0 <= self.lead <= LONGEST_LEAD:
            raise InputError(f"--curve-lead {self.lead:g}: must be in [0, {LONGEST_LEAD:g}] s")
        addresses = [parse(target) for target in self.targets]
        if sum(address.path == "-" for address in addresses) > 1:
            raise InputError("--to -: stdout takes one stream; expected it once")
        if json_lines and self.to_stdout:
            raise InputError("--json tells its events on stdout, where --to - would send curves; use --to jsonl:FILE")
        return rate

    @property
    def to_stdout(self) -> bool:
        """Whether stdout is taken by curves."""
        from scorebreath.live.streams.addresses import parse

        return any(parse(target).path == "-" for target in self.targets)


@dataclass(frozen=True, slots=True, kw_only=True)
class ControlOptions:
    """What moves parameters from outside."""

    osc: str | None = None
    """[HOST:]PORT; None: the usual one, if it is free"""
    no_osc: bool = False
    midi: str | None = None
    """name of an input, or a part of it; OWN_PORT; None: no MIDI"""
    midi_out: str | None = None
    midi_map: str | None = None
    """file"""
    midi_api: str | None = None
    """which of the machine's systems of MIDI; None: the first that works"""

    def osc_endpoint(self) -> tuple[str, int] | None:
        """Where to listen for OSC; None: nowhere.

        Raises:
            InputError: It is no address, or it is asked for and forbidden at once.
        """
        from scorebreath.live.controls.osc_server import HOST, PORT

        if self.no_osc:
            if self.osc is not None:
                raise InputError(f"--osc {shortened(self.osc, 40)} and --no-osc contradict each other")
            return None
        return (HOST, PORT) if self.osc is None else endpoint("--osc", self.osc, HOST)

    def mapping(self) -> Mapping | None:
        """Which knob does what; None: as by default.

        Raises:
            InputError: There is a file, but no MIDI, or something is wrong with it.
        """
        if self.midi is None:
            others = {"--midi-out": self.midi_out, "--midi-map": self.midi_map, "--midi-api": self.midi_api}
            for flag, value in others.items():
                if value is not None:
                    raise InputError(f"{flag} {shortened(value, 40)}: expected --midi PORT beside it")
        if self.midi_api is not None:
            from scorebreath.live.controls.rtmidi_driver import check_api

            check_api(self.midi_api)
        if self.midi_map is None:
            return None
        from scorebreath.live.controls.mapping_file import read_mapping

        return read_mapping(Path(self.midi_map))


def endpoint(flag: str, text: str, host: str) -> tuple[str, int]:
    """A host and a port.

    Args:
        flag: The option, for messages.
        text: `PORT` or `HOST:PORT`, `[::1]:PORT`.
        host: Where none is given.

    Raises:
        InputError: It is none.

    >>> endpoint("--osc", "9001", "127.0.0.1"), endpoint("--osc", "[::1]:9001", "")
    (('127.0.0.1', 9001), ('::1', 9001))
    """
    found = _ENDPOINT.match(text)
    if found is None or not 0 <= int(found["port"]) < 65536:
        raise InputError(f"{flag} {shortened(text, 60)!r}: expected PORT or HOST:PORT, such as 57130 or 0.0.0.0:57130")
    return (found["host"] or host).strip("[]"), int(found["port"])


def seconds_from(flag: str, value: float, longest: float) -> float:
    """A time in a Score.

    Raises:
        InputError: It is not within it.
    """
    if math.isnan(value) or not 0 <= value < max(longest, 1e-6):
        raise InputError(f"{flag} {value:g}: must be in [0, {longest:g}) s, within the score")
    return value
