"""What `live` and `play` open: streams of curves, and the summary of what became of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import asdict
from math import isfinite
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fractions import Fraction

    from scorebreath.curves.curve_set import CurveSet
    from scorebreath.engine.live.status import Status
    from scorebreath.live.picture import Stream
    from scorebreath.live.streams.sender import Sender
    from scorebreath_cli.performing.settings import StreamOptions
    from scorebreath_cli.performing.telling import Teller

COUNTED_SOUNDS = {"lead_min", "lead_mean"}
"""Figures that are left out where nothing sounded: they are no numbers then."""
NO_COUNT = {"latency"}
"""What an engine tells besides counts; `started` has it, with the output's."""


def open_streams(options: StreamOptions) -> list[Stream]:
    """Every target, open.

    Raises:
        InputError: One is none, or an option of it is wrong.
        MissingExtraError: One needs a package that is not installed.
        EnvironmentFailure: A port or file cannot be opened.
    """
    from scorebreath.live.streams.addresses import open_stream

    streams: list[Stream] = []
    with ExitStack() as opened:
        for target in options.targets:
            stream = open_stream(target)
            opened.callback(stream.target.close)
            streams.append(stream)
        opened.pop_all()
    return streams


def open_sender(
    streams: Sequence[Stream], stack: ExitStack, *, curves: Callable[[], Mapping[str, CurveSet]],
    clock: Callable[[], float], start: Callable[[], float], rate: Fraction, lead: float, latency: float,
    teller: Teller,
) -> Sender:  # fmt: skip
    """Pictures to all targets, not sent before it is started; it ends, and they close, with the stack."""
    from scorebreath.live.streams.sender import Sender

    sender = Sender(
        curves, clock, start, streams, rate=rate, lead=lead, latency=latency, on_trouble=teller.stream
    )  # fmt: skip
    stack.callback(sender.stop)
    return sender


def figures(engine: Status, streams: Sequence[Stream], sender: Sender | None) -> dict[str, Any]:
    """What an engine and streams have counted, for programs."""
    unlisted = NO_COUNT if isfinite(engine.lead_min) else NO_COUNT | COUNTED_SOUNDS
    told = {name: value for name, value in asdict(engine).items() if name not in unlisted}
    counts = sender.counts if sender is not None else ()
    curves = [{"target": s.target.name, **asdict(count)} for s, count in zip(streams, counts, strict=True)]
    return {"engine": told, "curves": curves}
