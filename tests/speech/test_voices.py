"""The table of voices."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from scorebreath.errors import InputError, VoiceError, did_you_mean
from scorebreath.speech.voices import DEFAULT, ENGINES, list_voices, open_voice
from tests.speech.speaking import check, request


@pytest.mark.parametrize(
    ("name", "language", "whole", "spoken"),
    [("espeak", "en", "espeak:en-us", ("en-US", "en")), ("espeak", "de-AT", "espeak:de", ("de",)),
     ("ESPEAK:en_GB", "de", "espeak:en-gb", ("en-GB", "en")), ("espeak:+F3", "de", "espeak:de+f3", ("de",)),
     ("espeak:en-us+f3", "en", "espeak:en-us+f3", ("en-US", "en")), ("tone", "de", "tone", ("mul",))],
)  # fmt: skip
def test_a_name_opens_a_voice_that_speaks(name: str, language: str, whole: str, spoken: tuple[str, ...]) -> None:
    with open_voice(name, language) as voice:
        assert voice.details.voice == whole
        assert voice.details.languages == spoken
        text = "Am Abend, in the evening."
        (speech,) = voice.speak_all([request(text)])
        check(text, speech)
        assert len(speech.words) >= 4
        assert voice.details.sample_rate == speech.sample_rate


UNKNOWN = {
    (
        "espek",
        "en",
    ): "voice 'espek' is unknown; there are: espeak, piper, recording, tone, joe, best; did you mean",
    ("kokoro-af", "en"): "voice 'kokoro-af' is unknown; there are: espeak, piper, recording, tone, joe, best",
    ("espeak:", "en"): "voice 'espeak:': expected espeak:LANGUAGE+VARIANT",
    ("tone:loud", "en"): "voice 'tone:loud': expected tone alone",
    ("espeak:en+f33", "en"): "voice 'espeak:en+f33': there is no variant 'f33'; did you mean f3",
    ("espeak:xq", "en"): "voice 'espeak:xq': eSpeak NG has no language 'xq'",
}


@pytest.mark.parametrize(("name", "language"), UNKNOWN)
def test_unknown_names_say_what_there_is(name: str, language: str) -> None:
    with pytest.raises(InputError) as caught:
        open_voice(name, language)
    assert str(caught.value).startswith(UNKNOWN[name, language])


@pytest.mark.parametrize("name", ["espeak", "espeak:en-AU", "espeak:+f2", "espeak:en+Mr serious", "tone"])
def test_the_name_on_record_opens_the_same_voice_whatever_the_language(name: str) -> None:
    with open_voice(name, "de-DE") as first, open_voice(first.details.voice, "ja") as second:
        assert second.details == first.details
        text = "One, two."
        (one,), (other,) = first.speak_all([request(text)]), second.speak_all([request(text)])
        assert np.array_equal(one.samples, other.samples)


NO_LANGUAGE = {
    "tlh": "; expected a code as en, de or fr-FR",
    "german": "; did you mean de?",
    "": "; expected a code as en, de or fr-FR",
}


@pytest.mark.parametrize("language", NO_LANGUAGE)
def test_a_language_it_does_not_speak_is_the_user_s_to_mend(language: str) -> None:
    with pytest.raises(InputError) as caught:
        open_voice("espeak", language)
    assert str(caught.value) == f"language {language!r}: voice 'espeak' does not speak it{NO_LANGUAGE[language]}"


def test_every_row_says_what_one_must_know() -> None:
    rows = list_voices()
    assert {row.name for row in rows} >= {DEFAULT, "tone"}
    assert {row.engine for row in rows}
    for row in rows:
        assert row.licence
        assert row.provenance
        assert row.installed == (row.how == "")
        assert row.installed == bool(row.version)
        assert row.languages
        assert row.name.partition(":")[0] in ENGINES


def test_a_missing_engine_is_a_row_that_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "espeakng_loader", None)
    row = next(row for row in list_voices() if row.name == "espeak")
    assert not row.installed
    assert "pip install espeakng-loader" in row.how
    with pytest.raises(VoiceError, match="pip install espeakng-loader"):
        open_voice("espeak", "en")


def test_the_table_loads_no_voice() -> None:
    root = str(Path(__file__).resolve().parents[2])
    code = f"import sys; sys.path.insert(0, {root!r}); import scorebreath.speech.voices; print(*sorted(sys.modules))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "scorebreath.speech.voices" in loaded
    assert not {"numpy", "pydantic", "espeakng_loader", "parselmouth", "ctypes"} & set(loaded)


def test_names_far_from_all_are_not_guessed_at() -> None:
    assert did_you_mean("qqqq", ["espeak", "tone"]) == ""
    assert did_you_mean("TONE", ["espeak", "tone"]) == "; did you mean tone?"
