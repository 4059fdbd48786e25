"""The natural model under any person, state and markup: what its lungs, sounds and times never do."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import log10, pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scorebreath.compose.acts import ACTS
from scorebreath.compose.lungs import Levels, initiation
from scorebreath.compose.models import breathing_model
from scorebreath.compose.state import BodyState
from scorebreath.equations.breath import mix_level
from scorebreath.parameters.state_table import STATES
from scorebreath.parameters.table import Parameters
from scorebreath.score.document import Site
from scorebreath.score.events import (
    Event,
    Expiration,
    Hold,
    Inspiration,
    Marker,
    Pause,
    State,
    Utterance,
    WarningEvent,
)
from scorebreath.script.marks import Act, ActName, BreathingMark, Mark, NamedMark, StateMark

from .bodies import perform

Said = list[tuple[str, int, float, Site]]
Breath = Inspiration | Expiration | Hold
sites: st.SearchStrategy[Site] = st.sampled_from(["sentence", "paragraph", "comma", "clause", "word", "tag"])
syllables = st.integers(1, 44)
said: st.SearchStrategy[Said] = st.lists(
    st.tuples(st.text("ab ", min_size=1, max_size=4), syllables, st.just(0.0), sites).map(
        lambda row: (row[0], row[1], row[1] / 5.0, row[3])
    ),
    min_size=1,
    max_size=5,
)
people = st.builds(
    Parameters,
    sex=st.sampled_from(["male", "female"]),
    age=st.sampled_from([6.0, 10.0, 30.0, 80.0]),
    height=st.sampled_from([110.0, 165.0, 200.0]),
    posture=st.sampled_from(["upright", "supine", "reclined"]),
    condition=st.sampled_from(["none", "parkinson", "copd"]),
    speaking_loudness=st.sampled_from([40.0, 100.0, 250.0]),
    capacity_lung=st.sampled_from([50.0, 100.0, 150.0]),
)
acts: st.SearchStrategy[Mark] = st.builds(
    Act,
    at=st.just(0),
    written=st.just("[act]"),
    name=st.sampled_from(sorted(ACTS)),
    seconds=st.sampled_from([None, 0.3, 4.0]),
    level_db=st.sampled_from([0.0, -6.0, 6.0]),
    length=st.sampled_from([0.5, 1.0, 2.0]),
)
feelings: st.SearchStrategy[Mark] = st.builds(
    StateMark,
    at=st.just(0),
    written=st.just("[state]"),
    name=st.sampled_from(sorted(STATES)),
    intensity=st.floats(0.0, 1.0),
    ramp=st.sampled_from([0.0, 3.0]),
)
marks = st.dictionaries(st.integers(0, 5), st.lists(acts | feelings, max_size=3).map(tuple), max_size=3)


def breaths(events: Sequence[Event]) -> list[Breath]:
    return sorted((e for e in events if isinstance(e, (Inspiration, Expiration, Hold))), key=lambda e: (e.onset, e.end))


def ends(event: Breath) -> tuple[float, float]:
    return (event.volume, event.volume) if isinstance(event, Hold) else (event.from_volume, event.to_volume)


@settings(max_examples=60)
@given(said, people, marks, st.integers(0, 3))
def test_lungs_stay_within_their_limits_whatever_happens(
    groups: Said, p: Parameters, asked: dict[int, tuple[Mark, ...]], seed: int
) -> None:
    events, state = perform("natural", groups, p, seed, asked)
    level, time, litres = state.person.resting_volume, 0.5, state.person.vital_capacity
    for event in breaths(events):
        before, after = ends(event)
        assert event.onset == pytest.approx(time, abs=2e-5)
        assert before == pytest.approx(level)
        assert 0.15 <= after <= 0.95  # physiology 10
        if isinstance(event, Inspiration):
            assert after >= before
            assert (after - before) * litres * pi / 2 / event.duration <= 8.0  # L/s
        elif isinstance(event, Expiration):
            assert after <= before
        level, time = after, event.end
    assert level == pytest.approx(state.person.resting_volume)
    assert time == pytest.approx(state.time, abs=2e-5)
    assert len({event.id for event in events}) == len(events)


@settings(max_examples=60)
@given(said, people, marks)
def test_every_sound_lies_within_its_breath_and_is_never_louder_than_speech(
    groups: Said, p: Parameters, asked: dict[int, tuple[Mark, ...]]
) -> None:
    for event in breaths(perform("natural", groups, p, 0, asked)[0]):
        noise = event.noise
        if noise is None:
            continue
        assert noise.onset + noise.duration <= event.duration + 2e-6
        assert noise.attack + noise.hold + noise.release == pytest.approx(noise.duration, abs=5e-6)
        if not isinstance(event, Hold):
            assert noise.level_db + mix_level(event.sound_mouth, event.sound_nose) <= -6.0 + 1e-5  # physiology 3.2
            assert event.sound_mouth + event.sound_nose > 0


@settings(max_examples=30)
@given(said, marks)
def test_sound_and_motion_off_leave_every_time_of_acts_too(groups: Said, asked: dict[int, tuple[Mark, ...]]) -> None:
    times = [(e.id, e.onset, e.duration) for e in perform("natural", groups, marks=asked)[0]]
    silent = perform("natural", groups, Parameters(breath_sound=False), marks=asked)[0]
    still = perform("natural", groups, Parameters(breath_motion=False), marks=asked)[0]
    assert [(e.id, e.onset, e.duration) for e in silent] == times
    assert [(e.id, e.onset, e.duration) for e in still] == times
    assert all(e.noise is None for e in breaths(silent))
    for event in breaths(still):
        assert event.motion.thorax == event.motion.neck_pitch == event.motion.tremor == 0.0
        if not isinstance(event, Hold):
            assert event.mouth_open == event.nostril_flare == 0.0


def resting(p: Parameters, seconds: float, seed: int = 0) -> list[Event]:
    breathing = breathing_model("natural")
    person = breathing.person(p)
    state = BodyState(body="b", seed=seed, parameters=p, person=person, time=0.0, volume=person.resting_volume)
    after, events = breathing.rest(state, seconds, "rest")
    assert after.time == pytest.approx(seconds, abs=1e-5)
    assert after.volume == person.resting_volume  # a clean handover
    return events


def test_at_rest_it_breathes_as_people_do() -> None:
    # physiology 1.6: 15 a minute, Ti/Ttot 0.35-0.45, half a litre, expiration longer than inspiration
    events = resting(Parameters(), 600.0)
    inward = [e for e in events if isinstance(e, Inspiration)]
    outward = [e for e in events if isinstance(e, Expiration)]
    assert 140 <= len(inward) <= 160
    cycles = [b.onset - a.onset for a, b in pairwise(inward)]
    mean = sum(cycles) / len(cycles)
    spread = (sum((c - mean) ** 2 for c in cycles) / len(cycles)) ** 0.5
    assert 0.10 <= spread / mean <= 0.20
    shares = [e.duration / cycle for e, cycle in zip(inward, cycles, strict=False)]
    assert 0.35 <= sum(shares) / len(shares) <= 0.45
    litres = [(e.to_volume - e.from_volume) * 5.1 for e in inward]
    assert 0.45 <= sum(litres) / len(litres) <= 0.55
    assert {e.kind for e in inward} == {e.kind for e in outward} == {"tidal"}
    assert {e.profile for e in outward} == {"exponential"}


def test_a_short_wait_is_no_breath_and_a_long_pause_is_one() -> None:
    assert not [e for e in resting(Parameters(), 1.0) if isinstance(e, (Inspiration, Expiration))]
    pause = Act(at=0, written="[pause 9]", name="pause", seconds=9.0)
    groups: Said = [("a", 10, 2.0, "sentence"), ("b", 10, 2.0, "sentence")]
    events, _ = perform("natural", groups, Parameters(initiation_spread=0.0), marks={1: (pause,)})
    between = [e for e in events if isinstance(e, Inspiration) and e.kind == "tidal" and e.group]
    assert len(between) == 2
    assert next(e for e in events if isinstance(e, Pause) and e.kind == "asked").duration == 9.0


def test_a_breath_is_as_deep_as_what_is_to_be_said_and_makes_up_for_the_last_one() -> None:
    level = Levels(rest=0.38, termination=0.36, reserve=0.25, floor=0.20)
    assert initiation(level, 0.36, 0.30, 0.3, 0.0) > initiation(level, 0.36, 0.10, 0.3, 0.0)
    assert initiation(level, 0.25, 0.16, 0.3, 0.0) == pytest.approx(0.36 + 0.16 + 0.3 * 0.11)  # recovery
    assert initiation(level, 0.30, 0.16, 0.0, -0.2) == pytest.approx(0.25 + 0.16)  # never into the reserve
    assert initiation(level, 0.50, 0.01, 0.0, 0.0) == pytest.approx(0.565)  # at least a small breath


def test_a_recovery_breath_after_a_long_group_is_deeper() -> None:
    still = Parameters(initiation_spread=0.0, breath_variability=0.0, inspiration_spread=0.0)

    def second(first: int) -> Inspiration:
        groups: Said = [("a", first, first / 5, "comma"), ("b", 18, 3.6, "sentence")]
        events, _ = perform("natural", groups, still.with_values({"volume_per_syllable": 0.012}))
        return [e for e in events if isinstance(e, Inspiration) and e.kind == "speech"][1]

    usual, after_long = second(18), second(54)
    assert after_long.to_volume > usual.to_volume + 0.01
    assert after_long.duration > usual.duration


def test_a_group_that_exceeds_the_lungs_is_warned_of() -> None:
    events, state = perform("natural", [("a long one", 44, 9.0, "sentence")], Parameters(capacity_lung=40.0))
    warning = next(e for e in events if isinstance(e, WarningEvent))
    assert warning.code == "lung-budget"
    assert "44 syllables" in warning.text
    assert min(e.to_volume for e in events if isinstance(e, Expiration)) >= 0.15
    fits, _ = perform("natural", [("a short one", 10, 2.0, "sentence")], Parameters(capacity_lung=40.0))
    assert not [e for e in fits if isinstance(e, WarningEvent)]
    assert state.volume == state.person.resting_volume


def test_level_and_brightness_follow_the_flow() -> None:
    still = Parameters(initiation_spread=0.0, breath_variability=0.0, inspiration_spread=0.0, recovery_share=0.0)
    groups: Said = [("a", 2, 1.0, "comma"), *[(str(n), n, n / 5, "comma") for n in (8, 12, 18, 24, 32)]]
    events, _ = perform("natural", groups, still)
    rows = [
        ((e.to_volume - e.from_volume) / e.duration, e.noise.level_db, e.noise.brightness)
        for e in events
        if isinstance(e, Inspiration) and e.kind == "speech" and e.noise
    ][1:]
    flow0, level0, _ = rows[0]
    for flow, level, _ in rows:
        assert level - level0 == pytest.approx(33.2 * log10(flow / flow0), abs=0.01)  # 20 * 1.66
    ordered = sorted(rows)
    assert [row[2] for row in ordered] == sorted(row[2] for row in rows)
    assert ordered[-1][2] > ordered[0][2]


KINDS: dict[ActName, tuple[tuple[type[Event], str], ...]] = {
    "breath": ((Inspiration, "speech"), (Expiration, "tidal")),
    "sigh": ((Inspiration, "sigh"), (Expiration, "sigh")),
    "gasp": ((Inspiration, "gasp"), (Hold, "held"), (Expiration, "tidal")),
    "sniff": ((Inspiration, "sniff"),),
    "laugh": ((Expiration, "laugh"),),
    "exhale": ((Expiration, "audible"),),
    "hold": ((Hold, "held"),),
    "pause": ((Pause, "asked"),),
}


def test_every_act_has_a_row() -> None:
    assert set(KINDS) == set(ACTS)


@pytest.mark.parametrize("model", ["natural", "bernardet-2017"])
@pytest.mark.parametrize("name", sorted(KINDS))
def test_each_act_after_the_last_word_is_placed_and_heard(name: ActName, model: str) -> None:
    mark = Act(at=1, written=f"[{name}]", name=name)
    events, state = perform(model, [("a", 10, 2.0, "text end")], marks={1: (mark,)})
    asked = [e for e in events if e.origin == "markup"]
    for kind, what in KINDS[name]:
        assert any(isinstance(e, kind) and getattr(e, "kind", what) == what for e in asked), (kind, what)
    assert all(f"[{name}]" in e.rule for e in asked)
    speech = next(e for e in events if isinstance(e, Utterance))
    assert all(e.onset >= speech.end - 1e-5 for e in asked)
    if name != "pause":
        assert any(e.noise for e in breaths(asked))
    assert state.volume == pytest.approx(state.person.resting_volume)


def test_a_breath_asked_for_is_the_groups_own() -> None:
    breath = Act(at=0, written="[breath]", name="breath", level_db=6.0, length=1.5)
    groups: Said = [("a", 10, 2.0, "sentence"), ("b", 10, 2.0, "sentence")]
    plain = [e for e in perform("natural", groups)[0] if isinstance(e, Inspiration)]
    asked = [e for e in perform("natural", groups, marks={1: (breath,)})[0] if isinstance(e, Inspiration)]
    assert len(asked) == len(plain)
    assert asked[1].origin == "markup"
    assert asked[1].duration > plain[1].duration
    gasp = Act(at=0, written="[gasp]", name="gasp")
    kinds = [e.kind for e in perform("natural", groups, marks={1: (gasp,)})[0] if isinstance(e, Inspiration)]
    assert kinds[:2] == ["speech", "gasp"]


def test_names_stand_where_speech_begins_and_states_are_told() -> None:
    groups: Said = [("a", 10, 2.0, "sentence"), ("b", 10, 2.0, "sentence")]
    before: tuple[Mark, ...] = (
        StateMark(at=0, written="[state anxious 0.8 over 2]", name="anxious", intensity=0.8, ramp=2.0),
        NamedMark(at=0, written="[mark here]", name="here"),
    )
    events, after = perform("natural", groups, marks={1: before})
    state = next(e for e in events if isinstance(e, State))
    assert (state.name, state.start, state.target, state.ramp, state.origin) == ("anxious", 0.0, 0.8, 2.0, "markup")
    marker = next(e for e in events if isinstance(e, Marker))
    speech = [e for e in events if isinstance(e, Utterance)][1]
    assert marker.onset == pytest.approx(speech.onset, abs=2e-6)
    assert after.blend.at(after.time) == {"anxious": pytest.approx(0.8)}
    papers, _ = perform("bernardet-2019", groups, marks={1: before})
    assert [e.code for e in papers if isinstance(e, WarningEvent)] == ["no-states"]
    assert not [e for e in papers if isinstance(e, State)]


def test_wishes_for_breaths_hold_until_the_next() -> None:
    groups: Said = [("a", 10, 2.0, "sentence"), ("b", 10, 2.0, "sentence"), ("c", 10, 2.0, "sentence")]
    loud = BreathingMark(at=0, written="<amazon:auto-breaths>", level_db=6.0, length=1.4)
    silent = BreathingMark(at=0, written="<amazon:auto-breaths>", silent=True)
    plain = [e for e in perform("natural", groups)[0] if isinstance(e, Inspiration)]
    wished = [e for e in perform("natural", groups, marks={1: (loud,), 2: (silent,)})[0] if isinstance(e, Inspiration)]
    assert wished[0] == plain[0]
    assert wished[1].duration == pytest.approx(plain[1].duration * 1.4, rel=0.2)
    assert wished[2].noise is None
    assert plain[2].noise is not None


def test_states_move_rate_depth_route_and_sound_together() -> None:
    # B55, B60: long and deep is calm, fast and shallow anxious
    groups: Said = [(str(n), 18, 3.6, "sentence") for n in range(40)]

    def mean(name: str) -> tuple[float, float, float, float]:
        mark = StateMark(at=0, written="[state]", name=name, intensity=1.0, ramp=0.0)
        events, _ = perform("natural", groups, marks={0: (mark,)})
        own = [e for e in events if isinstance(e, Inspiration) and e.kind == "speech" and e.noise]
        loud = [e.noise.level_db + mix_level(e.sound_mouth, e.sound_nose) for e in own if e.noise]
        return (
            sum(e.duration for e in own) / len(own),
            sum(e.sound_nose for e in own) / len(own),
            sum(e.thorax_share for e in own) / len(own),
            sum(loud) / len(own),
        )

    calm, neutral, anxious = mean("calm"), mean("neutral"), mean("anxious")
    assert calm[0] > neutral[0] > anxious[0]
    assert calm[1] > neutral[1] > anxious[1]
    assert calm[2] < neutral[2] < anxious[2]
    assert calm[3] < neutral[3] < anxious[3]


def test_two_sniffs_are_two() -> None:
    mark = Act(at=1, written="[sniff]", name="sniff")
    twice = 0
    for seed in range(12):
        events, _ = perform("natural", [("a", 10, 2.0, "text end")], seed=seed, marks={1: (mark,)})
        seeds = [e.noise.seed for e in events if isinstance(e, Inspiration) and e.kind == "sniff" and e.noise]
        assert len(set(seeds)) == len(seeds)
        twice += len(seeds) == 2
    assert twice


def test_a_gasp_on_full_lungs_is_a_breath_too() -> None:
    gasp = Act(at=0, written="[gasp]", name="gasp")
    groups: Said = [("a", 3, 0.6, "tag"), ("b", 3, 0.6, "sentence")]
    events, _ = perform("natural", groups, marks={0: (gasp,), 1: (gasp,)})
    gasps = [e for e in events if isinstance(e, Inspiration) and e.kind == "gasp"]
    assert len(gasps) == 2
    assert all(e.to_volume - e.from_volume >= 0.1 for e in gasps)


@pytest.mark.parametrize("model", ["bernardet-2017", "bernardet-2019"])
def test_the_papers_models_gasp_and_breathe_as_asked(model: str) -> None:
    groups: Said = [("a", 10, 2.0, "sentence"), ("b", 10, 2.0, "sentence")]
    gasp = Act(at=0, written="[gasp]", name="gasp")
    events, _ = perform(model, groups, marks={1: (gasp,)})
    first, second = (e for e in events if isinstance(e, Inspiration))
    assert (first.kind, second.kind) == ("speech", "gasp")
    assert second.duration < 0.6 < first.duration
    soft = Act(at=0, written="<amazon:breath/>", name="breath", level_db=-12.0, length=0.5)
    events, _ = perform(model, groups, marks={1: (soft,)})
    first, second = (e for e in events if isinstance(e, Inspiration))
    assert second.duration == pytest.approx(0.5 * first.duration)
    assert first.noise and second.noise
    assert second.noise.level_db == pytest.approx(first.noise.level_db - 12.0)
    assert second.to_volume == first.to_volume
    long = Act(at=0, written="[pause 9]", name="pause", seconds=9.0)
    events, _ = perform(model, groups, marks={1: (long,)})
    assert [e.kind for e in events if isinstance(e, Inspiration)] == ["speech", "speech"]


def test_length_that_is_asked_for_does_not_change_the_level() -> None:
    groups: Said = [("a", 10, 2.0, "sentence"), ("b", 10, 2.0, "sentence")]

    def second(length: float) -> Inspiration:
        mark = Act(at=0, written="<amazon:breath/>", name="breath", length=length)
        return [e for e in perform("natural", groups, marks={1: (mark,)})[0] if isinstance(e, Inspiration)][1]

    usual, long = second(1.0), second(1.5)
    assert long.duration > 1.3 * usual.duration
    assert usual.noise and long.noise
    assert long.noise.level_db == pytest.approx(usual.noise.level_db, abs=0.5)


def test_heavy_breathing_at_rest_keeps_its_rate_and_share() -> None:
    # physiology 4.2: 42 a minute, share 0.48
    breathing = breathing_model("natural")
    p = Parameters()
    person = breathing.person(p)
    state = BodyState(body="b", seed=0, parameters=p, person=person, time=0.0, volume=person.resting_volume)
    mark = StateMark(at=0, written="[state]", name="exertion", intensity=1.0, ramp=0.0, held=True)
    state, _ = breathing.act(state, (mark,), "begin")
    _, events = breathing.rest(state, 120.0, "rest")
    inward = [e for e in events if isinstance(e, Inspiration)]
    cycles = [b.onset - a.onset for a, b in pairwise(inward)]
    assert 60 * len(cycles) / sum(cycles) == pytest.approx(42.0, abs=2.0)
    shares = [e.duration / cycle for e, cycle in zip(inward, cycles, strict=False)]
    assert sum(shares) / len(shares) == pytest.approx(0.48, abs=0.03)


def test_states_go_on_changing_while_the_body_waits() -> None:
    breathing = breathing_model("natural")
    p = Parameters(breath_variability=0.0)
    person = breathing.person(p)
    state = BodyState(body="b", seed=0, parameters=p, person=person, time=0.0, volume=person.resting_volume)
    mark = StateMark(at=0, written="[state]", name="exertion", intensity=1.0, ramp=0.0)
    state, _ = breathing.act(state, (mark,), "begin")
    _, events = breathing.rest(state, 180.0, "rest")
    onsets = [e.onset for e in events if isinstance(e, Inspiration)]
    early = sum(onset < 20 for onset in onsets)
    late = sum(160 <= onset < 180 for onset in onsets)
    assert early >= 11  # 42 a minute, and falling
    assert 4 <= late <= 7  # 15 a minute, nearly


def test_much_air_that_is_let_go_is_heard() -> None:
    gasp = Act(at=1, written="[gasp]", name="gasp")
    events, _ = perform("natural", [("a", 3, 0.6, "text end")], marks={1: (gasp,)})
    out = next(e for e in events if isinstance(e, Expiration) and e.kind == "tidal" and e.origin == "markup")
    assert out.noise is not None


def test_sniffs_stop_where_the_lungs_are_full() -> None:
    marks = tuple(Act(at=1, written="[sniff]", name="sniff") for _ in range(40))
    events, _ = perform("natural", [("a", 3, 0.6, "text end")], marks={1: marks})
    sniffs = [e for e in events if isinstance(e, Inspiration) and e.kind == "sniff"]
    assert all(e.to_volume > e.from_volume for e in sniffs)
    assert "full-lungs" in {e.code for e in events if isinstance(e, WarningEvent)}
