"""The reader: what it refuses, what it bears, and when it lets a sentence go."""

from __future__ import annotations

import pytest

from scorebreath.errors import ScriptError
from scorebreath.script import decode
from scorebreath.script import reader as reading
from scorebreath.script.language import primary
from scorebreath.script.reader import Reader, read
from scorebreath.script.words import LONGEST


@pytest.mark.parametrize("text", ["", " \n\t ", "...", "?! -- (…)", "_ _", "\ufeff", "🎉 🚲", "* * *", "\x00\x07"])
def test_nothing_to_speak(text: str) -> None:
    with pytest.raises(ScriptError, match="nothing to speak") as caught:
        read(text, file="a.txt")
    assert caught.value.file == "a.txt"
    assert Reader().feed(text) == Reader().finish() == []


def test_emotions_alone_are_something_to_show() -> None:
    script = read(":-) :-o [sigh] 😀")
    assert script.sentences == ()
    assert [mark.written for mark in script.marks] == [":-)", ":-o", "[sigh]", "😀"]


def test_half_a_surrogate_pair_is_no_text() -> None:
    with pytest.raises(ScriptError, match="U\\+D800") as caught:
        read("ab\ncd \ud800", file="a.txt")
    assert (caught.value.line, caught.value.column) == (2, 4)
    with pytest.raises(ScriptError, match="character 3"):
        Reader().feed("abc\udfff")


def test_length_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(decode, "LIMIT", 10)
    with pytest.raises(ScriptError, match="11 characters"):
        read("a" * 11)


@pytest.mark.parametrize("tag", ["", "e", "english language", "12", "../de"])
def test_a_language_is_a_tag(tag: str) -> None:
    with pytest.raises(ScriptError, match="BCP 47"):
        read("Hello", language=tag)


def test_only_the_primary_language_counts() -> None:
    assert primary("EN-us") == "en"
    assert primary("pt_BR") == "pt"
    assert read("5 km", language="de-AT").sentences[0].words[1].spoken.text == "Kilometer."


def test_control_characters_are_spaces_and_a_form_feed_a_paragraph() -> None:
    script = read("One\x00two\x1bthree\x07.\x0cFour")
    assert [[word.text for word in sentence.words] for sentence in script.sentences] == [
        ["One", "two", "three"],
        ["Four"],
    ]
    assert [sentence.stanza for sentence in script.sentences] == [0, 1]


@pytest.mark.parametrize("gap", ["\n\n", "\n \n", "\f"])
def test_a_heading_without_a_full_stop_is_a_paragraph_of_its_own(gap: str) -> None:
    """Even where the first sentence below it ends beyond doubt; and however the text arrives."""
    text = f"The heading{gap}The story went on. Then it ended"
    script = read(text)
    assert [sentence.text for sentence in script.sentences] == ["The heading", "The story went on.", "Then it ended"]
    assert [sentence.stanza for sentence in script.sentences] == [0, 1, 1]
    reader = Reader()
    assert tuple([one for letter in text for one in reader.feed(letter)] + reader.finish()) == script.sentences


def test_any_newline_will_do() -> None:
    for newline in ("\n", "\r\n", "\r"):
        script = read(newline.join(["One", "two.", "", "Three"]))
        assert script.text == "One\ntwo.\n\nThree"
        assert [sentence.stanza for sentence in script.sentences] == [0, 1]


def test_a_word_too_long_for_a_breath_is_cut_into_pieces() -> None:
    script = read("So " + "a" * 10_000 + " it is.")
    words = [word for sentence in script.sentences for word in sentence.words]
    assert max(len(word.text) for word in words) == LONGEST
    assert "".join(word.text for word in words) == "So" + "a" * 10_000 + "itis"
    assert {word.edge for word in words[1:-3]} == {"joint"}
    assert [word.edge for word in words[-3:]] == ["word", "word", "paragraph"]


def test_a_sentence_without_end_comes_in_parts_cut_at_strong_places() -> None:
    text = "and then we went on, " * 1000 + "home."
    script = read(text)
    *parts, last = script.sentences
    assert len(parts) > 3
    assert all(not part.complete and part.words[-1].edge == "comma" for part in parts)
    assert all(reading.LONGEST / 2 < part.source.length <= reading.LONGEST for part in parts)
    assert last.complete
    assert "".join(part.text + part.gap for part in script.sentences) == text
    assert all(part.type == "statement" for part in parts)


def test_parts_prefer_the_strongest_place() -> None:
    unit = "word " * 300
    script = read(unit + "one; " + unit + "two, " + unit * 3)
    assert script.sentences[0].text.endswith("two,")
    assert read(unit + "one, " + unit + "two; " + unit * 3).sentences[0].text.endswith("two;")


def test_mixed_scripts_are_words() -> None:
    text = "Hello мир, שלום עולם: 你好 world! हिन्दी में ไทย 한국어 \u202bعربي\u202c ok"
    script = read(text)
    found = [word.text for sentence in script.sentences for word in sentence.words]
    assert found == [
        "Hello", "мир", "שלום", "עולם", "你", "好", "world", "हिन्दी", "में", "ไทย", "한국어", "عربي\u202c", "ok",
    ]  # fmt: skip
    assert all(word.words for sentence in script.sentences for word in sentence.words)


def test_emoji_are_kept_as_written_but_not_spoken() -> None:
    script = read("I ❤️ you 👩‍👩‍👧 so😀 much. 🎉 Bye 👋🏽")
    assert [word.spoken.text for sentence in script.sentences for word in sentence.words] == [
        "I",
        "you",
        "so",
        "much.",
        "Bye.",
    ]
    assert "".join(sentence.text + sentence.gap for sentence in script.sentences) == script.text


def test_a_sentence_is_given_once_the_next_one_has_begun() -> None:
    reader = Reader()
    assert reader.feed("It rained. ") == []
    assert [sentence.text for sentence in reader.feed("The")] == ["It rained."]
    assert [sentence.text for sentence in reader.feed(" sun came. ")] == []
    assert [sentence.text for sentence in reader.feed("Dr")] == ["The sun came."]
    assert reader.feed(". Smith left.") == []
    assert [sentence.text for sentence in reader.finish()] == ["Dr. Smith left."]


def test_a_doubtful_end_waits_for_some_more_text_only() -> None:
    reader = Reader()
    given = reader.feed("He came at 5 p.m. ")
    text = (
        "Then he took off his coat and hat, and sat down by the fire, and there he stayed, and did not say one word, "
    )
    count = 0
    while not given:
        given = reader.feed(text[count])
        count += 1
    assert given[0].text == "He came at 5 p.m."
    assert count <= reading.STEP


def test_memory_is_bounded_by_the_sentence() -> None:
    reader = Reader()
    for _ in range(300):
        reader.feed("It was a long and winding road, and we walked on. " * 20)
    assert len(reader._text) <= 2 * reading._TRIM + 2000


def test_newlines_and_byte_order_mark_across_pieces() -> None:
    reader = Reader()
    given = [
        s for piece in ("", "\ufeff", "One\r", "\n", "\r", "\nTwo\r") for s in reader.feed(piece)
    ] + reader.finish()
    assert given == list(read("\ufeffOne\r\n\r\nTwo\r").sentences)
    assert [sentence.stanza for sentence in given] == [0, 1]
