"""The console: a `Desk` in front of a performance. What is told is checked at once, and done when it is its turn."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from types import MappingProxyType

from scorebreath.ensemble import Performer
from scorebreath.errors import InputError, did_you_mean, shortened
from scorebreath.live import orders
from scorebreath.live.desk import COMMANDS, Change, OverError, Setting
from scorebreath.live.moving import move, moved
from scorebreath.live.performance import Performance
from scorebreath.live.text import Text
from scorebreath.parameters.in_force import in_force
from scorebreath.parameters.table import Parameters
from scorebreath.score.events import Command
from scorebreath.script.marks import Mark
from scorebreath.script.markup.marked import Markup, marked
from scorebreath.units import snap

LONGEST_TEXT = 1_000_000
"""Code points that are taken at once."""
MOST_WAITING = 10_000
"""Orders that wait to be carried out; what comes beyond is refused."""


class Console:
    """What is told to a performance, from any thread.

    Args:
        performance: Which.
        wake: Called when something has been told.
        markup: What stands in whole texts besides words.
    """

    def __init__(
        self, performance: Performance, *, wake: Callable[[], None] = lambda: None, markup: Markup = "auto"
    ) -> None:
        """Nothing has been told."""
        self._performance, self._wake, self._markup = performance, wake, markup
        self._streams: dict[str, Text] = {}
        self._listeners: list[Change] = []
        self._closed = False

    def close(self) -> None:
        """Take nothing more."""
        self._closed = True

    @property
    def bodies(self) -> tuple[str, ...]:
        """Who is there."""
        return tuple(self._performance.ledger.bodies)

    def say(self, text: str, *, body: str = "", cut_in: bool = False) -> None:
        """A whole text, markup and all."""
        voice = self._voice(body)
        whole = marked(_clean(text), markup=self._markup)
        if not whole.text.strip() and not whole.marks:
            raise InputError("nothing to say: an empty text")
        one = Text(voice=voice, complete=True)
        one.waiting.append(whole)

        def begin(performance: Performance) -> None:
            if cut_in:
                who = performance.company.ensemble.performer(voice)
                _write(performance, who, "cut_in")
                orders.break_off(performance, who)
                performance.paused = False
            performance.hear(one)

        self._tell(begin)

    def stream(self, piece: str, *, body: str = "") -> None:
        """A piece of a text that goes on."""
        voice, piece = self._voice(body), _clean(piece)
        if voice not in self._streams:
            text = self._streams[voice] = Text(voice=voice)
            self._tell(lambda performance: performance.hear(text))
        text = self._streams[voice]
        self._tell(lambda performance: performance.supply.go_on(text, piece, performance.now))

    def end_stream(self, *, body: str = "") -> None:
        """What was streamed is complete."""
        text = self._streams.pop(self._voice(body), None)
        if text is not None:
            self._tell(lambda performance: performance.supply.go_on(text, None, performance.now), opens=False)

    def command(self, name: str, *, body: str = "") -> None:
        """One of `COMMANDS`."""
        if name not in COMMANDS:
            raise InputError(
                f"no command is called {shortened(str(name), 40)!r} (there are {', '.join(COMMANDS)})"
                f"{did_you_mean(str(name), COMMANDS)}"
            )
        self._voice(body)
        open_texts = list(self._streams.values()) if name == "end" else []
        if name == "end":
            self._streams.clear()

        def carry_out(performance: Performance) -> None:
            for text in open_texts:
                performance.supply.go_on(text, None, performance.now)
            before = _values(performance) if name == "reset" else {}
            for who in _who(performance, body, name):
                _write(performance, who, name)
                if name in orders.ACTS:
                    orders.act(performance, who, name)
                else:
                    orders.ORDERS[name](performance, who)
            if name == "reset":
                after = _values(performance)
                self._changed(one for one, value in after.items() if before.get(one) != value)

        self._tell(carry_out, opens=name not in ("end", "reset"))

    def act(self, voice: str, marks: tuple[Mark, ...]) -> None:
        """What a text without a word asks of whoever has a voice; not refused, for it was taken."""
        with suppress(OverError):
            self._tell(lambda performance: orders.without_words(performance, voice, marks))

    def set(self, name: str, value: Setting | None, *, body: str = "", glide: float | None = None) -> None:
        """Move a parameter; None resets it."""
        self._voice(body)
        if value is not None and _is_number(name) and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        Parameters(**({} if value is None else {name: value}))
        if name not in Parameters.model_fields:
            Parameters(**{name: 0.0})  # raises, and says what may be meant
        if glide is not None and not (isinstance(glide, int | float) and 0.0 <= glide <= 60.0):
            raise InputError(f"glide={glide} must be in [0, 60] s")

        for who in _who(self._performance, body, ""):
            moved(who.state.parameters, {name: value})

        def carry_out(performance: Performance) -> None:
            for who in _who(performance, body, ""):
                move(performance, who, {name: value}, glide)
            self._changed((who.state.body, name) for who in _who(performance, body, ""))

        self._tell(carry_out, opens=False)

    def values(self, body: str = "") -> Mapping[str, Setting]:
        """The value in force of every parameter."""
        voice = self._voice(body)
        return MappingProxyType(in_force(self._performance.parameters(voice)))

    def listen(self, changed: Change) -> Callable[[], None]:
        """Be told of every move."""
        self._listeners.append(changed)

        def no_more() -> None:
            if changed in self._listeners:
                self._listeners.remove(changed)

        return no_more

    def _changed(self, places: Iterable[tuple[str, str]]) -> None:
        """Parameters of bodies were moved: tell those who listen."""
        values = _values(self._performance) if self._listeners else {}
        for place in places:
            for listener in tuple(self._listeners):
                listener(*place, values[place])

    def _tell(self, order: Callable[[Performance], None], *, opens: bool = True) -> None:
        """Have an order carried out when it is its turn.

        Args:
            order: What to do.
            opens: Whether there is more to come, though the end was decided.

        Raises:
            InputError: Too many wait, or all is over.
        """
        if self._closed or self._performance.is_over:
            raise OverError
        if len(self._performance.inbox) >= MOST_WAITING:
            raise InputError(f"{MOST_WAITING} orders wait to be carried out; no more are taken")

        def in_turn(performance: Performance) -> None:
            if opens:
                performance.closing.take_back(performance)
            elif performance.is_over:
                raise OverError
            order(performance)

        self._performance.inbox.append(in_turn)
        self._wake()

    def _voice(self, body: str) -> str:
        """The voice of a body.

        Raises:
            InputError: There is no such body.
        """
        if not isinstance(body, str):
            raise InputError(f"{body!r} is no body; expected the id of one")
        performers = self._performance.company.ensemble.performers
        found = next((voice for voice, who in list(performers.items()) if body in ("", who.state.body)), None)
        if found is None:
            bodies = self.bodies
            raise InputError(
                f"no body is called {shortened(body, 40)!r} (there are {', '.join(bodies)}){did_you_mean(body, bodies)}"
            )
        return found


def _who(performance: Performance, body: str, command: str) -> tuple[Performer, ...]:
    """Whom an order is for."""
    everybody = performance.company.performers
    if command in orders.ALONE:
        return everybody[:1]
    if body:
        return tuple(who for who in everybody if who.state.body == body)
    if command in ("stop", "take") or command in orders.ACTS:
        return (performance.speaker,) if command != "take" else everybody[:1]
    return everybody


def _values(performance: Performance) -> dict[tuple[str, str], Setting]:
    """Of every body and parameter the value in force."""
    everybody = performance.company.performers
    return {
        (who.state.body, name): value
        for who in everybody
        for name, value in in_force(who.state.parameters).items()
    }  # fmt: skip


def _write(performance: Performance, who: Performer, name: str) -> None:
    performance.decisions.decide(
        [
            Command(
                id=f"{who.state.body}.command", body=who.state.body, onset=snap(max(0.0, performance.now)),
                duration=0.0, origin="performer", rule="commanded", name=name,
            )
        ]
    )  # fmt: skip


def _is_number(name: str) -> bool:
    from scorebreath.parameters.table import bounds

    return name in Parameters.model_fields and bounds(name) is not None


def _clean(text: str) -> str:
    """A piece of text as everything here takes it.

    Raises:
        InputError: It is too long, or no text.
    """
    if not isinstance(text, str):
        raise InputError(f"{shortened(repr(text), 40)} is no text; expected a str")
    if len(text) > LONGEST_TEXT:
        raise InputError(f"a text of {len(text)} characters; at most {LONGEST_TEXT} are taken at once")
    try:
        text.encode()
    except UnicodeEncodeError:
        raise InputError("half of a surrogate pair, which is no text") from None
    return text.replace("\r\n", "\n").replace("\r", "\n").replace("\0", "")
