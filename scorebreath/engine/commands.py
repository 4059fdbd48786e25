"""What an engine is told offline, as the file of OSC bundles that it reads: the bytes of a supriya score.

supriya itself takes longer to import than a sentence takes to render; a test holds the two together.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

from scorebreath.engine.clock import OfflineClock
from scorebreath.engine.osc import bundle, message
from scorebreath.engine.play import load, play
from scorebreath.engine.segments import Segment
from scorebreath_synthdefs.catalogue import ALL
from scorebreath_synthdefs.compiled import together

FIRST_NODE = 1000
"""Node ids below belong to the engine's own groups."""
_SECOND = 2**32  # units of an OSC time tag
_ROOT = 0
_ACTIONS: Mapping[str, int] = {"ADD_TO_HEAD": 0, "ADD_TO_TAIL": 1}


@dataclass(frozen=True, slots=True, kw_only=True)
class Buffer:
    """A place for a sound in the engine's memory."""

    id_: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """A group or a sound in the engine."""

    id_: int


@dataclass(slots=True, kw_only=True)
class Commands:
    """The part of a supriya context that `play` needs, kept as OSC. It grows as it is told, so it changes."""

    moments: dict[int, list[bytes]] = field(default_factory=dict)
    """messages by time tag"""
    nodes: int = 0
    buffers: int = 0
    _now: list[bytes] = field(default_factory=list)
    _groups: tuple[int, ...] = ()

    @contextmanager
    def at(self, seconds: float) -> Iterator[None]:
        """What is told within happens then."""
        self._now = self.moments.setdefault(int(seconds * _SECOND), [])
        yield

    def add_synthdefs(self, *names: str) -> None:
        """Instruments of the catalogue."""
        self._now.append(message("/d_recv", together(names)))

    def add_group(self, *, add_action: str = "ADD_TO_HEAD") -> Node:
        """A group in the one of everything; groups made one after the other are made in one message."""
        made = self._node()
        if self._now and self._now[-1] == message("/g_new", *self._groups):
            self._now.pop()
        else:
            self._groups = ()
        self._groups = (*self._groups, made.id_, _ACTIONS[add_action], _ROOT)
        self._now.append(message("/g_new", *self._groups))
        return made

    def add_synth(
        self, name: str, *, add_action: str = "ADD_TO_HEAD", target_node: Node | None = None, **controls: float
    ) -> Node:
        """A sound; controls at their defaults are left out."""
        defaults = ALL[name].controls
        said = [(key, float(value)) for key, value in sorted(controls.items()) if value != defaults[key].default]
        target = _ROOT if target_node is None else target_node.id_
        made = self._node()
        self._now.append(
            message("/s_new", name, made.id_, _ACTIONS[add_action], target, *(part for pair in said for part in pair))
        )
        return made

    def set_node(self, node: Node, **controls: float) -> None:
        """Move a sound's controls."""
        said = [(key, float(value)) for key, value in sorted(controls.items())]
        self._now.append(message("/n_set", node.id_, *(part for pair in said for part in pair)))

    def add_buffer(self, *, file_path: Path) -> Buffer:
        """A sound file read into memory."""
        made = Buffer(id_=self.buffers)
        self.buffers += 1
        self._now.append(message("/b_allocRead", made.id_, str(file_path), 0, 0))
        return made

    def free_buffer(self, buffer: Buffer) -> None:
        """Forget it."""
        self._now.append(message("/b_free", buffer.id_))

    def free_all(self) -> None:
        """End all that sounds."""
        self._now.append(message("/g_freeAll", _ROOT))

    def _node(self) -> Node:
        self.nodes += 1
        return Node(id_=FIRST_NODE + self.nodes - 1)


def commands(
    segment: Segment, where: Callable[[str], str], *, sample_rate: int, buses: Mapping[str, int] | None = None
) -> Commands:
    """What an engine must be told to make the segment's sounds and end in silence.

    Args:
        segment: What sounds.
        where: From the SHA-256 of media to a file.
        sample_rate: Hz.
        buses: First control bus of every body that is moved in the segment.
    """
    clock = OfflineClock(sample_rate=sample_rate, start=segment.start)
    made = Commands()
    with made.at(0.0):
        places = load(made, (sound.instrument for sound in segment.sounds), buses=buses, instrument=str)
    end = clock.of_frame(segment.start + segment.frames)
    play(
        made, segment.sounds,
        moves=segment.moves, places=places, when=lambda time: min(clock(time), end), where=where, instrument=str,
    )  # fmt: skip
    with made.at(end):
        made.free_all()  # some units that are alive at the end crash the embedded engine
    return made


def write_commands(stream: BinaryIO, made: Commands) -> None:
    """Write what the engine reads: each bundle after its length, in order of time.

    The last bundle ends the sound. Time tags are whole 2^-32 s, truncated as sclang does (formats 3.15).
    """
    for tag, messages in sorted(made.moments.items()):
        if not messages:
            continue
        datagram = bundle(tag, messages)
        stream.write(struct.pack(">i", len(datagram)))
        stream.write(datagram)
