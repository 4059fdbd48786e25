"""A performance as it happens: performer, clock, controls (OSC, MIDI), streams of curves."""
