"""A voice for tests: tones and noise by whole-number arithmetic, the same bytes on every machine."""
