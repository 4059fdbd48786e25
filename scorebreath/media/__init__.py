"""Samples by content."""
