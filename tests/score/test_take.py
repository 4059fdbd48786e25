"""Takes grow line by line, survive a cut, and are Scores afterwards."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

from scorebreath.errors import EnvironmentFailure, ScoreError
from scorebreath.media.store import MemoryStore
from scorebreath.score.codec import dumps
from scorebreath.score.document import MediaInfo, Score
from scorebreath.score.files import load, save
from scorebreath.score.take import TAKE_FILE, TakeWriter, lasting, read_take

from .strategies import scores
from .test_document import empty, marker

quick = settings(
    max_examples=30,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.function_scoped_fixture],
)


def perform(folder: Path, score: Score) -> None:
    start = dataclasses.replace(score, text="", duration=0.0, groups=(), events=(), media={})
    with TakeWriter(folder, start) as take:
        take.text(score.text)
        for name, info in score.media.items():
            take.sound(name, info)
        for group in score.groups:
            take.group(group)
        for event in score.events:
            take.event(event)


@quick
@given(scores())
def test_a_take_is_the_score_that_was_performed(tmp_path_factory: pytest.TempPathFactory, score: Score) -> None:
    folder = tmp_path_factory.mktemp("take")
    perform(folder, score)
    end = lasting(score.events)
    again = read_take(folder)
    assert again.duration == pytest.approx(end, abs=1e-6)
    assert dataclasses.replace(again, duration=score.duration) == score


def test_a_torn_last_line_is_dropped_and_said(tmp_path: Path) -> None:
    score = dataclasses.replace(empty(), events=(marker("a"), marker("b", onset=2.0)))
    perform(tmp_path, score)
    path = tmp_path / TAKE_FILE
    path.write_bytes(path.read_bytes()[:-10])
    again = read_take(tmp_path)
    assert [event.id for event in again.events] == ["a", "torn-take"]
    assert again.events[-1].type == "warning"


def test_any_other_broken_line_is_refused_with_its_number(tmp_path: Path) -> None:
    perform(tmp_path, dataclasses.replace(empty(), events=(marker("a"), marker("b"))))
    path = tmp_path / TAKE_FILE
    lines = path.read_bytes().split(b"\n")
    lines[2] = b'{"type": '
    path.write_bytes(b"\n".join(lines))
    with pytest.raises(ScoreError, match=f"{TAKE_FILE}:3"):
        read_take(tmp_path)


def test_what_is_wrong_with_all_of_it_names_the_file(tmp_path: Path) -> None:
    perform(tmp_path, dataclasses.replace(empty(), events=(marker("a"),)))
    path = tmp_path / TAKE_FILE
    path.write_bytes(path.read_bytes() + path.read_bytes().split(b"\n")[-2] + b"\n")
    with pytest.raises(ScoreError, match=f"{TAKE_FILE}: event id 'a' is used twice"):
        read_take(tmp_path)


def test_a_take_is_never_written_over(tmp_path: Path) -> None:
    perform(tmp_path, empty())
    with pytest.raises(EnvironmentFailure, match="exists"):
        TakeWriter(tmp_path, empty())


def test_saving_writes_media_and_loading_finds_them(tmp_path: Path) -> None:
    media = MemoryStore()
    samples = np.linspace(-1, 1, 50, dtype=np.float32)
    name = media.put(samples, 8000, "speech")
    info = MediaInfo(path=f"speech/{name}.wav", frames=50, sample_rate=8000, kind="speech")
    score = dataclasses.replace(empty(), media={name: info})
    save(score, tmp_path / "deep" / "score.json", media)
    again, store = load(tmp_path / "deep" / "score.json")
    assert dumps(again) == dumps(score)
    assert np.array_equal(store.get(name).samples, samples)
    assert sorted(p.name for p in (tmp_path / "deep").rglob("*") if p.is_file()) == sorted(
        [f"{name}.wav", "score.json"]
    )


def test_loading_a_folder_loads_its_take(tmp_path: Path) -> None:
    perform(tmp_path, dataclasses.replace(empty(), events=(marker(),)))
    assert [event.id for event in load(tmp_path)[0].events] == ["a"]
    assert load(tmp_path)[0] == load(tmp_path / TAKE_FILE)[0]


def test_a_missing_file_is_said(tmp_path: Path) -> None:
    with pytest.raises(ScoreError, match="No such file"):
        load(tmp_path / "none.json")
