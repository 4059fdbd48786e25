"""Breathing of every kind, for laws that hold whatever a body does: drawn in gasps, laughed, held, sighed."""

from __future__ import annotations

import dataclasses
from typing import Literal, get_args, get_type_hints

from hypothesis import strategies as st

from scorebreath.score.document import Score
from scorebreath.score.event import Profile
from scorebreath.score.events import Event, Expiration, Hold, Inspiration, Lead, Motion, Noise, Trapezoid
from scorebreath.units import snap
from tests.curves.faces import face_events
from tests.curves.scores import REST, on_grid, score_of

INSPIRATIONS: tuple[str, ...] = get_args(get_type_hints(Inspiration)["kind"])
EXPIRATIONS: tuple[str, ...] = get_args(get_type_hints(Expiration)["kind"])
PROFILES: tuple[Profile, ...] = get_args(Profile)
STEADY = Motion(thorax=1.7, abdomen=1.4, shoulder=0.4, neck_pitch=3.0)


def noise_of(length: float, envelope: Literal["trapezoid", "flow"] = "flow", hold: float = 0.2) -> Noise:
    """A noise that begins after a tenth of `length` and ends before it is over."""
    parts = snap(0.3 * length), snap(hold * length), snap((0.55 - hold) * length)
    return Noise(
        onset=snap(0.1 * length), duration=snap(sum(parts)), attack=parts[0], hold=parts[1], release=parts[2],
        level_db=-24.0, seed=7, envelope=envelope,
    )  # fmt: skip


def face_of(length: float) -> Trapezoid:
    """Half of it rises and falls."""
    return Trapezoid(attack=snap(0.2 * length), hold=snap(0.5 * length), release=snap(0.3 * length))


def breathe_in(**given: object) -> Inspiration:
    """0.38 to 0.58 of VC in 0.6 s, a sine."""
    length = given.get("duration", 0.6)
    assert isinstance(length, float)
    plain: dict[str, object] = {
        "id": "in", "body": "body", "onset": 0.0, "duration": length, "from_volume": REST, "to_volume": 0.58,
        "profile": "sine", "thorax_share": 0.65, "motion": STEADY, "sound_nose": 0.0, "sound_mouth": 1.0,
        "nostril_flare": 0.2, "mouth_open": 0.3, "face": face_of(length), "lead": Lead(),
    }  # fmt: skip
    return Inspiration(**plain | given)  # type: ignore[arg-type]


def breathe_out(**given: object) -> Expiration:
    """0.58 to 0.38 of VC in 2 s by recoil."""
    plain: dict[str, object] = {
        "id": "out", "body": "body", "onset": 0.0, "duration": 2.0, "from_volume": 0.58, "to_volume": REST,
        "profile": "exponential", "thorax_share": 0.65, "motion": STEADY,
    }  # fmt: skip
    return Expiration(**plain | given)  # type: ignore[arg-type]


def keep(**given: object) -> Hold:
    """Held at 0.58 of VC for 1 s."""
    plain: dict[str, object] = {
        "id": "hold", "body": "body", "onset": 0.0, "duration": 1.0, "kind": "held", "volume": 0.58,
        "thorax_share": 0.65, "motion": STEADY,
    }  # fmt: skip
    return Hold(**plain | given)  # type: ignore[arg-type]


_envelopes: st.SearchStrategy[Literal["trapezoid", "flow"]] = st.sampled_from(["trapezoid", "flow"])
_motions = st.builds(
    Motion, thorax=on_grid(0, 2), abdomen=on_grid(0, 2), shoulder=on_grid(0, 1), neck_pitch=on_grid(-5, 9),
    tremor=st.just(0.0) | on_grid(0, 0.3),
)  # fmt: skip


@dataclasses.dataclass(slots=True)
class _Body:
    """Where a body is while a performance is drawn."""

    time: float
    volume: float
    share: float
    motion: Motion

    def turn(self, draw: st.DrawFn) -> None:
        """What the volume moves becomes another."""
        self.share, self.motion = draw(on_grid(0, 1)), draw(_motions)

    def place(self, event: Event, volume: float) -> Event:
        self.time, self.volume = snap(event.end), volume
        return event


@st.composite
def performances(draw: st.DrawFn, most: int = 6) -> Score:
    """A Score in which a body breathes in every way there is, without a gap, and ends at its resting volume.

    Its face moves meanwhile.
    """
    body = _Body(0.0, REST, draw(on_grid(0, 1)), draw(_motions))
    events: list[Event] = []
    for number in range(draw(st.integers(1, most))):
        if draw(st.integers(0, 3)) == 0:
            body.turn(draw)
        make = draw(st.sampled_from((_draw_in, _draw_out, _draw_hold)))
        events.append(make(draw, body, f"e{number}"))
    if body.volume > REST:
        events.append(_draw_out(draw, body, "last", REST))
    elif body.volume < REST:
        events.append(_draw_in(draw, body, "last", REST))
    events += draw(face_events(body.time))
    return score_of(events, duration=snap(max(event.end for event in events) + 0.3))


def _draw_in(draw: st.DrawFn, body: _Body, name: str, to: float | None = None) -> Event:
    to = draw(on_grid(body.volume + 0.01, 0.95)) if to is None and body.volume < 0.9 else to
    if to is None:
        return _draw_out(draw, body, name)
    body.turn(draw)
    length, envelope = draw(on_grid(0.3, 2.5)), draw(_envelopes)
    event = breathe_in(
        id=name, onset=body.time, duration=length, kind=draw(st.sampled_from(INSPIRATIONS)), from_volume=body.volume,
        to_volume=to, profile=draw(st.sampled_from(PROFILES)), peak=draw(on_grid(0.2, 0.8)),
        saccades=draw(st.integers(1, 4)), thorax_share=body.share, motion=body.motion, sound_nose=draw(on_grid(0, 1)),
        sound_mouth=draw(on_grid(0, 1)), nostril_flare=draw(on_grid(0, 1)), mouth_open=draw(on_grid(0, 1)),
        lead=Lead(mouth=draw(on_grid(0, 0.5)), nostril=draw(on_grid(0, 0.5))),
        noise=noise_of(length, envelope) if draw(st.booleans()) else None,
    )  # fmt: skip
    return body.place(event, to)


def _draw_out(draw: st.DrawFn, body: _Body, name: str, to: float | None = None) -> Event:
    to = draw(on_grid(0.15, body.volume - 0.01)) if to is None and body.volume > 0.2 else to
    if to is None:
        return _draw_in(draw, body, name)
    length, envelope = draw(on_grid(0.5, 4.0)), draw(_envelopes)
    count = draw(st.integers(1, 8))
    gap = length / count
    puffs = tuple(snap(draw(on_grid(0, 0.3)) * gap + k * gap) for k in range(count)) if draw(st.booleans()) else ()
    event = breathe_out(
        id=name, onset=body.time, duration=length, kind="laugh" if puffs else draw(st.sampled_from(EXPIRATIONS)),
        from_volume=body.volume, to_volume=to, profile=draw(st.sampled_from(PROFILES)), peak=draw(on_grid(0.2, 0.8)),
        thorax_share=body.share, motion=body.motion, sound_nose=draw(on_grid(0, 1)), sound_mouth=draw(on_grid(0, 1)),
        nostril_flare=draw(on_grid(0, 1)), mouth_open=draw(on_grid(0, 1)), puffs=puffs,
        face=face_of(length) if draw(st.booleans()) else None,
        noise=noise_of(0.5 * gap if puffs else length, envelope) if draw(st.booleans()) else None,
    )  # fmt: skip
    return body.place(event, to)


def _draw_hold(draw: st.DrawFn, body: _Body, name: str) -> Event:
    length = draw(on_grid(0.05, 1.5))
    event = keep(
        id=name, onset=body.time, duration=length, kind=draw(st.sampled_from(["rest", "held"])), volume=body.volume,
        thorax_share=body.share, motion=body.motion, noise=noise_of(length) if draw(st.booleans()) else None,
    )  # fmt: skip
    return body.place(event, body.volume)
