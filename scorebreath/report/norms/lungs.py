"""Rows about the lungs: levels, volumes, flows, and the laws of the curves (physiology 2.2, 10)."""

from __future__ import annotations

import numpy as np

from scorebreath.report.norms.figures import UPRIGHT, Array, Figure, When
from scorebreath.report.norms.material import Material
from scorebreath.report.norms.row import Row
from scorebreath.report.norms.timing import MEASURED, ratio
from scorebreath.score.events import Expiration, Hold, Inspiration

LUNGS, LAWS = "Lungs", "Laws of the curves"
UP = When(posture=UPRIGHT, loudness=(0.0, 200.0))
LOUD = When(posture=UPRIGHT, loudness=(200.0, 1e9))
"""Twice the amplitude is 6 dB (physiology 2.2: loud)."""
ADULT = When(age=(18.0, 200.0))


def initiation(m: Material) -> Array:
    """Lung volume at the first phone, % VC."""
    return m.levels[:, 0]


def termination(m: Material) -> Array:
    """Lung volume at the last phone, % VC."""
    return m.levels[:, 1]


def excursion(m: Material) -> Array:
    """Volume spent on a group, % VC."""
    return m.levels[:, 0] - m.levels[:, 1]


def per_syllable(m: Material) -> Array:
    """Volume spent on a syllable, % VC."""
    said = m.syllables[m.on_speech_breath]
    return ratio(excursion(m), said, said > 0)


def millilitres(m: Material) -> Array:
    """Volume spent on a syllable, mL."""
    return per_syllable(m) * 10.0 * m.body.person.vital_capacity


def speech_flow(m: Material) -> Array:
    """Mean airflow from the first phone to the last, L/s."""
    length = (m.end - m.start)[m.on_speech_breath]
    litres = excursion(m) / 100.0 * m.body.person.vital_capacity
    return ratio(litres, length, length > MEASURED)


def _volumes(m: Material) -> Array:
    """Every volume an event of the body begins or ends at, and the resting volume before and after, % VC."""
    found: list[float] = []
    for event in m.score.events:
        if event.body != m.body.id or event.duration <= 0:
            continue
        if isinstance(event, Inspiration | Expiration):
            found += (event.from_volume, event.to_volume)
        elif isinstance(event, Hold):
            found.append(event.volume)
    return 100.0 * np.array([*found, m.body.person.resting_volume] if found else [])


def lowest(m: Material) -> Array:
    """Lowest of them, (1,) or (0,) where nothing breathes, % VC."""
    return np.sort(_volumes(m))[:1]


def highest(m: Material) -> Array:
    """Highest of them, (1,) or (0,), % VC."""
    return np.sort(_volumes(m))[-1:]


def _law(m: Material, name: str) -> Array:
    found = m.laws
    return np.zeros(0) if found is None else np.array([getattr(found, name)])


ROWS: tuple[Row, ...] = (
    Row(
        name="initiation", title="Where speech begins", part=LUNGS, unit="% VC", measure=initiation, digits=1,
        measured="lung volume at the first phone of a group, above residual volume",
        figures=(
            Figure(of="mean", source="winkworth95", mark="V", low=42.0, high=63.0, when=UP,
                   note="session means of one woman, spontaneous; 47 to 53 of another"),
            Figure(of="mean", source="scorebreath", mark="E", low=40.0, high=65.0, when=UP, judges=False),
            Figure(of="mean", source="hixon", mark="M", low=50.0, high=60.0, when=UP, judges=False,
                   note="the classic range"),
            Figure(of="mean", source="hixon", mark="M", low=55.0, high=85.0, when=LOUD, note="loud speech"),
        ),
    ),
    Row(
        name="termination", title="Where speech ends", part=LUNGS, unit="% VC", measure=termination, digits=1,
        measured="lung volume at the end of the last phone of a group, above residual volume",
        figures=(
            Figure(of="mean", source="hixon", mark="M", low=25.0, high=45.0, when=When(posture=UPRIGHT),
                   note="with Hoit & Hixon 1987"),
        ),
    ),
    Row(
        name="excursion", title="Volume of a breath group", part=LUNGS, unit="% VC", measure=excursion, digits=1,
        measured="lung volume at the first phone less that at the last",
        figures=(Figure(of="mean", source="scorebreath", mark="C", low=5.0, high=35.0, note="from the two levels"),),
    ),
    Row(
        name="volume_per_syllable", title="Volume of a syllable", part=LUNGS, unit="% VC", measure=per_syllable,
        measured="volume of a group over its syllables",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=0.5, high=1.8, note="acceptance window"),
        ),
    ),
    Row(
        name="millilitres_per_syllable", title="Volume of a syllable, absolute", part=LUNGS, unit="mL", digits=1,
        measure=millilitres, measured="volume of a group over its syllables, times vital capacity",
        figures=(Figure(of="mean", source="hoit", mark="M", low=30.0, high=50.0, when=ADULT, note="men"),),
    ),
    Row(
        name="speech_flow", title="Mean airflow of speech", part=LUNGS, unit="L/s", measure=speech_flow,
        measured="volume of a group over the time from its first phone to its last",
        figures=(Figure(of="mean", source="hixon_hoit", mark="M", low=0.10, high=0.25, when=ADULT),),
    ),
    Row(
        name="lowest_volume", title="Lowest lung volume", part=LUNGS, unit="% VC", measure=lowest, kind="number",
        digits=1,
        measured="lowest of all volumes that the body's breaths and holds begin or end at",
        figures=(Figure(of="value", source="scorebreath", mark="E", low=15.0, note="acceptance window"),),
    ),
    Row(
        name="highest_volume", title="Highest lung volume", part=LUNGS, unit="% VC", measure=highest, kind="number",
        digits=1,
        measured="highest of all volumes that the body's breaths and holds begin or end at",
        figures=(Figure(of="value", source="scorebreath", mark="E", high=95.0, note="acceptance window"),),
    ),
    Row(
        name="volume_sum", title="Chest and belly add up", part=LAWS, unit="%", kind="number", digits=4,
        measure=lambda m: _law(m, "sum_error"),
        measured="largest |thorax_volume + abdomen_volume - (lung_volume - resting level)|, of the largest excursion "
                 "from "
                 "rest, in every frame of 10 ms of the first day",
        figures=(Figure(of="value", source="scorebreath", mark="E", high=1.0, note="acceptance window"),),
    ),
    Row(
        name="largest_flow", title="Fastest change of volume", part=LAWS, unit="L/s", kind="number",
        measure=lambda m: _law(m, "flow"), measured="largest change of lung_volume in a frame of 20 ms, over the frame",
        figures=(Figure(of="value", source="scorebreath", mark="E", high=8.0, note="acceptance window"),),
    ),
    Row(
        name="change_over_flow", title="Change of volume over the flow", part=LAWS, unit="", kind="number", digits=3,
        measure=lambda m: _law(m, "over_flow"),
        measured="largest change of lung_volume in a frame of 20 ms, over what the highest airflow within or 10 ms "
                 "around it "
                 "moves in that time",
        figures=(Figure(of="value", source="scorebreath", mark="E", high=1.02,
                        note="never more than the profile's peak flow; 2 % for the sampling"),),
    ),
    Row(
        name="continuity", title="Half a frame, half the step", part=LAWS, unit="", kind="number", digits=3,
        measure=lambda m: _law(m, "ratio"),
        measured="largest change of lung_volume in 10 ms over the largest in 20 ms; a jump gives 1",
        figures=(Figure(of="value", source="scorebreath", mark="E", low=0.4, high=0.6, note="acceptance: a half"),),
    ),
)  # fmt: skip
"""Rows about the lungs."""
