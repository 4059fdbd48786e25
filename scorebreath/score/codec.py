"""Score to bytes and back: one canonical JSON form, so equal Scores are equal bytes.

Keys are sorted; optional fields that say nothing are left out; the top level, groups and events stand one a line.
What comes in is hostile until read: unknown fields, unknown versions, numbers off the grid, names used twice and
nesting without end are refused, each with its place.
"""

from __future__ import annotations

import dataclasses
import json
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from pydantic import TypeAdapter, ValidationError

from scorebreath.errors import ScoreError, shortened
from scorebreath.score.document import SCHEMA, Body, Group, Score
from scorebreath.score.events import EVENTS, Event, Unknown
from scorebreath.score.values import per_class

LARGEST_FILE = 1 << 30
"""Bytes of JSON accepted."""

Json = Any
E = TypeVar("E")


def dumps(score: Score) -> bytes:
    """The canonical bytes of a Score (UTF-8, newline at the end)."""
    plain = _fields(score)
    plain["schema"] = SCHEMA
    plain["groups"] = [encode(group) for group in score.groups]
    plain["events"] = [encode(event) for event in score.events]
    lines: list[str] = []
    for key in sorted(plain):
        value = plain[key]
        if key in ("groups", "events") and value:
            text = "[\n" + ",\n".join(_line(item) for item in value) + "\n]"
        else:
            text = _line(_plain(value))
        lines.append(f"{_line(key)}:{text}")
    return ("{\n" + ",\n".join(lines) + "\n}\n").encode()


def dump_event(event: Event) -> str:
    """One event as one line of JSON, without the newline: what a take is made of."""
    return _line(encode(event))


def loads(data: bytes, file: str = "") -> Score:
    """Read a Score.

    Args:
        data: JSON text, UTF-8.
        file: Its name, for messages.

    Returns:
        A Score for which `dumps` gives the canonical form of `data`.

    Raises:
        ScoreError: The data are no Score, a broken or newer one, or break one of its rules.
    """
    if len(data) > LARGEST_FILE:
        raise ScoreError(f"{_named(file)}holds {len(data)} bytes; a score has at most {LARGEST_FILE}")
    plain = parse_json(data, file)
    if not isinstance(plain, dict) or "schema" not in plain:
        raise ScoreError(f"{_named(file)}is not a score: expected a JSON object with a key 'schema'")
    check_schema(plain.pop("schema"), SCHEMA, file)
    events = plain.pop("events", [])
    if not isinstance(events, list):
        raise ScoreError(f"{_named(file)}events: expected a list")
    for part, kind in (("bodies", Body), ("groups", Group)):
        if isinstance(plain.get(part), list):
            plain[part] = [_validated(kind, item, f"{part}[{n}]", file) for n, item in enumerate(plain[part])]
    values = {key: value for key, value in plain.items() if not key.startswith("x_")}
    extras = {key: value for key, value in plain.items() if key.startswith("x_")}
    try:
        read = tuple(decode_event(item, f"events[{n}]", file) for n, item in enumerate(events))
        # Validated without its events, whose types the class knows only by their base.
        score: Score = _adapter(Score).validate_python({**values, "x": extras, "events": ()})
        return dataclasses.replace(score, events=read)
    except ValidationError as error:
        _refuse(error, "", file)
    except ScoreError as error:
        raise error if not file or file in str(error) else ScoreError(f"{file}: {error}") from None


def decode_event(item: Json, place: str = "event", file: str = "") -> Event:
    """An event from its JSON object.

    Raises:
        ScoreError: It breaks a rule; says which, at which field.
    """
    if not isinstance(item, dict):
        raise ScoreError(f"{_named(file)}{place}: expected an object, found {type(item).__name__}")
    kind = item.get("type")
    if isinstance(kind, str) and kind.startswith("x_"):
        known = {f.name for f in dataclasses.fields(Event)} - {"x"}
        rest = {key: value for key, value in item.items() if key not in known and key != "type"}
        base = {key: value for key, value in item.items() if key in known}
        return _checked(Unknown, {**base, "kind": kind, "x": rest}, place, file)
    if not isinstance(kind, str) or kind not in EVENTS:
        raise ScoreError(
            f"{_named(file)}{place}.type: {shortened(str(kind), 40)!r} is not one of {', '.join(EVENTS)}, or x_..."
        )
    return _validated(EVENTS[kind][0], {key: value for key, value in item.items() if key != "type"}, place, file)


def encode(item: Body | Group | Event) -> dict[str, Json]:
    """A body, a group or an event as a JSON object."""
    plain = _plain(item)
    if isinstance(item, Unknown):
        plain["type"] = plain.pop("kind")
    elif isinstance(item, Event):
        plain["type"] = item.type
    return plain  # type: ignore[no-any-return]


def json_schema() -> dict[str, Json]:
    """JSON Schema (2020-12) of a Score."""
    schema: dict[str, Json] = _adapter(Score).json_schema()
    definitions: dict[str, Json] = schema.setdefault("$defs", {})
    definitions.pop("Event", None)
    references: list[Json] = []
    for name, (kind, reach) in EVENTS.items():
        one = _adapter(kind).json_schema()
        definitions.update(one.pop("$defs", {}))
        one["properties"]["type"] = {"const": name}
        one["required"] = ["type", *one.get("required", [])]
        one["description"] = (
            f"{(kind.__doc__ or '').splitlines()[0]} Reach: {reach.lead} s before, {reach.lag} s after."
        )
        definitions[kind.__name__] = _open(one)
        references.append({"$ref": f"#/$defs/{kind.__name__}"})
    unknown = {"type": {"type": "string", "pattern": "^x_"}}
    required = ["type", "id", "body", "onset", "duration"]
    definitions["Unknown"] = {"type": "object", "properties": unknown, "required": required}
    schema["properties"]["events"] = {"type": "array", "items": {"anyOf": [*references, {"$ref": "#/$defs/Unknown"}]}}
    schema["properties"]["schema"] = {"const": SCHEMA}
    schema["required"] = ["schema", *schema["required"]]
    for name in (Body.__name__, Group.__name__):
        definitions[name] = _open(definitions[name])
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": SCHEMA, **_open(schema)}


_SURROGATE = re.compile(rb"\\u[dD][89a-fA-F]")


def parse_json(data: bytes, file: str = "") -> Json:
    """JSON from outside: UTF-8, no NaN or infinity, no key twice, bounded depth.

    Raises:
        ScoreError: With line and column.
    """

    def unique(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
        found = dict(pairs)
        if len(found) != len(pairs):
            keys = [key for key, _ in pairs]
            raise ScoreError(
                f"{_named(file)}key {shortened(next(k for k in keys if keys.count(k) > 1), 40)!r} stands twice"
            )
        return found

    def constant(name: str) -> NoReturn:
        raise ScoreError(f"{_named(file)}{name} is not a number a score can hold")

    try:
        found: Json = json.loads(data.decode("utf-8"), object_pairs_hook=unique, parse_constant=constant)
        if _SURROGATE.search(data):  # halves that meet are a character; one alone is no text
            json.dumps(found, ensure_ascii=False).encode()
        return found
    except UnicodeEncodeError:
        raise ScoreError(f"{_named(file)}half of a surrogate pair, which is no text") from None
    except UnicodeDecodeError as error:
        raise ScoreError(f"{_named(file)}byte {error.start}: not UTF-8") from None
    except json.JSONDecodeError as error:
        place = f"{file or '<score>'}:{error.lineno}:{error.colno}"
        raise ScoreError(f"{place}: broken JSON: {error.msg}") from None
    except RecursionError:
        raise ScoreError(f"{_named(file)}nested too deeply") from None
    except ValueError:  # Python's own limit
        raise ScoreError(f"{_named(file)}a number of thousands of digits; expected at most 17") from None


def read_whole(path: Path) -> bytes:
    """A file's bytes, at most one more than is accepted: a device or a pipe may never end.

    Raises:
        ScoreError: It cannot be read, or is too large.
    """
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise ScoreError(f"{path}: cannot be read: {error.strerror}") from None
    if len(data) > LARGEST_FILE:
        raise ScoreError(f"{path}: larger than any score ({LARGEST_FILE} bytes)")
    return data


def check_schema(found: Json, wanted: str, file: str = "") -> None:
    """Refuse another schema, or a newer version of ours, naming the version needed."""
    if found == wanted:
        return
    name = wanted.rpartition("/")[0]
    if isinstance(found, str) and found.rpartition("/")[0] == name:
        version = shortened(found.rpartition("/")[2], 20)
        raise ScoreError(f"{_named(file)}needs a scorebreath that reads {name}/{version}; this one reads {wanted}")
    raise ScoreError(f"{_named(file)}schema {shortened(str(found), 60)!r}: expected {wanted!r}")


def _checked(kind: type[E], values: Mapping[str, Json], place: str, file: str) -> E:
    try:
        return _adapter(kind).validate_python(values)  # type: ignore[no-any-return]
    except ValidationError as error:
        _refuse(error, place, file)
    except ScoreError as error:
        raise ScoreError(f"{_named(file)}{place}: {error}") from None


def _validated(kind: type[E], item: Json, place: str, file: str) -> E:
    """An object of `kind`, its unknown `x_` fields kept in `x`."""
    if not isinstance(item, dict):
        raise ScoreError(f"{_named(file)}{place}: expected an object, found {type(item).__name__}")
    extras = {key: value for key, value in item.items() if key.startswith("x_")}
    values = {key: value for key, value in item.items() if not key.startswith("x_")}
    if "x" in values:
        raise ScoreError(f"{_named(file)}{place}.x: unknown field (fields of your own begin with 'x_')")
    return _checked(kind, {**values, "x": extras}, place, file)


def _refuse(error: ValidationError, place: str, file: str) -> NoReturn:
    first = error.errors()[0]
    path = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in first["loc"])
    message = str(first["msg"]).removeprefix("Value error, ")
    given = first.get("input")
    found = f", found {shortened(str(given), 60)!r}" if isinstance(given, (str, int, float, bool)) else ""
    raise ScoreError(f"{_named(file)}{(place + path).lstrip('.')}: {message}{found}") from None


def _named(file: str) -> str:
    return f"{file}: " if file else ""


@per_class
def _adapter(kind: Any) -> TypeAdapter[Any]:
    return TypeAdapter(kind)


def _line(value: Json) -> str:
    return _encoder(value)


_encoder: Callable[[Json], str] = json.JSONEncoder(
    sort_keys=True, ensure_ascii=False, separators=(",", ":"), allow_nan=False
).encode


def _plain(value: Json) -> Json:
    """Dataclasses to dictionaries, tuples to lists; what says nothing is left out."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {key: _plain(part) for key, part in _fields(value).items()}
    if isinstance(value, Mapping):
        return {key: _plain(part) for key, part in value.items()}
    if isinstance(value, tuple):
        if value and isinstance(value[0], (int, float, str)):
            return value
        return [_plain(part) for part in value]
    return value


def _fields(item: Any) -> dict[str, Json]:
    kept: dict[str, Json] = {}
    for name, default in _defaults(type(item)):
        value = getattr(item, name)
        if name == "x":
            kept.update(value)
        elif value is None or value == default:
            continue
        else:
            kept[name] = value
    return kept


_REQUIRED = object()


@per_class
def _defaults(kind: Any) -> tuple[tuple[str, Json], ...]:
    """Field names with the value that says nothing: a default, or an empty collection's."""
    found: list[tuple[str, Json]] = []
    for field in dataclasses.fields(kind):
        if field.default is not dataclasses.MISSING:
            found.append((field.name, field.default))
        elif field.default_factory is not dataclasses.MISSING:
            found.append((field.name, field.default_factory()))
        else:
            found.append((field.name, _REQUIRED))
    return tuple(found)


def _open(schema: dict[str, Json]) -> dict[str, Json]:
    """The schema of an object that takes `x_` fields."""
    schema.get("properties", {}).pop("x", None)
    return {**schema, "patternProperties": {"^x_": {}}, "additionalProperties": False}
