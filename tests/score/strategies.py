"""Random valid Scores, for laws that hold for every Score."""

from __future__ import annotations

import collections.abc
import dataclasses
import typing
from typing import Any

from hypothesis import strategies as st

from scorebreath.score.document import (
    Body,
    Group,
    MediaInfo,
    Score,
)
from scorebreath.score.events import EVENTS, Event, Part, Unknown, Utterance
from scorebreath.score.values import Flag, Number, Whole, per_class
from scorebreath.units import snap

numbers = st.integers(-2_000_000_000, 2_000_000_000).map(lambda n: snap(n / 1_000_000))
positive = st.integers(0, 2_000_000_000).map(lambda n: snap(n / 1_000_000))
names = st.text(st.characters(codec="utf-8"), max_size=12)
json_values = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**53), 2**53) | names,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3),
    max_leaves=6,
)
extensions = st.dictionaries(names.map(lambda name: f"x_{name}"), json_values, max_size=2)
MEDIA = ["0" * 64, "f" * 64]


def of_type(hint: Any) -> st.SearchStrategy[Any]:
    """Values of a field's type."""
    if hint == Number:
        return numbers
    if hint == Whole:
        return st.integers(-(2**53), 2**53)
    if hint == Flag:
        return st.booleans()
    if hint is str:
        return names
    origin, args = typing.get_origin(hint), typing.get_args(hint)
    if origin is typing.Literal:
        return st.sampled_from(args)
    if origin is tuple and args[-1] is Ellipsis:
        return st.lists(of_type(args[0]), max_size=3).map(tuple)
    if origin is tuple:
        return st.tuples(*[of_type(arg) for arg in args])
    if isinstance(hint, type) and issubclass(hint, Part):
        return st.builds(hint, **fields_of(hint))
    if origin is collections.abc.Mapping:
        return st.dictionaries(names, numbers | st.booleans() | names, max_size=3)
    if type(None) in args:
        return st.none() | of_type(typing.Union[tuple(arg for arg in args if arg is not type(None))])  # noqa: UP007
    if hint is Event:
        return st.nothing()  # drawn apart, so that they fit their Score
    raise TypeError(hint)


@per_class
def fields_of(kind: Any) -> dict[str, st.SearchStrategy[Any]]:
    """A strategy for each field of a class of the Score."""
    hints = typing.get_type_hints(kind, include_extras=True)
    special: dict[str, st.SearchStrategy[Any]] = {"x": extensions}
    return {f.name: special[f.name] if f.name in special else of_type(hints[f.name]) for f in dataclasses.fields(kind)}


@per_class
def event_of(kind: Any) -> st.SearchStrategy[Event]:
    """Events of one type; id, group and body are put right afterwards."""
    strategies: dict[str, st.SearchStrategy[Any]] = {
        **fields_of(kind),
        "id": st.just("e"),
        "body": st.just("body"),
        "onset": positive,
        "duration": positive,
        "group": st.integers(0, 5).map(lambda n: f"g{n}"),
    }
    if kind is Unknown:
        strategies["kind"] = names.map(lambda name: f"x_{name}")
    if kind is Utterance:
        strategies["media"] = st.sampled_from(MEDIA)
    return st.builds(kind, **strategies)


events = st.one_of([event_of(kind) for kind, _ in EVENTS.values()] + [event_of(Unknown)])
bodies = st.builds(Body, **{**fields_of(Body), "id": st.just("body")})
groups = st.builds(Group, **{**fields_of(Group), "id": st.just("g"), "body": st.just("body")})
wholes: st.SearchStrategy[Score] = st.builds(
    Score,
    **{
        **fields_of(Score),
        "duration": positive,
        "bodies": bodies.map(lambda body: (body,)),
        "media": st.tuples(*[st.builds(MediaInfo, **fields_of(MediaInfo)) for _ in MEDIA]).map(
            lambda infos: dict(zip(MEDIA, infos, strict=True))
        ),
        "groups": st.lists(groups, max_size=3).map(
            lambda found: tuple(dataclasses.replace(group, id=f"g{n}") for n, group in enumerate(found))
        ),
        "events": st.just(()),
    },
)


@st.composite
def scores(draw: st.DrawFn) -> Score:
    """A valid Score."""
    score = draw(wholes)
    known = {group.id for group in score.groups}
    placed = [
        dataclasses.replace(event, id=f"e{n}", group=event.group if event.group in known else None)
        for n, event in enumerate(draw(st.lists(events, max_size=5)))
    ]
    return dataclasses.replace(score, events=tuple(placed))
