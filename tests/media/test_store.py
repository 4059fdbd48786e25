"""Media by content: the same sound has one name, and a name gives that sound or an error."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import soundfile
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray

from scorebreath.errors import ScoreError
from scorebreath.media.store import FolderStore, LayeredStore, MediaStore, MemoryStore, float_wave

samples = hnp.arrays(np.float32, st.integers(0, 50), elements=st.floats(-1, 1, width=32))


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(samples)
def test_every_store_gives_back_what_it_got(
    tmp_path_factory: pytest.TempPathFactory, sound: NDArray[np.float32]
) -> None:
    folder = FolderStore(tmp_path_factory.mktemp("media"))
    stores: list[MediaStore] = [MemoryStore(), folder, LayeredStore(MemoryStore(), folder)]
    found = set()
    for store in stores:
        name = store.put(sound, 22050, "speech")
        assert store.put(sound.copy(), 22050, "speech") == name
        held = store.get(name)
        assert held.samples.tobytes() == sound.tobytes()
        assert (held.sample_rate, held.kind, store.frames(name)) == (22050, "speech", len(sound))
        assert name in store
        found.add(name)
    assert len(found) == 1


def test_files_are_plain_wav_for_anyone(tmp_path: Path) -> None:
    sound = np.linspace(-1, 1, 101, dtype=np.float32)
    name = FolderStore(tmp_path).put(sound, 44100, "breath")
    read, rate = soundfile.read(tmp_path / "breath" / f"{name}.wav", dtype="float32")
    assert rate == 44100
    assert np.array_equal(read, sound)
    assert [p.name for p in tmp_path.rglob("*.part")] == []


@pytest.mark.parametrize("name", ["../../etc/passwd", "", "0" * 63, "0" * 64 + "/x", "Z" * 64, "0" * 64 + "\n"])
def test_names_are_never_paths(tmp_path: Path, name: str) -> None:
    store = FolderStore(tmp_path)
    assert name not in store
    with pytest.raises(ScoreError, match="not a SHA-256"):
        store.get(name)


def test_changed_samples_are_noticed(tmp_path: Path) -> None:
    store = FolderStore(tmp_path)
    name = store.put(np.zeros(10, np.float32), 8000, "speech")
    path = tmp_path / "speech" / f"{name}.wav"
    data = bytearray(path.read_bytes())
    data[-1] = 0x3F
    path.write_bytes(bytes(data))
    with pytest.raises(ScoreError, match="not those the score names"):
        store.get(name)


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: data[:-4],
        lambda data: data[:30],
        lambda data: b"",
        lambda data: b"RIFX" + data[4:],
        lambda data: data.replace(b"fmt ", b"fmt_"),
        lambda data: data[:20] + b"\x01\x00" + data[22:],
        lambda data: data[:-4] + np.float32(np.nan).tobytes(),
    ],
)
def test_broken_files_are_one_error(tmp_path: Path, damage: object) -> None:
    assert callable(damage)
    store = FolderStore(tmp_path)
    name = store.put(np.zeros(10, np.float32), 8000, "speech")
    path = tmp_path / "speech" / f"{name}.wav"
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(ScoreError, match=name[:12]):
        store.get(name)


def test_the_bytes_of_a_wav_are_these() -> None:
    assert float_wave(np.array([0.5], np.float32), 8000).hex() == (
        "52494646360000005741564566"
        + "6d7420120000000300010040"
        + "1f0000007d000004002000000066616374040000000100000064617461040000000000003f"
    )


def test_missing_media_are_said(tmp_path: Path) -> None:
    for store in (FolderStore(tmp_path), MemoryStore(), LayeredStore(MemoryStore())):
        with pytest.raises(ScoreError, match="0000"):
            store.get("0" * 64)
