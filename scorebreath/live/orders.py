"""What commands do, each a row: to the breath, to the flow of the text, to the whole performance."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from scorebreath.ensemble import Performer
from scorebreath.expression.emotion import wordless
from scorebreath.live.interrupting import interrupt, next_break
from scorebreath.live.moving import move
from scorebreath.script.marks import Act, ActName, EmotionMark, Mark
from scorebreath.units import snap

if TYPE_CHECKING:
    from scorebreath.live.performance import Performance

QUICK, SOFT = 0.03, 0.08
"""s in which speech fades: between two words, and within one."""
AT_ONCE = 0.005
"""s: as soon as an engine can be told."""
BREATH_LEFT = 0.04
"""Volume above rest, fraction of VC, from which on an interrupted body lets it go audibly."""

ACTS: Mapping[str, ActName] = MappingProxyType(
    {
        "breathe": "breath",
        "sigh": "sigh",
        "gasp": "gasp",
        "sniff": "sniff",
        "laugh": "laugh",
        "exhale": "exhale",
        "hold": "hold",
    }
)
"""Commands that are acts of the breath."""
Order = Callable[["Performance", Performer], None]


def act(performance: Performance, who: Performer, name: str) -> None:
    """A body does something with its breath now: between two words, if it speaks; then it speaks on."""
    mark = Act(at=0, written=f"{name} now", name=ACTS[name])
    between_words(performance, who, lambda: perform(performance, who, mark))


def without_words(performance: Performance, voice: str, marks: Sequence[Mark]) -> None:
    """What a text without a word asks of a body: acts, states, and emotions one after the other."""
    who = performance.company.ensemble.performers.get(voice)
    if who is None:
        performance.tell("a text without a word is for somebody who is not there, and is left out")
        return

    def do() -> None:
        perform(performance, who, *(mark for mark in marks if not isinstance(mark, EmotionMark)))
        felt = [mark for mark in marks if isinstance(mark, EmotionMark)]
        if felt and who.state.parameters.face_emotion:
            onset = snap(max(who.state.time, performance.now + performance.timing.ahead))
            shown = wordless(felt, body=who.state.body, onset=onset)
            who.keep_from(shown)
            performance.shown = max(performance.shown, *(snap(event.end) for event in shown))
            performance.decisions.decide(shown)

    between_words(performance, who, do)


def between_words(performance: Performance, who: Performer, do: Callable[[], None]) -> None:
    """A body does something now: between two words, if it speaks; then it speaks on."""
    performance.take_back()
    reaction = snap(performance.now + performance.timing.reaction)
    speaking = who is performance.speaker and performance.speaks
    at, place = reaction, None
    if speaking:
        at, place = next_break(performance.ledger.near(who.state.body), reaction)
    interrupt(performance, who, snap(at), fade=QUICK)
    performance.company.ensemble.clock = max(performance.line, who.state.time) if not speaking else who.state.time
    do()
    if place is not None:
        performance.plan_again(place)


def perform(performance: Performance, who: Performer, *marks: Mark) -> None:
    """Place acts where a body is."""
    performance.acts += 1
    name = next((mark.name for mark in marks if isinstance(mark, Act)), "act")
    who.go_on(performance.company.ensemble.breathing.act(who.state, marks, f"{name}{performance.acts}"))
    performance.occupied(who)
    made = performance.company.drain()
    performance.decisions.decide([replace(event, origin="performer") for event in made])


def pause(performance: Performance, _: Performer) -> None:
    """At the next breath nothing more is said."""
    performance.take_back()
    performance.paused = True


def go(performance: Performance, _: Performer) -> None:
    """On with the text."""
    performance.paused = False


def stop(performance: Performance, who: Performer) -> None:
    """Speech ends now, and what air there is too much goes out."""
    break_off(performance, who)
    if who.state.volume - who.state.person.resting_volume > BREATH_LEFT:
        perform(performance, who, Act(at=0, written="stopped", name="exhale"))
    performance.paused = False


def break_off(performance: Performance, who: Performer) -> None:
    """Speech ends now; nothing of the text is left."""
    clear(performance, who)
    speaker = performance.speaker
    for each in {id(one): one for one in (who, speaker)}.values():
        if each is who or (each is speaker and performance.speaks):
            interrupt(performance, each, snap(performance.now + performance.timing.reaction), fade=SOFT)
            performance.company.ensemble.clock = each.state.time
            performance.occupied(each)


def clear(performance: Performance, _: Performer) -> None:
    """Nothing of the text is left but what is being said."""
    performance.take_back()
    performance.floor = None
    performance.supply.forget(blend=performance.speaker.state.blend, time=performance.line)


def repeat(performance: Performance, _: Performer) -> None:
    """The last breath group once more, behind the one that is being said."""
    performance.take_back()
    if performance.last is None:
        performance.tell("repeat: nothing has been said yet")
        return
    performance.supply.repeat(performance.last.prepared)


def take(performance: Performance, who: Performer) -> None:
    """A body breathes in, to be seen and heard; whoever speaks yields at the next breath; its text comes first.

    So does a text that it is given only then, until it has spoken.
    """
    performance.take_back()
    voice = next(name for name, one in performance.company.ensemble.performers.items() if one is who)
    performance.floor = voice
    performance.plan_again(prefer=voice)
    if who is not performance.speaker or not performance.speaks:
        interrupt(performance, who, snap(performance.now + performance.timing.reaction), fade=QUICK)
        perform(performance, who, Act(at=0, written="takes the floor", name="breath"))


def panic(performance: Performance, who: Performer) -> None:
    """Silence at once, of everybody."""
    clear(performance, who)
    at = snap(max(0.0, performance.now + max(0.0, performance.timing.curve_lead) + AT_ONCE))
    performance.decisions.sounder.panic()
    for each in performance.company.performers:
        interrupt(performance, each, at, fade=AT_ONCE)
    performance.company.ensemble.clock = at
    for each in performance.company.performers:
        perform(performance, each, Act(at=0, written="panic", name="pause", seconds=performance.timing.reaction))
    performance.paused = False


def end(performance: Performance, _: Performer) -> None:
    """When all is said, all is over."""
    performance.ending = True
    performance.paused = False


def reset(performance: Performance, who: Performer) -> None:
    """Parameters as they were at the beginning."""
    begun, now = performance.begun_with[who.state.body], who.state.parameters.set_by_hand()
    changes = {name: begun.get(name) for name in {*begun, *now} if begun.get(name) != now.get(name)}
    if changes:
        move(performance, who, dict(sorted(changes.items())), None)


ORDERS: Mapping[str, Order] = MappingProxyType(
    {
        "pause": pause,
        "go": go,
        "stop": stop,
        "repeat": repeat,
        "clear": clear,
        "take": take,
        "reset": reset,
        "panic": panic,
        "end": end,
    }
)
"""Commands that are no acts."""
ALONE = frozenset({"pause", "go", "repeat", "clear", "panic", "end"})
"""Commands that mean everybody, whoever is named."""
