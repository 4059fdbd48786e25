"""A live engine: silent ones, scsynth on a JACK server without hardware, the embedded engine on a device of nothing."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from scorebreath.engine.engines import External
from scorebreath.engine.live import process
from scorebreath.engine.live.backend import Device
from scorebreath.engine.live.conductor import Played
from scorebreath.engine.live.devices import devices
from scorebreath.engine.live.journal import Entry, JournalFile
from scorebreath.engine.live.making import NAMES, backend_named, sounder_named
from scorebreath.engine.live.orders import Mix, instrument
from scorebreath.engine.live.process import StartedBackend
from scorebreath.engine.live.server import LiveServer
from scorebreath.engine.live.sounder import Sounder
from scorebreath.engine.onsets import Onset, onsets
from scorebreath.errors import EngineError, EnvironmentFailure, InputError
from scorebreath.media.store import MemoryStore
from scorebreath.score.events import Event
from scorebreath.score.performing import Heard
from scorebreath_synthdefs.catalogue import ALL, LOOK_AHEAD
from tests.engine.sounding import babble, inspiration, noise, score, utterance
from tests.jackd import jack_server, needs_jack

PATIENCE = 30.0
STORE = MemoryStore()
SPOKEN = STORE.put(babble(0.4, 22050, 1), 22050, "speech")


def until(true: Callable[[], bool], what: str) -> None:
    """Wait, long if need be."""
    end = time.monotonic() + PATIENCE
    while not true():
        assert time.monotonic() < end, f"waited in vain for {what}"
        time.sleep(0.01)


def some(begin: float = 0.3, count: int = 4) -> tuple[Onset, ...]:
    events: list[Event] = []
    for number in range(count):
        events.append(inspiration(begin + 0.6 * number, noise(0.05, 0.1, 0.05), nose=0.5))
        events.append(utterance(begin + 0.25 + 0.6 * number, SPOKEN, 0.4))
    return onsets(score(events, begin + 0.7 * count + 1, STORE))


@pytest.fixture(params=["silent", pytest.param("scsynth", marks=needs_jack)])
def engine(request: pytest.FixtureRequest) -> Iterator[str]:
    if request.param == "silent":
        yield "silent"
    else:
        with jack_server():
            yield request.param


def begun(sounder: Sounder, lead: float = 0.5) -> None:
    sounder.begin(time.time() + lead)


def test_every_sound_is_sent_once_and_all_is_counted(engine: str, tmp_path: Path) -> None:
    journal = JournalFile(tmp_path / "journal.jsonl")
    troubles: list[str] = []
    sounds = some()
    with sounder_named(engine, journal=journal, on_trouble=troubles.append) as sounder:
        assert sounder.latency == LOOK_AHEAD
        begun(sounder)
        sounder.play(sounds, STORE)
        sounder.move(1.0, "body", Heard(speech=0.5, brightness=1.2), 0.1)
        until(lambda: sounder.status().waiting == 0 and sounder.status().sent >= len(sounds) + 1, "all to be sent")
        time.sleep(0.3)
        status = sounder.status()
        assert (status.alive, status.restarts, status.sent + status.lost) == (True, 0, len(sounds) + 1)
        if isinstance(sounder._backend, StartedBackend):
            assert not [line for line in sounder._backend._said if "FAILURE" in line or "ERROR" in line]
        folder = sounder._folder
    journal.close()
    assert not folder.exists()
    assert sounder.status().alive is False
    lines = (tmp_path / "journal.jsonl").read_text().splitlines()
    assert len(lines) == status.sent
    assert troubles == []


def test_a_late_bundle_is_counted_by_the_engine() -> None:
    if shutil.which("jackd") is None or shutil.which("scsynth") is None:
        pytest.skip("needs jackd and scsynth")
    with jack_server(), sounder_named("scsynth") as sounder:
        tag = sounder._conductor.clock.tag(-0.5)
        before = sounder.status().late
        sounder._send(tag, [instrument("scorebreath_speech")])
        until(lambda: sounder.status().late > before, "the engine to say that it was late")


test_a_late_bundle_is_counted_by_the_engine = pytest.mark.jack(test_a_late_bundle_is_counted_by_the_engine)


@pytest.mark.jack
@pytest.mark.skipif(shutil.which("jackd") is None or shutil.which("scsynth") is None, reason="needs jackd and scsynth")
def test_an_engine_killed_in_mid_breath_comes_back_and_goes_on() -> None:
    troubles: list[tuple[float, str]] = []
    entries: list[Entry] = []

    def told(message: str) -> None:
        troubles.append((time.monotonic(), message))

    with jack_server(synchronous=False), sounder_named("scsynth", journal=entries.append, on_trouble=told) as sounder:
        backend = sounder._backend
        assert isinstance(backend, StartedBackend)
        first, first_port = backend.pid, backend._port
        long = inspiration(0.2, noise(0.5, 4.0, 0.5))
        begun(sounder)
        later: tuple[Onset, ...] = ()
        sounder.move(0.1, "body", Heard(mouth=0.5), 0.0)
        sounder.play(onsets(score([long], 9.0)), STORE)
        until(lambda: len(entries) >= 2, "the breath")
        time.sleep(0.4)
        assert first is not None
        os.kill(first, signal.SIGKILL)
        until(lambda: sounder.status().restarts == 1, "the engine to come back")
        until(lambda: len(troubles) == 2, "word of it")
        assert "SIGKILL" in troubles[0][1]
        assert "is back" in troubles[1][1]
        now = time.time() - sounder.start_unix
        later = some(now + 0.6, 2)
        sent = sounder.status().sent
        sounder.play(later, STORE)
        until(lambda: sounder.status().sent == sent + len(later), "it to go on")
        time.sleep(0.3)
        status = sounder.status()
        assert status.lost == 1  # the breath it died in
        assert backend.pid != first
        shared = [path.name for path in Path("/dev/shm").glob("SuperColliderServer_*")]
        assert first_port != backend._port and f"SuperColliderServer_{first_port}" not in shared
        assert not [line for line in backend._said if "FAILURE" in line or "ERROR" in line]
    until(lambda: not _alive(first), "the first process to be gone")


def _alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.jack
@pytest.mark.skipif(shutil.which("jackd") is None or shutil.which("scsynth") is None, reason="needs jackd and scsynth")
def test_a_guest_in_somebody_elses_engine_leaves_nothing_behind() -> None:
    """As another client sees it: supriya's own server object."""
    import supriya

    with jack_server():
        host = StartedBackend(External())
        host.start()
        assert host._link is not None
        port = host._link._socket.getpeername()[1]
        other = supriya.Server().connect(ip_address="127.0.0.1", port=port)
        try:
            before = str(other.query_tree())
            with sounder_named(f"scsynth@127.0.0.1:{port}", mix=Mix(pans={"body": 0.3})) as sounder:
                begun(sounder, 0.2)
                sounds = some(0.3, 2)
                sounder.play(sounds, STORE)
                until(lambda: sounder.status().sent == len(sounds), "all to be sent")
                during = str(other.query_tree())
                assert "scorebreath_master_2_limited" in during
                assert "scorebreath_place" in during
            until(lambda: str(other.query_tree()) == before, "it to leave")
            assert host.trouble() == ""
            assert not [line for line in host._said if "FAILURE" in line and "/n_free" not in line]
        finally:
            other.disconnect()
            host.close()


@pytest.mark.jack
@pytest.mark.skipif(shutil.which("jackd") is None or shutil.which("scsynth") is None, reason="needs jackd and scsynth")
def test_somebody_elses_engine_that_is_started_anew_is_found_again(monkeypatch: pytest.MonkeyPatch) -> None:
    troubles: list[str] = []
    with jack_server(synchronous=False):
        host = StartedBackend(External())
        host.start()
        assert host._link is not None
        port = host._link._socket.getpeername()[1]
        monkeypatch.setattr(process, "free_port", lambda: port)
        try:
            with sounder_named(f"scsynth@127.0.0.1:{port}", on_trouble=troubles.append) as sounder:
                begun(sounder, 0.2)
                assert host.pid is not None
                os.kill(host.pid, signal.SIGKILL)
                until(lambda: not sounder.status().alive, "the loss to be noticed")
                host.start()
                until(lambda: sounder.status().restarts == 1, "it to be found again")
                sounds = some(time.time() - sounder.start_unix + 0.5, 1)
                sounder.play(sounds, STORE)
                until(lambda: sounder.status().sent == len(sounds), "it to go on")
                time.sleep(0.6)
                assert not [line for line in host._said if "FAILURE" in line and "/n_free" not in line]
        finally:
            host.close()
    assert "does not answer" in troubles[0]


def test_nobody_answers_there() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as deaf:
        deaf.bind(("127.0.0.1", 0))
        name = f"scsynth@127.0.0.1:{deaf.getsockname()[1]}"
        with pytest.raises(EngineError, match="nothing answers there"):
            sounder_named(name)


@pytest.fixture
def null_device(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An ALSA device that takes everything, as fast as it comes."""
    usual = Path("/usr/share/alsa/alsa.conf")
    if not usual.exists():
        pytest.skip("ALSA's own configuration is not installed")
    own = tmp_path / "asound.conf"
    own.write_text(
        f'<{usual}>\npcm.!default {{ type plug slave.pcm "null" }}\npcm.nothing {{ type plug slave.pcm "null" }}\n'
    )
    monkeypatch.setenv("ALSA_CONFIG_PATH", str(own))


def test_the_embedded_engine_boots_and_takes_what_it_is_told(null_device: None) -> None:
    """Its clock runs free on such a device, so nothing is said of times."""
    try:
        sounder = sounder_named("embedded")
    except EngineError as error:
        pytest.skip(f"no sound device, not even one of nothing: {error}")
    with sounder:
        begun(sounder, 0.2)
        sounds = some(0.3, 1)
        sounder.play(sounds, STORE)
        sounder.move(0.4, "body", Heard(mouth=2.0), 0.1)
        sounder.cut(0.9, [one.event for one in sounds], 0.05)
        until(lambda: sounder.status().sent >= len(sounds) + 1, "all to be sent")
        time.sleep(0.3)
        backend = sounder._backend
        assert isinstance(backend, StartedBackend)
        assert not [line for line in backend._said if "FAILURE" in line and "n_set" not in line]
        pid = backend.pid
        assert "nanosynth" in sounder.status().engine
    assert pid is not None
    assert not _alive(pid)


def test_devices_are_listed_and_a_wrong_one_is_refused(null_device: None) -> None:
    found = devices("embedded")
    if not found.names:
        pytest.skip(found.about)
    assert "ALSA : nothing" in found.names
    with pytest.raises(EngineError, match="device='loudspeaker' is not there") as caught:
        sounder_named("embedded", device=Device(name="loudspeaker"))
    assert "ALSA : nothing" in str(caught.value) + str(getattr(caught.value, "words", caught.value.args))
    with sounder_named("embedded", device=Device(name="ALSA : nothing")) as sounder:
        assert sounder.output_latency > 0


def test_who_has_no_devices_says_why() -> None:
    for name in ("silent", "scsynth@127.0.0.1:57110"):
        assert devices(name).names == ()
        assert devices(name).about


@pytest.mark.parametrize("name", ["scsynth@nowhere", "scsynth@host:0", "scsynth@host:99999", "loud", "embedded:x", ""])
def test_unknown_engines_are_refused_by_name(name: str) -> None:
    with pytest.raises(InputError, match="engine="):
        backend_named(name)


def test_every_name_of_the_table_is_an_engine() -> None:
    for name in NAMES:
        backend_named(name.replace("FILE", "/usr/bin/scsynth").replace("HOST:PORT", "127.0.0.1:57110"))
    with pytest.raises(InputError, match="has its own"):
        backend_named("scsynth@127.0.0.1:57110", Device(name="x"))


@pytest.mark.parametrize("lookahead", [0.0, 11.0, float("nan")])
def test_a_lookahead_out_of_range_is_refused(lookahead: float) -> None:
    with pytest.raises(InputError, match="lookahead="):
        sounder_named("silent", lookahead=lookahead)


def test_a_missing_engine_says_how_to_get_it() -> None:
    with pytest.raises(EngineError, match="not an executable file"):
        sounder_named("scsynth:/nowhere/scsynth")


def test_an_engine_without_a_device_says_so(tmp_path: Path) -> None:
    """Its own words come along."""
    program = tmp_path / "scsynth"
    program.write_text(
        "#!/bin/sh\n[ \"$1\" = -v ] && { echo 'scsynth 3.13.0'; exit 0; }\necho 'Jack server is not running'\nexit 1\n"
    )
    program.chmod(0o755)
    with pytest.raises(EnvironmentFailure, match="JACK") as caught:
        sounder_named(f"scsynth:{program}")
    assert "ended with status 1" in str(caught.value)


def test_media_that_are_missing_lose_one_sound_and_say_so() -> None:
    troubles: list[str] = []
    sounds = some(0.4, 1)
    with sounder_named("silent", on_trouble=troubles.append) as sounder:
        begun(sounder, 0.1)
        sounder.play(sounds, MemoryStore())
        until(lambda: sounder.status().waiting == 0 and sounder.status().sent >= 2, "the breath")
        until(lambda: sounder.status().lost == 1, "the count")
    assert len(troubles) == 1
    assert "is lost" in troubles[0]


def test_panic_drops_what_is_being_made_ready(monkeypatch: pytest.MonkeyPatch) -> None:
    with sounder_named("silent") as sounder:
        begun(sounder, 0.1)
        held, seen = threading.Event(), threading.Event()
        prepare = sounder._load

        def slow(played: Played) -> bool:
            seen.set()
            held.wait(PATIENCE)
            return prepare(played)

        monkeypatch.setattr(sounder, "_load", slow)
        sounder.play(some(0.5, 3), STORE)
        assert seen.wait(PATIENCE)
        sounder.panic()
        held.set()
        until(lambda: sounder._jobs.empty() and not sounder._shelf._users, "the worker")
        assert sounder.status().waiting == 0
        assert not list(sounder._folder.iterdir())


def test_files_and_buffers_are_given_back() -> None:
    with sounder_named("silent") as sounder:
        begun(sounder, 0.1)
        sounder.play(some(0.3, 3), STORE)
        until(lambda: sounder.status().sent == 9, "all to be sent")
        until(lambda: not sounder._conductor.here, "all to be over")
        assert not list(sounder._folder.iterdir())
        assert len(sounder._shelf._free) == 1024


def test_instruments_fit_into_datagrams() -> None:
    sizes = {name: len(instrument(name)) for name in ALL}
    assert max(sizes.values()) < 60_000, sizes


def test_closing_twice_and_playing_afterwards_do_nothing() -> None:
    sounder = sounder_named("silent")
    sounder.close()
    sounder.close()
    sounder.play(some(), STORE)
    assert sounder.status().sent == 0


def test_an_engine_that_hangs_is_killed_when_it_is_closed(tmp_path: Path) -> None:
    """Also when it neither answers nor quits."""
    if shutil.which("jackd") is None or shutil.which("scsynth") is None:
        pytest.skip("needs jackd and scsynth")
    with jack_server(synchronous=False):
        sounder = sounder_named("scsynth")
        backend = sounder._backend
        assert isinstance(backend, StartedBackend)
        pid = backend.pid
        assert pid is not None
        os.kill(pid, signal.SIGSTOP)
        sounder.close()
        assert not _alive(pid)


test_an_engine_that_hangs_is_killed_when_it_is_closed = pytest.mark.jack(
    test_an_engine_that_hangs_is_killed_when_it_is_closed
)


@pytest.mark.jack
@pytest.mark.skipif(shutil.which("jackd") is None or shutil.which("scsynth") is None, reason="needs jackd and scsynth")
def test_an_engine_does_not_outlive_whoever_started_it() -> None:
    code = (
        f"import sys, time; sys.path[:0] = {sys.path!r}\n"
        "from scorebreath.engine.live.making import sounder_named\n"
        "sounder = sounder_named('scsynth')\n"
        "print(sounder._backend.pid, flush=True)\n"
        "time.sleep(600)\n"
    )
    with jack_server(synchronous=False):
        owner = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        try:
            assert owner.stdout is not None
            engine = int(owner.stdout.readline())
            assert _alive(engine)
        finally:
            owner.kill()
            owner.communicate()
        until(lambda: not _alive(engine), "the engine to end")


def test_a_live_server_is_a_sounder() -> None:
    def takes(sounder: Sounder) -> str:
        return sounder.status().engine

    with LiveServer(backend_named("silent")) as made:
        assert takes(made) == "silent"


def test_nothing_of_ours_is_left_running() -> None:
    own = subprocess.run(
        ["ps", "-o", "args=", "--ppid", str(os.getpid())], capture_output=True, text=True, check=False
    ).stdout
    assert "lookalike.py -u" not in own
