"""Rows about the sound of breaths (physiology 3.2, 3.5)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scorebreath.report.norms.figures import Array, Figure, Route, When
from scorebreath.report.norms.material import Material
from scorebreath.report.norms.row import Row

SOUND = "Sound of the breaths"
HELD = "over the breath's hold, or while it is at least half as loud as its loudest"
WELCH = f"{HELD}; Welch's method, 0.1 to 12 kHz"


class Window(NamedTuple):
    """Where a spectrum may lie, for each route (physiology 3.5)."""

    mouth: tuple[float | None, float | None]
    nose: tuple[float | None, float | None]

    def of(self, route: Route) -> tuple[float | None, float | None]:
        """The window of a route; of both at once from the lower end of one to the higher end of the other."""
        if route != "both":
            return self.mouth if route == "mouth" else self.nose
        low = [each for each in (self.mouth[0], self.nose[0]) if each is not None]
        high = [each for each in (self.mouth[1], self.nose[1]) if each is not None]
        return (min(low) if len(low) == 2 else None), (max(high) if len(high) == 2 else None)


ROUTES: dict[Route, str] = {
    "mouth": "breaths through the mouth",
    "nose": "breaths through the nose",
    "both": "breaths through both: from one end of the mouth's window to the other end of the nose's",
}


def _figures(window: Window) -> tuple[Figure, ...]:
    return tuple(
        Figure(of="mean", source="scorebreath", mark="E", low=low, high=high, when=When(route=route), note=note)
        for route, note in ROUTES.items()
        for low, high in [window.of(route)]
    )


def level(m: Material) -> Array:
    """How loud, dB relative to the active level of the speech."""
    return m.heard.level if m.heard else np.zeros(0)


def _spectral(m: Material, name: str) -> Array:
    return np.asarray(getattr(m.heard.spectra, name)) if m.heard else np.zeros(0)


def _band(m: Material, number: int) -> Array:
    return m.heard.spectra.bands[:, number] if m.heard else np.zeros(0)


ROWS: tuple[Row, ...] = (
    Row(
        name="breath_level", title="Level of the breaths", part=SOUND, unit="dB", measure=level, digits=1,
        measured=f"root mean square {HELD}; relative to the speech's active level (steps within 40 dB of the loudest)",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=-27.0, high=-21.0,
                   note="acceptance window: -24 at the "
                   "defaults"),
            Figure(of="each", source="scorebreath", mark="E", low=-36.0, high=-10.0, judges=False,
                   note="audible, and not "
                   "taken for speech"),
        ),
    ),
    Row(
        name="centroid", title="Mean frequency", part=SOUND, unit="Hz", digits=0, measured=WELCH,
        measure=lambda m: _spectral(m, "centroid"), figures=_figures(Window((1100.0, 2400.0), (2200.0, 3800.0))),
    ),
    Row(
        name="median_frequency", title="Median frequency", part=SOUND, unit="Hz", digits=0,
        measured=f"half of the power lies below it; {WELCH}",
        measure=lambda m: _spectral(m, "median"), figures=_figures(Window((900.0, 2200.0), (1800.0, 3600.0))),
    ),
    Row(
        name="roll_off", title="85 % roll-off", part=SOUND, unit="Hz", digits=0,
        measured=f"85 % of the power lies below it; {WELCH}",
        measure=lambda m: _spectral(m, "roll_off"), figures=_figures(Window((1800.0, 4000.0), (3300.0, 6000.0))),
    ),
    Row(
        name="band_0_1", title="Power from 0.1 to 1 kHz", part=SOUND, unit="dB", digits=1,
        measured=f"relative to all of it; {WELCH}",
        measure=lambda m: _band(m, 0), figures=_figures(Window((-6.0, -2.0), (-12.0, -4.0))),
    ),
    Row(
        name="band_1_3", title="Power from 1 to 3 kHz", part=SOUND, unit="dB", digits=1,
        measured=f"relative to all of it; {WELCH}",
        measure=lambda m: _band(m, 1), figures=_figures(Window((-5.0, -2.0), (-8.0, -2.0))),
    ),
    Row(
        name="band_3_6", title="Power from 3 to 6 kHz", part=SOUND, unit="dB", digits=1,
        measured=f"relative to all of it; {WELCH}",
        measure=lambda m: _band(m, 2), figures=_figures(Window((-16.0, -6.0), (-6.0, -1.5))),
    ),
    Row(
        name="band_6_12", title="Power from 6 to 12 kHz", part=SOUND, unit="dB", digits=1,
        measured=f"relative to all of it; {WELCH}",
        measure=lambda m: _band(m, 3), figures=_figures(Window((None, -12.0), (None, -10.0))),
    ),
)  # fmt: skip
"""Rows about sound."""
