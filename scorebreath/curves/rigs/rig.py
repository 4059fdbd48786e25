"""A rig: a table from channels to a character's own shapes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from scorebreath.curves.curve_set import CurveSet
from scorebreath.curves.lips.visemes import VISEMES
from scorebreath.curves.rigs.drivers import CONTACT, DRIVERS, VISEME
from scorebreath.curves.tracks import Array
from scorebreath.errors import InputError
from scorebreath.score.acting import EMOTIONS

Negative = Literal["clip", "offset", "allow"]
GATE = "closing"
"""The driver that shuts lips for p, b and m: the closure gate."""
HIGH = "high"
TIMES = "*"
"""Between the names of a product of two."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """One shape, angle or parameter of a character."""

    name: str
    unit: str
    """empty for a plain ratio"""
    low: float
    high: float
    negative: Negative
    """what is done with channels that add up to less than 0: `clip` takes 0, `offset` shows -1..1 as 0..1 with 0.5 at
    rest, `allow` takes them as they are"""
    parts: Mapping[str, float]
    """factor of each channel or driver, or of a product of two of them, in the column's unit"""
    emotions: Mapping[str, float]
    """what each emotion adds at full intensity, in the column's unit"""
    gate: float
    """share of it that the closure gate takes away, 0..1"""
    shuts: str
    """the column which it equals where the closure gate shuts the lips; `high`: its own highest value; or empty"""
    yields: str
    """the driver that takes its emotions away: a lid that shuts, or empty"""

    @property
    def made_of(self) -> str:
        """The row in words: factors of channels, then of emotions, then what shuts or covers it."""
        parts = _added(self.parts) + (", halved around 0.5" if self.negative == "offset" and self.parts else "")
        felt = _added(self.emotions) + (f", less as {self.yields}" if self.yields and self.emotions else "")
        gate = f"{GATE} takes {self.gate:g}" if self.gate else ""
        shuts = f"{GATE}: {f'{self.high:g}' if self.shuts == HIGH else self.shuts}" if self.shuts else ""
        return "; ".join(filter(None, (parts, felt, gate, shuts))) or "0"


@dataclass(frozen=True, slots=True, kw_only=True)
class Rig:
    """A table of columns, ready to be sampled; read by `rigs.rig_named`."""

    name: str
    about: str
    """what it is for, and where its names come from"""
    signs: str
    """what is positive, and whose left is left"""
    table: tuple[Column, ...]
    kind: str = ""
    """the rig of ours that its files are like: itself, or the one whose columns and units it has; else empty"""

    @property
    def columns(self) -> tuple[str, ...]:
        """Names, in their order."""
        return tuple(column.name for column in self.table)

    def sample(self, curve_set: CurveSet, times: ArrayLike, names: Sequence[str] | None = None) -> Array:
        """The columns at any times; each row depends on its own time alone.

        Channels times factors are summed, `negative` is applied, emotions are added, the sum is held within the
        column's range; the closure gate comes last, so no emotion opens p, b or m (design: Mixing). Where the
        `curve_set` has no closure gate the sum stays plain, as in S3 (A18, A43): nothing is taken from it, nor yields.

        Args:
            curve_set: Whose curves.
            times: Seconds, (n,).
            names: Columns wanted, in this order; all when left out.

        Returns:
            (n, columns) float64, in the units of `table`.

        Raises:
            InputError: A name is no column, or a time is not a finite number.
        """
        wanted = self.table if names is None else tuple(self.column(name) for name in names)
        sources = self._sources(wanted, curve_set, times)
        out = np.empty((len(wanted), len(sources[GATE])))
        for number, column in enumerate(wanted):
            out[number] = _sum(column, sources, plain=not curve_set.closure_gate)
            if not curve_set.closure_gate:
                continue
            if column.gate:
                out[number] *= 1.0 - column.gate * sources[GATE]
            if column.shuts:
                target = column.high if column.shuts == HIGH else _sum(self.column(column.shuts), sources)
                out[number] += (target - out[number]) * sources[GATE]
        return out.T

    def column(self, name: str) -> Column:
        """The table's row of that name.

        Raises:
            InputError: There is none.
        """
        for column in self.table:
            if column.name == name:
                return column
        raise InputError(f"rig {self.name} has no column {name!r}; expected one of {', '.join(self.columns)}")

    def drivers(self) -> dict[str, str]:
        """What the columns are made from besides channels: name -> meaning."""
        used = {factor for column in self.table for part in column.parts for factor in factors(part)}
        used |= {column.yields for column in self.table}
        used |= {GATE for column in self.table if column.gate or column.shuts}
        return {name: driver.meaning for name, driver in DRIVERS.items() if name in used}

    def _sources(self, table: Sequence[Column], curve_set: CurveSet, times: ArrayLike) -> dict[str, Array]:
        """Every channel and driver that some columns need, (n,) each."""
        table = (*table, *(self.column(column.shuts) for column in table if column.shuts not in ("", HIGH)))
        felt = {name for column in table for name in column.emotions}
        parts = {name for column in table for name in (*column.parts, column.yields) if name}
        wanted = {factor for part in parts for factor in factors(part)}
        wanted |= {GATE} | {f"emotion_{name}" for name in EMOTIONS if name in felt}
        drivers = [name for name in sorted(wanted) if name in DRIVERS]
        needed = (wanted - set(drivers)) | {need for name in drivers for need in DRIVERS[name].channels}
        channels = sorted(name for name in needed if name != CONTACT and not name.startswith(VISEME))
        found = dict(zip(channels, np.ascontiguousarray(curve_set.sample(times, channels).T), strict=True))
        found[CONTACT] = curve_set.contact(times)
        if any(name.startswith(VISEME) for name in needed):
            shares = np.ascontiguousarray(curve_set.visemes(times).T)
            found |= {f"{VISEME}{name}": share for name, share in zip(VISEMES, shares, strict=True)}
        for name in drivers:
            found[name] = DRIVERS[name].of(*(found[need] for need in DRIVERS[name].channels))
        for part in parts:
            if part not in found:
                one, other = factors(part)
                found[part] = found[one] * found[other]
        return found


def factors(part: str) -> tuple[str, ...]:
    """The names in a part: itself, or both of a product.

    >>> factors("jaw_open"), factors("jaw_open * lip_round")
    (('jaw_open',), ('jaw_open', 'lip_round'))
    """
    return tuple(name.strip() for name in part.split(TIMES))


def _added(factors: Mapping[str, float]) -> str:
    """A sum in words.

    >>> _added({"lip_round": 1.0, "jaw_open": -1.6})
    '1 lip_round - 1.6 jaw_open'
    """
    said = "".join(f" {'-' if gain < 0 else '+'} {abs(gain):g} {name}" for name, gain in factors.items())
    return said.removeprefix(" + ") if not said.startswith(" - ") else f"-{said.removeprefix(' - ')}"


def _sum(column: Column, sources: Mapping[str, Array], *, plain: bool = False) -> Array:
    """One column without the closure gate, (n,); `plain`: no emotion yields.

    A sum in the table's order, not a matrix product: that differs in the last bit with the number of moments.
    """
    value = np.zeros(len(sources[GATE]))
    for name, gain in column.parts.items():
        value += gain * sources[name]
    if column.negative == "clip":
        value = np.maximum(value, 0.0)
    elif column.negative == "offset":
        value = 0.5 + 0.5 * value
    left = 1.0 - sources[column.yields] if column.yields and not plain else 1.0
    for name, gain in column.emotions.items():
        value += gain * sources[f"emotion_{name}"] * left
    return np.clip(value, column.low, column.high)
