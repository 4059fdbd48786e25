"""Lips, jaw and tongue while speaking: Cohen and Massaro's dominance functions (A13)."""
