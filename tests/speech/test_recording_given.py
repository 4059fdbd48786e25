"""Times that others have found: TextGrids as Praat writes them, JSON as Whisper does, and what is neither."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import parselmouth
import pytest
from parselmouth.praat import call

from scorebreath.errors import InputError
from scorebreath.speech.recording.given import Given, align, read_textgrid, read_words
from scorebreath.speech.recording.listen import spoken_of
from scorebreath.speech.recording.model import Alignment
from tests.speech.takes import take_of, written

TAKE = take_of(np.full(16_000, 0.1, dtype=np.float32), 8000)
"""Two seconds."""
WORDS = [("the", 0.1, 0.3), ("old", 0.3, 0.7), ("harbour", 1.0, 1.6)]
PHONES = [("DH", 0.1, 0.2), ("AH0", 0.2, 0.3), ("OW1", 0.3, 0.5), ("L", 0.5, 0.6), ("D", 0.6, 0.7)]


def grid(path: Path, tiers: dict[str, list[tuple[str, float, float]]], length: float = 2.0, how: str = "text") -> Path:
    made = call("Create TextGrid", 0.0, length, " ".join(f'"{name}"' for name in tiers).replace('"', ""), "")
    for number, labels in enumerate(tiers.values(), 1):
        edges = sorted({edge for _, start, end in labels for edge in (start, end)})
        for edge in edges:
            if 0 < edge < length:
                call(made, "Insert boundary", number, edge)
        for text, start, end in labels:
            call(made, "Set interval text", number, call(made, "Get interval at time", number, (start + end) / 2), text)
    call(made, f"Save as {how} file", str(path))
    return path


def aligned(given: Given, text: str = "The old harbour.") -> Alignment:
    return align(TAKE, written(text), given, lambda word: spoken_of(word, "en"))


@pytest.mark.parametrize("how", ["text", "short text", "binary"])
def test_a_textgrid_of_any_kind_is_read(tmp_path: Path, how: str) -> None:
    given = read_textgrid(grid(tmp_path / "a.TextGrid", {"words": WORDS, "phones": PHONES}, how=how), TAKE)
    assert [(word.text, round(word.start, 6), round(word.end, 6)) for word in given.words] == WORDS
    found = aligned(given)
    assert [word.word for word in found.words] == [0, 1, 2]
    assert [[phone.ipa for phone in word.phones] for word in found.words] == [["ð", "ʌ"], ["oʊ", "l", "d"], []]
    assert found.words[1].phones[0].start == pytest.approx(0.3)
    assert found.mismatches == ()


def test_a_textgrid_of_another_encoding_is_read(tmp_path: Path) -> None:
    path = grid(tmp_path / "a.TextGrid", {"words": [("Möwe", 0.2, 0.9)]})
    if b"\xfe\xff" not in path.read_bytes()[:2]:  # Praat itself writes UTF-16 for what is not ASCII
        path.write_bytes(path.read_text(encoding="utf-8").encode("utf-16"))
    assert read_textgrid(path, TAKE).text == "Möwe"


@pytest.mark.parametrize("name", ["words", "Word", "ORT-MAU", "anna - words", "whatever"])
def test_the_tier_of_words_has_many_names(tmp_path: Path, name: str) -> None:
    tiers = {"phones": [*PHONES, ("HH", 1.0, 1.6)], name.replace(" ", "_"): WORDS}
    path = grid(tmp_path / "a.TextGrid", tiers)
    path.write_text(path.read_text(encoding="utf-8").replace(name.replace(" ", "_"), name), encoding="utf-8")
    assert read_textgrid(path, TAKE).text == "the old harbour"


@pytest.mark.parametrize(
    ("told", "text"),
    [
        ({"words": [{"word": "The", "start": 0.1, "end": 0.3}, {"word": " old", "start": 0.3, "end": 0.7}]}, "The old"),
        ([{"text": "The", "start": 0, "end": 1}], "The"),
        ({"segments": [{"words": [{"word": "The", "start": 0.1, "end": 0.2, "probability": 0.9}]}]}, "The"),
        ({"words": [{"word": "The", "start": 0.1, "end": 0.2}, {"word": "3"}]}, "The"),
        ({"words": [{"word": "old", "start": 0.5, "end": 0.9}, {"word": "The", "start": 0.1, "end": 0.6}]}, "The old"),
    ],
)
def test_words_as_json_are_read(tmp_path: Path, told: Any, text: str) -> None:
    path = tmp_path / "a.json"
    path.write_text(json.dumps(told))
    given = read_words(path, TAKE)
    assert given.text == text
    assert all(0 <= word.start < word.end <= TAKE.duration for word in given.words)


@pytest.mark.parametrize(
    ("told", "said"),
    [
        ("{", "is no JSON: line 1, column 2"),
        ("[" * 100_000, "is no JSON"),
        ("7", 'holds neither "words" nor "segments"'),
        ('{"words": []}', "holds no words with times"),
        ('{"words": [5]}', r"words\[0\] is 5; expected an object"),
        ('{"words": [{"start": 1, "end": 2}]}', r'words\[0\] has no text; expected "word"'),
        ('{"words": [{"word": "a", "start": "1", "end": 2}]}', r"words\[0\].start and .end must be numbers"),
        ('{"words": [{"word": "a", "start": NaN, "end": 2}]}', r"must be numbers"),
        ('{"words": [{"word": "a", "start": 2, "end": 1}]}', "goes from 2 to 1 s"),
        ('{"words": [{"word": "a", "start": -1, "end": 1}]}', "goes from -1 to 1 s"),
        ('{"words": [{"word": "a", "start": 1, "end": 9}]}', "ends at 9.00 s, and take.wav lasts 2.00 s"),
        ('{"segments": [{"text": "a", "start": 1, "end": 2}]}', r"segments\[0\] has no words; expected times of words"),
    ],
)
def test_what_is_no_list_of_words_is_refused(tmp_path: Path, told: str, said: str) -> None:
    path = tmp_path / "a.json"
    path.write_text(told)
    with pytest.raises(InputError, match=said):
        read_words(path, TAKE)


def test_a_textgrid_of_another_file_is_refused(tmp_path: Path) -> None:
    path = grid(tmp_path / "a.TextGrid", {"words": WORDS}, length=7.5)
    with pytest.raises(InputError, match=r"lasts 7.50 s, and take.wav 2.00 s; expected the TextGrid of the recording"):
        read_textgrid(path, TAKE)


@pytest.mark.parametrize(
    "content", [b"", b"nothing", b'File type = "ooTextFile"\nObject class = "TextGrid"\n\nxmin = 0', b"\0" * 500]
)
def test_what_is_no_textgrid_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "a.TextGrid"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"is no TextGrid|is broken"):
        read_textgrid(path, TAKE)


def test_another_object_of_praat_is_no_textgrid(tmp_path: Path) -> None:
    call(parselmouth.Sound(np.zeros(100), 8000), "Save as text file", str(tmp_path / "TextGrid.txt"))
    with pytest.raises(InputError, match="is no TextGrid"):
        read_textgrid(tmp_path / "TextGrid.txt", TAKE)


def test_a_textgrid_without_words_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no words"):
        read_textgrid(grid(tmp_path / "a.TextGrid", {"phones": PHONES}), TAKE)
    with pytest.raises(InputError, match="no such file"):
        read_textgrid(tmp_path / "b.TextGrid", TAKE)


def test_what_does_not_match_is_told_word_by_word(tmp_path: Path) -> None:
    given = read_textgrid(grid(tmp_path / "a.TextGrid", {"words": WORDS}), TAKE)
    found = aligned(given, "The very old harbour.")
    assert [str(one) for one in found.mismatches] == ["0.30 s: 'very' is written and not heard"]
    assert [word.word for word in found.words] == [0, 2, 3]
    found = aligned(given, "The harbour.")
    assert [str(one) for one in found.mismatches] == ["0.30 s: 'old' is heard and not written"]
    assert [word.word for word in found.words] == [0, None, 1]
    found = aligned(given, "The new harbour.")
    assert [one.kind for one in found.mismatches] == ["instead"]
    assert [(word.word, word.start) for word in found.words] == [(0, 0.1), (1, 0.3), (2, 1.0)]
    with pytest.raises(InputError, match="3 of 3 words of the transcript are not heard"):
        aligned(given, "Something entirely else.")


def test_no_word_is_lost_for_want_of_time(tmp_path: Path) -> None:
    """Whisper now and then gives a word none: it shares with the one before. Many at one time are nobody's times."""
    path = tmp_path / "a.json"
    path.write_text(json.dumps([{"word": "the", "start": 0, "end": 0.4}, {"word": "old", "start": 0.4, "end": 0.4}]))
    assert [(word.text, word.start, word.end) for word in read_words(path, TAKE).words] == [
        ("the", 0, 0.2), ("old", 0.2, 0.4),
    ]  # fmt: skip
    path.write_text(json.dumps([{"word": f"word{number}", "start": 1, "end": 1.5} for number in range(9)]))
    with pytest.raises(InputError, match=r"'word\d' at 1.00 s has no time of its own"):
        read_words(path, TAKE)


def test_numbers_are_matched_however_they_are_written(tmp_path: Path) -> None:
    labels = [("in", 0.1, 0.3), ("23", 0.3, 0.9), ("years", 1.0, 1.4)]
    given = read_textgrid(grid(tmp_path / "a.TextGrid", {"words": labels}), TAKE)
    for text in ("In 23 years.", "In twenty-three years."):
        found = aligned(given, text)
        assert found.mismatches == ()
        assert found.words[-1].start == 1.0
