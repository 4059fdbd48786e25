"""Hands on a performance: OSC and MIDI, turned into what a desk understands."""
