"""`express(state, placed) -> (state, events)`: the face events around what compose has placed.

A face goes on from silence to group to silence. A group is decided when it is known what follows: the next group, or
`LOOK_AHEAD` of silence, or the end. A silence is decided as it goes on, up to where speech begins again, or up to
`LOOK_AHEAD` before what is known. So it makes no difference in which pieces a silence is placed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import MappingProxyType

from scorebreath.expression.actor import Actor
from scorebreath.expression.blinks import speech_blinks
from scorebreath.expression.brows import brows
from scorebreath.expression.coordination import beside_pauses, plan_pauses
from scorebreath.expression.emotion import emotion_events
from scorebreath.expression.gaze import speech_gaze
from scorebreath.expression.heads import SETTLE, heads
from scorebreath.expression.scene import Question, Scene, first_sound, last_sound, opening, questions, scene, speech
from scorebreath.expression.search import search_brows, searches
from scorebreath.expression.silence import LOOK_AHEAD, Bounds, behind, silence
from scorebreath.expression.state import FaceState, Placed
from scorebreath.score.events import Blink, Brow, Emotion, Event, Gaze, Head, Phrase
from scorebreath.script.marks import EmotionMark

UPBEAT = 0.5
"""s before speech in which brows and head may begin to move for its first accent."""
QUESTION = 2.0
"""s that brows and head stay raised behind a question, at most."""
SHOWN: tuple[tuple[type[Event], str], ...] = (
    (Blink, "face_blinks"), (Brow, "face_brows"), (Head, "face_head"), (Gaze, "face_gaze"),
)  # fmt: skip
"""Events that are seen, and the parameter that says whether (A60)."""


def express(
    state: FaceState, placed: Placed, *, over: float | None = None, hurry: bool = False
) -> tuple[FaceState, list[Event]]:
    """Decide what the face does, as far as it can be known: up to the group before the last one.

    Args:
        state: The face until now.
        placed: What compose has placed since.
        over: s; the time at which all is over: everything is decided up to there. None: more will come.
        hurry: Nobody knows what follows, and the last group is about to begin: decide it as if silence followed.

    Returns:
        The face afterwards, and its events; none lies before the `time` that `state` was decided up to, but for
        emotions, which begin with their phrase.
    """
    actor = Actor(state, over)
    felt: list[Event] = []
    actor.note(horizon=max([actor.memory.horizon, placed.until, *(event.end for event in placed.events)]))
    waiting = [*state.waiting, *([placed] if speech(placed) else [])]
    while True:
        if actor.memory.silent is not None:
            begins = first_sound(waiting[0]) if waiting else None
            silence(actor, _bounds(actor, actor.memory.silent, waiting[0] if waiting else None, over))
            if begins is None:
                break
            _forward(actor, max(actor.memory.silent, begins - UPBEAT))
            actor.note(silent=None, numbers=MappingProxyType({}), place=waiting[0].place, group=_group(waiting[0]))
        following = waiting[1] if len(waiting) > 1 else None
        known = following is not None or over is not None or hurry
        if not known and actor.memory.horizon < last_sound(waiting[0]) + LOOK_AHEAD:
            break
        seen = scene(waiting[0], state.language)
        felt += _emotions(actor, waiting[0], following, over)
        _speak(actor, seen, following, over)
        _forward(actor, seen.end)
        actor.note(silent=seen.end, entered=False, asked=_asks(seen), run_until=None)
        waiting.pop(0)
    if over is not None:
        _forward(actor, over)
    done = replace(actor.state, waiting=tuple(waiting), memory=actor.memory)
    return done, _shown(state, actor.events, felt)


def _bounds(actor: Actor, since: float, following: Placed | None, over: float | None) -> Bounds:
    """Of the silence before a group."""
    return Bounds(
        since=since, speech=first_sound(following) if following else None, over=over, horizon=actor.memory.horizon,
        opening=opening(following, actor.state.language) if following else (),
    )  # fmt: skip


def _forward(actor: Actor, time: float) -> None:
    actor.state = replace(actor.state, time=max(actor.state.time, time))


def _group(placed: Placed) -> str | None:
    return speech(placed)[0].group


def _asks(seen: Scene) -> bool:
    """Whether a group ends within a question, or with one."""
    return any(span.end >= seen.end - 0.05 for span in seen.asking)


def _speak(actor: Actor, seen: Scene, following: Placed | None, over: float | None) -> None:
    """All that happens while a group is spoken."""
    after = first_sound(following) if following else None
    held = [(question, _until(question, seen, after, over)) for question in seen.questions]
    pauses = plan_pauses(actor, seen)
    found = searches(actor, seen, pauses)
    later = questions(following) if following and after and after - seen.end < LOOK_AHEAD else ()
    brows(actor, seen, held, [question.onset for question in later])
    search_brows(actor, found)
    heads(actor, seen, held)
    glances = beside_pauses(seen, speech_gaze(actor, seen, pauses, found))
    plan = behind(actor, _bounds(actor, seen.end, following, over), asked=_asks(seen))
    speech_blinks(actor, seen, pauses, (*glances, *(plan.looks if plan else ())))


def _until(question: Question, seen: Scene, after: float | None, over: float | None) -> float:
    """When what a question raises comes back (Y6): when speech goes on, after `QUESTION`, or in time for the end."""
    if question.until is not None:
        return question.until
    until = seen.end + QUESTION if after is None else min(after, seen.end + QUESTION)
    return until if over is None else max(seen.end, min(until, over - 2.0 * SETTLE))


def _emotions(actor: Actor, placed: Placed, following: Placed | None, over: float | None) -> list[Event]:
    """Emotions of a group, unless they came with the one before; those behind it too, unless the next one is near."""
    own, behind = _parted(placed)
    felt: list[Emotion | Blink] = []
    if not actor.memory.felt:
        felt += _felt(actor, own, [placed], over)
    near = _near(placed, following)
    if following is not None and near:
        felt += _felt(actor, [*behind, *_parted(following)[0]], [placed, following], over)
    elif behind:
        last = _felt(actor, behind, [placed], over)
        felt += [replace(event, id=f"{event.id}.behind") for event in last]
    winks = [(event.onset, event.end) for event in felt if isinstance(event, Blink)]
    waiting = [wink for wink in actor.memory.winks if wink[1] > actor.state.time]
    actor.note(felt=near, winks=tuple(sorted([*waiting, *winks])))
    return list(felt)


def _near(placed: Placed, following: Placed | None) -> bool:
    """Whether speech goes on so soon that both groups are one to the face."""
    begins = first_sound(following) if following else None
    return begins is not None and begins - last_sound(placed) < LOOK_AHEAD


def _felt(
    actor: Actor, marks: Sequence[EmotionMark], said: Sequence[Placed], over: float | None
) -> list[Emotion | Blink]:  # fmt: skip
    utterances = [utterance for placed in said for utterance in speech(placed)]
    phrases = sorted((e for placed in said for e in placed.events if isinstance(e, Phrase)), key=lambda e: e.onset)
    return emotion_events(marks, phrases, utterances, body=actor.state.body, over=over) if marks else []


def _parted(placed: Placed) -> tuple[list[EmotionMark], list[EmotionMark]]:
    """Marks before and in a group, and those behind its last word."""
    last = max((w.source[0] for u in speech(placed) for w in u.words if w.source), default=-1)
    own = [mark for mark in placed.marks if mark.at <= last]
    return own, [mark for mark in placed.marks if mark.at > last]


def _shown(state: FaceState, events: Sequence[Event], felt: Sequence[Event]) -> list[Event]:
    """Without what is not to be seen (A60); everything else is as if it were. A wink is an emotion's."""
    hidden = tuple(kind for kind, name in SHOWN if not getattr(state.parameters, name))
    seen = [event for event in events if not isinstance(event, hidden)]
    return [*(felt if state.parameters.face_emotion else ()), *seen]
