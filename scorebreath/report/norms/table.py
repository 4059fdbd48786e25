"""The table of norms: every row in the order in which it is told. A new row is one entry in one of these tables."""

from __future__ import annotations

from scorebreath.report.norms import acoustics, lungs, places, timing_rows
from scorebreath.report.norms.row import Row

ROWS: tuple[Row, ...] = (*timing_rows.ROWS, *places.ROWS, *lungs.ROWS, *acoustics.ROWS)
"""All rows."""
