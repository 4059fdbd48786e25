"""Sounds as they happen: a running engine that is told of each a moment before."""
