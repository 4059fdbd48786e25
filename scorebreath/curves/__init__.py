"""Lungs, chest, head, nostrils, mouth and levels as functions of time: closed forms of a Score's events."""
