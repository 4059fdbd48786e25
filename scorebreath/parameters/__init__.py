"""Parameters: one typed table, presets, and the low level that Eq. 1 derives."""
