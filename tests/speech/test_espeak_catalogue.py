"""Languages and variants, read from the data folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from scorebreath.errors import InputError, VoiceError
from scorebreath.speech.espeak.catalogue import catalogue
from scorebreath.speech.espeak.launch import installed
from scorebreath.speech.espeak.library import Library
from scorebreath.speech.espeak.prosody import settings
from scorebreath.speech.espeak.voice import known

CODES = {
    "en": "en-us", "EN": "en-us", "en-GB": "en-gb", "en_US": "en-us", "de": "de", "fr": "fr-fr", "pt": "pt",
    "zh": "cmn", "pt-br": "pt-br", "no": "nb", "de-DE": "de", "de_DE": "de", "de-AT": "de", "de-Latn-AT-1996": "de",
    "en-AU": "en-us", "en-UK": "en-gb", "en-GB-oxendict": "en-gb", "en-GB-x-ours": "en-gb", "en-GB-x-rp": "en-gb-x-rp",
    "fr-CA": "fr-fr", "fr-CH": "fr-ch", "es-MX": "es-419", "es-ES": "es", "zh-Hant-TW": "cmn",
}  # fmt: skip


@pytest.mark.parametrize("asked", CODES)
def test_a_code_finds_its_voice(asked: str) -> None:
    assert known().choose(asked).language.code == CODES[asked]


def test_every_language_answers_to_its_own_code() -> None:
    for language in known().languages:
        found = known().find(language.code)
        assert found is not None
        assert found.code == language.code


MEANT = {
    "german": "de", "German": "de", "germn": "de", "english": "en", "chinese": "cmn", "brazil": "pt-br", "irish": "ga",
    "en-uss": "en-us", "cherokee": "chr-us-qaaa-x-west",
}  # fmt: skip


@pytest.mark.parametrize("asked", MEANT)
def test_a_language_s_name_is_answered_with_its_code(asked: str) -> None:
    assert known().find(asked) is None
    assert known().hint(asked) == f"; did you mean {MEANT[asked]}?"
    assert known().find(MEANT[asked]) is not None


@pytest.mark.parametrize("asked", ["xq", "xq-DE", "spa", "swe", "deutsch", "", "-", "de-", "geschwurbel", "en-a"])
def test_what_is_near_no_language_is_not_guessed_at(asked: str) -> None:
    assert known().find(asked) is None
    assert known().hint(asked) == "; expected a code as en, de or fr-FR"


def test_languages_without_a_dictionary_are_not_offered() -> None:
    """Faroese and two others have a voice file, but nothing to read with."""
    codes = {code for language in known().languages for code, _ in language.codes}
    assert not codes & {"fo", "xex", "kaa"}
    assert len(known().languages) > 130


def test_variants_in_any_case_and_with_spaces() -> None:
    assert known().choose("de", "F2").variant == "f2"
    assert known().choose("en", "mr serious").name == "en-us+Mr serious"


def test_unknown_names_are_answered_with_close_ones() -> None:
    with pytest.raises(InputError, match=r"did you mean en-us\?$"):
        known().choose("en-uss")
    with pytest.raises(InputError, match=r"did you mean klatt"):
        known().choose("en", "klat")


def test_a_variant_changes_the_definition_but_not_the_language() -> None:
    plain, woman = known().choose("en"), known().choose("en", "f3")
    assert plain.pitch == (82, 118)
    assert woman.pitch == (140, 240)
    lines = woman.definition().splitlines()
    assert "language variant" not in lines
    assert not any(line.startswith("echo") for line in lines), "an echo would fill the closures"
    assert "language en-us 2" in lines


def test_only_a_continuation_changes_the_tunes() -> None:
    english = known().choose("en")
    assert english.definition() + "tunes NULL c2\n" == english.definition(continuing=True)
    french = known().choose("fr")
    assert french.definition() == french.definition(continuing=True), "its own goes on by itself"


@pytest.mark.parametrize("code", ["en", "de", "fr", "zh", "cs"])
def test_our_definition_sounds_as_the_library_s_own_voice(
    code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The lines without comments are the same voice as the file itself."""
    monkeypatch.chdir(tmp_path)
    chosen = known().choose(code)
    path = next(
        path
        for path in (known().folder / "lang").rglob("*")
        if path.is_file() and f"language {chosen.language.code}" in path.read_text(errors="replace").lower()
    )
    ours = settings(chosen)
    raw = type(ours)(definition=path.read_bytes().decode("utf-8", "surrogateescape"))
    assert installed().synthesise("1 2 3.", ours)[0] == installed().synthesise("1 2 3.", raw)[0]


def test_a_folder_without_voices_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(VoiceError, match="no voices in"):
        catalogue(str(tmp_path))


def test_a_deep_folder_and_one_with_a_plus_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The library cuts paths at 160 bytes, and takes what follows a plus for a variant."""
    deep = tmp_path / ("+" + "x" * 200)
    deep.mkdir()
    monkeypatch.chdir(deep)
    (deep / "data").symlink_to(installed().data)
    far = Library(path=installed().path, data=str(deep / "data"))
    english = settings(known().choose("en"))
    assert far.synthesise("Hello.", english) == installed().synthesise("Hello.", english)
    assert [path.name for path in deep.iterdir()] == ["data"], "nothing is left behind"


def test_data_that_is_not_there_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    lost = Library(path=installed().path, data=str(tmp_path / "nowhere"))
    with pytest.raises(OSError, match="finds no data"):
        lost.synthesise("Hello.", settings(known().choose("en")))
