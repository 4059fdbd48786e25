"""Scores built by hand for the tests of curves, formats and report."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from hypothesis import strategies as st

from scorebreath.curves.curve_set import curves
from scorebreath.score.document import Body, CutReason, Group, MediaInfo, Person, Score, VoiceInfo
from scorebreath.score.events import (
    Event,
    Expiration,
    Hold,
    Inspiration,
    Lead,
    Level,
    Motion,
    Noise,
    Phone,
    Pitch,
    Profile,
    Trapezoid,
    Utterance,
    Word,
)
from scorebreath.units import snap

E = TypeVar("E", bound=Event)
REST = 0.38
REFERENCE_DB = -20.0
MEDIA = "0" * 64
MOTION = Motion(thorax=1.7, abdomen=1.4, shoulder=0.4, neck_pitch=3.0)
SAID = ("f", "u", "ŋ", "a", "p", "", "t", "iː", "l", "aʊ")
SENTENCE = "The quick brown fox jumps over the lazy dog, and then it rests."


@dataclass(frozen=True, kw_only=True)
class Breath:
    """One breath group, in seconds and fractions of VC."""

    before: float = 0.1
    """held before breathing in"""
    inspiration: float = 0.6
    after: float = 0.06
    """held before speaking"""
    speech: float = 2.5
    to_volume: float = 0.54
    end_volume: float = 0.36
    share: float = 0.65
    motion: Motion = MOTION
    profile: Profile = "linear"
    nose: float = 0.35
    mouth: float = 0.65
    opening: float = 0.3
    lead_mouth: float = 0.0
    lead_nostril: float = 0.0
    noise: bool = True
    text: str = SENTENCE


def build(breaths: Sequence[Breath], *, resting: float = REST, capacity: float = 5.0, tail: float = 0.5) -> Score:
    """Group after group, the first from rest and the last back to it, every moment of them covered by an event."""
    events: list[Event] = []
    groups: list[Group] = []
    now, volume, text = 0.0, resting, ""
    for index, breath in enumerate(breaths):
        last = index == len(breaths) - 1
        name = f"g{index + 1}"
        held = breaths[index - 1] if index else breath  # who holds the breath still moves as in the breath before
        group, placed = _group(breath, held, name, now, volume, resting if last else breath.end_volume, len(text))
        events += placed
        groups.append(group)
        now, volume = snap(placed[-1].end), breath.end_volume
        text += breath.text + " "
    return score_of(events, groups, text, snap(now + tail), resting, capacity)


def score_of(
    events: Sequence[Event],
    groups: Sequence[Group] = (),
    text: str = "",
    duration: float = 0.0,
    resting: float = REST,
    capacity: float = 5.0,
) -> Score:
    """A Score of one body around some events."""
    voice = VoiceInfo(
        engine="tone", voice="tone", version="1", licence="CC0-1.0", sample_rate=24000, reference_db=REFERENCE_DB
    )
    return Score(
        made_by="tests", seed=1, language="en", model="natural", text=text or " " * 10_000,
        duration=duration or max((snap(event.end) for event in events), default=0.0),
        bodies=(Body(id="body", voice=voice, person=Person(vital_capacity=capacity, resting_volume=resting)),),
        media={MEDIA: MediaInfo(path="speech.wav", frames=1, sample_rate=24000, kind="speech")},
        groups=tuple(groups), events=tuple(events),
    )  # fmt: skip


def inspiration(
    breath: Breath,
    onset: float,
    from_volume: float,
    *,
    id: str = "i",  # noqa: A002
    group: str | None = None,
) -> Inspiration:
    """The inspiration of a breath."""
    length = breath.inspiration
    attack, release = snap(0.25 * length), snap(0.3 * length)
    face = Trapezoid(attack=attack, hold=snap(length - attack - release), release=release)
    start, sound = snap(0.1 * length), snap(0.8 * length)
    noise = Noise(
        onset=start, duration=sound, attack=snap(0.2 * sound), hold=snap(sound - snap(0.2 * sound) - snap(0.3 * sound)),
        release=snap(0.3 * sound), level_db=-24.0, seed=7,
    )  # fmt: skip
    return Inspiration(
        id=id, body="body", onset=snap(onset), duration=length, group=group, from_volume=from_volume,
        to_volume=breath.to_volume, profile=breath.profile, thorax_share=breath.share, motion=breath.motion,
        sound_nose=breath.nose, sound_mouth=breath.mouth, nostril_flare=snap(breath.nose * breath.opening),
        mouth_open=snap(breath.mouth * breath.opening), face=face,
        lead=Lead(mouth=breath.lead_mouth, nostril=breath.lead_nostril), noise=noise if breath.noise else None,
    )  # fmt: skip


def utterance(breath: Breath, onset: float, place: int, *, id: str = "u", group: str | None = None) -> Utterance:  # noqa: A002
    """The speech of a breath: words of equal length, a level that rises and falls."""
    pieces = breath.text.split()
    edges = [snap(breath.speech * i / len(pieces)) for i in range(len(pieces) + 1)]
    words, at = [], 0
    for piece, start, end in zip(pieces, edges, edges[1:], strict=False):
        at = breath.text.index(piece, at)
        words.append(
            Word(
                text=piece.strip(".,"),
                onset=start,
                duration=snap(end - start),
                source=(place + at, place + at + len(piece)),
            )
        )
        at += len(piece)
    steps = max(1, int(breath.speech / 0.01))
    wave = np.sin(np.arange(steps) * 0.19) * 6 - 24 - np.cos(np.linspace(0, 2 * np.pi, steps)) * 4
    return Utterance(
        id=id, body="body", onset=snap(onset), duration=breath.speech, group=group, media=MEDIA, gain_db=0.0,
        closing="final", words=tuple(words), phones=phones(breath.speech),
        pitch=Pitch(step=0.01, hertz=()), level=Level(step=0.01, db=tuple(snap(x) for x in wave.tolist())),
    )  # fmt: skip


def phones(length: float, said: Sequence[str] = SAID) -> tuple[Phone, ...]:
    """Phones of equal length, every channel of the lips among them."""
    edges = [snap(length * i / len(said)) for i in range(len(said) + 1)]
    return tuple(
        Phone(ipa=ipa, onset=start, duration=snap(end - start))
        for ipa, start, end in zip(said, edges, edges[1:], strict=False)
    )


def without(score: Score, id: str) -> Score:  # noqa: A002
    """The Score less one event."""
    return dataclasses.replace(score, events=tuple(event for event in score.events if event.id != id))


def shifted(score: Score, by: float) -> Score:
    """All events later by some seconds, the Score as long as it was."""
    return dataclasses.replace(
        score, events=tuple(dataclasses.replace(event, onset=snap(event.onset + by)) for event in score.events)
    )


def value(score: Score, name: str, *times: float) -> list[float]:
    """A channel at some times."""
    return curves(score).sample(list(times), [name])[:, 0].tolist()  # type: ignore[no-any-return]


def _group(
    breath: Breath, held: Breath, name: str, now: float, volume: float, end_volume: float, place: int
) -> tuple[Group, list[Event]]:
    placed: list[Event] = []
    if breath.before:
        placed.append(_hold(held, f"{name}.before", name, now, breath.before, volume))
        now = snap(now + breath.before)
    placed.append(inspiration(breath, now, volume, id=f"{name}.in", group=name))
    now = snap(now + breath.inspiration)
    if breath.after:
        placed.append(_hold(breath, f"{name}.after", name, now, breath.after, breath.to_volume))
        now = snap(now + breath.after)
    placed.append(utterance(breath, now, place, id=f"{name}.say", group=name))
    placed.append(
        Expiration(
            id=f"{name}.out", body="body", onset=now, duration=breath.speech, group=name,
            from_volume=breath.to_volume, to_volume=end_volume, profile=breath.profile,
            thorax_share=breath.share, motion=breath.motion,
        )
    )  # fmt: skip
    group = Group(
        id=name, body="body", source=(place, place + len(breath.text)), text=breath.text, syllables=16,
        sentence_type="statement", cut=CutReason(site="sentence", rule="test"),
    )  # fmt: skip
    return group, placed


def _hold(breath: Breath, id: str, group: str, onset: float, duration: float, volume: float) -> Hold:  # noqa: A002
    return Hold(
        id=id, body="body", onset=onset, duration=duration, group=group, volume=volume, thorax_share=breath.share,
        motion=breath.motion,
    )  # fmt: skip


def on_grid(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers that a Score may hold."""
    return st.integers(round(low * 1e6), round(high * 1e6)).map(lambda n: n / 1e6)


def breaths(**fixed: object) -> st.SearchStrategy[Breath]:
    """Any breath whose numbers are on the grid; `fixed` fields are as given."""
    drawn: dict[str, st.SearchStrategy[object]] = {
        "before": st.sampled_from([0.0, 0.08]) | on_grid(0.01, 1.0),
        "inspiration": on_grid(0.05, 2.0),
        "after": st.sampled_from([0.0, 0.06]) | on_grid(0.01, 0.3),
        "speech": on_grid(0.1, 6.0),
        "to_volume": on_grid(0.4, 0.95),
        "end_volume": on_grid(0.2, 0.5),
        "share": on_grid(0.0, 1.0),
        "motion": st.builds(
            Motion, thorax=on_grid(0, 4), abdomen=on_grid(0, 4), shoulder=on_grid(0, 2), neck_pitch=on_grid(-10, 20)
        ),
        "profile": st.sampled_from(["linear", "sine"]),
        "nose": on_grid(0, 1),
        "mouth": on_grid(0, 1),
        "lead_mouth": st.just(0.0) | on_grid(0, 0.5),
        "lead_nostril": st.just(0.0) | on_grid(0, 0.5),
    }
    drawn |= {name: st.just(value) for name, value in fixed.items()}
    return st.builds(Breath, **drawn)


def scores(max_groups: int = 4, **fixed: object) -> st.SearchStrategy[Score]:
    """Any Score of `breaths`."""
    return st.lists(breaths(**fixed), min_size=1, max_size=max_groups).map(build)
