"""What can go wrong, by whom it can be mended: every error names the value, its place and what was expected."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Sequence


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


def did_you_mean(wanted: str, known: Iterable[str], most: int = 3) -> str:
    """A tail for an error message that lists the closest names, or nothing.

    >>> did_you_mean("formel", ["casual", "formal"])
    '; did you mean formal?'
    >>> did_you_mean("xyz", ["casual", "formal"])
    ''
    """
    from difflib import get_close_matches

    by_case = {name.lower(): name for name in known}
    close = get_close_matches(wanted.lower(), by_case, n=most, cutoff=0.5)
    if not close:
        prefixed = sorted(name for name in by_case if wanted and name.startswith(wanted.lower()[:2]))
        close = prefixed[:most]
    return f"; did you mean {' or '.join(by_case[name] for name in close)}?" if close else ""


def shortened(text: str, most: int = 12) -> str:
    """The beginning of a long name or value, for a message.

    >>> shortened("c0ffee" * 10), shortened("tone")
    ('c0ffeec0ffee...', 'tone')
    """
    return text if len(text) <= most else f"{text[:most]}..."


_EXCERPT = 100


def _excerpt(text: str, column: int) -> tuple[str, int]:
    """The part of a long line around `column`, made printable, and how many cells of a terminal stand before it.

    >>> _excerpt("Well [xyz]", 6), _excerpt("息を [xyz]", 4)
    (('Well [xyz]', 5), ('息を [xyz]', 5))
    """
    start = max(0, column - 1 - _EXCERPT // 2)
    part = text.rstrip("\r\n")[start : start + _EXCERPT]
    shown = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in part)
    head = "..." if start else ""
    before = max(0, column - 1 - start)
    return head + shown, len(head) + sum(map(_cells, shown[:before])) + max(0, before - len(shown))


def _cells(character: str) -> int:
    """How wide a terminal shows it: 2 for Chinese, Japanese, Korean and emoji, 0 for marks on the letter before."""
    if unicodedata.combining(character):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1
