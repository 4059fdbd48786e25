"""Which Piper voices there are, and what is wrong with a file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from scorebreath.errors import InputError, MissingExtraError
from scorebreath.speech.piper import models
from scorebreath.speech.voices import list_voices, open_voice
from tests.speech.neural import needs_joe

GOOD: dict[str, Any] = {
    "audio": {"sample_rate": 22050},
    "espeak": {"voice": "de"},
    "language": {"code": "de_DE"},
    "num_speakers": 2,
    "speaker_id_map": {"anna": 0, "bert": 1},
    "phoneme_id_map": {symbol: [number] for number, symbol in enumerate("_^$aeioubdfghjklmnprstvz")},
    "num_symbols": 30,
}


@pytest.fixture
def installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(models, "version", lambda: "1.8.0")


def put(folder: Path, config: object, model: bytes = b"x") -> str:
    (folder / "voice.onnx").write_bytes(model)
    (folder / "voice.onnx.json").write_text(config if isinstance(config, str) else json.dumps(config))
    return str(folder / "voice.onnx")


@pytest.mark.usefixtures("installed")
def test_a_file_and_its_speakers(tmp_path: Path) -> None:
    path = put(tmp_path, GOOD)
    assert models.find(path).speaker == 0
    assert models.find(f"{path}#bert").speaker == 1
    assert models.find(f"{path}#1").speaker == 1
    assert models.find(f"{path}#bert").name == f"{Path(path).resolve()}#bert"
    assert models.find(path).language == "de-DE"
    assert models.find(path).licence == models.UNTOLD_LICENCE
    with pytest.raises(InputError, match="no speaker 'carl'; there are 2: anna, bert"):
        models.find(f"{path}#carl")


BROKEN: dict[str, tuple[object, str]] = {
    "no json": ("{", "is not the JSON of a Piper voice"),
    "deep": ("[" * 100_000, "is not the JSON of a Piper voice"),
    "a list": ([], "is not the JSON of a Piper voice"),
    "no map": ({**GOOD, "phoneme_id_map": None}, "is not the JSON of a Piper voice"),
    "empty map": ({**GOOD, "phoneme_id_map": {}}, "phoneme_id_map has 0 symbols; expected ^, $, _ among them"),
    "few": ({**GOOD, "phoneme_id_map": {"_": [0], "^": [1], "$": [2], "a": [3]}}, "expected the sounds of a language"),
    "high ids": ({**GOOD, "num_symbols": 9}, "phoneme_id_map goes up to 23; num_symbols=9 allows 8"),
    "pinyin": ({**GOOD, "phoneme_type": "pinyin"}, "phoneme_type='pinyin' must be 'espeak'"),
    "map of words": ({**GOOD, "phoneme_id_map": {"a": ["b"]}}, "must be a list of numbers"),
    "no rate": ({**GOOD, "audio": {}}, "sample_rate=None must be a whole number"),
    "rate": ({**GOOD, "audio": {"sample_rate": 10**9}}, "sample_rate=1000000000 must be"),
    "no language": ({**GOOD, "espeak": {}, "language": {}}, "must be the code of a language"),
    "no speakers": ({**GOOD, "num_speakers": 0}, "num_speakers=0 must be"),
}


@pytest.mark.usefixtures("installed")
@pytest.mark.parametrize("case", BROKEN)
def test_a_broken_json_is_told_in_one_line(tmp_path: Path, case: str) -> None:
    config, said = BROKEN[case]
    with pytest.raises(InputError) as caught:
        models.find(put(tmp_path, config))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.usefixtures("installed")
def test_files_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        models.find(str(tmp_path / "none.onnx"))
    with pytest.raises(InputError, match=r"expected joe, or the path of an \.onnx file"):
        models.find("jo")
    (tmp_path / "alone.onnx").write_bytes(b"x")
    with pytest.raises(InputError, match=r"alone\.onnx\.json is missing beside it"):
        models.find(str(tmp_path / "alone.onnx"))
    (tmp_path / "empty.onnx").write_bytes(b"")
    with pytest.raises(InputError, match="the file has 0 bytes"):
        models.find(str(tmp_path / "empty.onnx"))
    with pytest.raises(InputError, match="expected joe, or the path"):
        open_voice("piper", "en")


def test_without_the_extra_its_name_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(models, "version", lambda: "")
    with pytest.raises(MissingExtraError, match=r"scorebreath\[neural\]"):
        open_voice("joe", "en")
    rows = [row for row in list_voices() if row.engine == "piper"]
    assert [row.installed for row in rows] == [False, False]
    assert all("scorebreath[neural]" in row.how for row in rows)


@needs_joe
def test_a_language_that_espeak_has_not_is_refused(tmp_path: Path) -> None:
    (tmp_path / "voice.onnx").write_bytes(b"model")
    told = {**GOOD, "espeak": {"voice": "zz-nope"}}
    (tmp_path / "voice.onnx.json").write_text(json.dumps(told))
    with pytest.raises(InputError, match=r"espeak.voice='zz-nope' is no language of eSpeak NG"):
        open_voice(f"piper:{tmp_path / 'voice.onnx'}", "en")


@needs_joe
def test_what_lies_beside_a_link_counts_not_what_lies_beside_its_target(tmp_path: Path) -> None:
    """A cache of models keeps files elsewhere, under other names."""
    (tmp_path / "blobs").mkdir()
    (tmp_path / "snapshot").mkdir()
    (tmp_path / "blobs" / "abc123").write_bytes(b"model")
    (tmp_path / "snapshot" / "voice.onnx").symlink_to(tmp_path / "blobs" / "abc123")
    (tmp_path / "snapshot" / "voice.onnx.json").write_text(json.dumps(GOOD))
    found = models.find(str(tmp_path / "snapshot" / "voice.onnx"))
    assert found.config == tmp_path / "snapshot" / "voice.onnx.json"
    assert found.name == str(tmp_path / "snapshot" / "voice.onnx")
