"""Voices: what is asked of them, what they give, one folder or file each."""
