"""The user's own breaths: named, found, levelled, stretched, drawn by chance; and files that are no breaths."""

from __future__ import annotations

import math
import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scorebreath.errors import InputError
from scorebreath.media import recordings
from scorebreath.media.recordings import KINDS, RATE, SUSTAINED, Recordings, Take, describe, load_recordings
from scorebreath.media.store import FolderStore, MemoryStore
from scorebreath.signal.breaths import hold_db
from tests.signal.recorded import among, breath

SOURCE = 16000


def record(path: Path, samples: NDArray[np.float64] | None = None, rate: int = SOURCE, subtype: str = "PCM_16") -> Path:
    soundfile.write(path, breath(0.8) if samples is None else samples, rate, subtype=subtype)
    return path


def load(folder: Path, seed: int = 1) -> Recordings:
    return load_recordings(folder, MemoryStore(), seed=seed)


def shas(found: Recordings) -> list[str]:
    return [take.sha for takes in found.takes.values() for take in takes]


def test_every_kind_is_kept_at_one_level_and_rate(tmp_path: Path) -> None:
    for number, kind in enumerate(KINDS):
        record(tmp_path / f"{kind}.wav", among(0.3, breath(0.8, 0.02 + 0.05 * number, number), 0.4) + 0.05)
    store = MemoryStore()
    found = load_recordings(tmp_path, store, seed=1)
    assert tuple(found.takes) == KINDS
    for kind, (take,) in found.takes.items():
        media = store.get(take.sha)
        assert (media.kind, media.sample_rate, len(media.samples)) == ("breath", RATE, take.frames)
        assert hold_db(media.samples, RATE) == pytest.approx(-20.0, abs=0.4), kind
        assert abs(float(media.samples.mean())) < 2e-3, "no offset is left"
        assert take.recorded == pytest.approx(1.5)
        assert 0.3 <= take.breath[0] < take.breath[1] <= 1.12
        if kind in SUSTAINED:
            assert take.frames == 5 * RATE
            assert take.stretch > 5
        else:
            assert take.frames / RATE == pytest.approx(take.breath[1] - take.breath[0], abs=1e-3)
            assert take.stretch == 1.0


def test_names_say_the_kind_whatever_follows(tmp_path: Path) -> None:
    for name in ("mouth.wav", "mouth-2.flac", "Mouth_soft.WAV", "nose3.ogg", "SIGH loud.aiff", "exhale.old.wav"):
        record(tmp_path / name, subtype="VORBIS" if name.endswith("ogg") else "PCM_16")
    (tmp_path / "LICENCE.txt").write_text("CC0")
    (tmp_path / ".DS_Store").write_bytes(b"\0")
    (tmp_path / "more").mkdir()
    found = load(tmp_path)
    assert {kind: [take.file for take in takes] for kind, takes in found.takes.items()} == {
        "mouth": ["Mouth_soft.WAV", "mouth-2.flac", "mouth.wav"],
        "nose": ["nose3.ogg"],
        "exhale": ["exhale.old.wav"],
        "sigh": ["SIGH loud.aiff"],
    }


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("mouht.wav", r"'mouht\.wav' names no kind of breath.*mouth, nose, exhale.*did you mean mouth\?"),
        ("sighs.wav", r"did you mean sigh"),
        ("holding.wav", r"did you mean hold"),
        ("1.wav", "names no kind"),
        ("x" * 200 + ".wav", "names no kind"),
    ],
)
def test_other_names_are_refused(tmp_path: Path, name: str, words: str) -> None:
    record(tmp_path / name)
    with pytest.raises(InputError, match=words) as caught:
        load(tmp_path)
    assert len(str(caught.value)) < 400


def test_stereo_is_mixed_and_the_loudest_breath_taken(tmp_path: Path) -> None:
    sound = among(0.1, breath(0.5, 0.02), 0.9, breath(0.6, 0.2), 0.5)
    record(tmp_path / "sigh.wav", np.column_stack((sound, sound)))
    record(tmp_path / "gasp.wav", sound)
    found = load(tmp_path)
    assert found.takes["sigh"][0].sha == found.takes["gasp"][0].sha
    assert found.takes["sigh"][0].sounds == 2
    assert found.takes["sigh"][0].breath[0] == pytest.approx(1.5, abs=0.1)


def test_what_is_made_depends_on_the_sound_and_the_seed_alone(tmp_path: Path) -> None:
    one, two = tmp_path / "one", tmp_path / "two"
    one.mkdir()
    two.mkdir()
    record(one / "mouth.wav")
    record(one / "sigh.wav")
    record(two / "mouth-7.wav")
    record(two / "mouth-1.wav", breath(0.7, seed=5))
    record(two / "sigh.wav")
    first, again, other = load(one), load(one), load(one, seed=2)
    assert shas(first) == shas(again)
    assert first.takes["mouth"][0].sha == load(two).takes["mouth"][1].sha
    assert first.takes["mouth"][0].sha != other.takes["mouth"][0].sha, "stretched with other phases"
    assert first.takes["sigh"][0].sha == other.takes["sigh"][0].sha


def test_draws_are_keyed_and_fair(tmp_path: Path) -> None:
    takes = tuple(
        Take(
            kind="mouth", file=f"mouth-{n}.wav", sha=str(n) * 64, frames=9, sample_rate=RATE, recorded=1.0,
            breath=(0.0, 1.0), sounds=1, gain_db=0.0, stretch=1.0,
        )
        for n in range(3)
    )  # fmt: skip
    found = Recordings(seed=1, takes={"mouth": takes})
    drawn = [found.take("mouth", "body", f"group {n}") for n in range(300)]
    assert drawn == [found.take("mouth", "body", f"group {n}") for n in range(300)]
    counted = Counter(take.file for take in drawn if take)
    assert len(counted) == 3
    assert min(counted.values()) > 70
    other = [found.take("mouth", "another", f"group {n}") for n in range(300)]
    assert drawn != other
    assert found.take("sniff", "body", "group 1") is None


def test_sounds_go_into_the_folder_of_breaths(tmp_path: Path) -> None:
    record(tmp_path / "gasp.wav")
    store = FolderStore(tmp_path / "out")
    (take,) = load_recordings(tmp_path, store, seed=1).takes["gasp"]
    assert (tmp_path / "out" / "breath" / f"{take.sha}.wav").is_file()
    assert store.get(take.sha).kind == "breath"


def test_it_is_said_what_was_made_of_each_file(tmp_path: Path) -> None:
    record(tmp_path / "mouth.wav", among(0.5, breath(0.8, 0.05), 0.7))
    record(tmp_path / "sniff.wav", breath(0.3, 0.5))
    mouth, sniff = describe(load(tmp_path))
    assert re.fullmatch(r"mouth\.wav: mouth, 0\.5\d-1\.2\d s of 2\.00 s, \+\d+\.\d dB, hold x\d+\.\d to 5\.00 s", mouth)
    assert re.fullmatch(r"sniff\.wav: sniff, 0\.0\d-0\.\d\d s of 0\.30 s, [+-]\d+\.\d dB, 0\.\d\d s", sniff)


QUIET, BUZZ = [0.0] * 4800, [0.5] * 20 + [-0.5] * 20


def _wave(path: Path, samples: list[float], rate: int = SOURCE) -> None:
    soundfile.write(path, np.array(samples), rate, subtype="DOUBLE")


@pytest.mark.parametrize(
    ("name", "samples", "rate", "words"),
    [
        ("mouth.wav", [0.0] * SOURCE, SOURCE, "is silent"),
        ("mouth.wav", [], SOURCE, "holds no samples"),
        ("mouth.wav", [0.1, math.nan] * 900, SOURCE, "not finite"),
        ("mouth.wav", [0.1, math.inf] * 900, SOURCE, "not finite"),
        ("mouth.wav", [1e300, -1e300] * 900, SOURCE, "far beyond full scale"),
        ("mouth.wav", [0.1, -0.1] * (16 * SOURCE), SOURCE, "longer than 30 s"),
        ("sigh.wav", QUIET + BUZZ * 8 + QUIET, SOURCE, r"lasts 0\.020 s; expected at least 0\.03"),
        ("nose.wav", QUIET + BUZZ * 60 + QUIET, SOURCE, r"lasts 0\.1\d s.*at least 0\.20 s of nose"),
        ("mouth.wav", [0.1, -0.1] * 900, 1000, r"sample_rate=1000 must be in \[4000, 400000\]"),
    ],
)  # fmt: skip
def test_files_that_are_no_breaths_are_refused(
    tmp_path: Path, name: str, samples: list[float], rate: int, words: str
) -> None:
    _wave(tmp_path / name, samples, rate)
    with pytest.raises(InputError, match=words) as caught:
        load(tmp_path)
    assert name in str(caught.value)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("mouth.wav", b"RIFF\xff\xff\xff\xffWAVEfmt \x10\0\0\0"),
        ("mouth.wav", b"no sound at all"),
        ("mouth.wav", b""),
        ("mouth.raw", b"\0" * 1000),
        ("nose.flac", b"fLaC" + b"\xff" * 300),
        ("sigh.mp3", b"\xff\xfb" + b"\0" * 64),
    ],
)
def test_files_that_are_no_sounds_are_refused(tmp_path: Path, name: str, content: bytes) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=re.escape(name)):
        load(tmp_path)


def test_folders_without_recordings_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no recordings"):
        load(tmp_path)
    with pytest.raises(InputError, match=r"nowhere: cannot be read: No such file.*expected a folder"):
        load(tmp_path / "nowhere")
    with pytest.raises(InputError, match="cannot be read: Not a directory"):
        load(record(tmp_path / "mouth.wav"))


def test_a_crowd_of_files_is_refused_before_any_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recordings, "MOST_FILES", 3)
    for number in range(4):
        (tmp_path / f"mouth{number}.wav").write_bytes(b"")
    with pytest.raises(InputError, match="holds 4 files; expected at most 3"):
        load(tmp_path)
