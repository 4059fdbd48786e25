"""A Score's text in pieces that know when they are spoken."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections import deque
from collections.abc import Iterator, Set
from typing import TypedDict

from scorebreath.curves.performed import performed
from scorebreath.report.acts import Act, acts
from scorebreath.report.marks import DASH, broken_off
from scorebreath.report.rows import breaths
from scorebreath.score.document import Score
from scorebreath.score.events import Cut, Inspiration, Utterance
from scorebreath.units import snap


class Piece(TypedDict, total=False):
    """What stands between words has only a text, a breath has a depth, an act a caption, a word both text and time."""

    text: str
    onset: float
    """s"""
    end: float
    """s"""
    depth: float
    """of a breath, fraction of VC"""
    caption: str
    """of what is done besides speaking, such as `[sighs]`"""


class _Said(TypedDict):
    source: tuple[int, int] | None
    text: str
    onset: float
    end: float
    group: str | None
    broken: bool
    """off, by a cut"""


def transcript(score: Score, body: str, until: float) -> list[Piece]:
    """The text as written, words, breaths and acts with their times, as far as they begin before `until`.

    Several spoken words that stand for one written one ("23") are one piece. Words that stand nowhere in the text, or
    out of its order, appear as they are spoken. What cuts left unsaid is not there; a word broken off has a dash.
    """
    cuts = sorted(cut.onset for cut in score.of(Cut, body))
    broken = broken_off(score, body)
    score = performed(score)
    text = _unwrapped(score.text)
    last = 0.0  # s; end of the last word
    depths = {event.onset: event.to_volume - event.from_volume for event in score.of(Inspiration, body)}
    starts = {each.group.id: each for each in breaths(score, body)}
    done = deque(act for act in acts(score, body) if act.onset < until)
    pieces: list[Piece] = []
    at = 0
    group: str | None = None
    for said in _merged(_words(score, body, until, broken)):
        begins = said["group"] is not None and said["group"] != group
        group = said["group"]
        source = said["source"]
        written = source is not None and source[0] >= at
        between = text[at : source[0]] if written and source else " "
        if between.strip() and bisect_left(cuts, snap(last)) < bisect_right(cuts, said["onset"]):
            between = " "  # what stands there was not said
        last = said["end"]
        head, tail = _split(between) if at else ("", between)
        pieces.append({"text": head})
        breathed: list[Piece] = []
        if begins and group in starts:
            breath = starts[group]
            depth = snap(max(0.0, depths.get(breath.onset, 0.0)))
            breathed = [{"onset": breath.onset, "end": breath.inspired, "depth": depth}]
        pieces += sorted([*breathed, *_captions(done, said["onset"])], key=lambda piece: piece["onset"])
        pieces.append({"text": tail})
        shown = text[source[0] : source[1]] if written and source else said["text"]
        pieces.append({"text": shown + DASH * said["broken"], "onset": said["onset"], "end": said["end"]})
        at = source[1] if written and source else at
    if bisect_left(cuts, snap(last)) < len(cuts):
        text = text[:at]  # nor was the rest
    pieces.append({"text": re.match(r"\S*", text[at:])[0]})  # type: ignore[index]  # \S* always matches
    pieces += _captions(done, until)
    return [piece for piece in pieces if piece.get("text") != ""]


def _captions(done: deque[Act], until: float) -> Iterator[Piece]:
    """Takes from `done` what begins before `until`."""
    while done and done[0].onset < until:
        act = done.popleft()
        yield {"caption": f"[{act.caption}]", "onset": act.onset, "end": act.end}


def _words(score: Score, body: str, until: float, broken: Set[tuple[str, float]]) -> Iterator[_Said]:
    for utterance in sorted(score.of(Utterance, body), key=lambda event: event.onset):
        for word in utterance.words:
            onset = snap(utterance.onset + word.onset)
            if onset < until:
                end = snap(onset + word.duration)
                yield {
                    "source": word.source, "text": word.text, "onset": onset, "end": end, "group": utterance.group,
                    "broken": (utterance.id, word.onset) in broken,
                }  # fmt: skip


def _merged(words: Iterator[_Said]) -> Iterator[_Said]:
    """Neighbours whose places in the text overlap, as one."""
    last: _Said | None = None
    for word in words:
        here, there = word["source"], last and last["source"]
        if last is not None and here is not None and there and here[0] < there[1] and there[0] < here[1]:
            last["source"] = (min(here[0], there[0]), max(here[1], there[1]))
            last["end"] = max(last["end"], word["end"])
            last["broken"] |= word["broken"]
            continue
        if last is not None:
            yield last
        last = word
    if last is not None:
        yield last


def _split(between: str) -> tuple[str, str]:
    """What ends the last word, and what begins the next: a breath stands in between.

    >>> _split('. "'), _split(",")
    (('. ', '"'), (',', ''))
    """
    cut = max((match.end() for match in re.finditer(r"\s+", between)), default=len(between))
    return between[:cut], between[cut:]


def _unwrapped(text: str) -> str:
    """The text with line breaks after long lines as spaces: prose wrapped by an editor, not verse; same length."""
    return re.sub(r"(?<=[^\n]{60})\n(?=[^\n])", " ", text)
