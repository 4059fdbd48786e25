"""What is typed on the rehearsal screen: a line is said; one that begins with a slash is a command, each a row."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from scorebreath.errors import InputError, did_you_mean, shortened
from scorebreath.live.desk import COMMANDS

if TYPE_CHECKING:
    from scorebreath.live.controls.midi_control import MidiControl
    from scorebreath.live.desk import Desk, Setting

SLASH = "/"
EVERYBODY = "*"
GLIDE = "glide"


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """A command that is no command of the desk's."""

    usage: str
    about: str
    do: Callable[[Typed, str], str]
    """takes what stands behind the name; what is to be shown"""
    complete: Callable[[Typed], Sequence[str]] = lambda _: ()
    """what may stand behind the name"""


class Typed:
    """Does what is typed.

    Args:
        desk: Of the performance.
        midi: For learning; None: there is no MIDI.
    """

    def __init__(self, desk: Desk, midi: Callable[[], MidiControl | None] = lambda: None) -> None:
        """Whoever began is spoken to."""
        self.desk, self.midi = desk, midi
        self.body = ""
        """whose lines and commands follow; empty: whoever began says what is typed, and commands are everybody's"""

    def do(self, line: str) -> str:
        """Do one line.

        Returns:
            What is to be shown, if anything.

        Raises:
            InputError: It is not understood, or refused.
        """
        if not line.strip():
            return ""
        if not line.startswith(SLASH) or line.startswith(2 * SLASH):
            self.desk.say(line.removeprefix(SLASH), body=self.body)
            return ""
        name, _, rest = line[1:].partition(" ")
        name, rest = name.strip().lower(), rest.strip()
        if name in ROWS and (rest or name not in COMMANDS):
            return ROWS[name].do(self, rest)
        if name not in COMMANDS:
            hint = did_you_mean(name, known()) or "; /help lists them"
            raise InputError(f"/{shortened(name, 30)}: there is no such command{hint}")
        if rest and rest not in self.desk.bodies:
            raise InputError(
                f"/{name} {shortened(rest, 30)}: expected a body ({', '.join(self.desk.bodies)}) or nothing"
            )
        self.desk.command(name, body=rest or self.body)
        return ""

    def completions(self, line: str) -> list[str]:
        """Lines that this one may become."""
        if not line.startswith(SLASH) or line.startswith(2 * SLASH):
            return []
        name, space, rest = line[1:].partition(" ")
        if not space:
            return [f"{SLASH}{each}" for each in known() if each.startswith(name)]
        words = ROWS[name].complete(self) if name in ROWS else self.desk.bodies if name in COMMANDS else ()
        return [f"{SLASH}{name} {word}" for word in words if word.startswith(rest.lstrip())]


def known() -> list[str]:
    """Names of all commands."""
    return sorted({*COMMANDS, *ROWS})


def describe() -> list[tuple[str, str]]:
    """Usage and meaning of every command, for `/help`."""
    own = [(row.usage, row.about) for row in ROWS.values()]
    acts = ((f"/{name}", row.about) for name, row in COMMANDS.items())
    return [*acts, *own, (f"{2 * SLASH}TEXT", "says a text that begins with a slash")]


def _cut(typed: Typed, rest: str) -> str:
    typed.desk.say(rest, body=typed.body, cut_in=True)
    return ""


def _set(typed: Typed, rest: str) -> str:
    from scorebreath.parameters.assign import parse_assignment

    if not rest:
        raise InputError("/set: expected NAME=VALUE, such as /set nose_share=0.4")
    assignment, glides, seconds = rest.partition(f" {GLIDE} ")
    if "=" not in assignment:  # as SuperCollider's people write it
        assignment = "=".join(assignment.split(maxsplit=1))
    name, value = parse_assignment(assignment)
    try:
        glide = float(seconds) if glides else None
    except ValueError:
        raise InputError(f"{GLIDE} {shortened(seconds, 30)}: expected seconds") from None
    typed.desk.set(name, value, body=typed.body, glide=glide)
    return ""


def _reset(typed: Typed, rest: str) -> str:
    typed.desk.set(rest.replace("-", "_"), None, body=typed.body)
    return ""


def _who(typed: Typed, rest: str) -> str:
    bodies = typed.desk.bodies
    if rest and rest != EVERYBODY and rest not in bodies:
        hint = did_you_mean(rest, bodies)
        raise InputError(
            f"/who {shortened(rest, 30)}: expected {', '.join(bodies)}, or {EVERYBODY} for everybody{hint}"
        )
    if rest:
        typed.body = "" if rest == EVERYBODY else rest
    return f"{', '.join(bodies)}; you speak to {typed.body or 'everybody'}"


def _learn(typed: Typed, rest: str) -> str:
    control = typed.midi()
    if control is None:
        raise InputError("/learn: there is no MIDI; begin with --midi PORT")
    name = rest.replace("-", "_")
    if name in COMMANDS:
        control.learn(command=name, body=typed.body)
        return f"press the key that is to {name}"
    control.learn(name, body=typed.body)
    return f"move the knob that is to move {name}"


def _map(typed: Typed, rest: str) -> str:
    from scorebreath.live.controls.mapping_file import dumps_mapping

    control = typed.midi()
    if control is None:
        raise InputError("/map: there is no MIDI; begin with --midi PORT")
    if not rest:
        raise InputError("/map: expected a name for a new file")
    try:
        with Path(rest).open("x", encoding="utf-8") as stream:
            stream.write(dumps_mapping(control.mapping))
    except FileExistsError:
        raise InputError(f"/map {rest}: is there already; expected a name for a new file") from None
    except (OSError, ValueError) as error:
        said = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise InputError(f"/map {rest}: cannot be written: {said}") from None
    return f"{rest}: the mapping as it is now; --midi-map {rest} has it again"


def _show(typed: Typed, rest: str) -> str:
    values = typed.desk.values(typed.body)
    name = rest.replace("-", "_")
    if not name:
        raise InputError("/show: expected the name of a parameter")
    if name not in values:
        raise InputError(f"/show {shortened(rest, 30)}: expected a parameter{did_you_mean(name, values)}")
    return f"{name} = {shown(values[name])}"


def _help(_: Typed, __: str) -> str:
    return ""


def shown(value: Setting) -> str:
    """A value, for people.

    >>> shown(0.5), shown(True), shown("female")
    ('0.5', 'on', 'female')
    """
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, float):
        from scorebreath.units import plain

        return plain(round(value, 4))
    return str(value)


def _assignments(typed: Typed) -> list[str]:
    return [f"{name}=" for name in typed.desk.values(typed.body)]


def _names(typed: Typed) -> list[str]:
    return list(typed.desk.values(typed.body))


def _learned(typed: Typed) -> list[str]:
    return [*typed.desk.values(typed.body), *COMMANDS]


ROWS: Mapping[str, Row] = MappingProxyType(
    {
        "cut": Row(usage="/cut TEXT", about="say TEXT now, in place of everything else", do=_cut),
        "set": Row(
            usage="/set NAME=VALUE [glide S]", about="move a parameter, within S seconds", do=_set,
            complete=_assignments,
        ),
        "reset": Row(usage="/reset [NAME]", about="one parameter, or all, as they began", do=_reset, complete=_names),
        "show": Row(usage="/show NAME", about="a parameter's value", do=_show, complete=_names),
        "who": Row(
            usage="/who [BODY|*]", about="who is there, and whom you speak to", do=_who,
            complete=lambda typed: [*typed.desk.bodies, EVERYBODY],
        ),
        "learn": Row(
            usage="/learn NAME", about="the next knob or key moves a parameter, or gives a command", do=_learn,
            complete=_learned,
        ),
        "map": Row(usage="/map FILE", about="write down what knobs and keys do now", do=_map),
        "help": Row(usage="/help", about="this list, page by page; Enter goes back", do=_help),
    }
)  # fmt: skip
"""Commands besides those of the desk; where a name is in both tables, this row takes it with something behind it."""
