"""Every instrument of the catalogue plays on the real engine, on its sample, again and again the same, and goes."""

from __future__ import annotations

import shutil

import numpy as np
import pytest

from scorebreath.engine import run
from scorebreath.errors import EngineError
from scorebreath_synthdefs import CATALOGUE, RECORDING, SPEECH
from tests.engine.listening import level_db
from tests.synthdefs.playing import FLOW, RAMPS, onset, played

GRAPHS = [name for name in CATALOGUE if name.endswith("_male") or name in {RECORDING, SPEECH}]
"""One of each; speakers differ in numbers only."""
EXPONENTS = [0.0, FLOW]
needs_scsynth = pytest.mark.skipif(shutil.which("scsynth") is None, reason="no scsynth on PATH")


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("name", CATALOGUE)
def test_it_starts_on_its_sample_and_ends_with_its_envelope(name: str, exponent: float) -> None:
    """Anywhere in the engine's blocks of 64, and bit for bit the same there."""
    first, later = 480, 480 + 64 + 37
    one, other = (played([onset(name, frame / 48000, 77, exponent=exponent)], 2.5) for frame in (first, later))
    assert not one[:first].any()
    assert np.flatnonzero(one)[0] <= first + 12  # a flow to the power of 1.66 begins below what 32 bits can hold
    end = first + round(onset(name, 0.0, exponent=exponent).duration * 48000)
    assert not one[end + 2 :].any()
    assert np.abs(one[end - 960 : end]).max() > 0
    np.testing.assert_array_equal(one[first : end + 2], other[later : end + 2 + later - first])


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("name", CATALOGUE)
def test_one_seed_is_one_sound(name: str, exponent: float) -> None:
    one, again, other = (played([onset(name, 0.0, seed, exponent=exponent)], 0.5) for seed in (5, 5, 6))
    assert one.any()
    np.testing.assert_array_equal(one, again)
    assert name == SPEECH or not np.array_equal(one, other)


@pytest.mark.parametrize("name", GRAPHS)
def test_it_frees_itself(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A hundred and fifty one after the other in an engine that holds fewer than a hundred."""
    full = run._flags

    def small(sample_rate: int, needs: run.Needs) -> list[str]:
        flags = full(sample_rate, needs)
        flags[flags.index("-n") + 1] = "96"
        return flags

    monkeypatch.setattr(run, "_flags", small)
    ramps = dict.fromkeys(RAMPS, 0.003)
    sounds = [onset(name, 0.02 * index, 1 + index, media_seconds=0.009, exponent=FLOW, **ramps) for index in range(150)]
    signal = played(sounds, 3.1)
    assert all(signal[round(960 * index) :][:432].any() for index in range(150))
    crowd = [onset(name, 0.001 * index, 1 + index, hold=2.0) for index in range(150)]
    with pytest.raises(EngineError, match="too many sounds"):
        played(crowd, 3.0)


@needs_scsynth
@pytest.mark.scsynth
@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("name", GRAPHS)
def test_engines_agree_on_it(name: str, exponent: float) -> None:
    sound = onset(name, 0.0123, 9, exponent=exponent)
    one, other = (played([sound], 2.5, engine=engine) for engine in ("embedded", "scsynth"))
    assert level_db(one - other + 1e-12) < level_db(one) - 40


@pytest.mark.parametrize("rate", [16000, 22050, 192000])
@pytest.mark.parametrize("name", GRAPHS)
def test_extremes_stay_finite(name: str, rate: int) -> None:
    """A very small tract in very fast air at a low rate: no resonance leaves the circle."""
    if name in {RECORDING, SPEECH}:
        return
    for scale, brightness in ((2.4, 4.0), (0.5, 0.25)):
        signal = played([onset(name, 0.0, 3, exponent=FLOW, scale=scale, brightness=brightness)], 2.0, rate)
        assert np.isfinite(signal).all()
        assert 0.001 < np.abs(signal).max() < 1.0
