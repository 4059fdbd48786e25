"""Lines of JSON: what stands in them, and streams that are slow, broken or closed."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.curves.channels import CHANNELS
from scorebreath.errors import InputError
from scorebreath.live.picture import Picture
from scorebreath.live.streams.addresses import open_stream
from scorebreath.live.streams.lines import LineTarget, line
from tests.live.pictures import START, picture

NAMES = [channel.name for channel in CHANNELS]


@given(time=st.floats(-1, 8), name=st.text(max_size=20))
@settings(deadline=None, max_examples=30)
def test_a_line_holds_the_picture(time: float, name: str) -> None:
    shown = picture(time, name=name)
    made = line(shown, "oculus")
    assert made.count(b"\n") == 1 and made.endswith(b"}\n")
    found = json.loads(made)
    assert list(found) == ["schema", "body", "name", "time", "unix", "number", "channels", "rig"]
    assert (found["schema"], found["body"], found["name"]) == ("scorebreath.picture/1", "body", name)
    assert (found["time"], found["unix"]) == (round(time, 6), round(START + time, 6))
    assert list(found["channels"]) == NAMES
    assert found["channels"] == pytest.approx(dict(shown.channels), abs=5.1e-7)
    assert found["rig"] == pytest.approx(dict(shown.rig("oculus")), abs=5.1e-7)
    assert b"-0.0," not in made


def test_a_file_gets_every_line(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl"
    stream = open_stream(f"jsonl:{path}?rate=30&body=body2")
    assert (stream.rate, stream.body) == (30.0, "body2")
    for number in range(100):
        stream.target.send(picture(number / 60))
    stream.target.close()
    assert [json.loads(each)["number"] for each in path.read_bytes().splitlines()] == list(range(100))


class Stuck(io.RawIOBase):
    """A reader that takes nothing until it is let."""

    def __init__(self) -> None:
        self.may, self.asked, self.got = threading.Event(), threading.Event(), bytearray()

    def writable(self) -> bool:
        return True

    def write(self, data: object) -> int:
        self.asked.set()
        assert self.may.wait(30.0)
        part = bytes(memoryview(data))[:1000]  # type: ignore[arg-type]
        self.got += part
        return len(part)


def test_a_slow_reader_costs_pictures_not_memory_or_time() -> None:
    stuck = Stuck()
    target = LineTarget("-", stuck, waiting=5, keep=True)  # type: ignore[arg-type]
    target.send(picture(0.0))
    assert stuck.asked.wait(30.0)
    for number in range(1, 50):
        target.send(picture(number / 60))
    assert target.lost == 44
    stuck.may.set()
    target.close()
    assert [json.loads(each)["number"] for each in stuck.got.splitlines()] == [0, *range(45, 50)]


def test_a_closed_pipe_is_an_error_of_this_target_alone() -> None:
    read, write = os.pipe()
    target = LineTarget("jsonl:-", os.fdopen(write, "wb", buffering=0))
    os.close(read)
    with pytest.raises(OSError, match="Broken pipe"):
        for _ in range(10_000):
            target.send(picture())
    target.close()


PROGRAM = """
import sys
from scorebreath.live.streams.addresses import open_stream
from tests.live.pictures import picture
stream = open_stream("-?rig=arkit")
failed = 0
for number in range(int(sys.argv[1])):
    try:
        stream.target.send(picture(number / 60))
    except OSError:
        failed += 1
stream.target.close()
print("failed", failed, file=sys.stderr)
"""


@pytest.mark.parametrize(("count", "read"), [(5, 5), (2000, 1)])
def test_stdout_is_read_to_the_end_or_closed_early(root: Path, count: int, read: int) -> None:
    path = os.pathsep.join(str(root / folder) for folder in ("", "cli", "synthdefs"))
    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(count)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": path}, cwd=root,
    ) as process:  # fmt: skip
        assert process.stdout is not None and process.stderr is not None
        found = [json.loads(process.stdout.readline()) for _ in range(read)]
        process.stdout.close()
        said = process.stderr.read().decode()
        assert process.wait(60) == 0
    assert [each["number"] for each in found] == list(range(read)) and "jawOpen" in found[0]["rig"]
    failed = int(said.removeprefix("failed "))
    assert failed == 0 if read == count else failed > 0


@pytest.mark.parametrize("address", ["-?rig=arkid", "jsonl:{folder}/never.jsonl?rig=arkid", "ws://127.0.0.1:0?rig=x"])
def test_a_rig_that_is_none_is_refused(address: str, tmp_path: Path) -> None:
    with pytest.raises(InputError):
        open_stream(address.format(folder=tmp_path))
    assert not (tmp_path / "never.jsonl").exists()


def test_bytes_stay(golden: Callable[[str, bytes], None]) -> None:
    shown: Picture = picture()
    golden("streams/picture.jsonl", line(shown) + line(shown, "livelink"))
