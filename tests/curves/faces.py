"""Events of the face for tests: lids, brows, head, gaze, emotions, each with a usual shape."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

from hypothesis import strategies as st

from scorebreath.curves.curve_set import curves
from scorebreath.curves.rigs.rig import Rig
from scorebreath.curves.rigs.table import rig_named
from scorebreath.score.acting import EMOTIONS
from scorebreath.score.document import Score
from scorebreath.score.events import Blink, Brow, Emotion, Event, Gaze, Head, Utterance
from scorebreath.units import snap
from tests.curves.scores import Breath, build, on_grid, phones, score_of, utterance

FACE = ("blink", "brow", "head", "gaze", "emotion")


def blink(onset: float, **given: object) -> Blink:
    """75 ms down, 10 ms shut, 160 ms up, both eyes."""
    plain: dict[str, object] = {
        "id": f"blink{onset}", "body": "body", "onset": onset, "duration": 0.245, "left": 1.0, "right": 1.0,
        "close": 0.075, "hold": 0.01, "open": 0.16,
    }  # fmt: skip
    return Blink(**plain | given)  # type: ignore[arg-type]


def brow(onset: float, **given: object) -> Brow:
    """150 ms up, 150 ms there, 250 ms down."""
    plain: dict[str, object] = {
        "id": f"brow{onset}", "body": "body", "onset": onset, "duration": 0.55, "left": 0.4, "right": 0.3, "frown": 0.0,
        "apex": 0.15, "hold": 0.15,
    }  # fmt: skip
    return Brow(**plain | given)  # type: ignore[arg-type]


def head(onset: float, **given: object) -> Head:
    """0.3 s up, 0.2 s there, 0.3 s back; 3 degrees up."""
    plain: dict[str, object] = {
        "id": f"head{onset}", "body": "body", "onset": onset, "duration": 0.8, "pitch": 3.0, "yaw": 0.0, "roll": 0.0,
        "apex": 0.3, "hold": 0.2,
    }  # fmt: skip
    return Head(**plain | given)  # type: ignore[arg-type]


def gaze(onset: float, **given: object) -> Gaze:
    """A second, 10 degrees to the left, there in 45 ms."""
    plain: dict[str, object] = {
        "id": f"gaze{onset}", "body": "body", "onset": onset, "duration": 1.0, "target": "away", "yaw": 10.0,
        "pitch": 0.0, "move": 0.045,
    }  # fmt: skip
    return Gaze(**plain | given)  # type: ignore[arg-type]


def emotion(name: str, onset: float, **given: object) -> Emotion:
    """Two seconds, full after one."""
    plain: dict[str, object] = {
        "id": f"{name}{onset}", "body": "body", "onset": onset, "duration": 2.0, "name": name, "apex": 1.0,
        "intensity": 1.0,
    }  # fmt: skip
    return Emotion(**plain | given)  # type: ignore[arg-type]


def faced(*events: Event, score: Score | None = None) -> Score:
    """A Score with those events besides: of two plain breaths, unless told."""
    score = build([Breath(), Breath()]) if score is None else score
    last = max((snap(event.end) for event in events), default=0.0)
    return dataclasses.replace(score, events=(*score.events, *events), duration=max(score.duration, last))


def whole_face() -> Score:
    """A Score in which everything moves: every emotion, every part of the face, every way of the lips."""
    emotions = [emotion(name, snap(0.2 * number), intensity=0.8) for number, name in enumerate(EMOTIONS)]
    looks = (
        blink(0.4), brow(1.0, left=0.8, frown=0.0), brow(2.0, left=0.0, right=0.0, frown=0.7),
        head(0.5, pitch=4.0, yaw=6.0, roll=-3.0), gaze(0.3), gaze(1.3, yaw=-8.0, pitch=9.0, from_yaw=10.0),
        gaze(2.3, yaw=0.0, pitch=-9.0, from_yaw=-8.0, from_pitch=9.0),
    )  # fmt: skip
    return speaking(faced(*emotions, *looks))


def speaking(score: Score, said: Sequence[str] = ("p", "a", "f", "uː", "θ", "iː", "k", "ɔ", "m", "ʃ", "s")) -> Score:
    """The Score with those phones in each of its utterances, each as long as the others."""
    events = (
        dataclasses.replace(event, phones=phones(event.duration, said)) if isinstance(event, Utterance) else event
        for event in score.events
    )
    return dataclasses.replace(score, events=tuple(events))


def said_in(seconds: float, *said: str) -> Utterance:
    """An utterance of phones of equal length from time 0."""
    return dataclasses.replace(utterance(Breath(speech=seconds), 0.0, 0), phones=phones(seconds, said))


def shown(rig: str | Rig, score: Score, at: float, *, gate: bool = True) -> Mapping[str, float]:
    """A rig's columns at one moment."""
    found = rig_named(rig) if isinstance(rig, str) else rig
    values = found.sample(curves(score, closure_gate=gate), [at])[0].tolist()
    return dict(zip(found.columns, values, strict=True))


def only(*events: Event) -> Score:
    """A Score of ten seconds with those events and no others."""
    return score_of(events, duration=10.0)


@st.composite
def face_events(draw: st.DrawFn, until: float, most: int = 3) -> list[Event]:
    """Any events of a face that begin before `until`; gaze goes from target to target and ends straight ahead."""
    found: list[Event] = []
    for number in range(draw(st.integers(0, most))):
        onset, length = draw(on_grid(0, until)), draw(on_grid(0.2, 2.0))
        third = snap(length / 3)
        turned = {angle: draw(on_grid(-20, 20)) for angle in ("pitch", "yaw", "roll")}
        raised = {part: draw(on_grid(0, 1)) for part in ("left", "right", "frown")}
        sides = {side: draw(on_grid(0, 1)) for side in ("left", "right")}
        common = {"onset": onset, "duration": length}
        found += [
            blink(**common, id=f"b{number}", close=third, hold=third, open=snap(length - 2 * third), **sides),
            brow(**common, id=f"w{number}", apex=third, hold=third, **raised),
            head(**common, id=f"h{number}", apex=third, hold=third, **turned),
            emotion(draw(st.sampled_from(EMOTIONS)), id=f"m{number}", apex=third, **common),
        ]
    now, yaw, pitch = draw(on_grid(0, until)), 0.0, 0.0
    steps = draw(st.integers(0, most))
    for number in range(steps):
        last = number == steps - 1
        to = (0.0, 0.0) if last else (draw(on_grid(-20, 20)), draw(on_grid(-20, 20)))
        length = draw(on_grid(0.2, 1.0))
        found.append(
            gaze(
                now, id=f"g{number}", duration=length, move=draw(on_grid(0.05, 0.2)), from_yaw=yaw, from_pitch=pitch,
                yaw=to[0], pitch=to[1],
            )
        )  # fmt: skip
        now, (yaw, pitch) = snap(now + length), to
    return found
