"""Numbers worked by hand for every way of breathing: gasps, puffs, recoil, trembling, held breath."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.curves.strokes import WAYS, peak_flow, soundings_of, strokes_of
from scorebreath.equations.breath import FLOW_EXPONENT, LOUD
from scorebreath.equations.shapes import HIGHEST_FLOW
from scorebreath.errors import ScoreError
from scorebreath.score.document import Person
from scorebreath.score.events import Expiration, Hold, Inspiration, Lead, Noise
from scorebreath.units import FLOOR_DB
from tests.curves.acts import PROFILES, STEADY, breathe_in, breathe_out, face_of, keep, noise_of
from tests.curves.scores import REST, score_of, value

PERSON = Person(vital_capacity=5.0, resting_volume=REST)
CATCH = Noise(onset=0.0, duration=0.1, attack=0.02, hold=0.03, release=0.05, level_db=-30.0, seed=3)


def test_flow_is_highest_at_the_peak_and_the_volume_there_is_the_peak_s_share() -> None:
    score = score_of([breathe_in(onset=1.0, duration=1.0, peak=0.4)])
    mean = 0.2 * 5.0 / 1.0
    assert value(score, "lung_volume", 1.0, 1.2, 1.4, 1.7, 2.0) == pytest.approx(
        [
            0.38,
            0.38 + 0.2 * 0.4 * (1 - math.cos(math.pi / 4)),
            0.38 + 0.2 * 0.4,
            0.38 + 0.2 * (0.4 + 0.6 * math.sin(math.pi / 4)),
            0.58,
        ],
        abs=1e-12,
    )
    assert value(score, "airflow", 1.0, 1.4, 1.7) == pytest.approx(
        [0.0, mean * math.pi / 2, mean * math.pi / 2 * math.cos(math.pi / 4)], abs=1e-12
    )


def test_a_peak_in_the_middle_is_half_a_sine_to_the_last_bit() -> None:
    """Scores written before there was a peak keep their curves."""
    event = breathe_in(from_volume=0.0, to_volume=1.0, duration=1.0)
    times = np.linspace(0.0, 1.0, 3001)[1:-1]
    got = curves(score_of([event], resting=0.0)).sample(times, ["lung_volume", "airflow"])
    assert np.array_equal(got[:, 0], 0.5 - 0.5 * np.cos(np.pi * times))
    assert np.array_equal(got[:, 1], 0.5 * np.pi * np.sin(np.pi * times) * 5.0)


def test_recoil_has_four_time_constants() -> None:
    """Physiology 1.6: at rest Te = 2.1 s, tau = 0.4-0.6 s."""
    score = score_of([breathe_out(duration=2.1)])
    tau = 2.1 / 4
    left = [(math.exp(-k) - math.exp(-4)) / (1 - math.exp(-4)) for k in range(5)]
    got = value(score, "lung_volume", *(k * tau for k in range(5)))
    assert got == pytest.approx([0.38 + 0.2 * share for share in left], abs=1e-12)
    assert got[-1] == 0.38
    flow = value(score, "airflow", 0.0, tau)
    assert flow[0] / flow[1] == pytest.approx(math.e)
    assert flow[0] == pytest.approx(-0.2 * 5.0 / tau / (1 - math.exp(-4)))


@pytest.mark.parametrize("profile", PROFILES)
def test_gasps_are_equal_parts_of_time_and_volume(profile: str) -> None:
    event = breathe_in(onset=0.5, duration=0.9, saccades=3, profile=profile, peak=0.3)
    score = score_of([event])
    got = value(score, "lung_volume", 0.5, 0.8, 1.1, 1.4)
    assert got == pytest.approx([0.38, 0.38 + 0.2 / 3, 0.38 + 0.4 / 3, 0.58], abs=1e-12)
    one = breathe_in(onset=0.5, duration=0.3, to_volume=0.446667, profile=profile, peak=0.3)
    at = np.array([0.05, 0.09, 0.2])
    alone = curves(score_of([one])).sample(0.5 + at, ["airflow"])
    for part in range(3):
        assert curves(score).sample(0.5 + 0.3 * part + at, ["airflow"]) == pytest.approx(alone, rel=1e-4)


def test_air_leaves_in_puffs_and_stays_between_them() -> None:
    """Each takes 0.6 of the time to the next; a third of the volume leaves in each of three."""
    event = breathe_out(onset=2.0, duration=1.0, kind="laugh", profile="sine", puffs=(0.1, 0.3, 0.8))
    score = score_of([breathe_in(onset=1.4), event])
    volumes = {
        2.0: 0.58, 2.05: 0.58, 2.1: 0.58, 2.16: 0.58 - 0.1 / 3, 2.22: 0.58 - 0.2 / 3, 2.29: 0.58 - 0.2 / 3,
        2.45: 0.58 - 0.3 / 3, 2.6: 0.58 - 0.4 / 3, 2.79: 0.58 - 0.4 / 3, 2.86: 0.58 - 0.5 / 3, 2.92: 0.38, 3.0: 0.38,
    }  # fmt: skip
    assert value(score, "lung_volume", *volumes) == pytest.approx(list(volumes.values()), abs=1e-9)
    assert value(score, "airflow", 2.05, 2.25, 2.7, 2.95) == [0.0] * 4
    assert value(score, "airflow", 2.86) == pytest.approx([-0.2 / 3 * 5.0 / 0.12 * math.pi / 2])


@pytest.mark.parametrize(
    ("event", "expected"),
    [
        (breathe_in(duration=0.5, profile="linear"), 2.0),
        (breathe_in(duration=0.5, peak=0.2), 2.0 * math.pi / 2),
        (breathe_in(duration=0.5, saccades=4), 2.0 * math.pi / 2),
        (breathe_out(duration=2.0), -0.5 * 4 / (1 - math.exp(-4))),
        (breathe_out(duration=1.0, profile="linear", puffs=(0.0, 0.25)), -1.0 / 2 / 0.15),
        (keep(), 0.0),
    ],
)
def test_highest_flows(event: Inspiration | Expiration | Hold, expected: float) -> None:
    assert peak_flow(event, PERSON) == pytest.approx(expected)


def test_every_profile_has_its_way() -> None:
    assert tuple(WAYS) == PROFILES
    x = np.linspace(0, 1, 100_001)
    assert set(HIGHEST_FLOW) == set(PROFILES)
    for name, way in WAYS.items():
        peak = np.full_like(x, 0.3)
        volume, flow = way.volume(x, peak), way.flow(x, peak)
        assert (volume[0], volume[-1]) == (0.0, 1.0)
        assert float(flow.max()) == pytest.approx(HIGHEST_FLOW[name])
        np.testing.assert_allclose(np.gradient(volume, x)[1:-1], flow[1:-1], atol=1e-4)


def test_a_frightened_chest_trembles_and_its_volume_does_not() -> None:
    afraid = dataclasses.replace(STEADY, tremor=0.03)
    score = score_of([keep(motion=afraid, duration=3.0)])
    seconds = [0.0, 1 / 30, 2 / 30, 0.1]  # a quarter of a 7.5 Hz period each
    assert value(score, "thorax", *seconds) == pytest.approx([1.7 * 0.2 * k for k in (1.0, 1.03, 1.0, 0.97)])
    assert value(score, "thorax_volume", *seconds) == pytest.approx([0.65 * 0.2] * 4)
    assert value(score, "abdomen", *seconds) == pytest.approx([1.4 * 0.2] * 4)


def test_fear_comes_with_the_next_breath_s_lead() -> None:
    afraid = dataclasses.replace(STEADY, tremor=0.2)
    score = score_of([keep(duration=2.0), breathe_in(onset=2.0, from_volume=0.58, to_volume=0.6, motion=afraid)])
    low = [1.3, 1.7, 1.966667]  # where the sine is -1
    assert [math.sin(2 * math.pi * 7.5 * t) for t in low] == pytest.approx([-1.0] * 3, abs=1e-4)
    shares = [max(0.0, 1 - (2.0 - t) / 0.5) for t in low]
    assert value(score, "thorax", *low) == pytest.approx([0.34 * (1 - 0.2 * s) for s in shares], abs=1e-5)


def test_what_the_volume_moves_may_change_with_any_breath() -> None:
    """A state that begins before an expiration: the belly takes over during half a second before it, not at once."""
    belly = dataclasses.replace(STEADY, abdomen=2.0)
    score = score_of(
        [keep(id="before", duration=2.0), breathe_out(onset=2.0, motion=belly, thorax_share=0.25, profile="linear")]
    )
    assert value(score, "abdomen", 1.5, 1.75, 2.0, 3.0) == pytest.approx([1.4 * 0.2, 1.7 * 0.2, 2.0 * 0.2, 2.0 * 0.1])
    assert value(score, "thorax_volume", 1.5, 1.75, 2.0) == pytest.approx([0.65 * 0.2, 0.45 * 0.2, 0.25 * 0.2])


def test_an_expiration_opens_mouth_and_nostrils() -> None:
    out = breathe_out(onset=1.0, duration=1.0, mouth_open=0.5, nostril_flare=0.1, face=face_of(1.0))
    score = score_of([breathe_in(onset=0.4, face=face_of(0.6)), out])
    assert value(score, "mouth_open", 1.1, 1.2, 1.5, 1.85, 2.0) == pytest.approx([0.25, 0.5, 0.5, 0.25, 0.0])
    assert value(score, "nostril_flare", 1.1, 1.5) == pytest.approx([0.05, 0.1])
    still = dataclasses.replace(out, face=None)
    assert value(score_of([still]), "mouth_open", 1.5) == [0.0]


def test_of_an_expiration_and_the_next_breath_s_lead_the_higher_shows() -> None:
    out = breathe_out(onset=0.0, duration=1.0, mouth_open=0.2, face=face_of(1.0))
    coming = breathe_in(onset=1.0, mouth_open=0.9, lead=Lead(mouth=0.5), face=face_of(0.6))
    both = score_of([out, coming])
    for time in (0.55, 0.6, 0.9):
        apart = value(score_of([out]), "mouth_open", time)[0], value(score_of([coming]), "mouth_open", time)[0]
        assert value(both, "mouth_open", time) == [max(apart)]
    assert value(both, "mouth_open", 0.55)[0] == pytest.approx(0.2)


@pytest.mark.parametrize("hold", [0.0, 0.2, 0.5])
def test_a_noise_that_follows_the_flow_is_at_its_level_over_its_loud_part(hold: float) -> None:
    """`level_db` is the RMS of the part at least half as loud as the loudest moment."""
    event = breathe_in(duration=2.0, noise=noise_of(2.0, "flow", hold))
    level = curves(score_of([event])).sample(np.linspace(0, 2, 200_001), ["breath_level"])[:, 0]
    power = 10 ** (level / 10)
    loud = power[power >= power.max() * LOUD**2]
    assert 10 * math.log10(loud.mean()) == pytest.approx(-24.0, abs=0.01)
    assert level.max() > -24.0


def test_a_noise_that_follows_the_flow_rises_as_its_power() -> None:
    event = breathe_in(duration=2.0, noise=noise_of(2.0))  # rises 0.2..0.8 s
    low, high = value(score_of([event]), "breath_level", 0.4, 0.9)
    assert high - low == pytest.approx(-20 * FLOW_EXPONENT * math.log10(math.sin(math.pi / 6)))


def test_a_breath_s_noise_counts_nose_and_mouth_in_and_out() -> None:
    noise = noise_of(2.0, "trapezoid")  # full 0.8..1.2 s
    both = 10 * math.log10(0.5**2 + 10 ** (-6 / 10))
    gains = {"sound_nose": 1.0, "sound_mouth": 0.5, "noise": noise}
    for event in (breathe_in(duration=2.0, **gains), breathe_out(duration=2.0, **gains)):
        assert value(score_of([event]), "breath_level", 1.0) == pytest.approx([-24.0 + both])
    assert value(score_of([breathe_out(noise=noise)]), "breath_level", 1.0) == pytest.approx([-24.0])
    assert value(score_of([breathe_out(noise=noise, sound_mouth=0.0)]), "breath_level", 1.0) == [FLOOR_DB]


def test_the_throat_s_catch_is_heard_as_it_shuts() -> None:
    score = score_of([keep(onset=1.0, noise=CATCH)])
    assert value(score, "breath_level", 0.99, 1.03, 1.2) == pytest.approx([FLOOR_DB, -30.0, FLOOR_DB])
    assert value(score_of([keep(onset=1.0, kind="rest", noise=CATCH)]), "breath_level", 1.03) == [FLOOR_DB]


def test_every_gasp_and_every_puff_has_its_noise() -> None:
    gasps = breathe_in(onset=1.0, duration=0.9, saccades=3, noise=noise_of(0.9, "trapezoid"))
    score = score_of([gasps])
    for part in range(3):  # a whole breath's noise in a third of the time: full at 0.12..0.18 s
        begin = 1.0 + 0.3 * part
        got = value(score, "breath_level", begin + 0.02, begin + 0.15, begin + 0.29)
        assert got == pytest.approx([FLOOR_DB, -24.0, FLOOR_DB]), part
    laugh = breathe_out(onset=1.0, duration=1.0, puffs=(0.1, 0.4, 0.8), profile="sine", noise=CATCH)
    for puff in laugh.puffs:
        got = value(score_of([laugh]), "breath_level", 1.0 + puff - 0.01, 1.0 + puff + 0.03, 1.0 + puff + 0.12)
        assert got == pytest.approx([FLOOR_DB, -30.0, FLOOR_DB]), puff
    assert [s.onset for s in soundings_of(laugh)] == list(laugh.puffs)
    assert len(strokes_of(laugh)) == 4  # what comes before the first puff is one, of no volume


@pytest.mark.parametrize(
    ("event", "words"),
    [
        (breathe_out(puffs=(0.2, 0.2)), ["'out'", "puffs[0]=0.2", "before the next, 0.2 s"]),
        (breathe_out(puffs=(0.5, 0.2)), ["puffs[0]=0.5", "before the next"]),
        (breathe_out(puffs=(0.5, 2.0)), ["puffs[1]=2", "before its end, 2 s"]),
        (breathe_out(puffs=(-0.5, 1.0)), ["puffs[0]=-0.5", "at least 0"]),
        (breathe_out(puffs=(0.5, 1.95), noise=CATCH), ["noise", "after the last puff, 1.95 s", "2 s"]),
        (keep(duration=0.05, noise=CATCH), ["'hold'", "duration=0.1", "within"]),
        (breathe_out(face=face_of(3.0)), ["'out'", "face attack=0.6", "at most its duration, 2 s"]),
    ],
)
def test_contradictions_are_refused(event: Inspiration | Expiration | Hold, words: list[str]) -> None:
    with pytest.raises(ScoreError) as caught:
        curves(score_of([event]))
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize("make", [breathe_in, breathe_out, keep])
def test_what_lasts_no_time_does_nothing(make: Any) -> None:
    event = make(onset=1.0, duration=0.0, **({"face": face_of(0.0)} if make is breathe_in else {}))
    rows = curves(score_of([event], duration=2.0)).sample([0.99, 1.0, 1.01], ["lung_volume", "airflow", "mouth_open"])
    assert rows.tolist() == [[REST, 0.0, 0.0]] * 3
