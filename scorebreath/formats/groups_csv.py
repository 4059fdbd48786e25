"""Breath groups as CSV: a row a breath, times in seconds, volumes in fractions of vital capacity.

Quoting is RFC 4180's, lines end with LF, text is UTF-8. A spreadsheet takes a cell that begins with `=`, `+`, `-`, `@`,
a tab or a carriage return for a formula; such text gets an apostrophe before it, as OWASP advises. The text as it was
is at `source_start` and `source_end` of the Score.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence, Set
from typing import BinaryIO

from scorebreath.curves.performed import performed
from scorebreath.score.cutting import endings
from scorebreath.score.document import Group, Score
from scorebreath.score.events import Utterance
from scorebreath.score.spoken import SpokenGroup, spoken_groups
from scorebreath.units import snap

COLUMNS = (
    "group", "body", "onset", "duration", "end", "inspiration_onset", "inspiration_duration", "speech_onset",
    "speech_duration", "syllables", "from_volume", "to_volume", "end_volume", "sentence_type", "closing", "cut_site",
    "cut_rule", "source_start", "source_end", "text",
)  # fmt: skip
"""`onset` to `end` is the breath group of B52: from the inspiration's onset to the end of the last phone.

`to_volume` is where speech begins, `end_volume` where it ends; where something is done between words, speech goes on
to the last of them. A cell is empty where the Score has no such event.
"""

CUT = "cut"
"""How a group closes that was cut off; one that never began has neither times nor a closing."""
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def write(stream: BinaryIO, score: Score) -> None:
    """Write a row for each group, in the Score's order.

    Args:
        stream: Takes bytes.
        score: Any Score.
    """
    spoken = spoken_groups(performed(score))
    ends = endings(score.events)
    broken = {said.id for said in score.of(Utterance) if said.id in ends and ends[said.id].shortens(said)}
    stream.write(_line(COLUMNS))
    for group in score.groups:
        cells = _cells(group, spoken[group.id], broken)
        stream.write(_line([cells[column] for column in COLUMNS]))


def _line(cells: Sequence[str | int]) -> bytes:
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\r\n").writerow(cells)  # with "\n" alone it would not quote a "\r" (Python 3.11)
    return (text.getvalue().removesuffix("\r\n") + "\n").encode("utf-8", "replace")


def _cells(group: Group, spoken: SpokenGroup, broken: Set[str]) -> Mapping[str, str | int]:
    breath, begin = spoken.inspiration, spoken.onset
    first = spoken.utterances[0] if spoken.utterances else None
    last = spoken.utterances[-1] if spoken.utterances else None
    end = None if last is None else snap(last.end)
    return {
        "group": _safe(group.id),
        "body": _safe(group.body),
        "onset": _number(begin),
        "duration": _number(None if begin is None or end is None else end - begin),
        "end": _number(end),
        "inspiration_onset": _number(breath.onset if breath else None),
        "inspiration_duration": _number(breath.duration if breath else None),
        "speech_onset": _number(first.onset if first else None),
        "speech_duration": _number(end - first.onset if first and end is not None else None),
        "syllables": group.syllables,
        "from_volume": _number(breath.from_volume if breath else None),
        "to_volume": _number(breath.to_volume if breath else None),
        "end_volume": _number(spoken.spent[-1].to_volume if spoken.spent else None),
        "sentence_type": group.sentence_type,
        "closing": "" if last is None else CUT if last.id in broken else last.closing,
        "cut_site": group.cut.site,
        "cut_rule": _safe(group.cut.rule),
        "source_start": group.source[0],
        "source_end": group.source[1],
        "text": _safe(group.text),
    }


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
