"""What a message of OSC does: to the desk, and what is answered."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from scorebreath.errors import InputError, did_you_mean
from scorebreath.live.controls.addresses import BODIES, PONG, Place, address_of, resolve
from scorebreath.live.controls.arguments import seconds, setting
from scorebreath.live.controls.limits import Listeners, Sender
from scorebreath.live.controls.packets import Message, arguments_text, write_bundles, write_message
from scorebreath.live.desk import Desk, Setting
from scorebreath.parameters.table import Parameters


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """Packets for one receiver."""

    to: Sender
    packets: tuple[bytes, ...]


class Actions:
    """Does what messages say. Holds nothing but who listens, so a lost message is a lost move and nothing else."""

    def __init__(self, desk: Desk, listeners: Listeners) -> None:
        """Act on `desk`; `listeners` come and go by messages."""
        self._desk, self._listeners = desk, listeners
        self._verbs: Mapping[str, Callable[[Place, Message, Sender, float], tuple[Answer, ...]]] = {
            "say": self._say, "cut": self._say, "stream": self._stream, "stream/end": self._end_stream,
            "reset": self._reset, "values": self._values, "bodies": self._bodies, "listen": self._listen,
            "unlisten": self._unlisten, "ping": self._ping,
        }  # fmt: skip

    def do(self, message: Message, sender: Sender, now: float) -> tuple[Answer, ...]:
        """Do what one message says.

        Args:
            message: As it was read.
            sender: Who sent it, and is answered.
            now: s on any steady clock.

        Raises:
            InputError: The address or the arguments are wrong, or the desk refuses them.
        """
        place = resolve(message.address, self._desk.bodies)
        if place.kind == "parameter":
            return self._parameter(place, message, sender)
        if place.kind == "command":
            return self._command(place, message)
        return self._verbs[place.name](place, message, sender, now)

    def value(self, name: str, value: Setting, body: str = "") -> tuple[bytes, ...]:
        """Messages about a change: for everybody, or of one body, where the one that began speaks for all."""
        bodies = self._desk.bodies
        plain = write_message(address_of(name), value)
        if not body or len(bodies) < 2:
            return (plain,)
        own = write_message(address_of(name, body), value)
        return (plain, own) if body == bodies[0] else (own,)

    def all_values(self, bodies: Iterable[str] = ("",)) -> tuple[bytes, ...]:
        """Packets with every value in force."""
        values = (
            write_message(address_of(name, body), value)
            for body in bodies
            for name, value in self._desk.values(body).items()
        )
        return tuple(write_bundles(values))

    def _parameter(self, place: Place, message: Message, sender: Sender) -> tuple[Answer, ...]:
        given = message.arguments
        if not given:
            packet = write_message(message.address, self._desk.values(place.body).get(place.name))
            return (Answer(to=sender, packets=(packet,)),)
        _at_most(message, 2)
        glide = seconds(given[1]) if len(given) == 2 else None
        self._desk.set(place.name, setting(place.name, given[0]), body=place.body, glide=glide)
        return ()

    def _command(self, place: Place, message: Message) -> tuple[Answer, ...]:
        _at_most(message, 1)
        if message.arguments:
            (pressed,) = message.arguments
            if isinstance(pressed, str):
                raise InputError(
                    f"{message.address}: {pressed[:24]!r}, expected no argument, or 1 for a button pressed"
                )
            if not pressed:  # a button was let go
                return ()
        self._desk.command(place.name, body=place.body)
        return ()

    def _say(self, place: Place, message: Message, _sender: Sender, _now: float) -> tuple[Answer, ...]:
        self._desk.say(_text(message), body=place.body, cut_in=place.name == "cut")
        return ()

    def _stream(self, place: Place, message: Message, _sender: Sender, _now: float) -> tuple[Answer, ...]:
        self._desk.stream(_text(message), body=place.body)
        return ()

    def _end_stream(self, place: Place, message: Message, _sender: Sender, _now: float) -> tuple[Answer, ...]:
        if _pressed(message):
            self._desk.end_stream(body=place.body)
        return ()

    def _reset(self, place: Place, message: Message, _sender: Sender, _now: float) -> tuple[Answer, ...]:
        if not message.arguments or not isinstance(message.arguments[0], str):
            return self._command(Place(kind="command", name="reset", body=place.body), message)
        _at_most(message, 1)
        name = message.arguments[0]
        if name not in Parameters.model_fields:
            meant = did_you_mean(name[:40], Parameters.model_fields)
            raise InputError(f"{message.address}: no parameter is called {name[:40]!r}{meant}")
        self._desk.set(name, None, body=place.body)
        return ()

    def _values(self, place: Place, message: Message, sender: Sender, _now: float) -> tuple[Answer, ...]:
        _at_most(message, 1)
        return (Answer(to=sender, packets=self.all_values((place.body,))),)

    def _bodies(self, _place: Place, message: Message, sender: Sender, _now: float) -> tuple[Answer, ...]:
        _at_most(message, 1)
        return (Answer(to=sender, packets=(write_message(BODIES, *self._desk.bodies),)),)

    def _listen(self, _place: Place, message: Message, sender: Sender, now: float) -> tuple[Answer, ...]:
        listener = _listener(message, sender)
        if not self._listeners.add(listener, now):
            raise InputError(f"{message.address}: {Listeners.MOST} listen already")
        bodies = self._desk.bodies
        return (Answer(to=listener, packets=self.all_values(("", *bodies) if len(bodies) > 1 else ("",))),)

    def _unlisten(self, _place: Place, message: Message, sender: Sender, _now: float) -> tuple[Answer, ...]:
        self._listeners.remove(_listener(message, sender))
        return ()

    def _ping(self, _place: Place, message: Message, sender: Sender, _now: float) -> tuple[Answer, ...]:
        return (Answer(to=sender, packets=(write_message(PONG, *message.arguments[:1]),)),)


def _listener(message: Message, sender: Sender) -> Sender:
    """Where to tell: never another host than the one that asked."""
    _at_most(message, 1)
    if not message.arguments:
        return sender
    port = message.arguments[0]
    if isinstance(port, str) or port is None or isinstance(port, bool) or not 1 <= port <= 65535 or port != int(port):
        raise InputError(f"{message.address}: port {port!r}, expected a number in [1, 65535]")
    return (sender[0], int(port))


def _text(message: Message) -> str:
    if not message.arguments:
        raise InputError(f"{message.address}: expected a text")
    return arguments_text(message.arguments)


def _pressed(message: Message) -> bool:
    _at_most(message, 1)
    return not message.arguments or bool(message.arguments[0])


def _at_most(message: Message, most: int) -> None:
    if len(message.arguments) > most:
        raise InputError(f"{message.address}: {len(message.arguments)} arguments, expected {most} at most")
