"""Written text as it is to be spoken: numbers, amounts, abbreviations, names; each with its way back to the source."""
