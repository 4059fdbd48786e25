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
from scorebreath.score.events import (
    EVENTS,
    Blink,
    Brow,
    Cut,
    Emotion,
    Event,
    Gaze,
    Head,
    Noise,
    Part,
    Unknown,
    Utterance,
)
from scorebreath.score.values import Flag, Number, Whole, limits_of, per_class
from scorebreath.units import GRID, snap


def numbers_in(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers on the grid."""
    return st.integers(round(low * GRID), round(min(high, 1e6) * GRID)).map(lambda n: snap(n / GRID))


numbers = numbers_in(-2000, 2000)
positive = numbers_in(0, 2000)
names = st.text(st.characters(codec="utf-8"), max_size=12)
json_values = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**53), 2**53) | names,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3),
    max_leaves=6,
)
extensions = st.dictionaries(names.map(lambda name: f"x_{name}"), json_values, max_size=2)
MEDIA = ["0" * 64, "f" * 64]


def of_type(hint: Any, low: float = -2000.0, high: float = 2000.0) -> st.SearchStrategy[Any]:
    """Values of a field's type within its limits."""
    if hint == Number:
        return numbers_in(low, high)
    if hint == Whole:
        return st.integers(int(low), int(high))
    if hint == tuple[Whole, Whole]:
        return st.just((0, 0))  # a range of every text
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
    if hint is Noise:
        return noises()
    if isinstance(hint, type) and issubclass(hint, Part):
        return st.builds(hint, **fields_of(hint))
    if origin is collections.abc.Mapping:
        return st.dictionaries(names, numbers | st.booleans() | names, max_size=3)
    if type(None) in args:
        some: Any = typing.Union[tuple(arg for arg in args if arg is not type(None))]  # noqa: UP007
        return st.none() | of_type(some, low, high)
    if hint is Event:
        return st.nothing()  # drawn apart, so that they fit their Score
    raise TypeError(hint)


@per_class
def fields_of(kind: Any) -> dict[str, st.SearchStrategy[Any]]:
    """A strategy for each field of a class of the Score."""
    hints = typing.get_type_hints(kind, include_extras=True)
    limits = limits_of(kind)
    found = {f.name: of_type(hints[f.name], *limits.get(f.name, ())) for f in dataclasses.fields(kind) if f.name != "x"}
    return {**found, "x": extensions} if "x" in hints else found


@st.composite
def noises(draw: st.DrawFn) -> Noise:
    """Noises whose ramps fill them."""
    values = {name: draw(strategy) for name, strategy in fields_of(Noise).items()}
    parts = [draw(numbers_in(0, 5)) for _ in range(3)]
    values.update(zip(("attack", "hold", "release"), parts, strict=True))
    return Noise(**{**values, "duration": snap(sum(parts))})


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
        return utterances(strategies)
    if kind is Blink:
        return st.builds(_blink, **{name: strategy for name, strategy in strategies.items() if name != "duration"})
    if kind in PARTS_WITHIN:
        return st.builds(_within, st.just(kind), **strategies)
    return st.builds(kind, **strategies)


PARTS_WITHIN: dict[type[Event], tuple[str, ...]] = {
    Emotion: ("apex",), Brow: ("apex", "hold"), Head: ("apex", "hold"), Gaze: ("move",)
}  # fmt: skip
"""Fields of a movement that must fit into its duration together."""


def _within(kind: type[Event], /, **values: Any) -> Event:
    parts = PARTS_WITHIN[kind]
    duration = snap(sum(min(values[name], 100.0) for name in parts) + values["duration"])
    return kind(**{**values, **{name: min(values[name], 100.0) for name in parts}, "duration": duration})


def _blink(**values: Any) -> Blink:
    phases = {name: min(values[name], 100.0) for name in ("close", "hold", "open")}
    return Blink(**{**values, **phases, "duration": snap(sum(phases.values()))})


@st.composite
def utterances(draw: st.DrawFn, strategies: dict[str, st.SearchStrategy[Any]]) -> Utterance:
    """Utterances whose phones are of their words."""
    values = {name: draw(strategy) for name, strategy in strategies.items()}
    count = len(values["words"])
    words = st.none() | st.integers(0, count - 1) if count else st.none()
    values["phones"] = tuple(dataclasses.replace(phone, word=draw(words)) for phone in values["phones"])
    return Utterance(**values)


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
    others = tuple(event.id for event in placed if not isinstance(event, Cut))
    cut = [
        dataclasses.replace(event, targets=others[: len(event.targets)]) if isinstance(event, Cut) else event
        for event in placed
    ]
    return dataclasses.replace(score, events=tuple(cut))
