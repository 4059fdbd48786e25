"""Lids, eyes, brows, head and emotions: closed forms of the events of the face."""
