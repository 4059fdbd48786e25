"""Attributes of one element of SSML: their values, and errors that point at them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeVar

from scorebreath.errors import ScriptError, did_you_mean, shortened
from scorebreath.script.markup.origin import Origin

_Value = TypeVar("_Value")
_NAME = re.compile(r"<[^\s/>]+")
_ATTRIBUTE = re.compile(r"\s+([^\s=]+)\s*=\s*([\"'])(.*?)\2", re.DOTALL)


@dataclass(frozen=True, slots=True, kw_only=True)
class Attributes:
    """What an element was given."""

    origin: Origin
    place: Callable[[], int]
    """of the element's tag in the origin; asked for only where there is an error"""
    element: str
    values: Mapping[str, str]
    written: str
    """the tag"""

    def error(self, key: str, problem: str, expected: str) -> ScriptError:
        """The error for an attribute by its name: the caret stands under the name."""
        at = self._find(key)[0]
        return self.origin.error(at, f"{shortened(key, 40)} of <{self.element}> {problem}", expected)

    def wrong(self, key: str, expected: str) -> ScriptError:
        """The error for an attribute's value: the caret stands under the value."""
        value = shortened(self.values[key], 40)
        return self.origin.error(self._find(key)[1], f"{key}={value!r} of <{self.element}>", expected)

    def read(self, key: str, parse: Callable[[str], _Value | None], default: _Value, expected: str) -> _Value:
        """A value as `parse` reads it; `default` where the attribute is missing.

        Raises:
            ScriptError: `parse` makes nothing of it.
        """
        if key not in self.values:
            return default
        value = parse(self.values[key].strip())
        if value is None:
            raise self.wrong(key, expected)
        return value

    def choice(self, key: str, table: Mapping[str, _Value], default: str) -> _Value:
        """A value that is a word of a table.

        Raises:
            ScriptError: It is none.
        """
        word = self.values.get(key, default).strip()
        if word not in table:
            raise self.wrong(key, f"{', '.join(table)}{did_you_mean(word, table)}")
        return table[word]

    def _find(self, key: str) -> tuple[int, int]:
        """Where an attribute's name and its value begin."""
        start = self.place()
        name = _NAME.match(self.origin.text, start)
        at = name.end() if name else start
        while match := _ATTRIBUTE.match(self.origin.text, at):
            if match[1] == key:
                return match.start(1), match.start(3)
            at = match.end()
        return start, start
