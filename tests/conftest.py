"""Fixtures for all rooms: golden files, the checkout, Chromium."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent

CheckGolden = Callable[[str, bytes], None]


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout."""
    return ROOT


@pytest.fixture(scope="session")
def golden(request: pytest.FixtureRequest) -> CheckGolden:
    """Compare bytes with `tests/golden/NAME`; with --update-golden, write them there."""
    update = bool(request.config.getoption("--update-golden"))

    def check(name: str, made: bytes) -> None:
        path = ROOT / "tests" / "golden" / name
        if update:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(made)
        assert path.is_file(), f"{path} is missing; make it with pytest --update-golden"
        if path.read_bytes() != made:  # the default message would print both files
            pytest.fail(f"{name}: {_first_difference(path.read_bytes(), made)}; meant? then pytest --update-golden")

    return check


@pytest.fixture(scope="session")
def chromium() -> str:
    """Path of a Chromium; for tests marked `browser`."""
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if path := shutil.which(name):
            return path
    pytest.skip("no Chromium is installed")


def _first_difference(old: bytes, new: bytes) -> str:
    for number, (before, now) in enumerate(zip(old.splitlines(), new.splitlines(), strict=False), 1):
        if before != now:
            return f"line {number} was {before[:200]!r}, is {now[:200]!r}"
    return f"{len(old)} bytes became {len(new)}"
