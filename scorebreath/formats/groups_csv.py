"""Breath groups as CSV: a row a breath, times in seconds, volumes in fractions of vital capacity.

Quoting is RFC 4180's, lines end with LF, text is UTF-8. A spreadsheet takes a cell that begins with `=`, `+`, `-`, `@`,
a tab or a carriage return for a formula; such text gets an apostrophe before it, as OWASP advises. The text as it was
is at `source_start` and `source_end` of the Score.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from typing import BinaryIO, TypeVar

from scorebreath.score.document import Group, Score
from scorebreath.score.events import Event, Expiration, Inspiration, Utterance
from scorebreath.units import snap

COLUMNS = (
    "group", "body", "onset", "duration", "end", "inspiration_onset", "inspiration_duration", "speech_onset",
    "speech_duration", "syllables", "from_volume", "to_volume", "end_volume", "sentence_type", "closing", "cut_site",
    "cut_rule", "source_start", "source_end", "text",
)  # fmt: skip
"""`onset` to `end` is the breath group of B52: from the inspiration's onset to the end of the last phone.

`to_volume` is where speech begins, `end_volume` where it ends. A cell is empty where the Score has no such event.
"""

E = TypeVar("E", bound=Event)
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def write(stream: BinaryIO, score: Score) -> None:
    """Write a row for each group, in the Score's order.

    Args:
        stream: Takes bytes.
        score: Any Score.
    """
    breaths, speeches, spent = _first(score.of(Inspiration)), _first(score.of(Utterance)), _first(score.of(Expiration))
    stream.write(_line(COLUMNS))
    for group in score.groups:
        cells = _cells(group, breaths.get(group.id), speeches.get(group.id), spent.get(group.id))
        stream.write(_line([cells[column] for column in COLUMNS]))


def _line(cells: Sequence[str | int]) -> bytes:
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\r\n").writerow(cells)  # with "\n" alone it would not quote a "\r" (Python 3.11)
    return (text.getvalue().removesuffix("\r\n") + "\n").encode("utf-8", "replace")


def _cells(
    group: Group, breath: Inspiration | None, speech: Utterance | None, spent: Expiration | None
) -> Mapping[str, str | int]:
    begin = next((event.onset for event in (breath, speech) if event is not None), None)
    end = None if speech is None else snap(speech.end)
    return {
        "group": _safe(group.id),
        "body": _safe(group.body),
        "onset": _number(begin),
        "duration": _number(None if begin is None or end is None else end - begin),
        "end": _number(end),
        "inspiration_onset": _number(breath.onset if breath else None),
        "inspiration_duration": _number(breath.duration if breath else None),
        "speech_onset": _number(speech.onset if speech else None),
        "speech_duration": _number(speech.duration if speech else None),
        "syllables": group.syllables,
        "from_volume": _number(breath.from_volume if breath else None),
        "to_volume": _number(breath.to_volume if breath else None),
        "end_volume": _number(spent.to_volume if spent else None),
        "sentence_type": group.sentence_type,
        "closing": "" if speech is None else speech.closing,
        "cut_site": group.cut.site,
        "cut_rule": _safe(group.cut.rule),
        "source_start": group.source[0],
        "source_end": group.source[1],
        "text": _safe(group.text),
    }


def _first(events: Iterable[E]) -> dict[str, E]:
    """The first event of each group."""
    found: dict[str, E] = {}
    for event in events:
        if event.group is not None:
            found.setdefault(event.group, event)
    return found


def _number(value: float | None) -> str:
    """Six decimals; empty for nothing.

    >>> _number(0.5), _number(None)
    ('0.500000', '')
    """
    return "" if value is None else f"{snap(value):.6f}"


def _safe(text: str) -> str:
    """Text that no spreadsheet takes for a formula.

    >>> _safe("=1+1"), _safe("one")
    ("'=1+1", 'one')
    """
    return "'" + text if text.startswith(_FORMULA) else text
