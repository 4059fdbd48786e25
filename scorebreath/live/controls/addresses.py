"""The table of OSC addresses: made from the tables of parameters and commands, and a few words of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from scorebreath.errors import InputError, did_you_mean, shortened
from scorebreath.live.controls.packets import LONGEST_ADDRESS
from scorebreath.live.desk import COMMANDS
from scorebreath.parameters.table import OSC_ROOT, Parameters, bounds, choices, osc_address
from scorebreath.units import plain

Kind = Literal["parameter", "command", "verb"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Verb:
    """A word of OSC's own."""

    arguments: str
    about: str
    bodies: bool = False
    """whether a body's id may stand before it"""


VERBS: Mapping[str, Verb] = MappingProxyType(
    {
        "say": Verb(arguments="text", about="say a text after what is still to be said", bodies=True),
        "cut": Verb(arguments="text", about="say a text at once, in place of what was to be said", bodies=True),
        "stream": Verb(arguments="piece", about="a piece of a text that goes on, cut anywhere", bodies=True),
        "stream/end": Verb(arguments="", about="the streamed text is complete", bodies=True),
        "reset": Verb(
            arguments="name", about="a parameter back to where it came from; all, without a name", bodies=True
        ),
        "values": Verb(arguments="", about="answers with the value in force of every parameter", bodies=True),
        "bodies": Verb(arguments="", about="answers with the ids of the bodies"),
        "listen": Verb(
            arguments="[port]", about="be told of every change, at once of all values; again within a minute"
        ),
        "unlisten": Verb(arguments="[port]", about="be told no more"),
        "ping": Verb(arguments="", about="answers with `/scorebreath/pong`"),
    }
)
"""Word: what it takes and does."""

ERROR = f"{OSC_ROOT}/error"
PONG = f"{OSC_ROOT}/pong"
BODIES = f"{OSC_ROOT}/bodies"
ANSWERS = (ERROR, PONG)
"""Addresses that only answers have: never answered, so that two servers cannot talk to each other for ever."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """What an address leads to."""

    kind: Kind
    name: str
    body: str = ""
    """empty: everybody"""


@dataclass(frozen=True, slots=True, kw_only=True)
class AddressRow:
    """A row of the table, as documents and other programs show it."""

    address: str
    place: Place
    arguments: str
    values: str
    """range, words, or nothing"""
    about: str


class NoAddressError(InputError):
    """An address leads nowhere."""


def resolve(address: str, bodies: Sequence[str]) -> Place:
    """What an address leads to, for these bodies.

    Raises:
        NoAddressError: There is nothing there.
        InputError: It is none of ours.

    >>> resolve("/scorebreath/body2/nose_share", ["body", "body2"])
    Place(kind='parameter', name='nose_share', body='body2')
    >>> resolve("/scorebreath/sigh", ["body"]).kind
    'command'
    """
    if not address.startswith(f"{OSC_ROOT}/"):
        raise InputError(f"{shortened(address, 40)}: every address begins with {OSC_ROOT}/")
    path = address.removeprefix(f"{OSC_ROOT}/")
    if place := _named(path):
        return place
    body, _, rest = path.partition("/")
    if body in bodies and (place := _named(rest)) and (place.kind != "verb" or VERBS[place.name].bodies):
        return Place(kind=place.kind, name=place.name, body=body)
    raise NoAddressError(f"{shortened(address, 80)}: there is no such address")


def hint(address: str, bodies: Sequence[str]) -> str:
    """A tail for an error message: what somebody may have meant by an address that leads nowhere, or nothing.

    >>> hint("/scorebreath/command/sihg", ["body"])
    '; did you mean sigh?'
    >>> hint("/scorebreath/bdoy/nose_share", ["body", "body2"])
    '; there are body, body2; did you mean body or body2?'
    """
    path = address[:LONGEST_ADDRESS].removeprefix(f"{OSC_ROOT}/")
    first, _, rest = path.partition("/")
    if first == "command":
        return did_you_mean(rest, COMMANDS)
    if _named(rest):
        known = first in bodies
        return "; it is for everybody" if known else f"; there are {', '.join(bodies)}{did_you_mean(first, bodies)}"
    return did_you_mean(rest if first in bodies else path, [row.place.name for row in table()])


def address_of(name: str, body: str = "") -> str:
    """Address of a parameter, of one body or of all."""
    return f"{OSC_ROOT}/{body}/{name}" if body else osc_address(name)


def table() -> tuple[AddressRow, ...]:
    """Every address without a body, parameters first."""
    rows = [_parameter(name) for name in Parameters.model_fields]
    for name, verb in VERBS.items():
        place = Place(kind="verb", name=name)
        rows.append(
            AddressRow(address=f"{OSC_ROOT}/{name}", place=place, arguments=verb.arguments, values="", about=verb.about)
        )
    for name, command in COMMANDS.items():
        place = Place(kind="command", name=name)
        rows.append(
            AddressRow(address=f"{OSC_ROOT}/command/{name}", place=place, arguments="", values="", about=command.about)
        )
    return tuple(rows)


def _parameter(name: str) -> AddressRow:
    field = Parameters.model_fields[name]
    limits = bounds(name)
    values = f"{plain(limits[0])} .. {plain(limits[1])}" if limits else ", ".join(choices(name)) or "0, 1"
    extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
    return AddressRow(
        address=osc_address(name),
        place=Place(kind="parameter", name=name),
        arguments="value [glide]",
        values=f"{values} {extra.get('unit', '')}".strip(),
        about=field.description or "",
    )


def _named(path: str) -> Place | None:
    if path in Parameters.model_fields:
        return Place(kind="parameter", name=path)
    if path in VERBS:
        return Place(kind="verb", name=path)
    name = path.removeprefix("command/")
    return Place(kind="command", name=name) if name in COMMANDS else None
