"""The desk: all that a performer, a controller or a program can tell a performance, and the table of commands."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal, Protocol

from scorebreath.errors import InputError

Setting = float | str | bool
"""Value of a parameter."""
Change = Callable[[str, str, Setting], None]
"""Told of every parameter that was moved, whoever moved it: body, name, value in force."""


class OverError(InputError):
    """The end is decided: nothing more is said, and nothing more moves."""

    def __init__(self) -> None:
        """Say so."""
        super().__init__("the end is decided, and nothing more is taken")


Does = Literal["acts", "flow", "whole"]


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandRow:
    """A row of the table of commands."""

    about: str
    does: Does
    """`acts`: the body does something with its breath; `flow`: how the text goes on; `whole`: the whole performance"""


COMMANDS: Mapping[str, CommandRow] = MappingProxyType(
    {
        "pause": CommandRow(about="stop at the next breath and wait, breathing", does="flow"),
        "go": CommandRow(about="go on where it stopped", does="flow"),
        "stop": CommandRow(about="stop now, breathe out, and forget what was still to be said", does="flow"),
        "repeat": CommandRow(about="say the last breath group again", does="flow"),
        "clear": CommandRow(about="finish the breath group, and forget what was still to be said", does="flow"),
        "take": CommandRow(about="breathe in and take the floor: whoever speaks yields at a breath", does="flow"),
        "breathe": CommandRow(about="a breath, now", does="acts"),
        "sigh": CommandRow(about="a sigh, now", does="acts"),
        "gasp": CommandRow(about="a gasp, now", does="acts"),
        "sniff": CommandRow(about="a sniff, now", does="acts"),
        "laugh": CommandRow(about="laughter, now", does="acts"),
        "exhale": CommandRow(about="an audible breath out, now", does="acts"),
        "hold": CommandRow(about="hold the breath, now", does="acts"),
        "reset": CommandRow(about="all parameters back to where the performance began", does="whole"),
        "panic": CommandRow(about="silence at once; nothing more is said", does="whole"),
        "end": CommandRow(about="say what there is, come to rest, and end", does="whole"),
    }
)
"""Every command by its name: OSC, MIDI, keyboard and Python know the same ones."""


class Desk(Protocol):
    """What is told to a performance. Safe to call from any thread; nothing here waits for the performance.

    `body` is an id such as `body2`; empty: everybody, or for what is said whoever began.
    """

    @property
    def bodies(self) -> tuple[str, ...]:
        """Who is there."""

    def say(self, text: str, *, body: str = "", cut_in: bool = False) -> None:
        """A whole text, markup and all, behind what is still to be said; `cut_in`: at once, in place of it.

        Raises:
            InputError: The text or its markup is wrong, or there is no such body.
        """

    def stream(self, piece: str, *, body: str = "") -> None:
        """A piece of a text that goes on, cut anywhere; inline tags are understood."""

    def end_stream(self, *, body: str = "") -> None:
        """What was streamed is complete."""

    def command(self, name: str, *, body: str = "") -> None:
        """One of `COMMANDS`.

        Raises:
            InputError: There is no such command or body.
        """

    def set(self, name: str, value: Setting | None, *, body: str = "", glide: float | None = None) -> None:
        """Move a parameter; None resets it. What sounds follows in `glide` seconds (None: as the desk does).

        A value set by hand stays until it is reset, whatever its abstract parent does.

        Raises:
            ParameterError: The name or the value is wrong.
            InputError: There is no such body.
        """

    def values(self, body: str = "") -> Mapping[str, Setting]:
        """The value in force of every parameter, derived ones worked out; of whoever began, if not told otherwise."""

    def listen(self, changed: Change) -> Callable[[], None]:
        """Be told of every move; call what comes back to hear no more. `changed` must return at once."""
