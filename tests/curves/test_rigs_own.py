"""Rigs of one's own: TOML tables, and what is said of broken ones."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.curves.rigs.table import read_rig, rig_named
from scorebreath.errors import InputError
from tests.curves.acts import breathe_in
from tests.curves.faces import emotion, head, only, shown


def test_a_rig_like_another_changes_what_it_says() -> None:
    rig = read_rig("mine", """
        like = "arkit"
        order = ["jawOpen", "headYaw", "smile", "mood"]
        [units]
        percent = 100.0
        [columns]
        headYaw = { from = { head_yaw = -2.0 }, low = -90, high = 90, unit = "deg", negative = "allow" }
        smile = { from = { lip_spread = 0.5 }, unit = "percent" }
        mood = { from = { thorax = 1.0 }, negative = "offset" }
        [emotions.happy]
        smile = 0.4
    """)  # fmt: skip
    assert rig.columns == ("jawOpen", "headYaw", "smile", "mood")
    found = shown(rig, only(head(1.0, yaw=8.0), emotion("happy", 0.4)), 1.4)
    assert (found["headYaw"], found["smile"], found["jawOpen"]) == pytest.approx((-16.0, 40.0, 0.0))
    assert found["mood"] == 0.5
    assert rig.table[2].high == 100.0
    breath = shown(rig, only(breathe_in(duration=1.0)), 0.9)
    thorax = curves(only(breathe_in(duration=1.0))).sample([0.9], ["thorax"])[0, 0]
    assert breath["mood"] == pytest.approx(0.5 + 0.5 * thorax) != 0.5


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("columns", "rig mine: no TOML"),
        ("[colums]", "rig mine: section 'colums' is unknown; did you mean columns?"),
        ("", r"rig mine: \[columns\] is empty"),
        ('like = "bones"', "rig mine: like = 'bones'; expected one of arkit, livelink"),
        ("columns = 3", "rig mine: columns = 3; expected a table"),
        ("[columns]\na = 3", "rig mine: a = 3; expected a table"),
        ('[columns]\na = { form = {} }', "rig mine: a: key 'form' is unknown; did you mean from?"),
        ("[columns]\na = { from = { jaw = 1 } }", "rig mine: a: from 'jaw' is unknown; did you mean jaw_open"),
        ("[columns]\na = { from = 3 }", "rig mine: from = 3; expected a table"),
        ('[columns]\na = { from = ["jaw_open"] }', r"rig mine: from = \['jaw_open'\]; expected a table"),
        ('order = "a"\n[columns]\na = {}', "rig mine: order = 'a'; expected a list of columns"),
        ('order = ["a", "a"]\n[columns]\na = {}', "rig mine: order names 'a' twice; expected each column once"),
        ('[columns]\n"a,b" = {}', "rig mine: column 'a,b': expected a name without commas"),
        ('[columns]\n"" = {}', "rig mine: column '': expected a name"),
        ('[columns]\na = {}\n[units]\nrad = "x"', "rig mine: units: rad = 'x'; expected a number"),
        ("[columns]\na = {}\n[units]\nrad = 0", "rig mine: units: rad = 0; expected a number above 0"),
        ('[columns]\na = {}\n[closure]\na = "a"', "rig mine: closure: a cannot equal itself"),
        ("[columns]\na = { from = { mouth = 1e308 } }", "a: mouth = 1e.308; expected a number, at most 1e.09"),
        ("[columns]\ntime = {}", "rig mine: column 'time': expected a name"),
        ('like = "arkit"\norder = ["mouthClose"]', "rig mine: mouthClose closes jawOpen, which order leaves out"),
        ('[columns]\na = { from = { jaw_open = "1" } }', "rig mine: a: jaw_open = '1'; expected a number"),
        ('[columns]\na = { from = { "a * b * c" = 3 } }', "rig mine: a: from 'a' is unknown"),
        ('[columns]\na = { from = { "thorax * thorax * thorax" = 3 } }', "products of two at most"),
        ("[columns]\na = { low = 2 }", "rig mine: a: low = 2 must be below high = 1"),
        ("[columns]\na = { high = inf }", "rig mine: a: high = inf; expected a number"),
        ('[columns]\na = { negative = "flip" }', "rig mine: a: negative = 'flip'; expected clip, offset, allow"),
        ("[columns]\na = {}\n[emotions.hapy]\na = 1", "rig mine: emotions 'hapy' is unknown; did you mean happy?"),
        ("[columns]\na = {}\n[emotions.happy]\nb = 1", "rig mine: happy: no column is called 'b'"),
        ("[columns]\na = {}\n[closure]\nb = 1", "rig mine: closure: no column is called 'b'"),
        ("[columns]\na = {}\n[closure]\na = 2", r"rig mine: closure: a = 2 must be in \[0, 1\]"),
        ('[columns]\na = {}\n[closure]\na = "b"', "rig mine: closure: a 'b' is unknown"),
        ('[columns]\na = {}\n[yields]\na = "b"', "rig mine: yields: a 'b' is unknown"),
        ('order = ["b"]\n[columns]\na = {}', "rig mine: order 'b' is unknown"),
        ('names = "upper"\n[columns]\na = {}', "rig mine: names = 'upper'; expected pascal"),
    ],
)  # fmt: skip
def test_a_broken_rig_is_refused_where_it_is_broken(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_rig("mine", text)


def test_a_product_is_one_however_it_is_spaced() -> None:
    text = '[columns]\na = { from = { "jaw_open%slid_left" = 1.0 } }'
    score = only(breathe_in(duration=1.0))
    both = (read_rig("mine", text % star).sample(curves(score), [0.5]) for star in ("*", " * "))
    assert next(both) == next(both)


def test_a_rig_is_found_by_name_or_path(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"no rig is called 'arkti' \(there are .*\); did you mean arkit"):
        rig_named("arkti")
    with pytest.raises(InputError, match="cannot be read"):
        rig_named(str(tmp_path / "none.toml"))
    path = tmp_path / "puppet.toml"
    path.write_text("[columns]\nmouth = { from = { mouth = 1.0 } }\n")
    assert dataclasses.replace(rig_named(str(path)), table=()).name == "puppet"


def test_what_a_rig_s_files_are_follows_its_columns_not_its_name(tmp_path: Path) -> None:
    path = tmp_path / "livelink.toml"
    path.write_text('like = "livelink"\n[columns]\njawOpen = { from = { mouth = 0.9 } }\n')
    assert rig_named(str(path)).kind == "livelink"
    path.write_text('like = "livelink"\norder = ["mouthClose", "jawOpen"]\n')
    assert rig_named(str(path)).kind == ""
    path.write_text("[columns]\na = {}\n")
    assert rig_named(str(path)).kind == ""
    assert rig_named("livelink").kind == "livelink"
