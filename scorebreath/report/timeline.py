"""`timeline.png`: the papers' Figure 4 for one Score: lung volume, speech and breath sound, words, group limits (B14).

Below them stands what the face does, where it does anything.

Time runs in rows, most of them begun with a breath. A long Score shows its first rows in detail and all of itself in a
strip above them, so that a picture takes about as long to draw whatever the text.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from typing import BinaryIO

import numpy as np

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.performed import performed
from scorebreath.report.acts import Act, acts
from scorebreath.report.bands import FAINT, FILL, HAIR, INK, PAPER, Band
from scorebreath.report.face_lanes import HEIGHT, FaceLanes, has_face
from scorebreath.report.marks import DASH, Mark, broken_off, marks
from scorebreath.report.rows import Breath, Row, breaths, clock, groups_counted, place, wrap
from scorebreath.report.sheet import Sheet
from scorebreath.score.document import Score
from scorebreath.score.events import Command, Cut, Inspiration, Utterance, WarningEvent

MOST_ROWS, MOST_FACED_ROWS, ROW_SECONDS, SHORTEST_ROW = 8, 5, 15.0, 5.0
"""A row with a face is higher: fewer of them make a picture of about the same size."""
WIDTH, LEFT, RIGHT = 2400, 130, 60
HEADER, STRIP, ROW = 130, 160, 425
"""pixels"""


SOUND = Band(top=214, bottom=304, low=-50.0, high=8.0)
"""dB relative to the voice's reference"""
LUNG_TOP, LUNG_BOTTOM, STRIP_TOP, STRIP_BOTTOM = 56, 196, 10, 100
LABEL, WORDS, WORD_LINE, WORD_LINES, WORD_SIZE, FACE = 38, 350, 24, 3, 19, 408

MARKS, MARK_LINE, MARK_LINES, MARK_SIZE = 49, 20, 2, 16
"""pixels that a lane of marks adds to a row"""

DETAIL, INSPIRED = "#f1f4f8", "#c9e0f2"
SPEECH, BREATH = "#3b8fc4", "#d55e00"
"""A blue and the vermilion of Okabe and Ito's palette: no colour vision mistakes one for the other."""
TOLD: Mapping[str, str] = {Cut.type: "#a4161a", WarningEvent.type: "#a4161a", Command.type: "#6a4f99"}
"""Inks of marks; the rest in the common one."""
LEGEND = (("breath sound", BREATH), ("speech sound", SPEECH), ("breathing in", INSPIRED), ("lung volume", INK))


def write_timeline(stream: BinaryIO, score: Score, curve_set: CurveSet) -> None:
    """Draw a Score as PNG, 2400 pixels wide and at most 4310 high.

    Args:
        stream: Takes bytes.
        score: Any Score.
        curve_set: The curves of the body to be drawn.
    """
    told, broken = marks(score, curve_set.body), broken_off(score, curve_set.body)
    score = performed(score)
    groups, done = breaths(score, curve_set.body), acts(score, curve_set.body)
    longest = min(ROW_SECONDS, max(SHORTEST_ROW, score.duration))
    faced = has_face(score, curve_set.body)
    most, high = (MOST_FACED_ROWS, ROW + HEIGHT) if faced else (MOST_ROWS, ROW)
    high += MARKS if told else 0
    rows = wrap(score.duration, [group.onset for group in groups], longest, most)
    face = FaceLanes(score, curve_set, rows) if faced else None
    partial = rows[-1].end < score.duration
    top = HEADER + (STRIP if partial else 0)
    sheet = Sheet(WIDTH, top + high * len(rows), PAPER)
    _header(sheet, score, curve_set, groups, rows, told=told)
    if partial:
        _strip(sheet, curve_set, rows)
    rate = (WIDTH - LEFT - RIGHT) / longest
    for number, row in enumerate(rows):
        above = top + high * number
        drawn = _Row(sheet, curve_set, above, row, rate, broken=broken)
        drawn.draw(score, groups, done)
        if told:
            drawn.marks(told, above + high - MARKS)
        if face:
            face.draw(sheet, row, LEFT, above + FACE, rate)
    sheet.png(stream)


def _header(
    sheet: Sheet,
    score: Score,
    curve_set: CurveSet,
    groups: Sequence[Breath],
    rows: Sequence[Row],
    *,
    told: Sequence[Mark],
) -> None:
    voice = next(body.voice.voice for body in score.bodies if body.id == curve_set.body)
    facts = [clock(score.duration), groups_counted(len(groups)), f"model {score.model}", f"voice {voice}"]
    if warned := sum(mark.kind == WarningEvent.type for mark in told):
        facts.append(f"{warned} warning{'' if warned == 1 else 's'}")
    if rows[-1].end < score.duration:
        facts.append(f"the first {clock(rows[-1].end)} in detail")
    sheet.text(LEFT, 56, "Speech and breath", 30, INK, weight="bold")
    sheet.text(LEFT, 94, "   ·   ".join(facts), 19, FAINT)
    x = WIDTH - RIGHT
    for name, color in LEGEND:
        sheet.text(x, 56, name, 18, FAINT, align="right")
        x -= 10 * len(name) + 32
        sheet.area([x, x + 20], 48 if color == INK else 41, 51 if color == INK else 57, color)
        x -= 26


def _strip(sheet: Sheet, curve_set: CurveSet, rows: Sequence[Row]) -> None:
    """The whole Score in one line, and which part of it the rows below show."""
    width, duration = WIDTH - LEFT - RIGHT, curve_set.duration
    band = _lung_band(curve_set, HEADER + STRIP_TOP, HEADER + STRIP_BOTTOM)
    volume = curve_set.sample(np.linspace(0, duration, 4 * width), ["lung_volume"]).reshape(width, 4)
    x = LEFT + np.arange(width, dtype=np.float64)
    shown = LEFT + width * rows[-1].end / duration
    sheet.area([LEFT, shown], band.top - 8, band.bottom, DETAIL)
    sheet.area(x, band.y(volume.max(axis=1)) - 1, band.y(volume.min(axis=1)) + 1, INK, layer=1)
    sheet.line([LEFT, LEFT + width], band.bottom, FAINT, 1)
    for tick in np.arange(0, duration, _round_step(duration / 12)):
        at = LEFT + width * tick / duration
        sheet.line(at, [band.bottom, band.bottom + 8], FAINT, 1)
        sheet.text(at, band.bottom + 26, clock(tick), 15, FAINT, align="center")
    sheet.text(LEFT - 14, (band.top + band.bottom) / 2 + 6, "whole", 15, FAINT, align="right")


class _Row:
    """One row of the timeline."""

    def __init__(
        self,
        sheet: Sheet,
        curve_set: CurveSet,
        top: float,
        row: Row,
        pixels_a_second: float,
        *,
        broken: Set[tuple[str, float]],
    ) -> None:
        self.sheet, self.curves, self.top, self.time = sheet, curve_set, top, row
        self.rate, self.broken = pixels_a_second, broken
        self.lung = _lung_band(curve_set, LUNG_TOP, LUNG_BOTTOM)

    def draw(self, score: Score, groups: Sequence[Breath], done: Sequence[Act]) -> None:
        for inspiration in score.of(Inspiration, self.curves.body):
            self._inspired(inspiration.onset, inspiration.end)
        for group in groups:
            if self._begins(group.onset):
                self._group(group)
        self._scales()
        self._curves()
        words = [(text, x, INK) for text, x in self._words(score.of(Utterance, self.curves.body))]
        words += [(f"[{act.caption}]", self._x(act.onset), BREATH) for act in done if self._begins(act.onset)]
        words.sort(key=lambda word: word[1])
        labels = place([(text, x) for text, x, _ in words], WORD_SIZE, WORD_LINES)
        for label, (_, _, color) in zip(labels, words, strict=True):
            self.sheet.text(label.x, self.top + WORDS + WORD_LINE * label.line, label.text, WORD_SIZE, color)

    def marks(self, told: Sequence[Mark], top: float) -> None:
        """What was done to the performance, in a lane of its own; cuts go through the whole row."""
        here = [mark for mark in told if self._begins(mark.time)]
        self.sheet.text(LEFT - 14, top + MARK_LINE, "performer", 15, FAINT, align="right")
        self.sheet.line([LEFT, self._x(self.time.end)], top, HAIR, 1, layer=0)
        labels = place([(mark.text, self._x(mark.time)) for mark in here], MARK_SIZE, MARK_LINES)
        for mark, label in zip(here, labels, strict=True):
            color = TOLD.get(mark.kind, INK)
            above = self.top + LABEL - 16 if mark.kind == Cut.type else top
            self.sheet.line(label.x, [above, top + MARK_LINE * (label.line + 1)], color, 1.8, layer=2)
            self.sheet.text(label.x + 5, top + MARK_LINE * (label.line + 1) - 2, label.text, MARK_SIZE, color)

    def _x(self, time: float) -> float:
        return LEFT + (time - self.time.start) * self.rate

    def _begins(self, time: float) -> bool:
        """Whether a time is in this row."""
        return self.time.start <= time < self.time.end

    def _inspired(self, onset: float, end: float) -> None:
        begin, end = max(onset, self.time.start), min(end, self.time.end)
        if end > begin:
            self.sheet.area([self._x(begin), self._x(end)], self.top + LABEL + 6, self.top + SOUND.bottom, INSPIRED)

    def _group(self, group: Breath) -> None:
        x = self._x(group.onset)
        self.sheet.line(x, [self.top + LABEL - 16, self.top + WORDS + (WORD_LINES - 1) * WORD_LINE + 6], FAINT, 1.4)
        seconds, syllables = group.end - group.onset, group.group.syllables
        self.sheet.text(x + 9, self.top + LABEL, f"{seconds:.1f} s · {syllables} syll.", 15, FAINT)

    def _scales(self) -> None:
        right, foot = self._x(self.time.end), self.top + SOUND.bottom
        resting = self.curves.sources.breathing.person.resting_volume
        peak = self.top + float(self.lung.y(self.lung.high))
        rest = self.top + float(self.lung.y(resting))
        self.sheet.line([LEFT, right], rest, FAINT, 1.4, dashes=(5, 4))
        self.sheet.text(LEFT - 14, rest + 6, f"rest {resting:.0%}", 15, FAINT, align="right")
        if rest - peak > 20:
            self.sheet.text(LEFT - 14, peak + 6, f"{self.lung.high:.0%} VC", 15, FAINT, align="right")
        for level in (-40, -20, 0):
            y = self.top + float(SOUND.y(level))
            self.sheet.line([LEFT, right], y, HAIR, 1, layer=0)
            self.sheet.text(LEFT - 14, y + 6, f"{level} dB".replace("-", "−"), 15, FAINT, align="right")
        self.sheet.line([LEFT, right], foot, FAINT, 1.4)
        for second in range(int(np.ceil(self.time.start)), int(np.floor(self.time.end)) + 1):
            x, whole = self._x(second), second % 5 == 0
            self.sheet.line(x, [foot, foot + (10 if whole else 5)], FAINT, 1.4)
            if whole:
                self.sheet.text(x + 5, foot + 17, clock(second), 14, FAINT)

    def _curves(self) -> None:
        times = np.append(np.arange(self.time.start, self.time.end, 1 / self.rate), self.time.end)
        x = LEFT + (times - self.time.start) * self.rate
        volume, speech, breath = self.curves.sample(times, ["lung_volume", "speech_level", "breath_level"]).T
        y = self.top + self.lung.y(volume)
        self.sheet.area(x, y, self.top + self.lung.bottom, FILL)
        self.sheet.line(x, y, INK, 2.6, layer=2)
        for level, color in ((breath, BREATH), (speech, SPEECH)):
            self.sheet.area(x, self.top + SOUND.y(level), self.top + SOUND.bottom, color, layer=1)

    def _words(self, utterances: Iterator[Utterance]) -> Iterator[tuple[str, float]]:
        for utterance in utterances:
            if utterance.onset >= self.time.end or utterance.end <= self.time.start:
                continue
            for word in utterance.words:
                onset = utterance.onset + word.onset
                if self._begins(onset):
                    yield word.text + DASH * ((utterance.id, word.onset) in self.broken), self._x(onset)


def _lung_band(curve_set: CurveSet, top: float, bottom: float) -> Band:
    """A band from just below the Score's lowest volume to its highest, never narrower than a tenth."""
    parts = [curve_set.scenes.sources(number).breathing for number in range(len(curve_set.scenes))]
    moved = [volumes for breathing in parts for volumes in (breathing.from_volume, breathing.to_volume)]
    volumes = np.concatenate((*moved, [parts[0].person.resting_volume]))
    low, high = float(volumes.min()), float(volumes.max())
    return Band(top=top, bottom=bottom, low=low - 0.02, high=max(high, low + 0.08))


def _round_step(step: float) -> float:
    """The next round number of seconds.

    >>> _round_step(44.0)
    60
    """
    return next((nice for nice in (5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600) if nice >= step), 7200)
