"""Curves on their way out: OSC, VMC, Live Link Face, lines of JSON."""
