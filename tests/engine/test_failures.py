"""Every way an engine fails, loud or silent, is one EngineError with the engine's own words."""

from __future__ import annotations

import dataclasses
import io
import shutil
import struct
import sys
import textwrap
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from supriya import Score as Commands

from scorebreath.engine import staging
from scorebreath.engine.engines import Embedded, Engine, External
from scorebreath.engine.failures import SIGNS, ending, failure, words
from scorebreath.engine.offline import render
from scorebreath.engine.run import COMMANDS, Needs, run
from scorebreath.errors import EngineError, EnvironmentFailure, InputError, ScoreError
from scorebreath.media.store import Media, MemoryStore
from scorebreath_synthdefs import SPEECH, synthdef
from tests.engine.sounding import babble, inspiration, noise, score, utterance

FRAMES = 4800
BREATH = "scorebreath_mouth_male"
ENGINES = [
    pytest.param(Embedded(), id="embedded"),
    pytest.param(
        External(),
        id="scsynth",
        marks=[
            pytest.mark.scsynth,
            pytest.mark.skipif(shutil.which("scsynth") is None, reason="no scsynth on PATH"),
        ],
    ),
]


def told(build: Callable[[Commands], None], *, loaded: bool = True) -> bytes:
    """A file of commands that ends after 0.12 s, with everything freed."""
    made = Commands(output_bus_channel_count=1, input_bus_channel_count=0, buffer_count=4)
    with made.at(0.0):
        if loaded:
            made.add_synthdefs(synthdef(BREATH), synthdef(SPEECH))
        build(made)
    with made.at(0.12):
        made.free_group_children(made.root_node)
    return b"".join(struct.pack(">i", len(datagram)) + datagram for datagram in made.iterate_datagrams())


def a_breath(made: Commands) -> None:
    made.add_synth(synthdef(BREATH))


def a_missing_file(made: Commands) -> None:
    buffer = made.add_buffer(file_path=Path("nowhere.wav"))
    made.add_synth(synthdef(SPEECH), buffer=buffer.id_)


def a_crowd(made: Commands) -> None:
    for _ in range(3000):
        made.add_synth(synthdef(BREATH))


FINE = told(a_breath)
BROKEN = {
    "unknown instrument": (told(a_breath, loaded=False), "does not have an instrument", "SynthDef not found"),
    "missing file": (told(a_missing_file), "cannot read a sound file", "nowhere.wav"),
    "missing unit": (FINE.replace(b"\x0aWhiteNoise", b"\x0aWhiteNoisX"), "lacks a unit generator", "WhiteNoisX"),
    "unknown command": (FINE.replace(b"/s_new\0", b"/s_nex\0"), "does not know a command", "/s_nex"),
    "too many at once": (told(a_crowd), "too many sounds at once", "FAILURE IN SERVER"),
    "out of order": (FINE + FINE, "out of order", "out-of-order"),
    "truncated": (FINE[: len(FINE) // 2], "cannot read its commands", "OSC packet"),
    "empty": (b"", "cannot read its commands", "empty"),
    "not OSC": (b"no OSC in here" * 9, "cannot read its commands", "OSC packet"),
    "stops early": (FINE[: FINE.rindex(b"#bundle") - 4], "", ""),
}


@pytest.mark.parametrize("engine", ENGINES)
def test_the_commands_work_unbroken(engine: Engine, tmp_path: Path) -> None:
    (tmp_path / COMMANDS).write_bytes(FINE)
    made = run(engine, tmp_path, frames=FRAMES, sample_rate=48000, needs=Needs(buffers=1, nodes=1))
    assert made.stat().st_size >= FRAMES * 4
    assert any(made.read_bytes())


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("case", BROKEN)
def test_broken_commands_are_one_error(case: str, engine: Engine, tmp_path: Path) -> None:
    commands, meaning, said = BROKEN[case]
    (tmp_path / COMMANDS).write_bytes(commands)
    with pytest.raises(EngineError) as caught:
        run(engine, tmp_path, frames=FRAMES, sample_rate=48000, needs=Needs(buffers=1, nodes=1))
    assert f"the {engine.name} engine" in str(caught.value)
    assert meaning in str(caught.value)
    assert said in "\n".join(caught.value.output)


@dataclass(frozen=True, kw_only=True)
class Fake:
    """An engine that is a few lines of Python."""

    code: str
    name: str = "fake"
    about: str = ""
    remedy: str = ""

    def command(self) -> tuple[str, ...]:
        return (sys.executable, "-c", textwrap.dedent(self.code))

    def version(self) -> str:
        return "1"


FAKES = {
    "hangs": ("import time; print('thinking', flush=True); time.sleep(60)", "was not done after 0.5 s", "thinking"),
    "crashes": ("import os; print('farewell', flush=True); os.abort()", "was ended by SIGABRT", "farewell"),
    "gives up": ("import sys; print('I refuse'); sys.exit(7)", "ended with status 7", "I refuse"),
    "does nothing": ("print('all done')", "made 0 frames of 48000", "all done"),
    "does too little": ("open('mix.raw', 'wb').write(bytes(400))", "made 100 frames of 48000", ""),
    "makes nonsense": (
        "import array; array.array('f', [float('nan')] * 60000).tofile(open('mix.raw', 'wb'))",
        "not finite",
        "",
    ),
    "babbles": ("for i in range(20000): print('ERROR number', i)", "reports an error", "... and 19992 more"),
}


@pytest.mark.parametrize("case", FAKES)
def test_a_failing_engine_is_one_error_and_leaves_nothing(
    case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, meaning, said = FAKES[case]
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    stream = io.BytesIO()
    with pytest.raises(EngineError) as caught:
        render(
            score([inspiration(0.1, noise())], 1.0), MemoryStore(), stream,
            engine=Fake(code=code), timeout=0.5 if case == "hangs" else 30,
        )  # fmt: skip
    assert meaning in str(caught.value)
    assert said in str(caught.value)
    assert len(caught.value.output) <= 9
    assert stream.getvalue() == b""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("/nonexistent/scsynth", "is not an executable file"),
        ("/", "is not an executable file"),
        (__file__, "is not an executable file"),
        (sys.executable, "is not a SuperCollider server"),
    ],
)
def test_a_wrong_executable_is_refused(path: str, words: str) -> None:
    with pytest.raises(EngineError, match=words):
        render(score([], 0.1), MemoryStore(), io.BytesIO(), engine=f"scsynth:{path}")


def test_media_that_are_missing_are_named() -> None:
    full, empty = MemoryStore(), MemoryStore()
    name = full.put(babble(0.1, 22050, 1), 22050, "speech")
    with pytest.raises(ScoreError, match=name[:12]):
        render(score([utterance(0.0, name, 0.1)], 0.2, full), empty, io.BytesIO())


def test_media_that_are_not_finite_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    store = MemoryStore()
    name = store.put(babble(0.1, 22050, 1), 22050, "speech")
    sick = Media(samples=store.get(name).samples * float("nan"), sample_rate=22050, kind="speech")
    made = score([utterance(0.0, name, 0.1)], 0.2, store)
    monkeypatch.setattr(store, "get", lambda _: sick)
    with pytest.raises(ScoreError, match="not finite"):
        render(made, store, io.BytesIO())


def test_media_of_another_length_are_refused() -> None:
    store = MemoryStore()
    name = store.put(babble(0.1, 22050, 1), 22050, "speech")
    made = score([utterance(0.0, name, 0.1)], 0.2, store)
    wrong = dataclasses.replace(made.media[name], frames=22050)
    with pytest.raises(ScoreError, match=f"{name[:12]}.* last 0.1 s, not 1 s"):
        render(dataclasses.replace(made, media={name: wrong}), store, io.BytesIO())


def test_a_disk_without_room_is_said_before_anything_is_made() -> None:
    long_breath = inspiration(0.0, noise(hold=1e8))
    with pytest.raises(EnvironmentFailure, match=r"needs .* GB .* TMPDIR"):
        render(score([long_breath], 1e8), MemoryStore(), io.BytesIO())


def test_a_disk_that_fills_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    store = MemoryStore()
    name = store.put(babble(0.1, 22050, 1), 22050, "speech")
    monkeypatch.setattr(staging, "write_wave", full)
    with pytest.raises(EnvironmentFailure, match="disk is full"):
        render(score([utterance(0.0, name, 0.1)], 0.2, store), store, io.BytesIO())


@pytest.mark.parametrize("rate", [0, -1, 15999, 192001])
def test_a_rate_out_of_range_is_refused(rate: int) -> None:
    with pytest.raises(InputError, match=f"sample_rate={rate} must be in 16000..192000"):
        render(score([], 0.1), MemoryStore(), io.BytesIO(), sample_rate=rate)


@pytest.mark.parametrize(("sign", "meaning"), SIGNS)
def test_every_sign_is_seen_in_a_line(sign: str, meaning: str) -> None:
    found = failure(["start time 0", f"*** {sign} (something)", "nextOSCPacket 0.1"])
    assert found is not None
    assert meaning in {mean for word, mean in SIGNS if word in sign}
    assert found[1] == (f"*** {sign} (something)",)


def test_harmless_lines_are_no_failure() -> None:
    assert failure(["nextOSCPacket 0.25", "SC FFT global init: cosTable initialised."]) is None
    assert failure(["*** ERROR: dlopen '/x/Other.so' err 'undefined symbol'"]) is None


def test_the_most_telling_sign_wins() -> None:
    found = failure(["FAILURE IN SERVER /s_new SynthDef not found", "UGen 'X' not installed."])
    assert found is not None
    assert found[0] == "it lacks a unit generator"
    assert len(found[1]) == 2


def test_words_are_few_and_different() -> None:
    assert words(["a", "a", " b ", "", "a"]) == ("a", "b")
    assert words(str(number) for number in range(100))[-1] == "... and 92 more"


def test_an_ending_is_said_in_words() -> None:
    assert [ending(0), ending(2), ending(-9), ending(-200)] == [
        "ended with status 0", "ended with status 2", "was ended by SIGKILL", "was ended by signal 200",
    ]  # fmt: skip
