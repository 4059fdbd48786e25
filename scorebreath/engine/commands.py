"""A supriya score as the file of OSC commands that engines render."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import TYPE_CHECKING, BinaryIO

from scorebreath.engine.clock import OfflineClock
from scorebreath.engine.play import load, play
from scorebreath.engine.segments import Segment

if TYPE_CHECKING:
    from supriya import Score as Commands


def commands(segment: Segment, where: Callable[[str], str], *, sample_rate: int) -> Commands:
    """What an engine must be told to make the segment's sounds and end in silence."""
    from supriya import Score as Commands  # not a Score of ours

    clock = OfflineClock(sample_rate=sample_rate, start=segment.start)
    made = Commands(input_bus_channel_count=0, output_bus_channel_count=1, buffer_count=len(segment.sounds) + 1)
    with made.at(0.0):
        load(made, (sound.instrument for sound in segment.sounds))
    end = clock.of_frame(segment.start + segment.frames)
    play(made, segment.sounds, when=lambda time: min(clock(time), end), where=where)
    with made.at(end):
        made.free_group_children(made.root_node)  # some units that are alive at the end crash the embedded engine
    return made


def write_commands(stream: BinaryIO, made: Commands) -> None:
    """Write what the engine reads: each bundle after its length.

    The last bundle ends the sound. Time tags are whole 2^-32 s, truncated as sclang does (formats 3.15).
    """
    for datagram in made.iterate_datagrams():
        stream.write(struct.pack(">i", len(datagram)))
        stream.write(datagram)
