"""`render --loudness` and `--stems`, as they are typed."""

from __future__ import annotations

from pathlib import Path

import pytest
import soundfile

from tests.cli.running import events, run

pytest.importorskip("pyloudnorm", reason="the extra loudness is not installed")

TEXT = "Good evening. Here is the weather forecast for tonight.\n"


def test_a_set_with_loudness_and_stems(tmp_path: Path) -> None:
    out = tmp_path / "out"
    done = run("render", "-", "-o", out, "--loudness", "-20", "--stems", "--json", text=TEXT)
    assert done.exit_code == 0, done.output
    told = {event["event"]: event for event in events(done.stdout)}
    assert told["loudness"]["loudness"] == pytest.approx(-20, abs=0.1)
    assert told["loudness"]["true_peak_db"] <= -1
    written = [event["path"] for event in events(done.stdout) if event["event"] == "written"]
    for name in ("stems/speech.wav", "stems/breath.wav"):
        assert str(out / name) in written
        assert soundfile.info(out / name).frames == soundfile.info(out / "mix.wav").frames
    assert run("render", "-", "-o", out, "--stems", text=TEXT).exit_code == 2
    again = run("render", "-", "-o", out, "--force", text=TEXT)
    assert again.exit_code == 0
    assert not (out / "stems").exists(), "stems of another sound"


def test_a_mix_of_a_loudness_goes_to_stdout(tmp_path: Path) -> None:
    refused = run("render", "-", "-o", "-", "--stems", text=TEXT)
    assert refused.exit_code == 2
    assert "stdout takes the mix alone" in refused.stderr
    done = run("render", "-", "-o", "-", "--loudness", "-30", text=TEXT)
    assert done.exit_code == 0
    assert done.stdout_bytes[:4] == b"RIFF"


@pytest.mark.parametrize(("value", "said"), [("3", "loudness=3 must be in"), ("-99", "must be in"), ("loud", "loud")])
def test_a_loudness_that_is_none_is_refused(tmp_path: Path, value: str, said: str) -> None:
    done = run("render", "-", "-o", tmp_path / "out", f"--loudness={value}", text=TEXT)
    assert done.exit_code == 2
    assert said in done.stderr
    assert not (tmp_path / "out").exists()


def test_what_cannot_be_had_is_said(tmp_path: Path) -> None:
    done = run("render", "-", "-o", tmp_path / "out", "--loudness", "-5", text=TEXT)
    assert done.exit_code == 0
    assert "LUFS is what it can have" in done.stderr
