"""The preview page: self-contained, and made of the Score, the curves and the sound themselves."""

from __future__ import annotations

import base64
import io
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

from scorebreath.curves.curve_set import curves
from scorebreath.errors import InputError
from scorebreath.report import preview
from scorebreath.report.compact import RATE
from scorebreath.score.document import Score
from tests.curves.scores import Breath, build, score_of

HOSTILE = "</script><script>document.title='taken'</script> <b onclick=x> \u2028 {{sound}} '\"& ]]> <!-- done."


def page(score: Score, sound: Any = None, rate: int | None = RATE) -> str:
    if sound is None:
        sound = tone(score.duration, RATE)
    stream = io.BytesIO()
    preview.write_preview(stream, score, curves(score), sound, rate)
    return stream.getvalue().decode("utf-8")


def tone(seconds: float, rate: int) -> np.ndarray[Any, np.dtype[np.float32]]:
    return (0.3 * np.sin(np.arange(round(seconds * rate)) * 2 * np.pi * 440 / rate)).astype(np.float32)


def element(html: str, id: str) -> str:  # noqa: A002
    found = re.search(rf'<script type="[^"]*" id="{id}">(.*?)</script>', html, re.DOTALL)
    assert found
    return found[1]


def data(html: str) -> dict[str, Any]:
    loaded: dict[str, Any] = json.loads(element(html, "data"))
    return loaded


def decoded(html: str) -> np.ndarray[Any, np.dtype[np.float32]]:
    samples, rate = soundfile.read(io.BytesIO(base64.b64decode(element(html, "sound"))), dtype="float32")
    assert rate == RATE
    return np.asarray(samples)


def test_the_page_asks_nothing_of_the_network() -> None:
    html = page(build([Breath()] * 2))
    markup = re.sub(r"<script type=.*?</script>", "", html, flags=re.DOTALL)
    assert not re.search(r"https?:|//[a-z]+\.|@import|url\((?!#)", markup)
    assert set(re.findall(r'(?:src|href)="([^"]*)"', markup)) == {"data:,"}
    assert "default-src 'none'" in markup
    assert "{{" not in markup.split("<script>")[0]


def test_the_curves_in_the_page_are_the_curves() -> None:
    score = build([Breath(), Breath(profile="sine", lead_mouth=0.1)])
    found = data(page(score))
    assert found["shown"] == score.duration
    frames = int(np.ceil(score.duration * found["fps"])) + 1
    expected = curves(score).sample(np.arange(frames) / found["fps"], preview.CHANNELS)
    assert tuple(found["channels"]) == preview.CHANNELS
    for column, channel in enumerate(found["channels"].values()):
        steps = np.frombuffer(base64.b64decode(channel["values"]), dtype="<u2")
        assert len(steps) == (frames if channel["step"] else 1), "a channel that never moves is there once"
        values = np.broadcast_to(channel["low"] + channel["step"] * steps, frames)
        np.testing.assert_allclose(values, expected[:, column], atol=channel["step"] * 0.51 + 1e-12)
        assert channel["step"] <= np.ptp(expected[:, column]) / 65535 + 1e-15


def test_the_sound_is_the_sound_sample_by_sample() -> None:
    score = build([Breath(speech=1.0)])
    whole = np.rint(tone(score.duration, RATE) * 32767) / 32768
    np.testing.assert_array_equal(decoded(page(score, whole)), whole.astype(np.float32))


def test_sound_from_a_file_in_two_channels_at_another_rate(tmp_path: Path) -> None:
    score = build([Breath(speech=1.0)])
    left = tone(score.duration, 48_000)
    soundfile.write(tmp_path / "mix.wav", np.column_stack((left, 0 * left)), 48_000, subtype="PCM_24")
    found = decoded(page(score, tmp_path / "mix.wav", None))
    expected = tone(score.duration, RATE) / 2
    assert abs(len(found) - len(expected)) <= 1
    middle = slice(1000, min(len(found), len(expected)) - 1000)
    np.testing.assert_allclose(found[middle], expected[middle], atol=1e-3)


def test_a_long_score_is_cut_and_the_page_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(preview, "LONGEST", 60.0)
    score = build([Breath(speech=9.0)] * 12)
    html = page(score)
    assert "this page holds the first 1:00" in html
    found = data(html)
    assert found["shown"] == 60.0
    assert len(decoded(html)) == 60 * RATE
    assert max(piece.get("onset", 0) for piece in found["text"]) < 60
    assert "holds the first" not in page(build([Breath()]))


def test_text_cannot_leave_its_place() -> None:
    score = build([Breath(text=HOSTILE)])
    html = page(score)
    assert html.count("</script>") == 3
    assert "onclick=x>" not in re.sub(r"<script.*?</script>", "", html, flags=re.DOTALL)
    assert "".join(piece.get("text", "") for piece in data(html)["text"]) == score.text.strip()


def test_hardly_anything_is_enough_for_a_page() -> None:
    assert "Speech and breath" in page(score_of([]))
    assert decoded(page(score_of([], duration=0.5))).size == RATE // 2


def test_what_is_no_sound_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="sample_rate"):
        page(score_of([]), np.zeros(3), None)
    (tmp_path / "not.wav").write_bytes(b"no sound")
    for name in ("not.wav", "missing.wav"):
        with pytest.raises(InputError, match=name):
            page(score_of([]), tmp_path / name, None)


def test_one_breath_group_is_one() -> None:
    assert "· 1 breath group ·" in page(build([Breath()]))
    assert "· 2 breath groups ·" in page(build([Breath()] * 2))
