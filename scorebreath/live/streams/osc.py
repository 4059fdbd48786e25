"""Channels as plain OSC 1.0: a bundle a picture, a message a channel.

    /scorebreath/BODY/time ,f    seconds of the performance      /scorebreath/BODY/frame ,i    number of the picture
    /scorebreath/BODY/CHANNEL ,f ...

A bundle's time tag says when the picture is heard, or `at once` for receivers that hold back what comes early. What
does not fit into 1400 bytes goes on in another bundle of the same tag, time and frame.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from scorebreath.curves.channels import CHANNELS
from scorebreath.engine.osc import message
from scorebreath.errors import InputError, did_you_mean
from scorebreath.live.picture import Picture
from scorebreath.live.streams.datagrams import AT_ONCE, Datagrams, bundles, time_tag

TAGS = ("heard", "now")
"""What the time tag says: when the picture is heard, or `at once`."""
_UNFIT = re.compile(r"[^A-Za-z0-9_.-]")


class OscTarget:
    """A receiver of OSC.

    Args:
        name: What it is, for people.
        datagrams: Where to.
        channels: Names of channels, in the order in which they are sent; all when empty.
        tag: One of `TAGS`.

    Raises:
        InputError: A name is no channel, or `tag` none of TAGS.
    """

    def __init__(self, name: str, datagrams: Datagrams, *, channels: Sequence[str] = (), tag: str = "heard") -> None:
        """Look at the options."""
        known = [channel.name for channel in CHANNELS]
        for each in channels:
            if each not in known:
                raise InputError(f"{name}: no channel is called {each!r}{did_you_mean(each, known)}")
        if tag not in TAGS:
            raise InputError(f"{name}: tag={tag!r}; expected {' or '.join(TAGS)}")
        self._name, self._datagrams, self._channels, self._tag = name, datagrams, tuple(channels), tag

    @property
    def name(self) -> str:
        """What it is, for people."""
        return self._name

    def send(self, picture: Picture) -> None:
        """Send one picture.

        Raises:
            OSError: The network refused it.
        """
        tag = AT_ONCE if self._tag == "now" else time_tag(picture.unix)
        self._datagrams.send(packets(picture, self._channels, tag))

    def close(self) -> None:
        """Close the socket."""
        self._datagrams.close()


def packets(picture: Picture, channels: Sequence[str], tag: int) -> list[bytes]:
    """A picture's bundles; `channels` empty: all of them."""
    place = f"/scorebreath/{_UNFIT.sub('_', picture.body)}"
    head = [message(f"{place}/time", float(picture.time)), message(f"{place}/frame", picture.number & 0x7FFFFFFF)]
    values = picture.channels
    return bundles(tag, head, [message(f"{place}/{each}", values[each]) for each in channels or values])
