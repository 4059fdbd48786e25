"""Breath groups: one file a planner; every cut carries its reason."""
