"""The face's part of a row of the timeline: phrases, mouth, head, brows, blinks, gaze, emotions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from scorebreath.curves.curve_set import CurveSet
from scorebreath.report.bands import FAINT, FILL, HAIR, INK, Band
from scorebreath.report.rows import Row, width
from scorebreath.report.sheet import Points, Sheet
from scorebreath.score.document import Score
from scorebreath.score.events import Blink, Brow, Emotion, Event, Gaze, Head, Phrase
from scorebreath.units import snap

HEIGHT = 330
"""pixels that the face adds to a row"""
PHRASES = 12
BROWS = Band(top=198, bottom=232, low=0.0, high=1.0)
BLINKS, GAZE = (244, 260), (266, 286)
EMOTIONS = Band(top=296, bottom=322, low=0.0, high=1.0)
MOUTH_TOP, MOUTH_BOTTOM, MOUTH_STEP = 40, 84, 0.2
HEAD_TOP, HEAD_BOTTOM, HEAD_STEP = 98, 186, 4.0
"""Bands of the mouth and of the head, pixels; their scales end at the next multiple of a step."""
SMALL = 14
LEFT_SIDE, RIGHT_SIDE, ROLL = "#0072b2", "#cc79a7", "#b87a00"
LIPS, SHUT = "#d08a75", "#7a2e22"
TARGETS: Mapping[str, str] = MappingProxyType({"listener": "#cfe6da", "away": "#f2e3cd"})
"""By what a target's name begins with."""
ELSEWHERE = "#e6dff0"
COLOURS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "happy": ("#c98a00", "#f9e7bf"),
        "kidding": ("#b3558c", "#f2dcea"),
        "sad": ("#2f7fb5", "#d5eaf7"),
        "angry": ("#b84c00", "#f6d8c4"),
        "surprised": ("#8d8000", "#f5f0bf"),
        "disgusted": ("#00795a", "#cdeae1"),
        "afraid": ("#6a4f99", "#e2daf0"),
    }
)
"""Line and area of each emotion."""
MOVES = (Blink, Brow, Head, Gaze, Emotion)


def has_face(score: Score, body: str) -> bool:
    """Whether anything of a body's face moves but its mouth."""
    return any(isinstance(event, MOVES) and event.body == body for event in score.events)


class FaceLanes:
    """Draws the face of one body, row after row, each to the same scale."""

    def __init__(self, score: Score, curve_set: CurveSet, rows: Sequence[Row]) -> None:
        """Gather what is drawn.

        Args:
            score: Any Score.
            curve_set: The curves of the body.
            rows: All that will be drawn.
        """
        self.curves = curve_set
        shown = [e for e in score.events if e.body == curve_set.body and e.onset < rows[-1].end]
        self._events: dict[type[Event], list[Event]] = {
            kind: sorted((e for e in shown if isinstance(e, kind)), key=lambda e: (e.onset, e.id))
            for kind in (*MOVES, Phrase)
        }
        times = np.linspace(0.0, rows[-1].end, 1 + round(20 * rows[-1].end))
        most = _round_up(curve_set.sample(times, ["head_pitch", "head_yaw", "head_roll"]), HEAD_STEP)
        self.head = Band(top=HEAD_TOP, bottom=HEAD_BOTTOM, low=-most, high=most)
        widest = _round_up(curve_set.sample(times, ["jaw_open", "mouth_open"]), MOUTH_STEP)
        self.mouth = Band(top=MOUTH_TOP, bottom=MOUTH_BOTTOM, low=0.0, high=widest)

    def draw(self, sheet: Sheet, row: Row, left: float, top: float, rate: float) -> None:
        """Draw one row.

        Args:
            sheet: Where.
            row: Which.
            left: Pixels at which it begins.
            top: Pixels of its upper edge.
            rate: Pixels a second.
        """
        _Lane(face=self, sheet=sheet, row=row, left=left, top=top, rate=rate).draw()

    def during(self, kind: type[Event], row: Row) -> list[Event]:
        """Events that are seen in a row."""
        return [e for e in self._events[kind] if e.onset < row.end and e.end > row.start]


class _Lane:
    def __init__(self, *, face: FaceLanes, sheet: Sheet, row: Row, left: float, top: float, rate: float) -> None:
        self.face, self.sheet, self.time, self.left, self.top, self.rate = face, sheet, row, left, top, rate
        self.right = self._x(row.end)
        self.times = np.append(np.arange(row.start, row.end, 1 / rate), row.end)
        self.x: Points = left + (self.times - row.start) * rate

    def draw(self) -> None:
        self._phrases()
        self._mouth()
        self._head()
        self._brows()
        self._blinks()
        self._gaze()
        self._emotions()

    def _x(self, time: float) -> float:
        """Pixels; what lies outside the row stands at its edge."""
        return self.left + (min(max(time, self.time.start), self.time.end) - self.time.start) * self.rate

    def _name(self, y: float, text: str, color: str = FAINT) -> None:
        self.sheet.text(self.left - 14, self.top + y, text, SMALL, color, align="right")

    def _foot(self, band: Band, value: float = 0.0) -> None:
        self.sheet.line([self.left, self.right], self.top + float(band.y(value)), HAIR, 1, layer=0)

    def _phrases(self) -> None:
        events = self.face.during(Phrase, self.time)
        if events:
            self._name(PHRASES + 9, "phrases")
        for event in events:
            assert isinstance(event, Phrase)
            begin, end, y = self._x(event.onset), self._x(event.end), self.top + PHRASES
            self.sheet.line([begin, begin, end, end], [y - 6, y, y, y - 6], FAINT, 1.4)
            label = f"{event.break_index} {event.tone}".strip()
            if event.end <= self.time.end + 1e-9:
                self.sheet.text(end - 2, y + 16, label, SMALL, INK, align="right")

    def _mouth(self) -> None:
        jaw, breath, shut = self.face.curves.sample(self.times, ["jaw_open", "mouth_open", "lip_close"]).T
        opening = np.maximum(jaw, breath) * (1.0 - shut)
        band = self.face.mouth
        self._name(band.bottom - 12, "mouth open")
        self._name(band.bottom + 6, "lips shut", SHUT)
        self.sheet.area(self.x, self.top + band.y(opening), self.top + band.bottom, LIPS, layer=1)
        for begin, end in _runs(shut > 0.9):
            self.sheet.area([self.x[begin], self.x[end]], self.top + band.bottom, self.top + band.bottom + 6, SHUT)
        self._foot(band)

    def _head(self) -> None:
        band = self.face.head
        turned = self.face.curves.sample(self.times, ["head_pitch", "head_yaw", "head_roll"])
        middle = float(band.y(0.0))
        for value, y in ((band.high, band.top), (band.low, band.bottom)):
            self.sheet.text(self.right + 8, self.top + y + 5, f"{value:+.0f}°".replace("-", "−"), SMALL, FAINT)
            self._foot(band, value)
        self.sheet.line([self.left, self.right], self.top + middle, HAIR, 1, layer=0)
        looks = (("chin up", INK, 2.4), ("head left", LEFT_SIDE, 2.0), ("roll right", ROLL, 2.0))
        for column, (name, color, size) in enumerate(looks):
            self._name(middle - 15 + 20 * column, name, color)
            self.sheet.line(self.x, self.top + band.y(turned[:, column]), color, size, layer=3 - column)

    def _brows(self) -> None:
        left, right, frown = self.face.curves.sample(self.times, ["brow_left", "brow_right", "brow_frown"]).T
        self._name(BROWS.top + 8, "frown")
        self._name(BROWS.top + 24, "brow left", LEFT_SIDE)
        self._name(BROWS.top + 40, "brow right", RIGHT_SIDE)
        self.sheet.area(self.x, self.top + BROWS.y(frown), self.top + BROWS.bottom, FILL, layer=0)
        self.sheet.line(self.x, self.top + BROWS.y(right), RIGHT_SIDE, 2.4)
        self.sheet.line(self.x, self.top + BROWS.y(left), LEFT_SIDE, 1.8, layer=2)
        self._foot(BROWS)

    def _blinks(self) -> None:
        self._name(BLINKS[1] - 2, "blinks")
        above, below = self.top + BLINKS[0], self.top + BLINKS[1]
        middle = (above + below) / 2
        for event in self.face.during(Blink, self.time):
            assert isinstance(event, Blink)
            sides = {(True, True): (INK, above, below), (True, False): (LEFT_SIDE, above, middle)}
            color, begin, end = sides.get((event.left > 0, event.right > 0), (RIGHT_SIDE, middle, below))
            start, stop = self._x(event.onset), self._x(event.end)
            self.sheet.area([start, max(stop, start + 3)], begin, end, color, layer=1)

    def _gaze(self) -> None:
        self._name(GAZE[1] - 5, "looks at")
        for event in self.face.during(Gaze, self.time):
            assert isinstance(event, Gaze)
            begin, end = self._x(event.onset), self._x(event.end)
            self.sheet.area([begin, end], self.top + GAZE[0], self.top + GAZE[1], _place(event.target))
            self.sheet.line(begin, [self.top + GAZE[0], self.top + GAZE[1]], "#ffffff", 1.5)
            if end - begin > (width(event.target) + 0.6) * SMALL:
                self.sheet.text(begin + 5, self.top + GAZE[1] - 5, event.target, SMALL, INK)

    def _emotions(self) -> None:
        events = self.face.during(Emotion, self.time)
        self._name(EMOTIONS.bottom - 6, "emotions")
        self._foot(EMOTIONS)
        for name in dict.fromkeys(e.name for e in events if isinstance(e, Emotion) and e.name in COLOURS):
            line, fill = COLOURS[name]
            height = self.top + EMOTIONS.y(self.face.curves.sample(self.times, [f"emotion_{name}"])[:, 0])
            felt = height < self.top + EMOTIONS.bottom - 0.1
            for begin, end in _runs(felt):
                part = slice(max(0, begin - 1), end + 1)
                self.sheet.area(self.x[part], height[part], self.top + EMOTIONS.bottom, fill, layer=0)
                self.sheet.line(self.x[part], height[part], line, 2.2)
        for event in events:
            assert isinstance(event, Emotion)
            peak = snap(event.onset + event.apex)
            if self.time.start <= peak < self.time.end:
                line, _ = COLOURS.get(event.name, (FAINT, FILL))
                self.sheet.text(self._x(peak) + 8, self.top + EMOTIONS.bottom - 5, event.name, SMALL, line)


def _place(target: str) -> str:
    return next((color for name, color in TARGETS.items() if target.startswith(name)), ELSEWHERE)


def _round_up(values: Points, step: float) -> float:
    """The next multiple of a step above all values, whatever their sign."""
    return step * max(1.0, float(np.ceil(np.abs(values).max() / step - 1e-9)))


def _runs(held: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> list[tuple[int, int]]:
    """First and last index of each stretch that is true.

    >>> _runs(np.array([True, False, True, True]))
    [(0, 0), (2, 3)]
    """
    edges = np.flatnonzero(np.diff(np.concatenate(([False], held, [False])).astype(np.int8)))
    return [(int(begin), int(end) - 1) for begin, end in zip(edges[::2], edges[1::2], strict=True)]
