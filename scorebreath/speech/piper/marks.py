"""Symbols of every Piper model that are not spoken."""

from __future__ import annotations

BEGIN, END, PAD = "^", "$", "_"
