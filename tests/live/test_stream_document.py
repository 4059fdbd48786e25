"""docs/streams.md says what the code does: every table and list in it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scorebreath.live.picture import EVERYBODY
from scorebreath.live.streams.addresses import COMMON_OPTIONS, SCHEMES
from scorebreath.live.streams.datagrams import LARGEST
from scorebreath.live.streams.livelink import ANGLES, ORDER, packet
from scorebreath.live.streams.vmc import BONES, BREATH, PRESETS, packets
from tests.live.pictures import picture


@pytest.fixture(scope="module")
def text(root: Path) -> str:
    return (root / "docs" / "streams.md").read_text(encoding="utf-8")


def table(text: str, head: str) -> list[list[str]]:
    """Cells of the rows below a head."""
    lines = text[text.index(head) :].split("\n\n", maxsplit=1)[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def quoted(text: str) -> str:
    return f"`{text}`" if text else ""


def test_kinds(text: str) -> None:
    assert table(text, "| kind | for |") == [
        [
            f"`{name}`", row.about, f"`{name}://{row.host}:{row.port}`" if row.host else f"`{name}:FILE`",
            "everybody" if row.body == EVERYBODY else "whoever begins",
        ]
        for name, row in SCHEMES.items()
    ]  # fmt: skip


def test_options(text: str) -> None:
    own = [
        [f"`{name}`", f"`{option}`", quoted(default), meaning]
        for name, row in SCHEMES.items()
        for option, (default, meaning) in row.options.items()
    ]
    common = [["all", f"`{option}`", "", meaning] for option, meaning in COMMON_OPTIONS.items()]
    assert table(text, "| kind | option |") == own + common


def test_presets_and_breath(text: str) -> None:
    assert table(text, "| VRM 0 |") == [
        [f"`{row.vrm0}`", f"`{row.vrm1}`", f"{row.source} `{row.column}`"] for row in PRESETS
    ]
    for name in BREATH:
        assert f"`{name[0].upper()}{name[1:]}`" in text


def test_bones(text: str) -> None:
    told = {row[0].strip("`"): row[1] for row in table(text, "| bone |")}
    assert told.keys() == BONES.keys()
    for name, move in BONES.items():
        angles = {"pitch": move.pitch, "yaw": move.yaw, "roll": move.roll}
        parts = [f"{axis} {gain:g} x `{each}`" for axis, of in angles.items() for each, gain in of.items()]
        assert told[name] == (f"{move.head:g} of the head's turn" if move.head else ", ".join(parts))


def test_the_layout_of_live_link(text: str) -> None:
    listed = re.findall(r"```text\n(EyeBlinkLeft.*?)```", text, re.DOTALL)
    assert tuple(listed[0].split()) == ORDER
    assert "306 + n bytes" in text and len(packet(picture(name="n"))) == 307
    assert all(f"`angles={each}`" in text for each in ANGLES if each != "radians")


def test_every_address_of_vmc_is_told(text: str) -> None:
    from pythonosc.osc_bundle import OscBundle
    from pythonosc.osc_message import OscMessage

    from scorebreath.live.streams.skeleton import COMMON

    sent = {m.address for one in packets(picture(), bones=COMMON) for m in OscBundle(one) if isinstance(m, OscMessage)}
    assert set(re.findall(r"^(/VMC/\S+)", text, re.MULTILINE)) == sent
    assert f"none above {LARGEST} bytes" in text
