"""The cache of utterances: what it gives is what the voice would have given, whatever happens to its files."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import InputError
from scorebreath.media.store import MemoryStore
from scorebreath.parameters.table import Parameters
from scorebreath.pipeline import compile_text
from scorebreath.score.document import Score
from scorebreath.spans import Span, join
from scorebreath.speech.cache import keys
from scorebreath.speech.cache.shelf import FOLDER, LIMIT, Shelf, default_folder, size_of
from scorebreath.speech.cache.voice import STRETCH, CachedVoice, cached
from scorebreath.speech.model import Speech, SpeechRequest, Voice, VoiceDetails
from scorebreath.speech.piper.voice import PiperVoice
from scorebreath.speech.tone.voice import ToneVoice
from scorebreath.speech.voices import open_voice
from tests.speech.neural import needs_joe
from tests.speech.speaking import request

SENTENCE = "The old ferryman rowed slowly over the river."
OTHER = {"rate": 1.25, "pitch": 0.9, "closing": "continuing", "text": join([("no", Span(0, 2))])}
"""Another value of every field of a request that any voice heeds."""


class Counting(Voice):
    """The tone voice, counting what it is asked for."""

    def __init__(self, **other: object) -> None:
        self._tone, self._other = ToneVoice(), other
        self.asked: list[SpeechRequest] = []
        self.questions = 0

    @property
    def details(self) -> VoiceDetails:
        return replace(self._tone.details, **self._other)  # type: ignore[arg-type]

    @property
    def reference_db(self) -> float:
        self.questions += 1
        return self._tone.reference_db

    def speak(self, request: SpeechRequest) -> Speech:
        self.asked.append(request)
        return self._tone.speak(request)

    def speak_all(self, requests: Iterable[SpeechRequest]) -> Iterator[Speech]:
        """A few ahead, as a voice with a worker does."""
        waiting: list[Speech] = []
        for one in requests:
            waiting.append(self.speak(one))
            if len(waiting) > 3:
                yield waiting.pop(0)
        yield from waiting

    def syllables(self, words: Sequence[str]) -> Sequence[int]:
        self.questions += 1
        return self._tone.syllables(words)

    def close(self) -> None:
        self._tone.close()


def equal(one: Speech, two: Speech) -> bool:
    """Bit for bit."""
    same = all(getattr(one, field.name) == getattr(two, field.name) for field in fields(one) if field.name != "samples")
    return same and one.samples.dtype == two.samples.dtype and one.samples.tobytes() == two.samples.tobytes()


def utterances(shelf: Shelf) -> list[Path]:
    return sorted((shelf.folder / "utterances").glob("*/*.json"))


placed = st.builds(
    lambda text, at, rate, closing: SpeechRequest(
        text=join([(text, Span(at, at + len(text)))]), closing=closing, rate=rate
    ),
    st.sampled_from(["Yes.", "The rain came in.", "...", "Is it you?", "Ünter uns"]),
    st.integers(0, 500),
    st.sampled_from([0.8, 1.0]),
    st.sampled_from(["final", "continuing", "question"]),
)


@given(asked=st.lists(placed, max_size=12), before=st.lists(placed, max_size=6))
def test_what_is_remembered_is_what_would_be_said(
    tmp_path_factory: pytest.TempPathFactory, asked: list[SpeechRequest], before: list[SpeechRequest]
) -> None:
    shelf = Shelf(tmp_path_factory.mktemp("cache"))
    fresh = ToneVoice()
    with CachedVoice(Counting(), shelf) as first:
        list(first.speak_all(before))
    voice = Counting()
    with CachedVoice(voice, shelf) as second:
        got = list(second.speak_all(asked))
        assert second.spoken == len(voice.asked)
        assert second.spoken + second.kept == len(asked)
    assert len(got) == len(asked)
    assert all(equal(one, fresh.speak(two)) for one, two in zip(got, asked, strict=True))
    known = {keys.request_key("", one, context=False) for one in before}
    new = {keys.request_key("", one, context=False) for one in asked} - known
    assert len(voice.asked) == len(new)


def test_a_long_run_of_what_is_kept_does_not_wait_for_the_voice(tmp_path: Path) -> None:
    """Also beyond a whole stretch, and with something new at its end."""
    several = [request(f"Number {index}.") for index in range(3 * STRETCH)]
    with CachedVoice(Counting(), Shelf(tmp_path)) as first:
        list(first.speak_all(several))
    voice = Counting()
    with CachedVoice(voice, Shelf(tmp_path)) as second:
        taken: list[SpeechRequest] = []

        def asked() -> Iterator[SpeechRequest]:
            for one in [*several, request("This one is new.")]:
                taken.append(one)
                yield one

        said = second.speak_all(asked())
        next(said)
        assert len(taken) <= STRETCH
        rest = list(said)
    assert len(rest) == len(several)
    assert [one.text.text for one in voice.asked] == ["This one is new."]


@pytest.mark.parametrize("field", [field.name for field in fields(SpeechRequest)])
def test_every_field_of_a_request_is_in_its_key(field: str) -> None:
    """Before and after only for voices that heed them."""
    one = request(SENTENCE)
    two = replace(one, **{field: OTHER.get(field, "something else")})  # type: ignore[arg-type]
    assert keys.request_key("v", one, context=True) != keys.request_key("v", two, context=True)
    alike = keys.request_key("v", one, context=False) == keys.request_key("v", two, context=False)
    assert alike == (field in keys.CONTEXT)


def test_a_value_that_no_key_knows_is_not_passed_over() -> None:
    with pytest.raises(TypeError, match="no place in a key"):
        keys.request_key("v", request(SENTENCE, before=["a", "list"]), context=True)


def test_places_count_from_the_first() -> None:
    early, late, parted = (
        SpeechRequest(text=join([("ab", Span(at, at + 2)), ("cd", Span(then, then + 2))]), closing="final")
        for at, then in ((0, 2), (70, 72), (0, 3))
    )
    assert keys.request_key("v", early, context=False) == keys.request_key("v", late, context=False)
    assert keys.request_key("v", early, context=False) != keys.request_key("v", parted, context=False)


@pytest.mark.parametrize("field", ["engine", "voice", "version", "fingerprint"])
def test_another_voice_or_version_speaks_anew(tmp_path: Path, field: str) -> None:
    with CachedVoice(Counting(), Shelf(tmp_path)) as first:
        first.speak(request(SENTENCE))
    other = Counting(**{field: "another"})
    with CachedVoice(other, Shelf(tmp_path)) as second:
        second.speak(request(SENTENCE))
    assert len(other.asked) == 1


def test_a_changed_program_speaks_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = keys.voice_key(Counting().details)
    assert before == keys.voice_key(Counting().details)
    monkeypatch.setattr(keys, "code_digest", lambda: "of other code")
    assert keys.voice_key(Counting().details) != before


BREAKS = {
    "empty": lambda path: path.write_bytes(b""),
    "torn": lambda path: path.write_bytes(path.read_bytes()[: path.stat().st_size // 2]),
    "one byte": lambda path: path.write_bytes(path.read_bytes()[:-3] + b"\x01" + path.read_bytes()[-2:]),
    "foreign": lambda path: path.write_bytes(b'{"schema": "something/1"}'),
    "list": lambda path: path.write_bytes(b"[[[[]]]]"),
    "gone": lambda path: path.unlink(),
}


@pytest.mark.parametrize("kind", ["utterances", "speech", "voices"])
@pytest.mark.parametrize("how", BREAKS)
def test_a_broken_file_is_nothing_and_is_made_again(tmp_path: Path, kind: str, how: str) -> None:
    fresh = ToneVoice().speak(request(SENTENCE))
    shelf = Shelf(tmp_path)
    with CachedVoice(Counting(), shelf) as first:
        first.speak(request(SENTENCE))
        assert first.syllables(["river"]) == [2]
    (broken,) = [path for path in (tmp_path / kind).rglob("*") if path.is_file()]
    BREAKS[how](broken)
    for spoken in (0 if kind == "voices" else 1, 0):
        voice = Counting()
        with CachedVoice(voice, Shelf(tmp_path)) as again:
            assert equal(again.speak(request(SENTENCE)), fresh)
            assert again.syllables(["river"]) == [2]
        assert len(voice.asked) == spoken


def test_numbers_out_of_their_range_are_no_utterance(tmp_path: Path) -> None:
    shelf = Shelf(tmp_path)
    with CachedVoice(Counting(), shelf) as first:
        first.speak(request(SENTENCE))
    (path,) = utterances(shelf)
    told = json.loads(path.read_text())
    changes: list[dict[str, Any]] = [
        {"media": "../../etc/passwd"}, {"sample_rate": 8000}, {"key": "0" * 64}, {"words": [{}]}, {"pitch": None},
    ]  # fmt: skip
    samples = tmp_path / "speech" / f"{told['media']}.wav"
    data = samples.read_bytes()
    for change in changes:
        path.write_text(json.dumps(told | change))
        assert shelf.get(path.stem) is None
        assert not path.exists()
        path.write_text(json.dumps(told))
        samples.write_bytes(data)
        assert shelf.get(path.stem) is not None


def test_two_processes_share_a_folder(tmp_path: Path) -> None:
    """Each speaks the same forty groups; all are right, and nothing else is left."""
    code = (
        "import sys; from scorebreath.speech.cache.shelf import Shelf;"
        "from scorebreath.speech.cache.voice import CachedVoice;"
        "from scorebreath.speech.tone.voice import ToneVoice; from tests.speech.speaking import request;"
        "from pathlib import Path;"
        "voice = CachedVoice(ToneVoice(), Shelf(Path(sys.argv[1])));"
        "said = list(voice.speak_all(request(f'Number {i} of many.') for i in range(40)));"
        "assert len(said) == 40; voice.close(); print(voice.spoken + voice.kept)"
    )
    root = Path(__file__).resolve().parents[2]
    environment = {**os.environ, "PYTHONPATH": str(root)}
    running = [
        subprocess.Popen([sys.executable, "-c", code, str(tmp_path)], env=environment, stdout=subprocess.PIPE)
        for _ in range(3)
    ]
    assert [process.communicate(timeout=120)[0].strip() for process in running] == [b"40"] * 3
    shelf = Shelf(tmp_path)
    assert shelf.check() == (40, 0)
    assert not list(tmp_path.rglob("*.part"))


def test_the_cache_never_grows_beyond_its_limit_and_keeps_what_was_used_last(tmp_path: Path) -> None:
    limit = 1_500_000
    shelf = Shelf(tmp_path, limit)
    first = request("The one that is used again and again.")
    with CachedVoice(Counting(), shelf) as voice:
        voice.speak(first)
        for index in range(40):
            voice.speak(request(f"This is number {index} of rather many."))
            for holding in shelf.holdings():  # as if each were said a minute after the one before
                os.utime(holding.path, (holding.used - 60, holding.used - 60))
            voice.speak(first)
            assert sum(holding.size for holding in shelf.holdings()) <= limit
    assert 0 < len(utterances(shelf)) < 40
    again = Counting()
    with CachedVoice(again, Shelf(tmp_path, limit)) as voice:
        voice.speak(first)
    assert not again.asked


def test_what_is_larger_than_the_cache_is_not_kept(tmp_path: Path) -> None:
    shelf = Shelf(tmp_path, 1000)
    with CachedVoice(Counting(), shelf) as voice:
        voice.speak(request(SENTENCE))
    assert not utterances(shelf)


def test_a_folder_that_cannot_be_written_costs_nothing_but_time(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    shelf = Shelf(tmp_path / "file" / "cache")
    fresh = ToneVoice().speak(request(SENTENCE))
    with CachedVoice(Counting(), shelf) as voice:
        assert equal(voice.speak(request(SENTENCE)), fresh)
        assert equal(voice.speak(request(SENTENCE)), fresh)
        assert voice.spoken == 2
    assert str(tmp_path / "file") in shelf.problem


def test_one_voice_can_be_cleared(tmp_path: Path) -> None:
    shelf = Shelf(tmp_path)
    for name in ("tone:a", "tone:b"):
        with CachedVoice(Counting(voice=name), shelf) as voice:
            list(voice.speak_all([request("One."), request(f"Two, says {name}.")]))
    assert shelf.clear("tone:a") == 2
    assert {shelf.voice_of(path) for path in utterances(shelf)} == {"tone:b"}
    assert shelf.check() == (2, 0)
    assert shelf.clear() == 2
    assert not list(shelf.holdings())


@pytest.mark.parametrize("text", ["", "many", "-3GB", "3 XB", "1e400"])
def test_a_limit_that_is_no_size_is_refused(text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match="expected a size"):
        size_of(text, LIMIT)
    if text:
        monkeypatch.setenv(LIMIT, text)
        with pytest.raises(InputError, match=LIMIT):
            Shelf(tmp_path)


def test_the_environment_says_where_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert default_folder() is None
    monkeypatch.setenv(FOLDER, str(tmp_path))
    assert default_folder() == tmp_path
    monkeypatch.delenv(FOLDER)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    if sys.platform == "linux":
        assert default_folder() == tmp_path / "scorebreath"


def test_only_voices_that_repeat_themselves_are_kept(tmp_path: Path) -> None:
    shelf = Shelf(tmp_path)
    assert isinstance(cached(Counting(engine="slow"), shelf), CachedVoice)
    for voice in (Counting(), Counting(engine="slow", deterministic=False)):
        assert cached(voice, shelf) is voice


PROSE = (
    "The rain came in from the west, and stayed until the evening. Nobody had asked it to. "
    "In the harbour the boats lay close together, as cattle do. An old man counted them twice, and went home."
)


def _breathing_otherwise(shelf: Shelf, name: str) -> tuple[CachedVoice, CachedVoice]:
    scores: list[Score] = []
    voices: list[CachedVoice] = []
    for share in (1.0, 0.3):
        with open_voice(name, "en") as voice, CachedVoice(voice, shelf) as memory:
            media = MemoryStore()
            scores.append(compile_text(PROSE, voice=memory, media=media, parameters=Parameters(nose_share=share)))
            if voices and isinstance(voice, PiperVoice):  # espeak's is started when it is opened
                assert not voice.pids, "a model was loaded for nothing"
            voices.append(memory)
    assert scores[0] != scores[1]
    assert scores[0].media.keys() == scores[1].media.keys()
    return voices[0], voices[1]


@pytest.mark.parametrize("name", ["espeak", pytest.param("joe", marks=needs_joe)])
def test_another_way_of_breathing_speaks_nothing_again(tmp_path: Path, name: str) -> None:
    first, second = _breathing_otherwise(Shelf(tmp_path), name)
    assert (first.kept, second.spoken) == (0, 0)
    assert first.spoken == second.kept > 3


def test_a_remembered_score_is_the_fresh_one(tmp_path: Path) -> None:
    text = (Path(__file__).resolve().parents[2] / "examples" / "forecast.txt").read_text(encoding="utf-8")
    found = []
    for memory in (False, True, True):
        with open_voice("espeak", "en") as voice:
            who = CachedVoice(voice, Shelf(tmp_path)) if memory else voice
            media = MemoryStore()
            found.append((compile_text(text, voice=who, media=media), media))
            who.close()
    assert found[0][0] == found[1][0] == found[2][0]
    for sha in found[0][0].media:
        assert np.array_equal(found[0][1].get(sha).samples, found[2][1].get(sha).samples)
