"""A click that is played and comes back."""

from __future__ import annotations

import shutil

import numpy as np
import pytest

from scorebreath.engine.live.backend import Device
from scorebreath.engine.loopback import _judged, measure
from tests.jackd import RATE, connect, jack_server

PERIOD = 256
without_jack = shutil.which("jackd") is None or shutil.which("scsynth") is None


def wire() -> None:
    connect("SuperCollider:out_1", "SuperCollider:in_1")


@pytest.mark.jack
@pytest.mark.skipif(without_jack, reason="needs jackd and scsynth")
def test_what_comes_back_is_measured_by_the_sample() -> None:
    """A client of JACK hears itself one period later."""
    with jack_server():
        found = measure("scsynth", ready=wire)
    assert found.sample_rate == RATE
    assert found.round_trip is not None
    assert round(found.round_trip * RATE) == PERIOD
    assert found.level == pytest.approx(0.5, abs=0.01)
    assert "5.3 ms" in found.about


@pytest.mark.jack
@pytest.mark.skipif(without_jack, reason="needs jackd and scsynth")
def test_what_does_not_come_back_is_said() -> None:
    with jack_server():
        found = measure("scsynth")
    assert found.round_trip is None
    assert "no click came back" in found.about


def test_who_cannot_listen_says_so() -> None:
    for name in ("silent", "scsynth@127.0.0.1:57110"):
        found = measure(name, Device(inputs=1))
        assert (found.round_trip, found.level) == (None, 0.0)
        assert name in found.about


@pytest.mark.parametrize("noise", [0.0, 0.01])
def test_a_click_is_told_from_noise(noise: float) -> None:
    rng = np.random.default_rng(3)
    heard = (noise * rng.standard_normal(RATE)).astype(np.float32)
    assert _judged(heard, RATE).round_trip is None
    heard[1234:1282] += 0.4
    found = _judged(heard, RATE)
    assert found.round_trip == pytest.approx(1234 / RATE, abs=2 / RATE)
