"""The SynthDefs of scorebreath, and their catalogue."""
