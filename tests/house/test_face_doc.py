"""The page about the face says what the tables say."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scorebreath.curves.rigs.drivers import CONTACT, DRIVERS, VISEME
from scorebreath.curves.rigs.table import RIGS, read_rig
from scorebreath.expression.rules import RULES
from scorebreath.parameters.columns import read_table
from scorebreath.parameters.table import Parameters

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "face.md").read_text(encoding="utf-8")
FACES = read_table("faces.toml")


@pytest.mark.parametrize("name", FACES["restrained"])
def test_every_rate_of_a_face_is_told(name: str) -> None:
    row = Parameters.model_fields[name]
    extra = row.json_schema_extra
    unit = extra["unit"] if isinstance(extra, dict) else ""
    rates = " | ".join(f"{face[name]:g}" for face in FACES.values())
    assert f"| `{name}` | {rates} | {row.description}{f', {unit}' if unit else ''} |\n" in PAGE


@pytest.mark.parametrize("name", RULES)
def test_every_rule_is_told(name: str) -> None:
    rule = RULES[name]
    assert f"| {name} | {', '.join(rule.moves)} | {rule.source} | {rule.meaning} |\n" in PAGE


def test_nothing_else_is_told() -> None:
    assert len(re.findall(r"^\| `\w+` \| [\d.]+ \|", PAGE, re.MULTILINE)) == len(FACES["restrained"])
    rules = PAGE[PAGE.index("## The rules") : PAGE.index("## What the rules hear")]
    assert len(re.findall(r"^\| [a-z]", rules, re.MULTILINE)) == len(RULES) + 1


@pytest.mark.parametrize("name", DRIVERS)
def test_every_driver_is_told(name: str) -> None:
    driver = DRIVERS[name]
    if name.startswith(VISEME):
        assert f"`{name}`" in PAGE
        return
    of = ", ".join(f"`{channel}`" for channel in driver.channels if channel != CONTACT)
    assert f"| `{name}` | {of} | {driver.meaning} |\n" in PAGE


def test_the_rig_on_the_page_is_one() -> None:
    text = PAGE[PAGE.index("```toml\n") :].removeprefix("```toml\n").partition("```")[0]
    rig = read_rig("puppet", text)
    assert rig.columns == ("jawOpen", "mouthClose", "lids", "mood", "headYaw")
    assert rig.column("lids").yields == "shut_left" and rig.column("mood").gate == 0.2


def test_every_rig_is_told() -> None:
    rigs = PAGE[PAGE.index("## Curves and rigs") : PAGE.index("## A rig of your own")]
    assert re.findall(r"^\| `(\w+)` \|", rigs, re.MULTILINE) == list(RIGS)
