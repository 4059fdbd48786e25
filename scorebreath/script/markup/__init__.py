"""Markup in texts, inline tags and SSML: taken out before reading, so that what is left is only what is said."""
