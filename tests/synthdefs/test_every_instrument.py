"""Every instrument of the catalogue plays on the real engine, on its sample, again and again the same, and goes."""

from __future__ import annotations

import shutil
from functools import cache

import numpy as np
import pytest

from scorebreath.engine import run
from scorebreath.errors import EngineError
from scorebreath_synthdefs import CATALOGUE, RECORDING, SPEECH
from tests.engine.listening import Signal, level_db
from tests.synthdefs.playing import FLOW, LEVEL, RAMPS, onset, played

GRAPHS = [name for name in CATALOGUE if name.endswith("_male") or name in {RECORDING, SPEECH}]
"""One of each; speakers differ in numbers only."""
EXPONENTS = [0.0, FLOW]
needs_scsynth = pytest.mark.skipif(shutil.which("scsynth") is None, reason="no scsynth on PATH")


STEP = 2.112  # s between instruments, a whole number of blocks


@cache
def parade(exponent: float, *, shift: int = 0, seed: int = 77, run: int = 0) -> Signal:
    """All instruments one after the other: (instruments, frames), each `shift` frames after its row's beginning.

    Args:
        exponent: Of all.
        shift: Frames.
        seed: Of the noises.
        run: Another number is another run of the engine.
    """
    times = (STEP * index + shift / 48000 for index in range(len(CATALOGUE)))
    sounds = [onset(name, time, seed, exponent=exponent) for name, time in zip(CATALOGUE, times, strict=True)]
    return played(sounds, STEP * len(CATALOGUE)).reshape(len(CATALOGUE), -1)


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("name", CATALOGUE)
def test_it_starts_on_its_sample_and_ends_with_its_envelope(name: str, exponent: float) -> None:
    """Anywhere in the engine's blocks of 64, and bit for bit the same there."""
    row, shift = list(CATALOGUE).index(name), 37
    one, other = parade(exponent)[row], parade(exponent, shift=shift)[row]
    assert np.flatnonzero(one)[0] <= 12  # a flow to the power of 1.66 begins below what 32 bits can hold
    assert not other[:shift].any()
    end = round(onset(name, 0.0, exponent=exponent).duration * 48000)
    assert np.abs(one[end - 960 : end]).max() > 0
    assert not one[end + 2 :].any()
    np.testing.assert_array_equal(one[:-shift], other[shift:])


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("name", CATALOGUE)
def test_one_seed_is_one_sound(name: str, exponent: float) -> None:
    row = list(CATALOGUE).index(name)
    one, again, other = (found[row] for found in (parade(exponent), parade(exponent, run=1), parade(exponent, seed=6)))
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


@pytest.mark.parametrize("rate", [16000, 192000])
@pytest.mark.parametrize("name", [name for name in GRAPHS if name not in {RECORDING, SPEECH}])
def test_extremes_stay_in_bounds(name: str, rate: int) -> None:
    """A very small tract in very fast air at a low rate: no resonance leaves the circle."""
    for scale, brightness in ((2.4, 4.0), (0.5, 0.25)):
        sound = onset(
            name, 0.0, 3, exponent=FLOW, scale=scale, brightness=brightness, attack=0.1, hold=0.3, release=0.2
        )
        signal = played([sound], 0.6, rate)
        assert np.isfinite(signal).all()
        assert -16 < level_db(signal) - 20 * np.log10(LEVEL) < 2
        assert np.abs(signal).max() < 8 * LEVEL
