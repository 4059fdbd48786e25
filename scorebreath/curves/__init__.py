"""Lungs, chest, head, nostrils, mouth and levels as functions of time: closed forms of a Score's events."""

from __future__ import annotations

from scorebreath.curves.curve_set import CurveSet, curves

__all__ = ["CurveSet", "curves"]
