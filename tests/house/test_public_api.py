"""The names people import: there, in dependency order, and explained."""

from __future__ import annotations

import importlib
import inspect
import pkgutil

import pytest

import scorebreath

ORDER = (
    "errors", "units", "spans", "chance", "parameters", "equations", "signal", "media", "score", "script", "planning",
    "speech", "compose", "pipeline", "recorded", "curves", "engine", "formats", "report", "live",
)  # fmt: skip
"""Rooms, each after what it needs."""


def home(name: str) -> str:
    """Room in which a public name is defined."""
    value = getattr(scorebreath, name)
    return str(getattr(value, "__module__", "")).removeprefix("scorebreath").lstrip(".").partition(".")[0]


def test_there_are_public_names_and_none_twice() -> None:
    assert scorebreath.__all__
    assert len(set(scorebreath.__all__)) == len(scorebreath.__all__)


@pytest.mark.parametrize("name", scorebreath.__all__)
def test_a_public_name_is_there_and_explained(name: str) -> None:
    value = getattr(scorebreath, name)
    if inspect.isclass(value) or inspect.isroutine(value):
        assert inspect.getdoc(value), f"{name} has no docstring"


def test_public_names_stand_in_dependency_order() -> None:
    rooms = [ORDER.index(home(name)) for name in scorebreath.__all__ if home(name)]
    assert rooms == sorted(rooms)


def test_dir_shows_the_public_names() -> None:
    assert set(scorebreath.__all__) <= set(dir(scorebreath))


@pytest.mark.parametrize("package", [scorebreath.__name__, "scorebreath_cli", "scorebreath_synthdefs"])
def test_every_public_class_and_function_is_explained(package: str) -> None:
    """Also the methods and properties of classes; ruff cannot see what is made at run time."""
    top = importlib.import_module(package)
    bare = []
    for found in pkgutil.walk_packages(top.__path__, f"{package}."):
        if found.name.endswith("__main__"):
            continue
        module = importlib.import_module(found.name)
        for name, value in vars(module).items():
            ours = getattr(value, "__module__", "") == module.__name__ and not name.startswith("_")
            if ours and (inspect.isclass(value) or inspect.isfunction(value)) and not inspect.getdoc(value):
                bare.append(f"{module.__name__}.{name}")
    assert bare == []
