"""Which numbers of an engine are ours: nodes, buffers, buses."""

from __future__ import annotations

from dataclasses import dataclass

from scorebreath_synthdefs.catalogue import HEARD

BODIES = 64
"""As many can sound at once."""
_OWN_NODES = 16
_LAST_NODE = 1 << 24


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Where our numbers begin."""

    first_node: int
    first_buffer: int
    buffers: int
    """how many"""
    first_audio: int
    """bus"""
    first_control: int
    """bus"""

    @property
    def root(self) -> int:
        """The group of all that is ours."""
        return self.first_node

    @property
    def movers(self) -> int:
        """The group of what moves ratios, before all that sounds."""
        return self.first_node + 1

    @property
    def sounds(self) -> int:
        """The group of what sounds."""
        return self.first_node + 2

    @property
    def mixing(self) -> int:
        """The group of what mixes, last."""
        return self.first_node + 3

    @property
    def master(self) -> int:
        """The last synth of all."""
        return self.first_node + 4

    @property
    def mix(self) -> int:
        """First of the two audio buses that everything is mixed into."""
        return self.first_audio

    def audio(self, body: int) -> int:
        """The audio bus of a body."""
        return self.first_audio + 2 + body

    def control(self, body: int) -> int:
        """The first control bus of a body's ratios."""
        return self.first_control + len(HEARD) * body

    def place(self, body: int) -> int:
        """The node that puts a body between the speakers."""
        return self.first_node + _OWN_NODES + body

    def node(self, count: int) -> int:
        """The node of the n-th thing that was made."""
        first = self.first_node + _OWN_NODES + BODIES
        return first + count % (_LAST_NODE - _OWN_NODES - BODIES)


def own_layout(channels: int) -> Layout:
    """In an engine that is ours alone."""
    return Layout(first_node=1000, first_buffer=0, buffers=1024, first_audio=channels, first_control=0)


GUEST = Layout(first_node=50_000_000, first_buffer=512, buffers=512, first_audio=512, first_control=8192)
"""In somebody else's engine of the usual size: the upper halves, where nobody begins to count."""
