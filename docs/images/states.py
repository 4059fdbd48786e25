"""Makes docs/images/states.png and the tables of docs/states.md: one text read in four states.

    python docs/images/states.py

What the first table says is measured in sound, not in the Scores. Each reading is rendered with its breaths and
without them; times are the same, so the second sound is the speech alone, and the difference of the two the breaths.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import soundfile as sf
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

from scorebreath.curves import curves
from scorebreath.report.norms import Norms, norms
from scorebreath.report.norms.words import figure_said
from scorebreath.score.document import Score
from scorebreath.score.files import load

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TEXT = ROOT / "examples" / "four_states.txt"
READINGS = {
    "calm": ("--state", "calm=1"),
    "neutral": (),
    "anxious": ("--state", "anxious=1"),
    "exhausted": ("--state", "exertion=0.8", "--state", "fatigue=0.7"),
}
SHOWN = 36.0
"""Seconds that are drawn."""
FRAME = 0.01
"""s; levels are those of frames of this length"""
FAINT_DB = -40.0
"""Speech this far below its active level counts as silence, and breaths below it are not counted as heard."""
SHORTEST = 0.10
"""s; breaths and pauses are at least that long"""

NORMS = (
    "group_with_inspiration", "syllables", "cycle_rate", "inspiration", "inspiratory_fraction", "breath_pause",
    "initiation", "termination", "excursion", "volume_per_syllable", "breath_level", "centroid",
)  # fmt: skip
TOLD = {"outside: below": " (below)", "outside: above": " (above)", "outside": " (outside)"}
MARK = "<!-- made by docs/images/states.py -->"

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Heard:
    """A reading, as sound."""

    speech: Array
    """(frames,) dB re the active level of the speech"""
    breath: Array
    """(frames,) the same scale"""


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        made = {name: render(name, options, Path(folder)) for name, options in READINGS.items()}
        heard = {name: listen(out) for name, out in made.items()}
        scores = {name: load(out / "score.json")[0] for name, out in made.items()}
        draw(scores, heard)
        kinds = {name: norms(score, made[name] / "mix.wav") for name, score in scores.items()}
        write([*table(heard), "", *beside_norms(kinds)])


def render(name: str, options: tuple[str, ...], folder: Path) -> Path:
    """With breaths, and without them in the folder `silent` inside."""
    out = folder / name
    for target, more in ((out, ()), (out / "silent", ("--no-breath-sound",))):
        command = [sys.executable, "-m", "scorebreath_cli.main", "render", str(TEXT), "-o", str(target)]
        subprocess.run([*command, *options, *more], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return out


def listen(folder: Path) -> Heard:
    """Levels of speech and breath, frame by frame."""
    both, rate = sf.read(folder / "mix.wav")
    speech, _ = sf.read(folder / "silent" / "mix.wav")
    loud = frames(speech, rate)
    reference = 10 * np.log10(np.mean(10 ** (loud[loud > loud.max() - 40] / 10)))
    return Heard(speech=loud - reference, breath=frames(both - speech, rate) - reference)


def frames(sound: Array, rate: int) -> Array:
    """Level of each frame, dB re full scale."""
    size = round(FRAME * rate)
    blocks = sound[: len(sound) // size * size].reshape(-1, size)
    return np.asarray(10 * np.log10(np.mean(blocks**2, axis=1) + 1e-14))


def runs(flags: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Where a flag is set for long enough: beginnings and ends, in frames."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], flags.astype(int), [0]))))
    found = zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)
    return [(begin, end) for begin, end in found if (end - begin) * FRAME >= SHORTEST - 1e-9]


def table(heard: dict[str, Heard]) -> list[str]:
    """Lines of a Markdown table."""
    names = list(heard)
    rows: dict[str, list[str]] = {}
    for reading in heard.values():
        for name, value in measure(reading).items():
            rows.setdefault(name, []).append(value)
    lines = [f"| measured in the sound | {' | '.join(names)} |", "|---|" + "---|" * len(names)]
    return [*lines, *(f"| {name} | {' | '.join(values)} |" for name, values in rows.items())]


def measure(heard: Heard) -> dict[str, str]:
    """What the sound of one reading says about its breathing."""
    breaths = runs(heard.breath > FAINT_DB)
    silences = runs(heard.speech < FAINT_DB)[1:-1]  # without those at the two ends
    breathed = [(a, b) for a, b in silences if np.any(heard.breath[a:b] > FAINT_DB)]
    starts = [b for _, b in breathed]
    groups = [(a - b) * FRAME for b, (a, _) in zip(starts, breathed[1:], strict=False)]
    minutes = len(heard.speech) * FRAME / 60
    loudest = [float(np.max(heard.breath[a:b])) for a, b in breaths]
    return {
        "length of the reading, s": f"{60 * minutes:.1f}",
        "audible breaths a minute": f"{len(breaths) / minutes:.1f}",
        "speech between two breaths, s, median": f"{np.median(groups):.2f}",
        "pause with a breath in it, s, median": f"{np.median([(b - a) * FRAME for a, b in breathed]):.2f}",
        "audible part of a breath, s, median": f"{np.median([(b - a) * FRAME for a, b in breaths]):.2f}",
        "peak of a breath re speech, dB, median": f"{np.median(loudest):.1f}",
        "the same, 5 to 95 %": " to ".join(f"{value:.0f}" for value in np.percentile(loudest, [5, 95])),
    }


def beside_norms(readings: dict[str, Norms]) -> list[str]:
    """Lines of a Markdown table: means, and where they leave what is published of neutral speakers."""
    lines = [f"| norm | {' | '.join(readings)} | published |", "|---|" + "---|" * (len(readings) + 1)]
    for name in NORMS:
        results = [reading[name] for reading in readings.values()]
        row = results[0].row
        cells = [f"{r.value:.{row.digits}f}{TOLD.get(str(r.verdict), '')}" for r in results if r.value is not None]
        published = "; ".join(figure_said(one.figure, row.unit) for one in results[1].compared[:1])
        lines.append(f"| {row.title}{', ' + row.unit if row.unit else ''} | {' | '.join(cells)} | {published} |")
    return lines


def write(lines: list[str]) -> None:
    """Put the tables between their marks."""
    page = HERE.parent / "states.md"
    before, _, rest = page.read_text(encoding="utf-8").partition(MARK)
    after = rest.partition(MARK)[2]
    page.write_text("\n".join([before + MARK, "", *lines, "", MARK + after]), encoding="utf-8")


def draw(scores: dict[str, Score], heard: dict[str, Heard]) -> None:
    """Lungs above, sound below, for each reading."""
    figure = Figure(figsize=(12, 9.6), dpi=120, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(len(scores) * 2, 1, sharex=True, height_ratios=[3, 1.4] * len(scores))
    times = np.arange(0, SHOWN, 1 / 60)
    for row, (name, score) in enumerate(scores.items()):
        top, below = axes[2 * row], axes[2 * row + 1]
        set_ = curves(score)
        volume = 100 * set_.sample(times, ("lung_volume",))[:, 0]
        rest = 100 * score.bodies[0].person.resting_volume
        top.axhline(rest, color="0.7", linewidth=0.8)
        top.plot(times, volume, color="#1f5fa8", linewidth=1.3)
        top.fill_between(times, rest, volume, color="#1f5fa8", alpha=0.12, linewidth=0)
        top.set_ylim(15, 95)
        top.set_ylabel("lungs, % VC")
        top.set_title(name, loc="left", fontweight="bold")
        at = np.arange(len(heard[name].speech)) * FRAME
        below.fill_between(at, -60, np.maximum(heard[name].speech, -60), color="0.75", linewidth=0, label="speech")
        below.fill_between(at, -60, np.maximum(heard[name].breath, -60), color="#c8452d", linewidth=0, label="breath")
        below.set_ylim(-60, 8)
        below.set_ylabel("dB")
        for axis in (top, below):
            axis.spines[["top", "right"]].set_visible(False)
    axes[0].set_xlim(0, SHOWN)
    figure.legend(*axes[1].get_legend_handles_labels(), loc="outside upper right", ncols=2, frameon=False, fontsize=9)
    axes[-1].set_xlabel("s")
    figure.savefig(HERE / "states.png")
    with Image.open(HERE / "states.png") as picture:
        picture.convert("RGB").quantize(64).save(HERE / "states.png", optimize=True)


if __name__ == "__main__":
    main()
