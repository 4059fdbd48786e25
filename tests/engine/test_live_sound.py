"""What a live engine sounds like: recorded from JACK, compared with what it was given."""

from __future__ import annotations

import shutil
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scorebreath.engine.live.backend import Device
from scorebreath.engine.live.making import sounder_named
from scorebreath.engine.live.orders import Mix
from scorebreath.engine.live.process import CLIENT
from scorebreath.engine.onsets import onsets
from scorebreath.errors import EngineError
from scorebreath.media.store import MemoryStore
from scorebreath.score.performing import Heard
from tests.engine.listening import Signal
from tests.engine.sounding import babble, score, utterance
from tests.jackd import RATE, jack_server

pytestmark = [
    pytest.mark.jack,
    pytest.mark.skipif(
        any(shutil.which(name) is None for name in ("jackd", "jack_rec", "scsynth")), reason="needs jackd and scsynth"
    ),
]
SECONDS = 5
TURNS = 5
"""Times that it is recorded, at most."""
STORE = MemoryStore()
PLAIN, CUT, SOFT = (babble(0.8, RATE, seed) for seed in (1, 2, 3))


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Signal:
    """Both outputs (2, n) of three utterances: as it is, cut after half its length, at half its gain.

    A recording in which JACK dropped blocks shows nothing of the engine: it is made again.
    """
    for _ in range(TURNS):
        path = tmp_path_factory.mktemp("jack") / "out.wav"
        with jack_server() as jack:
            record(path)
            dropped = jack.xruns()
        if not dropped:
            return read(path)
    pytest.skip("JACK drops blocks: this machine is too busy to record anything")


def record(path: Path) -> None:
    """Perform the three, and record what the JACK that is in use hears."""
    names = [STORE.put(one, RATE, "speech") for one in (PLAIN, CUT, SOFT)]
    sounds = onsets(score([utterance(0.5 + 1.2 * number, name, 0.8) for number, name in enumerate(names)], 5.0, STORE))
    with sounder_named("scsynth", mix=Mix(pans={"body": 0.5})) as sounder:
        command = ["jack_rec", "-f", str(path), "-d", str(SECONDS), "-b", "32"]
        recorder = subprocess.Popen(
            [*command, "SuperCollider:out_1", "SuperCollider:out_2"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        try:
            sounder.begin(time.time() + 0.5)
            sounder.play(sounds, STORE)
            sounder.cut(1.7 + 0.4, [sounds[1].event], 0.05)
            sounder.move(2.7, "body", Heard(speech=0.5), 0.1)
            recorder.wait(SECONDS + 20)
        finally:
            if recorder.poll() is None:
                recorder.kill()
                recorder.wait()
        status = sounder.status()
    assert (status.lost, status.late_sent) == (0, 0)


def read(path: Path) -> Signal:
    signal, rate = soundfile.read(path, dtype="float64", always_2d=True)
    assert rate == RATE
    return np.asarray(signal.T)


def place(signal: Signal, said: Signal) -> int:
    """Where something is in a signal."""
    size = 1 << (len(signal) + len(said)).bit_length()
    found = np.fft.irfft(np.fft.rfft(signal, size) * np.conj(np.fft.rfft(said, size)), size)
    return int(np.argmax(found[: len(signal)]))


@pytest.mark.parametrize(("side", "gain"), [(0, 0.5), (1, 1.0)])
def test_speech_is_heard_sample_for_sample_at_its_place(recorded: Signal, side: int, gain: float) -> None:
    first = place(recorded[side], PLAIN.astype(np.float64))
    heard = recorded[side][first : first + len(PLAIN)]
    np.testing.assert_allclose(heard, gain * PLAIN, atol=1e-4)


def test_what_is_cut_fades_out_and_is_silent(recorded: Signal) -> None:
    first = place(recorded[1], CUT.astype(np.float64))
    heard = recorded[1][first : first + len(CUT)]
    until, after = round(0.4 * RATE), round(0.45 * RATE) + 3
    np.testing.assert_allclose(heard[: until - 1], CUT[: until - 1], atol=1e-4)
    assert not heard[after:].any()
    middle = slice(round(0.42 * RATE), round(0.43 * RATE))
    assert 0.3 < np.std(heard[middle]) / np.std(CUT[middle]) < 0.7


def test_what_is_moved_is_heard_as_it_was_moved(recorded: Signal) -> None:
    first = place(recorded[1], SOFT.astype(np.float64))
    heard = recorded[1][first : first + len(SOFT)]
    np.testing.assert_allclose(heard[RATE // 4 :], 0.5 * SOFT[RATE // 4 :], atol=1e-4)


def test_nothing_else_is_heard(recorded: Signal) -> None:
    """But the three, at their distances."""
    places = [place(recorded[1], said.astype(np.float64)) for said in (PLAIN, CUT, SOFT)]
    assert np.diff(places) / RATE == pytest.approx([1.2, 1.2], abs=0.01)
    loud = np.abs(recorded).max(axis=0) > 1e-6
    for first in places:
        assert loud[first : first + RATE // 4].any()
        loud[first : first + len(PLAIN) + 3] = False
    assert not loud.any()


def test_a_server_is_chosen_by_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    """A word alone is the server's, not the client's; one that is not there is no other."""
    with jack_server() as jack:
        monkeypatch.setenv("JACK_DEFAULT_SERVER", "elsewhere")
        for given, client in ((jack.name, CLIENT), (f"{jack.name}:mine", "mine")):
            with sounder_named("scsynth", device=Device(name=given)):
                assert f"{client}:out_1" in ports(jack.name)
        with pytest.raises(EngineError, match="no sound device"):
            sounder_named("scsynth", device=Device(name="nowhere"))


def ports(server: str) -> list[str]:
    """All of a JACK server."""
    return subprocess.run(["jack_lsp", "-s", server], capture_output=True, text=True, check=True).stdout.split()
