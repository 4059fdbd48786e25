"""Receivers that are not ours read our packets, each in an environment of its own.

`vmcp` is under the AGPL and `PyLiveLinkFace` brings numpy: neither is installed beside us.
"""

from __future__ import annotations

import ast
import socket
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from scorebreath.live.picture import Picture
from scorebreath.live.streams.addresses import open_stream
from scorebreath.live.streams.livelink import ORDER
from scorebreath.live.streams.skeleton import COMMON
from scorebreath.live.streams.vmc import expressions, pose
from tests.curves.faces import head
from tests.live.pictures import of, picture
from tests.live.sockets import port, receiver


def environment(folder: Path, *packages: str) -> Path:
    """The Python of a new environment with some packages; the test is skipped where they cannot be had."""
    made = subprocess.run([sys.executable, "-m", "venv", str(folder)], capture_output=True, text=True, check=False)
    if made.returncode:
        pytest.skip(f"no environment can be made: {made.stderr.strip()[-200:]}")
    python = folder / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    pip = [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--retries", "1", *packages]
    try:
        found = subprocess.run(pip, capture_output=True, text=True, check=False, timeout=180)
    except subprocess.TimeoutExpired:
        pytest.skip(f"{packages[0]} cannot be installed: it takes too long")
    if found.returncode:
        pytest.skip(f"{packages[0]} cannot be installed: {found.stderr.strip()[-200:]}")
    return python


@pytest.fixture(scope="session")
def vmcp(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return environment(tmp_path_factory.mktemp("vmcp") / "v", "vmcp==1.0.6", "osc4py3==1.0.8")


@pytest.fixture(scope="session")
def livelinkface(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return environment(tmp_path_factory.mktemp("livelink") / "v", "PyLiveLinkFace==0.1")


VMC_RECEIVER = """
import sys, time
from vmcp import events
from vmcp.facades import on_receive
from vmcp.osc import OSC
from vmcp.osc.backend.osc4py3 import as_eventloop

def told(event):
    kind = type(event).__name__
    if kind == "BlendShapeEvent":
        print((kind, event.key, event.value))
    elif kind == "BoneTransformEvent":
        p, q = event.position, event.rotation
        print((kind, event.joint.value, (p.x, p.y, p.z), (q.x, q.y, q.z, q.w)))
    elif kind == "RelativeTimeEvent":
        print((kind, event.delta))
    elif kind == "StateEvent":
        print((kind, event.model_state.value, event.calibration_state.value, event.calibration_mode.value,
               event.tracking_state.value))
    else:
        print((kind,))
        over.append(True)

over = []
with OSC(as_eventloop) as osc:
    receiver = osc.create_receiver("127.0.0.1", int(sys.argv[1]), "receiver")
    for name in ("BoneTransform", "BlendShape", "BlendShapeApply", "State", "RelativeTime"):
        on_receive(receiver, getattr(events, name + "Event"), told)
    receiver.open()
    print("ready", flush=True)
    end = time.time() + 30
    while time.time() < end and len(over) < 2:
        osc.run()
        time.sleep(0.005)
"""


def received(python: Path, pictures: list[Picture], query: str) -> list[Any]:
    """What vmcp makes of two pictures."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        chosen = free.getsockname()[1]
    stream = open_stream(f"vmc://127.0.0.1:{chosen}?{query}")
    with subprocess.Popen(
        [str(python), "-c", VMC_RECEIVER, str(chosen)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None and process.stderr is not None
        try:
            assert process.stdout.readline().strip() == "ready", process.stderr.read()
            for shown in pictures:
                stream.target.send(shown)
            output, said = process.communicate(timeout=60)
        finally:
            process.kill()
            stream.target.close()
    assert process.returncode == 0, said
    return [ast.literal_eval(each) for each in output.splitlines()]


@pytest.mark.parametrize("case", ["pascal", "camel"])
def test_vmcp_reads_our_vmc(vmcp: Path, case: str) -> None:
    shown = [picture(1.5), picture(2.5)]
    found = received(vmcp, shown, f"names=both&shapes=both&bones=1&case={case}")
    ends = [number for number, each in enumerate(found) if each == ("BlendShapeApplyEvent",)]
    assert len(ends) == 2 and ends[1] == len(found) - 1
    for each, told in zip(shown, (found[: ends[0]], found[ends[0] + 1 : ends[1]]), strict=True):
        assert told[:2] == [("StateEvent", 1, 3, 0, 1), ("RelativeTimeEvent", each.time)]
        values = {event[1]: event[2] for event in told if event[0] == "BlendShapeEvent"}
        assert values == pytest.approx(expressions(each, names="both", shapes="both", case=case), abs=1e-6)
        assert len(values) == 16 * 2 + 52 + 5
        bones = {event[1]: event[2:] for event in told if event[0] == "BoneTransformEvent"}
        wanted = pose(each.channels, COMMON)
        assert bones.keys() == wanted.keys()
        for name, (rest, turned) in wanted.items():
            assert bones[name][0] == pytest.approx(rest.place, abs=1e-6)
            assert bones[name][1] == pytest.approx(turned, abs=1e-6)


LIVELINK_DECODER = """
import sys
from pylivelinkface import FaceBlendShape, PyLiveLinkFace

found, face = PyLiveLinkFace.decode(bytes.fromhex(sys.argv[1]))
assert found
print({"name": face.name, "uuid": face.uuid, "version": face._version, "fps": face.fps, "frame": face._frames,
       "part": face._sub_frame, "denominator": face._denominator,
       "values": {shape.name: face.get_blendshape(shape) for shape in FaceBlendShape}})
"""


@pytest.mark.parametrize("name", ["scorebreath", "Märchenerzähler"])
def test_pylivelinkface_reads_our_datagrams(livelinkface: Path, name: str) -> None:
    turned = of(head(0.5, pitch=4.0, yaw=6.0, roll=-3.0), time=0.9)
    for shown in (picture(1.2504, name=name), turned):
        with receiver() as heard:
            stream = open_stream(f"livelink://127.0.0.1:{port(heard)}")
            stream.target.send(shown)
            stream.target.close()
            packet = heard.recv(2000)
        run = subprocess.run(
            [str(livelinkface), "-c", LIVELINK_DECODER, packet.hex()], capture_output=True, text=True, check=False,
            timeout=60, encoding="utf-8", env={"PYTHONIOENCODING": "utf-8"},
        )  # fmt: skip
        assert run.returncode == 0, run.stderr
        found = ast.literal_eval(run.stdout)
        assert found["values"] == pytest.approx(dict(shown.rig("livelink")), abs=1e-6)
        assert list(found["values"]) == list(ORDER)
        assert (found["name"], found["version"], found["fps"], found["denominator"]) == (shown.name, 6, 60, 1)
        assert found["frame"] + found["part"] == pytest.approx(shown.time * 60, abs=1e-5)
        assert len(found["uuid"]) == 37 and found["uuid"][0] == "$"  # it takes the length, 36, for a part of the id
    assert found["values"]["HeadYaw"] < 0 < found["values"]["HeadRoll"]
