"""Options, chance and skips that all tests share, the doctests of the packages among them."""

from __future__ import annotations

import os
import shutil

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

PROGRAMS = {"scsynth": ("scsynth",), "browser": ("chromium", "chromium-browser", "google-chrome")}
"""Marker: the programs of which one is needed."""

os.environ["SCOREBREATH_CACHE"] = "off"
"""Tests say themselves where a cache is: never the user's, and nothing goes from one test to the next."""

settings.register_profile("dev", deadline=None)
settings.register_profile(
    "ci", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow], print_blob=True
)
settings.load_profile("ci" if os.environ.get("CI") else "dev")

np.set_printoptions(precision=6, suppress=True, linewidth=120)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the only way to rewrite a golden file."""
    parser.addoption("--update-golden", action="store_true", help="rewrite tests/golden with what is made now")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip, with the reason, what this machine has no program for."""
    for marker, names in PROGRAMS.items():
        if any(shutil.which(name) for name in names):
            continue
        skip = pytest.mark.skip(reason=f"none of {', '.join(names)} is installed")
        for item in items:
            if item.get_closest_marker(marker):
                item.add_marker(skip)
