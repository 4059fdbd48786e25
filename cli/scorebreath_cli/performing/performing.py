"""While something is performed: keys, screen, messages and signals, looked after in turn by one thread."""

from __future__ import annotations

import signal
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any, Self

from scorebreath.errors import ScorebreathError
from scorebreath.live.desk import OverError
from scorebreath.live.viewing import view
from scorebreath_cli.performing.keys import Keyboard
from scorebreath_cli.performing.line import Line
from scorebreath_cli.performing.screen import Screen
from scorebreath_cli.performing.typed import Typed, describe

if TYPE_CHECKING:
    from rich.text import Text

    from scorebreath_cli.performing.feeding import Feeder
    from scorebreath_cli.performing.stage import Stage
    from scorebreath_cli.performing.telling import Teller

TURN = 0.05
"""s between looks"""


class Interrupts:
    """Ctrl-C: counted the first time, an exception the second; a context manager."""

    def __init__(self) -> None:
        """None yet."""
        self.count = 0
        self._before: Any = None

    def __enter__(self) -> Self:
        """From now on."""
        self._before = signal.signal(signal.SIGINT, self._hit)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """As before."""
        signal.signal(signal.SIGINT, self._before)

    def press(self) -> None:
        """Ctrl-C, as a key.

        Raises:
            KeyboardInterrupt: It is the second.
        """
        self.count += 1
        if self.count > 1:
            raise KeyboardInterrupt

    def _hit(self, _: int, __: FrameType | None) -> None:
        self.press()


class Performing:
    """A live performance under somebody's hands.

    Args:
        stage: Open.
        feeder: Of the texts that were given.
        teller: Tells what happens.
        keyboard: Of whoever performs; None: nobody does.
        drawn: Whether there is a screen.
        typing: Whether lines are typed; else there are keys only.
        stay: Whether it goes on when all texts are said.
        groups: Whether every group is told.
    """

    def __init__(
        self, stage: Stage, feeder: Feeder, teller: Teller, *, keyboard: Keyboard | None, drawn: bool, typing: bool,
        stay: bool, groups: bool,
    ) -> None:  # fmt: skip
        """Nothing happens yet."""
        self._stage, self._feeder, self._teller = stage, feeder, teller
        self._keyboard, self._drawn, self._typing = keyboard, drawn, typing
        self._stay, self._groups = stay, groups
        self._typed = Typed(stage.show.desk, lambda: stage.midi)
        self._line = Line(self._typed.completions)
        self._answer, self._wrong, self._helping = "", False, 0
        self._ended = self._stopped = False
        self._told: dict[str, str] = {}

    def run(self) -> bool:
        """Perform until all is over; whether it was interrupted.

        Raises:
            KeyboardInterrupt: It was, twice.
            ScorebreathError: The performance could not go on.
        """
        stage, desk = self._stage, self._stage.show.desk
        with ExitStack() as stack:
            interrupts = stack.enter_context(Interrupts())
            screen = stack.enter_context(Screen(self._draw)) if self._drawn else None
            self._teller.screen = self._stage.drawn = screen is not None
            stack.callback(setattr, self._teller, "screen", False)
            if self._keyboard is not None:
                stack.enter_context(self._keyboard)
            self._feeder.start(desk)
            while not stage.show.wait(0.0 if self._keyboard else TURN):
                keys = self._keyboard.read(TURN) if self._keyboard else []
                for key in keys:
                    self._press(key, interrupts)
                if interrupts.count and not self._stopped:
                    self._stop()
                if self._feeder.done and not self._stay and not self._ended:
                    self._end()
                if self._groups:
                    self._tell_groups()
                self._teller.drain()
                if screen is not None:
                    screen.refresh(now=bool(keys))
            return interrupts.count > 0

    def _stop(self) -> None:
        """Stop as soon as that sounds natural, and end."""
        self._stopped = True
        self._feeder.stop()
        desk = self._stage.show.desk
        with suppress(OverError):
            desk.end_stream()
            desk.command("stop")
            self._teller.note("stopping; Ctrl-C again ends at once")
        if not self._ended:
            self._end()

    def _end(self) -> None:
        """When all is said, all is over."""
        self._ended = True
        with suppress(OverError):
            self._stage.show.desk.command("end")

    def _press(self, key: str, interrupts: Interrupts) -> None:
        if key == "interrupt":
            interrupts.press()
        elif key in ("panic", "escape"):
            self._do("/panic")
        elif key == "over":
            if not self._line.text:
                self._do("/end")
        elif self._typing and (line := self._line.press(key)) is not None:
            self._do(line)
        elif self._typing and key != "enter" and self._answer:
            self._answer = ""

    def _do(self, line: str) -> None:
        self._helping = self._helping + 1 if line.strip() == "/help" else 0  # the page of the help that is seen
        try:
            self._answer, self._wrong = self._typed.do(line), False
        except ScorebreathError as error:
            self._answer, self._wrong = str(error).splitlines()[0], True
        self._ended = self._ended or line.strip() == "/end"
        if self._answer and not self._drawn:
            self._teller.note(self._answer)
        if self._helping and not self._drawn:
            for usage, about in describe():
                self._teller.note(f"{usage:<24} {about}")
            self._helping = 0

    def _tell_groups(self) -> None:
        seen = view(self._stage.show, samples=0)
        for body in seen.bodies:
            said = body.said
            if said is not None and self._told.get(body.body) != said.id:
                self._told[body.body] = said.id
                text = " ".join(said.text.split())
                self._teller.tell("group", text, body=body.body, id=said.id, text=text, onset=said.onset)

    def _draw(self, width: int, height: int, unicode: bool) -> Sequence[Text]:
        from scorebreath_cli.performing.drawing import KEYS, LUNGS, WATCHING, Shown, draw, help_pages

        stage, show = self._stage, self._stage.show
        hints = self._line.hints()
        if self._helping > len(help_pages(describe(), width, height)):
            self._helping = 0
        return draw(
            Shown(
                view=view(show, samples=min(LUNGS, max(1, width - 30))), counts=show.counts,
                engine=stage.sounder.status(), latency=stage.latency, targets=stage.targets(),
                moved=stage.moved, troubles=[message.text for message in self._teller.shown.copy()],
                line=self._line.text, cursor=self._line.cursor, hints=hints, answer=self._answer, wrong=self._wrong,
                help=describe() if self._helping else (), page=self._helping, typing=self._typing, unicode=unicode,
                prompt=f"{self._typed.body}> ", keys=KEYS if self._typing else WATCHING,
            ),
            width, height,
        )  # fmt: skip
