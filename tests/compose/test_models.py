"""The breathing models: what each places, and what neither may ever do."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.compose.bernardet import motion
from scorebreath.compose.models import MODELS, breathing_model
from scorebreath.compose.state import BodyState
from scorebreath.compose.timing import for_depth
from scorebreath.errors import InputError
from scorebreath.parameters.derive import derive
from scorebreath.parameters.table import Parameters
from scorebreath.planning.planners import PLANNERS
from scorebreath.score.document import Site
from scorebreath.score.events import EVENTS, Event, Expiration, Hold, Inspiration, Utterance
from scorebreath.script.marks import Act

from .bodies import perform, spoken

sites: st.SearchStrategy[Site] = st.sampled_from(["sentence", "paragraph", "comma", "clause", "word"])
said = st.tuples(
    st.text("abc ", min_size=1, max_size=5),
    st.integers(1, 60),
    st.integers(50, 12_000).map(lambda ms: ms / 1000),
    sites,
)
texts: st.SearchStrategy[list[tuple[str, int, float, Site]]] = st.lists(said, min_size=1, max_size=6)
FORECAST: list[tuple[str, int, float, Site]] = [
    ("one", 12, 2.4, "comma"),
    ("two", 18, 3.5, "sentence"),
    ("three", 30, 6.0, "word"),
    ("four", 4, 0.8, "paragraph"),
]


def volumes(events: Sequence[Event]) -> list[Inspiration | Expiration | Hold]:
    return sorted((e for e in events if isinstance(e, (Inspiration, Expiration, Hold))), key=lambda e: (e.onset, e.end))


def test_each_model_has_a_planner_of_its_name() -> None:
    assert set(MODELS) == set(PLANNERS)
    with pytest.raises(InputError, match="bernardet-2017"):
        breathing_model("none")


@given(texts, st.sampled_from(sorted(MODELS)), st.integers(0, 5))
def test_lungs_have_no_gaps_and_no_jumps(groups: list[tuple[str, int, float, Site]], model: str, seed: int) -> None:
    events, state = perform(model, groups, seed=seed)
    level, time = state.person.resting_volume, 0.5
    for event in volumes(events):
        assert event.onset == pytest.approx(time, abs=2e-6)
        before, after = (
            (event.volume, event.volume) if isinstance(event, Hold) else (event.from_volume, event.to_volume)
        )
        assert before == pytest.approx(level)
        assert 0.0 <= after <= 1.0
        level, time = after, event.end
    assert level == pytest.approx(state.person.resting_volume)
    assert time == pytest.approx(state.time, abs=2e-6)


@given(texts, st.sampled_from(sorted(MODELS)))
def test_leads_stay_within_the_reach_of_their_type(groups: list[tuple[str, int, float, Site]], model: str) -> None:
    for event in perform(model, groups)[0]:
        if isinstance(event, Inspiration):
            assert max(event.lead.mouth, event.lead.nostril) <= EVENTS["inspiration"][1].lead
            assert event.face.attack + event.face.hold + event.face.release == pytest.approx(event.duration)
            if event.noise:
                parts = event.noise.attack + event.noise.hold + event.noise.release
                assert parts == pytest.approx(event.noise.duration)
                assert 1 <= event.noise.seed < 2**24
                assert event.noise.onset + event.noise.duration <= event.duration + 1e-6


@given(texts, st.sampled_from(sorted(MODELS)))
def test_sound_and_motion_off_leave_every_time(groups: list[tuple[str, int, float, Site]], model: str) -> None:
    times = [(e.id, e.onset, e.duration) for e in perform(model, groups)[0]]
    silent = perform(model, groups, Parameters(breath_sound=False))[0]
    still = perform(model, groups, Parameters(breath_motion=False))[0]
    assert [(e.id, e.onset, e.duration) for e in silent] == times
    assert [(e.id, e.onset, e.duration) for e in still] == times
    assert all(e.noise is None for e in silent if isinstance(e, Inspiration))
    for event in still:
        if isinstance(event, Inspiration):
            assert event.motion.thorax == event.motion.neck_pitch == event.mouth_open == event.nostril_flare == 0.0


def test_the_papers_oscillate_and_nothing_stands_between() -> None:
    # B3, B6, B12: in for length_inspiration, out while speaking, and again.
    events, _ = perform("bernardet-2017", FORECAST, Parameters(capacity_lung=64.0, norm_syllables=20.0))
    breaths = [e for e in events if isinstance(e, Inspiration)]
    speeches = [e for e in events if isinstance(e, Utterance)]
    assert [e.duration for e in breaths] == [0.64] * 4
    assert [e.onset for e in breaths] == pytest.approx([0.5, 0.5 + 3.04, 0.5 + 7.18, 0.5 + 13.82])
    assert [e.onset for e in speeches] == pytest.approx([e.end for e in breaths])
    # B7 (X14): volume_lung = 0.64 * min(1, n / 16)
    assert [e.to_volume for e in breaths] == pytest.approx([0.48, 0.64, 0.64, 0.16])
    # B35, B36: shapes at d = 1
    assert breaths[0].motion.thorax == pytest.approx(0.65 * 0.64)
    assert breaths[0].motion.abdomen == pytest.approx(0.35 * 0.64)
    assert (breaths[0].sound_nose, breaths[0].sound_mouth) == (0.35, 0.65)
    assert (breaths[0].nostril_flare, breaths[0].mouth_open) == pytest.approx((0.105, 0.195))


def test_what_is_asked_for_moves_the_papers_chest_as_their_breaths_do() -> None:
    sigh = Act(at=0, written="[sigh]", name="sigh")
    p = Parameters(abdomen_share=0.2, amplitude_neck_motion=3.0)
    first = spoken(0, "one", 12, 2.4, "sentence", "one#0", before=(sigh,))
    model = breathing_model("bernardet-2019")
    state = BodyState(body="body", seed=0, parameters=p, person=model.person(p), time=0.0, volume=0.0)
    _, events = model.step(state, first)
    breaths = [event for event in events if isinstance(event, Inspiration | Expiration)]
    assert {event.kind for event in breaths} == {"sigh", "speech"}
    assert {event.motion for event in breaths} == {motion(p, derive(p))}
    assert {event.thorax_share for event in breaths} == {0.8}


def test_natural_breaths_follow_what_is_to_be_said() -> None:
    # physiology 1.3: 0.42 + 0.010 N, shorter after no boundary, longer after a paragraph
    p = Parameters(inspiration_spread=0.0, initiation_spread=0.0, breath_variability=0.0, recovery_share=0.0)
    events, _ = perform("natural", [*FORECAST, ("five", 10, 2.0, "sentence")], p)
    breaths = [e for e in events if isinstance(e, Inspiration) and e.kind == "speech"]
    # The first begins at rest, 2 % of VC above where speech ends; the fourth is the smallest anybody draws, and leaves
    # something for the fifth: lengths go with depths as for_depth says.
    need = [0.108, 0.162, 0.27, 0.036, 0.09]
    moved = [0.088, 0.162, 0.27, 0.065, 0.065]
    usual = [0.54, 0.60, 0.72, 0.46 * 0.7, 0.52 * 1.15]
    assert [e.duration for e in breaths] == pytest.approx(
        [t * for_depth(v, n) for t, v, n in zip(usual, moved, need, strict=True)], abs=2e-6
    )
    assert [round(e.to_volume, 3) for e in breaths] == [0.468, 0.522, 0.63, 0.425, 0.454]
    assert [round(e.to_volume - e.from_volume, 3) for e in breaths] == moved
    # physiology 1.4: silences
    speeches = [e for e in events if isinstance(e, Utterance)]
    gaps = [after.onset - before.end for before, after in zip(speeches, breaths[1:], strict=False)]
    assert gaps == pytest.approx([0.08, 0.18, 0.08, 0.45], abs=1e-5)
    assert [s.onset - b.end for s, b in zip(speeches, breaths, strict=True)] == pytest.approx([0.06] * 5, abs=1e-5)


def test_draws_belong_to_a_place_not_to_a_number() -> None:
    def drawn(groups: list[tuple[str, int, float, Site]]) -> dict[str, tuple[float, int]]:
        events, _ = perform("natural", groups, seed=7)
        breaths = [e for e in events if isinstance(e, Inspiration) and e.kind == "speech"]
        return {g[0]: (b.duration, b.noise.seed if b.noise else 0) for g, b in zip(groups, breaths, strict=True)}

    before = drawn(FORECAST)
    after = drawn([*FORECAST[:2], ("inserted", 9, 2.0, "sentence"), *FORECAST[2:]])
    assert {name: seed for name, (_, seed) in after.items() if name != "inserted"} == {
        name: seed for name, (_, seed) in before.items()
    }
    assert len(set(before.values())) == len(before)
    for name, (length, _) in before.items():  # what is left in the lungs is carried over, and fades
        assert after[name][0] == pytest.approx(length, rel=0.15)
    assert after["four"][0] == pytest.approx(before["four"][0], rel=0.06)


def test_an_equal_group_said_again_breathes_otherwise() -> None:
    events, _ = perform("natural", [("same", 10, 2.0, "sentence")] * 4)
    lengths = {e.duration for e in events if isinstance(e, Inspiration) and e.kind == "speech"}
    assert len(lengths) == 4


@pytest.mark.parametrize(
    ("site", "type_", "wanted"),
    [
        ("sentence", "statement", "final"),
        ("sentence", "question", "question"),
        ("comma", "question", "continuing"),
        ("word", "statement", "continuing"),
    ],
)
def test_how_a_group_closes(site: Site, type_: str, wanted: str) -> None:
    from scorebreath.compose.parts import closing

    assert closing(spoken(0, "a", 1, 1.0, site, "a", sentence_type=type_).group) == wanted
