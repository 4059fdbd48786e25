"""One row of the table of parameters."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

Level = Literal["abstract", "low", "person", "natural", "voice", "face", "output"]


def row(
    default: float | str | bool | None,
    meaning: str,
    *,
    unit: str = "",
    low: float | None = None,
    high: float | None = None,
    level: Level,
    source: str,
    cc: int | None = None,
) -> Any:  # pydantic's Field is typed as its default
    """One row of the table."""
    extra: dict[str, Any] = {"unit": unit, "level": level, "source": source, "midi_cc": cc}
    return Field(default, ge=low, le=high, description=meaning, json_schema_extra=extra, allow_inf_nan=None)
