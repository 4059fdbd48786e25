"""Curves: channels as closed forms of events."""
