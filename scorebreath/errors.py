"""What can go wrong, by whom it can be mended: every error names the value, its place and what was expected."""

from __future__ import annotations

from collections.abc import Sequence


class ScorebreathError(Exception):
    """The root of all errors raised on purpose; `exit_status` is what a command ends with (1: our bug)."""

    exit_status = 1


class InputError(ScorebreathError):
    """Bad usage or input: something the user can mend."""

    exit_status = 2


class ParameterError(InputError):
    """A parameter that does not exist, or a value outside its range."""


class ScoreError(InputError):
    """A score, take or media file that is broken, hostile, or newer than this program."""


class ScriptError(InputError):
    """A text that cannot be read; shows the place with a caret under it.

    Args:
        problem: What was found, in one phrase.
        expected: What should stand there instead.
        file: Name of the file, or `<stdin>`.
        line: Line number, from 1.
        column: Column in code points, from 1.
        text: The line itself.
    """

    def __init__(
        self, problem: str, *, expected: str = "", file: str = "", line: int = 0, column: int = 0, text: str = ""
    ) -> None:
        """Compose the one-line message, and the caret below it."""
        self.problem, self.expected, self.file, self.line, self.column, self.text = (
            problem, expected, file, line, column, text,
        )  # fmt: skip
        place = ":".join(str(part) for part in (file, line, column) if part)
        message = f"{place}: {problem}" if place else problem
        if expected:
            message += f"; expected {expected}"
        if text:
            shown, caret = _excerpt(text, column)
            message += f"\n  {shown}\n  {' ' * caret}^"
        super().__init__(message)


class EnvironmentFailure(ScorebreathError):  # noqa: N818 - the name EnvironmentError is taken
    """Something outside the input is missing or broken: an engine, a voice, an extra, the disk, a device."""

    exit_status = 3


class EngineError(EnvironmentFailure):
    """The sound engine failed; carries its own words.

    Args:
        message: What failed.
        output: Lines the engine printed about it.
    """

    def __init__(self, message: str, output: Sequence[str] = ()) -> None:
        """Append the engine's own words, one line each."""
        self.output = tuple(output)
        super().__init__("\n  engine: ".join((message, *self.output)))


class VoiceError(EnvironmentFailure):
    """A voice is not installed, does not speak the language, crashed, or missed its deadline."""


class MissingExtraError(EnvironmentFailure):
    """A feature needs an optional package; the message names the extra to install."""

    def __init__(self, what: str, extra: str) -> None:
        """Say what is missing and how to get it."""
        super().__init__(f"{what} is not installed: pip install 'scorebreath[{extra}]'")


_EXCERPT = 100


def _excerpt(text: str, column: int) -> tuple[str, int]:
    """The part of a long line around `column`, made printable, and the caret's offset in it."""
    start = max(0, column - 1 - _EXCERPT // 2)
    part = text.rstrip("\r\n")[start : start + _EXCERPT]
    shown = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in part)
    head = "..." if start else ""
    return head + shown, len(head) + max(0, column - 1 - start)
