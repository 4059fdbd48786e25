"""Targets as they are written: `vmc://192.168.1.7:39539?names=vrm1&rate=30`, `ws://127.0.0.1:8765`, `-`."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import BinaryIO, cast
from urllib.parse import parse_qsl, urlsplit

from scorebreath.curves.rigs.table import rig_named
from scorebreath.errors import EnvironmentFailure, InputError, did_you_mean, shortened
from scorebreath.live.picture import EVERYBODY, Stream, Target
from scorebreath.live.streams.datagrams import Datagrams
from scorebreath.live.streams.lines import LineTarget
from scorebreath.live.streams.livelink import LiveLinkTarget
from scorebreath.live.streams.osc import OscTarget
from scorebreath.live.streams.skeleton import COMMON, of_model
from scorebreath.live.streams.vmc import VmcTarget

STDOUT = "-"
LONGEST = 2000
"""Characters of an address."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Address:
    """An address, taken apart."""

    text: str
    """as it was written"""
    scheme: str
    host: str = ""
    port: int = 0
    path: str = ""
    """of a file, or STDOUT"""
    options: Mapping[str, str] = field(default_factory=dict)
    """those of its scheme, defaults filled in"""
    body: str = EVERYBODY
    rate: float | None = None

    @property
    def name(self) -> str:
        """What it is, for people: without its options."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{self.scheme}:{self.path}" if self.path else f"{self.scheme}://{host}:{self.port}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Scheme:
    """A kind of target."""

    name: str
    about: str
    host: str
    """default; empty where there is none: the scheme names a file"""
    port: int
    options: Mapping[str, tuple[str, str]]
    """name: default, meaning; besides `COMMON_OPTIONS`"""
    body: str
    """default: EVERYBODY, or empty for receivers that could not tell bodies apart: whoever begins"""
    open: Callable[[Address, BinaryIO | None], Target]


COMMON_OPTIONS: Mapping[str, str] = MappingProxyType(
    {"body": "whose curves: `body2`, `*` for everybody", "rate": "pictures of a body a second, at most the sender's"}
)
"""Options of every scheme."""


def _osc(address: Address, _: BinaryIO | None) -> Target:
    channels = [each for each in address.options["channels"].split(",") if each]
    return _over(address, lambda to: OscTarget(address.name, to, channels=channels, tag=address.options["tag"]))


def _vmc(address: Address, _: BinaryIO | None) -> Target:
    given = address.options
    bones = of_model(given["model"]) if given["model"] else COMMON if _switch(address, "bones") else None
    return _over(
        address,
        lambda to: VmcTarget(
            address.name, to, names=given["names"], shapes=given["shapes"], case=given["case"], bones=bones
        ),
    )


def _livelink(address: Address, _: BinaryIO | None) -> Target:
    frames = _number(address.text, "frames", address.options["frames"], 1, 1000)
    angles = address.options["angles"]
    return _over(address, lambda to: LiveLinkTarget(address.name, to, rate=round(frames), angles=angles))


def _ws(address: Address, _: BinaryIO | None) -> Target:
    from scorebreath.live.streams.websocket import PictureServer, WebSocketTarget

    origins = [each for each in address.options["origins"].split(",") if each]
    server = PictureServer(address.host, address.port, origins=origins)
    try:
        return WebSocketTarget(address.name, server, rig=address.options["rig"])
    except InputError:
        server.close()
        raise


def _jsonl(address: Address, stdout: BinaryIO | None) -> Target:
    rig = address.options["rig"]
    if address.path == STDOUT and stdout is not None:
        return LineTarget(address.name, stdout, rig=rig, keep=True)
    if rig:
        rig_named(rig)
    path = Path(address.path)
    if address.path != STDOUT and path.is_file():
        raise InputError(f"target {address.text!r}: {address.path} is there already; expected the name of a new file")
    if address.path != STDOUT and path.is_fifo() and not _is_read(path):
        raise EnvironmentFailure(f"{address.name} cannot be written: nobody reads it")
    try:
        # Without a buffer: one that cannot be flushed would spoil the end of the process.
        where = os.dup(sys.stdout.fileno()) if address.path == STDOUT else address.path
        stream = open(where, "wb", buffering=0)  # noqa: PTH123, SIM115 - the target closes it
    except (OSError, AttributeError) as error:
        raise EnvironmentFailure(f"{address.name} cannot be written: {error}") from None
    return LineTarget(address.name, cast(BinaryIO, stream), rig=rig)


def _is_read(fifo: Path) -> bool:
    """Whether somebody has the other end; to open one that nobody reads waits for ever."""
    try:
        os.close(os.open(fifo, os.O_WRONLY | os.O_NONBLOCK))
    except OSError:
        return False
    return True


def _over(address: Address, make: Callable[[Datagrams], Target]) -> Target:
    datagrams = Datagrams(address.host, address.port)
    try:
        return make(datagrams)
    except InputError:
        datagrams.close()
        raise


_RIG = {"rig": ("", "a rig whose columns are added, such as `arkit`")}
SCHEMES: Mapping[str, Scheme] = MappingProxyType(
    {
        row.name: row
        for row in (
            Scheme(
                name="osc", about="plain OSC: TouchDesigner, Max, SuperCollider, Resolume", host="127.0.0.1", port=9000,
                body=EVERYBODY, open=_osc,
                options={
                    "channels": ("", "names with commas between; empty: all"),
                    "tag": ("heard", "time tag: `heard`, or `now` for receivers that hold back what comes early"),
                },
            ),
            Scheme(
                name="vmc", about="VMC: VSeeFace, Warudo, VMagicMirror, Unity", host="127.0.0.1", port=39539, body="",
                open=_vmc,
                options={
                    "names": ("vrm0", "of presets: `vrm0`, `vrm1`, `both`"),
                    "shapes": ("presets", "`presets`, `arkit` (Perfect Sync), `both`"),
                    "case": ("pascal", "of other names: `pascal` (JawOpen), `camel` (jawOpen)"),
                    "bones": ("0", "`1`: bones too, where a common figure has them"),
                    "model": ("", "the character's .vrm: bones too, where it has them"),
                },
            ),
            Scheme(
                name="livelink", about="Live Link Face: Unreal", host="127.0.0.1", port=11111, body=EVERYBODY,
                open=_livelink,
                options={
                    "angles": ("radians", "`radians`, `degrees`, `half-turns`"),
                    "frames": ("60", "frames a second that frame numbers count"),
                },
            ),
            Scheme(
                name="ws", about="a WebSocket server that sends lines of JSON: browsers", host="127.0.0.1", port=8765,
                body=EVERYBODY, open=_ws,
                options={**_RIG, "origins": ("", "pages of other hosts that may read, commas between; `*`: all")},
            ),
            Scheme(
                name="jsonl", about="lines of JSON to a file, or to stdout: `jsonl:-` or `-`", host="", port=0,
                body=EVERYBODY, open=_jsonl, options=_RIG,
            ),
        )
    }
)  # fmt: skip
"""Every kind of target. A new one is a file beside this and a row here."""


def parse(text: str) -> Address:
    """An address, taken apart.

    Args:
        text: As described above; a name alone, such as `osc`, has all defaults.

    Raises:
        InputError: It is none; the message says what would be.

    >>> parse("vmc://[::1]?names=vrm1&body=body2&rate=30").name
    'vmc://[::1]:39539'
    """
    if len(text) > LONGEST or not text.isprintable():
        raise InputError(f"target {shortened(text, 40)!r}; expected at most {LONGEST} plain characters")
    scheme, rest = _scheme("jsonl:-" + text[1:] if text == STDOUT or text.startswith("-?") else text)
    try:
        parts = urlsplit(rest if scheme.host else rest.replace("#", "%23"))
        host, port = parts.hostname or scheme.host, parts.port
    except ValueError as error:
        raise InputError(f"target {text!r}: {error}; expected {_pattern(scheme)}") from None
    path = "" if scheme.host else rest.partition("?")[0]
    wrong = parts.path.strip("/") or parts.fragment or parts.username is not None or port == 0
    wrong = wrong or (rest and not rest.startswith(("//", "?")))
    if wrong if scheme.host else not path:
        raise InputError(f"target {text!r}; expected {_pattern(scheme)}")
    given = _options(text, scheme, parts.query)
    rate = given.pop("rate", "")
    body = given.pop("body", scheme.body)
    return Address(
        text=text, scheme=scheme.name, host=host, port=port or scheme.port, path=path, body=body,
        rate=_number(text, "rate", rate, 0.01, 1000) if rate else None,
        options=MappingProxyType({name: default for name, (default, _) in scheme.options.items()} | given),
    )  # fmt: skip


def open_stream(text: str, *, stdout: BinaryIO | None = None) -> Stream:
    """The target that an address names, and which pictures it gets.

    Args:
        text: As for `parse`.
        stdout: What `-` stands for; the process's own when left out.

    Raises:
        InputError: It is none, or an option is wrong.
        MissingExtraError: It needs a package that is not installed.
        EnvironmentFailure: Its port or file cannot be opened.
    """
    address = parse(text)
    target = SCHEMES[address.scheme].open(address, stdout)
    return Stream(target=target, body=address.body, rate=address.rate)


def _scheme(text: str) -> tuple[Scheme, str]:
    """The row of the table, and what stands behind its name and colon."""
    name = text
    for end in (":", "?"):
        name = name.partition(end)[0]
    if name not in SCHEMES:
        known = ", ".join(map(_pattern, SCHEMES.values()))
        raise InputError(f"target {text!r}: no kind of target is called {name!r}{did_you_mean(name, SCHEMES)}; "
                         f"expected {known}, or -")  # fmt: skip
    return SCHEMES[name], text[len(name) :].removeprefix(":")


def _pattern(scheme: Scheme) -> str:
    return f"{scheme.name}://HOST:{scheme.port}" if scheme.host else f"{scheme.name}:FILE"


def _options(text: str, scheme: Scheme, query: str) -> dict[str, str]:
    try:
        pairs = parse_qsl(query, keep_blank_values=True, strict_parsing=bool(query), max_num_fields=32)
    except ValueError:
        raise InputError(f"target {text!r}: options {query!r}; expected NAME=VALUE with & between") from None
    known = {*scheme.options, *COMMON_OPTIONS}
    found: dict[str, str] = {}
    for name, value in pairs:
        if name not in known:
            raise InputError(f"target {text!r}: {scheme.name} has no option {name!r}{did_you_mean(name, known)}; "
                             f"it has {', '.join(sorted(known))}")  # fmt: skip
        if name in found:
            raise InputError(f"target {text!r}: {name} is there twice; expected it once")
        found[name] = value
    return found


def _switch(address: Address, name: str) -> bool:
    value = address.options[name]
    if value not in ("0", "1"):
        raise InputError(f"target {address.text!r}: {name}={value!r}; expected 0 or 1")
    return value == "1"


def _number(text: str, name: str, value: str, low: float, high: float) -> float:
    try:
        number = float(value)
    except ValueError:
        number = float("nan")
    if not low <= number <= high:
        raise InputError(f"target {text!r}: {name}={value!r} must be a number in [{low:g}, {high:g}]")
    return number
