"""Reports of a performance that was interrupted: what happened is shown, what did not is not."""

from __future__ import annotations

import dataclasses
import io

import numpy as np
import pytest
from PIL import Image

from scorebreath.curves.curve_set import curves
from scorebreath.report.acts import acts
from scorebreath.report.face_rows import face_rows
from scorebreath.report.marks import broken_off, marks
from scorebreath.report.norms.compare import norms
from scorebreath.report.preview import Preview
from scorebreath.report.timeline import write_timeline
from scorebreath.report.transcript import transcript
from scorebreath.score.document import Score
from scorebreath.score.events import Command, Parameter, Utterance, WarningEvent
from scorebreath.units import snap
from tests.curves.cutting import compiled, cut_at
from tests.curves.scores import Breath, build

FIRST = "The rain falls mainly on the plain,"
SECOND = "and nobody is surprised by that."


def interrupted(time: float = 1.6) -> Score:
    """Two groups; the first one is cut in the midst of a word, the second one never comes."""
    score = build([Breath(text=FIRST), Breath(text=SECOND)], tail=4.0)
    told = (
        Command(id="stop", body="body", onset=time, duration=0.0, name="stop", origin="performer"),
        Parameter(id="p", body="body", onset=1.0, duration=0.0, name="speaking_loudness", value=60.0),
        Parameter(id="q", body="body", onset=1.1, duration=0.0, name="posture", text="lying"),
        Parameter(id="r", body="body", onset=1.2, duration=0.0, name="posture"),
        WarningEvent(id="w", body="body", onset=0.5, duration=0.0, code="late-speech", text="0.2 s late"),
    )
    return dataclasses.replace(cut_at(score, time), events=(*cut_at(score, time).events, *told))


def text_of(score: Score) -> str:
    """The transcript as one line."""
    return "".join(piece.get("text", "") for piece in transcript(score, "body", 99.0))


def test_the_transcript_breaks_off_where_the_speech_did() -> None:
    """With a dash behind the broken word; and ends there."""
    said = next(interrupted().of(Utterance))
    word = next(w for w in said.words if w.onset < 1.6 - said.onset < w.onset + w.duration)
    assert text_of(interrupted()) == FIRST[: FIRST.index(word.text)] + word.text + "—"
    assert broken_off(interrupted(), "body") == {(said.id, word.onset)}


def test_a_cut_between_words_breaks_none() -> None:
    """What is behind it is not there all the same."""
    said = next(interrupted().of(Utterance))
    time = snap(said.onset + said.words[2].onset)
    assert text_of(interrupted(time)).strip() == "The rain"
    assert not broken_off(interrupted(time), "body")


def test_what_was_skipped_does_not_stand_between() -> None:
    """After the cut the second group follows: nothing of the first one's rest is shown."""
    whole = build([Breath(text=FIRST), Breath(text=SECOND)], tail=4.0)
    second = [event for event in whole.events if event.group == "g2"]
    alone = dataclasses.replace(whole, events=tuple(e for e in whole.events if e.group == "g1"))
    score = cut_at(alone, 1.6, rest=0.0)
    later = snap(2.4 - min(event.onset for event in second))
    moved = tuple(dataclasses.replace(event, onset=snap(event.onset + later)) for event in second)
    found = text_of(dataclasses.replace(score, events=(*score.events, *moved), duration=20.0))
    assert found.replace("  ", " ").endswith("— " + SECOND)
    assert "plain" not in found


def test_marks_tell_what_was_done() -> None:
    """In order of time, in a word or two."""
    assert [(mark.time, mark.text) for mark in marks(interrupted(), "body")] == [
        (0.5, "! late-speech"), (1.0, "speaking_loudness 60"), (1.1, "posture lying"), (1.2, "posture reset"),
        (1.6, "cut"), (1.6, "stop"),
    ]  # fmt: skip
    assert marks(build([Breath()]), "body") == ()


def picture(score: Score) -> np.ndarray:
    """The timeline, (height, width, 3)."""
    stream = io.BytesIO()
    write_timeline(stream, score, curves(score))
    return np.asarray(Image.open(stream).convert("RGB"))


def red(picture: np.ndarray) -> np.ndarray:
    """Where it has the ink of cuts, or nearly."""
    return np.asarray(np.abs(picture.astype(int) - (0xA4, 0x16, 0x1A)).max(axis=2) < 40)


def test_the_timeline_has_a_lane_for_what_was_done() -> None:
    """A red line through the row where it was cut; none, and no lane, where nothing was done."""
    plain, cut = picture(dataclasses.replace(build([Breath()]), duration=8.0)), picture(interrupted())
    assert red(cut).sum(axis=0).max() > 350
    assert not red(plain).any()
    assert cut.shape[0] > plain.shape[0]


@pytest.mark.parametrize("time", [0.05, 0.3, 1.0, 2.0, 4.0, 9.0])
def test_every_report_takes_a_real_performance(time: float) -> None:
    """Cut in a breath, in speech, in a sigh: nothing goes on behind the cut, whoever tells it."""
    score = dataclasses.replace(cut_at(compiled(), time), duration=time + 8.0)
    found = curves(score)
    assert picture(score).any()
    assert all(row.end <= time + 1e-6 for row in face_rows(score))
    assert all(act.end <= time + 1e-6 for act in acts(score, "body"))
    assert all(piece.get("onset", 0.0) < time for piece in transcript(score, "body", 99.0))
    assert norms(score).results
    Preview(score, found)
