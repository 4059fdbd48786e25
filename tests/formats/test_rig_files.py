"""Rigs as files: tables, documents, Live Link Face's CSV, MPEG-4's .fap."""

from __future__ import annotations

import csv
import importlib.util
import io
import json
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.curve_set import curves
from scorebreath.curves.rigs.table import RIGS, rig_named
from scorebreath.errors import InputError
from scorebreath.formats.formats import FORMATS, ExportOptions, rig_formats
from scorebreath.formats.frames import BLOCK, frame_count
from scorebreath.formats.livelink_csv import timecode
from tests.curves.acts import performances
from tests.curves.faces import blink, emotion, gaze, head, whole_face
from tests.curves.scores import score_of

NTSC = Fraction(30000, 1001)
LIVE_LINK = (
    "Timecode,BlendShapeCount,EyeBlinkLeft,EyeLookDownLeft,EyeLookInLeft,EyeLookOutLeft,EyeLookUpLeft,EyeSquintLeft,"
    "EyeWideLeft,EyeBlinkRight,EyeLookDownRight,EyeLookInRight,EyeLookOutRight,EyeLookUpRight,EyeSquintRight,"
    "EyeWideRight,JawForward,JawRight,JawLeft,JawOpen,MouthClose,MouthFunnel,MouthPucker,MouthRight,MouthLeft,"
    "MouthSmileLeft,MouthSmileRight,MouthFrownLeft,MouthFrownRight,MouthDimpleLeft,MouthDimpleRight,MouthStretchLeft,"
    "MouthStretchRight,MouthRollLower,MouthRollUpper,MouthShrugLower,MouthShrugUpper,MouthPressLeft,MouthPressRight,"
    "MouthLowerDownLeft,MouthLowerDownRight,MouthUpperUpLeft,MouthUpperUpRight,BrowDownLeft,BrowDownRight,BrowInnerUp,"
    "BrowOuterUpLeft,BrowOuterUpRight,CheekPuff,CheekSquintLeft,CheekSquintRight,NoseSneerLeft,NoseSneerRight,"
    "TongueOut,HeadYaw,HeadPitch,HeadRoll,LeftEyeYaw,LeftEyePitch,LeftEyeRoll,RightEyeYaw,RightEyePitch,RightEyeRoll\n"
)
"""As the takes of the app have it, byte for byte."""


def written(name: str, **options: object) -> bytes:
    stream = io.BytesIO()
    FORMATS[name].write(stream, whole_face(), ExportOptions(**options))  # type: ignore[arg-type]
    return stream.getvalue()


def rows(data: bytes) -> list[list[str]]:
    return list(csv.reader(io.StringIO(data.decode("ascii"))))


@pytest.mark.parametrize("name", [name for name in RIGS if name != "livelink"])
@pytest.mark.parametrize("gate", [True, False])
def test_a_table_holds_the_rig(name: str, gate: bool) -> None:
    header, *found = rows(written(f"{name}.csv", fps=NTSC, closure_gate=gate))
    assert header == ["time", *rig_named(name).columns]
    times = np.array([float(i / NTSC) for i in range(frame_count(whole_face().duration, NTSC))])
    values = np.array(found, dtype=np.float64)
    np.testing.assert_allclose(values[:, 0], times, atol=0.51e-6)
    expected = rig_named(name).sample(curves(whole_face(), closure_gate=gate), times)
    np.testing.assert_allclose(values[:, 1:], expected, atol=0.51e-6)


@pytest.mark.parametrize("name", RIGS)
def test_a_document_holds_the_rig_and_says_what_its_columns_are_made_of(name: str) -> None:
    rig, document = rig_named(name), json.loads(written(f"{name}.json", fps=Fraction(24)))
    assert (document["schema"], document["rig"], document["signs"]) == ("scorebreath.rig/1", name, rig.signs)
    assert (document["fps"], document["closure_gate"], document["body"]) == ([24, 1], True, "body")
    times = np.arange(document["frames"]) / 24
    assert document["frames"] == frame_count(whole_face().duration, Fraction(24))
    expected = rig.sample(curves(whole_face()), times)
    for number, (column, told) in enumerate(zip(rig.table, document["columns"], strict=True)):
        assert (told["name"], told["unit"], told["range"]) == (column.name, column.unit, [column.low, column.high])
        assert told["made_of"] == column.made_of
        np.testing.assert_allclose(told["values"], expected[:, number], atol=0.51e-6)


def test_keys_add_rows_and_change_none() -> None:
    """A15, A16: what a frame misses has a row of its own."""
    plain = rows(written("arkit.csv", fps=Fraction(12)))
    keyed = rows(written("arkit.csv", fps=Fraction(12), keys=True))
    assert len(keyed) > len(plain)
    kept = {row[0]: row for row in keyed}
    assert all(kept[row[0]] == row for row in plain)
    times = [float(row[0]) for row in keyed[1:]]
    assert times == sorted(set(times))
    assert len(rows(written("curves.csv", fps=Fraction(12), keys=True))) == len(keyed)


def test_live_link_s_header_is_the_app_s() -> None:
    assert written("livelink.csv").partition(b"\n")[0].decode() + "\n" == LIVE_LINK


def test_live_link_s_rows_are_the_app_s() -> None:
    """63 cells without blanks, ten decimals, 61, timecodes in sixtieths; LF, no quotes, no -0."""
    data = written("livelink.csv", fps=Fraction(30))
    assert data.endswith(b"\n") and not set(b'\r" ') & set(data) and b"-0.0000000000" not in data
    _, *found = rows(data)
    assert len(found) == frame_count(whole_face().duration, Fraction(30))
    for frame, row in enumerate(found):
        assert len(row) == 63 and row[1] == "61"
        assert row[0] == timecode(frame, Fraction(30))
        assert all(len(cell.partition(".")[2]) == 10 for cell in row[2:])
        assert all(0 <= float(cell) <= 1 for cell in row[2:54])
    expected = rig_named("livelink").sample(curves(whole_face()), np.arange(len(found)) / 30)
    np.testing.assert_allclose(np.array([row[2:] for row in found], dtype=float), expected, atol=0.51e-10)


def test_live_link_s_angles_are_radians_unless_degrees_are_asked_for() -> None:
    radians = np.array([row[54:] for row in rows(written("livelink.csv"))[1:]], dtype=float)
    degrees = np.array([row[54:] for row in rows(written("livelink.csv", degrees=True))[1:]], dtype=float)
    np.testing.assert_allclose(np.degrees(radians), degrees, atol=1e-8)
    head = curves(whole_face()).sample(np.arange(len(degrees)) / 60, ["head_yaw", "head_pitch", "head_roll"])
    np.testing.assert_allclose(degrees[:, :3], -head, atol=1e-9)
    assert np.ptp(head, axis=0).min() > 1.0


@given(st.integers(0, 10**7), st.sampled_from([NTSC, Fraction(24), Fraction(60), Fraction(1000), Fraction(2997, 100)]))
def test_a_timecode_is_read_back_by_sixtieths(frame: int, fps: Fraction) -> None:
    """As Unreal's importer reads it: hours, minutes, seconds, frames of 1/60 s whatever the rate."""
    hours, minutes, seconds, frames = timecode(frame, fps).split(":")
    assert (len(frames), frames[2]) == (6, ".") and float(frames) < 60 and int(seconds) < 60 and int(minutes) < 60
    read = int(hours) * 3600 + int(minutes) * 60 + int(seconds) + Fraction(frames) / 60
    assert abs(read - frame / fps) <= Fraction(1, 120_000)


def test_a_timecode_rounds_before_it_carries() -> None:
    assert timecode(599_999, Fraction(600_000)) == "00:00:01:00.000"  # 59.9999 sixtieths
    assert timecode(3600 * 60, Fraction(60)) == "01:00:00:00.000"


@pytest.mark.skipif(importlib.util.find_spec("openfacefx") is None, reason="openfacefx is not installed")
def test_another_program_reads_live_link_s_table(tmp_path: Path) -> None:
    """PyPI's openfacefx 0.24.0: the right duration, and every channel."""
    path, out = tmp_path / "take_1_Face.csv", tmp_path / "track.json"
    path.write_bytes(written("livelink.csv"))
    command = [sys.executable, "-m", "openfacefx", "from-csv", str(path), "-o", str(out)]
    told = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    track = json.loads(out.read_bytes())
    last = (frame_count(whole_face().duration, Fraction(60)) - 1) / 60
    assert track["duration"] == pytest.approx(last, abs=1e-3), told.stdout
    assert track["viseme_set"] == LIVE_LINK.strip().split(",")[2:]
    open_ = next(channel for channel in track["channels"] if channel["name"] == "JawOpen")
    assert max(key["value"] if isinstance(key, dict) else key[1] for key in open_["keys"]) > 0.2


def test_a_fap_file_is_what_players_expect() -> None:
    """A header, then a mask of 68 and a line of whole numbers for each frame."""
    head, *lines = written("fap.fap", fps=Fraction(25)).decode("ascii").splitlines()
    count = frame_count(whole_face().duration, Fraction(25))
    assert head == f"2.1 body 25 {count}"
    assert len(lines) == 2 * count
    masks = {tuple(line.split()) for line in lines[::2]}
    assert len(masks) == 1
    mask = masks.pop()
    assert len(mask) == 68 and set(mask) == {"0", "1"} and mask[:2] == ("0", "0")
    for number, line in enumerate(lines[1::2]):
        frame, *values = map(int, line.split())
        assert frame == number and len(values) == mask.count("1")
    driven = [column for column, bit in zip(rig_named("fap").columns, mask[2:], strict=True) if bit == "1"]
    table = np.array([line.split()[1:] for line in lines[1::2]], dtype=float)
    expected = rig_named("fap").sample(curves(whole_face()), np.arange(count) / 25)
    np.testing.assert_allclose(table, expected[:, [rig_named("fap").columns.index(n) for n in driven]], atol=0.5)
    assert {"open_jaw", "head_pitch", "close_t_l_eyelid", "stretch_l_nose", "raise_tongue_tip"} <= set(driven)


def test_a_fap_file_has_whole_rates_alone() -> None:
    with pytest.raises(InputError, match=r"fps=30000/1001 must be a whole number"):
        written("fap.fap", fps=NTSC)


@pytest.mark.parametrize("name", ["arkit.csv", "livelink.csv", "fap.fap"])
def test_blocks_leave_no_seam(name: str) -> None:
    fps = Fraction(1000)
    count = frame_count(whole_face().duration, fps)
    assert count > BLOCK
    lines = written(name, fps=fps).splitlines()
    assert len(lines) == (2 * count + 1 if name == "fap.fap" else count + 1)
    if name == "livelink.csv":
        assert [line.split(b",")[0].decode() for line in lines[1:]] == [timecode(i, fps) for i in range(count)]


@pytest.mark.parametrize("name", [f"{rig}.csv" for rig in RIGS])
def test_an_empty_score_has_one_frame(name: str) -> None:
    stream = io.BytesIO()
    FORMATS[name].write(stream, score_of([]), ExportOptions())
    assert len(stream.getvalue().splitlines()) == 2


@settings(max_examples=15, deadline=None)
@given(performances(most=2))
def test_live_link_takes_anything(score: object) -> None:
    stream = io.BytesIO()
    FORMATS["livelink.csv"].write(stream, score, ExportOptions(fps=Fraction(24)))  # type: ignore[arg-type]
    assert {line.count(b",") for line in stream.getvalue().splitlines()} == {62}


@pytest.mark.parametrize("name", ["livelink.csv", "fap.fap"])
def test_golden_bytes(name: str, golden: Callable[[str, bytes], None]) -> None:
    """Without speech, so that only the format changes them."""
    events = [blink(0.1), head(0.0, yaw=-5.0, roll=2.0), gaze(0.3, pitch=-4.0), emotion("surprised", 0.0, duration=1.5)]
    stream = io.BytesIO()
    FORMATS[name].write(stream, score_of(events, duration=1.5), ExportOptions(fps=Fraction(30)))
    golden(f"formats/{name}", stream.getvalue())


def test_a_rig_of_one_s_own_has_formats(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("[columns]\nmouthOpen = { from = { mouth = 100.0 }, high = 100 }\n")
    table, document = rig_formats(str(path))
    stream = io.BytesIO()
    table.write(stream, whole_face(), ExportOptions(fps=Fraction(10)))
    assert stream.getvalue().startswith(b"time,mouthOpen\n0.000000,")
    stream = io.BytesIO()
    document.write(stream, whole_face(), ExportOptions(fps=Fraction(10)))
    assert json.loads(stream.getvalue())["rig"] == "mine"
