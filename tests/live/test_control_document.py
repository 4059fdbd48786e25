"""docs/controls.md says what the tables say, and what it sends from other programs is understood."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

from scorebreath.live.controls import limits, midi, osc_server, packets
from scorebreath.live.controls.addresses import VERBS, AddressRow, table
from scorebreath.live.controls.knobs import PATIENCE, WINDOW
from scorebreath.live.controls.mapping import SOURCES, default_mapping
from scorebreath.live.controls.mapping_file import KEYS, loads_mapping
from scorebreath.live.controls.osc_server import OscServer
from scorebreath.live.controls.scaling import CURVES
from scorebreath.live.desk import COMMANDS
from tests.live.desks import ToyDesk

ROOT = Path(__file__).resolve().parents[2]
DOCUMENT = (ROOT / "docs" / "controls.md").read_text(encoding="utf-8")
ROWS = {
    cells[0].strip("`"): cells[1:]
    for line in re.findall(r"^\| (.+) \|$", DOCUMENT, re.MULTILINE)
    if (cells := [cell.strip() for cell in re.split(r" ?\| ", line)])
}
KNOBS = {control.parameter: control for control in default_mapping().controls if control.parameter}
KEYS_OF = {control.command: control.number for control in default_mapping().controls if control.command}
PARAMETERS = [row for row in table() if row.place.kind == "parameter"]


@pytest.mark.parametrize("row", PARAMETERS, ids=lambda row: row.place.name)
def test_every_parameter_has_its_row(row: AddressRow) -> None:
    knob = KNOBS.get(row.place.name)
    numbers = "" if knob is None else str(knob.number)
    numbers += f", {knob.number + 32}" if knob and knob.source == "cc14" else ""
    assert ROWS[row.address] == [row.values, numbers, row.about]


def test_every_verb_and_command_has_its_row() -> None:
    for name, verb in VERBS.items():
        assert ROWS[f"/scorebreath/{name}"] == [verb.arguments, "yes" if verb.bodies else "no", verb.about]
    for name, command in COMMANDS.items():
        assert ROWS[name] == [str(KEYS_OF[name]), command.about]


def test_no_row_is_left_over() -> None:
    addresses = {name for name in ROWS if name.startswith("/")}
    assert addresses == {row.address for row in PARAMETERS} | {f"/scorebreath/{name}" for name in VERBS}
    keys = {key for head in ROWS for key in re.split(r"`, `", head)}
    assert set(KEYS) <= keys and set(CURVES) <= keys
    known = {*COMMANDS, *KEYS, *CURVES, "address", "command", "key", "curve", "---"}
    assert {key for key in keys if not key.startswith("/")} - known == set()
    assert all(ROWS[name] == [curve.about] for name, curve in CURVES.items())
    assert all(ROWS[source][0] == (f"0 to {highest}" if highest else "true") for source, highest in SOURCES.items())


def test_the_figures_are_those_of_the_code() -> None:
    assert f"at `{osc_server.HOST}`, port {osc_server.PORT}" in DOCUMENT
    assert f"no more than {osc_server.FARTHEST:g} s ahead" in DOCUMENT
    assert round(1 / osc_server.TELLING) == 50 and "fifty times a second" in DOCUMENT
    assert f"within {limits.Listeners.STAYS:g} s is told no more; {limits.Listeners.MOST} may listen" in DOCUMENT
    assert packets.DEEPEST == 4 and "four deep" in DOCUMENT
    assert f"within {PATIENCE * 1000:g} ms" in DOCUMENT and round(WINDOW * 127) == 2
    assert f"up to {1 / midi.LEAST:g} times a second" in DOCUMENT
    assert midi.LOOKING < 1.0 and "noticed within a second" in DOCUMENT


def test_the_mapping_is_understood() -> None:
    (example,) = re.findall(r"^```toml\n(.*?)^```", DOCUMENT, re.MULTILINE | re.DOTALL)
    mapping = loads_mapping(example)
    assert len(mapping.controls) == example.count("[[control]]") == 6
    assert {key for key in KEYS if re.search(rf"^{key} = ", example, re.MULTILINE)} == set(KEYS) - {"pressure"}


def given(text: str) -> list[str | float | int]:
    """Arguments as the programs send them: whole numbers, 32-bit floats, texts."""
    return [ast.literal_eval(part) for part in re.findall(r'"[^"]*"|-?\d+(?:\.\d+)?', text)]


def test_what_supercollider_sends_is_understood() -> None:
    lines = re.findall(r'n\.send(?:Msg\(|Bundle\(0\.2, \[)"(/[\w/]+)"(.*?)\]?\);', DOCUMENT)
    assert len(lines) == DOCUMENT.count("n.send")
    desk = ToyDesk()
    server = OscServer(desk)
    for address, rest in lines:
        assert server.receive(packets.write_message(address, *given(rest)), ("127.0.0.1", 9)) == [], address
    assert desk.calls == [
        ("say", "Hello there.", ""), ("set", "nose_share", 0.8, "", 0.5), ("set", "capacity_lung", 60.0, "body", None),
        ("set", "style", "spontaneous", "", None), ("command", "sigh", ""), ("set", "abdomen_share", 0.9, "", None),
    ]  # fmt: skip


def test_what_max_sends_is_understood() -> None:
    """It sends words one by one, numbers as they look."""
    (block,) = re.findall(r"\[udpsend 127\.0\.0\.1 57130\]\n(.*?)```", DOCUMENT, re.DOTALL)
    desk = ToyDesk()
    server = OscServer(desk)
    for line in block.strip().split("\n"):
        address, *words = line.split()
        arguments = [float(word) if re.fullmatch(r"-?\d*\.\d+", word) else word for word in words]
        assert server.receive(packets.write_message(address, *arguments), ("127.0.0.1", 9)) == [], line
    assert desk.calls == [("set", "nose_share", 0.8, "", None), ("say", "Hello there.", ""), ("command", "sigh", "")]


def test_the_lines_at_the_top_are_understood() -> None:
    (block,) = re.findall(r"^```\n(/scorebreath/nose_share 0\.8 .*?)```", DOCUMENT, re.MULTILINE | re.DOTALL)
    desk = ToyDesk("body", "body2")
    server = OscServer(desk)
    lines = [line.split("   ")[0] for line in block.strip().split("\n")]
    for line in lines:
        address, _, rest = line.partition(" ")
        answers = server.receive(packets.write_message(address, *given(rest)), ("127.0.0.1", 9))
        assert bool(answers) == (line == "/scorebreath/nose_share")
    assert (server.report().applied, server.report().refused) == (len(lines), 0)
