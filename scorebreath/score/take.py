"""Takes (`scorebreath.take/1`): a folder that grows while something is performed, and is a Score afterwards.

`take.jsonl` has a header line, then one line for each group and event as it happens, each handed to the system before
anything else happens, so what was performed survives the performer; once a second it is forced onto the disk, too. A
torn last line is dropped and said.
"""

from __future__ import annotations

import dataclasses
import json
import os
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from scorebreath.errors import EnvironmentFailure, ScoreError
from scorebreath.media.store import FolderStore
from scorebreath.score.codec import (
    check_schema,
    decode_event,
    dump_event,
    dumps,
    encode,
    loads,
    parse_json,
    read_whole,
)
from scorebreath.score.cutting import end_of, endings
from scorebreath.score.document import SCHEMA, Body, Group, MediaInfo, Score
from scorebreath.score.events import Event, WarningEvent

TAKE_SCHEMA = "scorebreath.take/1"
TAKE_FILE = "take.jsonl"
FORCED = 1.0
"""s after which what is written is forced onto the disk: a power cut may take so much."""


class TakeWriter:
    """Writes a take line by line; use it as a context manager.

    Args:
        folder: Where the take goes; must not hold one already.
        score: A Score without groups and events: everything known at the start.

    Raises:
        EnvironmentFailure: The folder holds a take, or the disk refuses.
    """

    def __init__(self, folder: Path, score: Score) -> None:
        """Write the header."""
        self.media = FolderStore(folder)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._stream = (folder / TAKE_FILE).open("xb")
        except OSError as error:
            raise EnvironmentFailure(f"{folder / TAKE_FILE}: cannot be written: {error.strerror}") from None
        self._forced = time.monotonic()
        header = json.loads(dumps(dataclasses.replace(score, groups=(), events=(), media={})))
        header["schema"] = TAKE_SCHEMA
        self._write(header)

    def text(self, piece: str) -> None:
        """More text arrived: it goes on where the text ended."""
        self._write({"text": piece})

    def body(self, body: Body) -> None:
        """Somebody joins."""
        self._write({"body": encode(body)})

    def group(self, group: Group) -> None:
        """A breath group was planned."""
        self._write({"group": encode(group)})

    def sound(self, name: str, info: MediaInfo) -> None:
        """Samples were put into the take's media."""
        self._write({"media": {name: dataclasses.asdict(info)}})

    def over(self, time: float | None) -> None:
        """All is over then, s; None: it was said, and is not so."""
        self._write({"duration": time})

    def event(self, event: Event) -> None:
        """Something happens."""
        self._line(dump_event(event))

    def events(self, events: Iterable[Event]) -> None:
        """Several things have been decided at once."""
        self._line("\n".join(dump_event(event) for event in events))

    def close(self) -> None:
        """Close the file."""
        if not self._stream.closed:
            with suppress(OSError):
                os.fsync(self._stream.fileno())
            self._stream.close()

    def __enter__(self) -> Self:
        """The writer."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, tb: TracebackType | None) -> None:
        """Close the file."""
        self.close()

    def _write(self, value: dict[str, Any]) -> None:
        self._line(json.dumps(value, sort_keys=True, ensure_ascii=False, separators=(",", ":"), allow_nan=False))

    def _line(self, line: str) -> None:
        try:
            self._stream.write(line.encode() + b"\n")
            self._stream.flush()
            if time.monotonic() - self._forced > FORCED:
                self._forced = time.monotonic()
                os.fsync(self._stream.fileno())
        except OSError as error:
            raise EnvironmentFailure(f"{self._stream.name}: cannot be written: {error.strerror}") from None


def read_take(folder: Path) -> Score:
    """The Score a take has become.

    A torn last line is dropped; a `warning` event with code `torn-take` says so.

    Raises:
        ScoreError: The take is missing, or a line other than the last is broken.
    """
    path = folder / TAKE_FILE
    lines = read_whole(path).split(b"\n")
    torn = lines.pop()  # what follows the last newline: nothing, unless the writer was cut off
    if not lines:
        raise ScoreError(f"{path}:1: a take begins with a header line")
    header = parse_json(lines[0], f"{path}:1")
    if not isinstance(header, dict):
        raise ScoreError(f"{path}:1: expected an object")
    check_schema(header.get("schema"), TAKE_SCHEMA, f"{path}:1")
    text, media = [str(header.get("text", ""))], {}
    groups: list[Any] = []
    bodies: list[Any] = list(header.get("bodies", ()))
    over: float | None = None
    events: list[Event] = []
    for number, line in enumerate(lines[1:], 2):
        item = parse_json(line, f"{path}:{number}")
        if not isinstance(item, dict):
            raise ScoreError(f"{path}:{number}: expected an object, found {type(item).__name__}")
        if "type" in item:
            events.append(decode_event(item, "event", f"{path}:{number}"))
        elif isinstance(item.get("text"), str):
            text.append(item["text"])
        elif isinstance(item.get("media"), dict):
            media.update(item["media"])
        elif "group" in item:
            groups.append(item["group"])
        elif "body" in item:
            bodies.append(item["body"])
        elif type(item.get("duration")) in (int, float) or item == {"duration": None}:
            over = None if item["duration"] is None else float(item["duration"])
        else:
            raise ScoreError(f"{path}:{number}: expected text, media, a body, a group, an event or the duration")
    plain = {**header, "schema": SCHEMA, "bodies": bodies, "text": "".join(text), "media": media, "groups": groups}
    plain["duration"] = lasting(events, float(header.get("duration", 0.0))) if over is None else over
    score = loads(json.dumps(plain).encode(), str(path))
    if torn:
        events.append(_torn(score, len(torn)))
    try:
        return dataclasses.replace(score, events=tuple(events))
    except ScoreError as error:  # of all events together, so of no line
        raise ScoreError(f"{path}: {error}") from None


def lasting(events: Iterable[Event], least: float = 0.0) -> float:
    """When the last of some events is over, s: cuts end them, or prevent them.

    Args:
        events: All of a performance.
        least: s.
    """
    events = tuple(events)
    ends = endings(events)
    happened = (event for event in events if event.id not in ends or not ends[event.id].prevents(event))
    return max([least, *(end_of(event, ends) for event in happened)])


def _torn(score: Score, size: int) -> WarningEvent:
    said = f"the last line was cut off ({size} bytes) and is dropped"
    return WarningEvent(
        id="torn-take", body=score.bodies[0].id, onset=score.duration, duration=0.0, rule="take",
        code="torn-take", text=said,
    )  # fmt: skip
