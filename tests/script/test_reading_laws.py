"""Laws of reading, on any text at all."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from scorebreath.errors import ScriptError
from scorebreath.script import emoticons
from scorebreath.script import reader as reading
from scorebreath.script.decode import universal_newlines
from scorebreath.script.model import Script, Sentence
from scorebreath.script.reader import Reader, read

WORDS = "Alice was he A b Dr. Smith e.g. etc. U.S. d.h. usw. 3. Mai 3rd $5.50 € 7:30 Uhr 10-15 50% 15°C km/h 5 km XIV."
STRANGE = "FBI well-known snake_case :-) :-o <3 <33 x@y.org https://a.b/c & # + = 0 007 2½ ２ ﬁ 你好 。 ！ مرحبا ؟ 😀"
MARKS = "-- — ... … ! ? ?! . , ; : ( ) “ ” „ « » ' ’ _"
PIECES = (
    *WORDS.split(),
    *STRANGE.split(),
    *MARKS.split(),
    *("z. B.", "10 000", " – ", '"', " _ ", ": - (", "§ 5", " ", "  ", "\n", "\n\n", "\n \n", "\f", "\r\n", "\t"),
    *("\u200b", "\u0301", "\u200d", "\u00ad", "\x00"),
)
MADE = st.lists(st.sampled_from(PIECES), max_size=60).map("".join) | st.lists(st.sampled_from(PIECES)).map(" ".join)
ANY = st.text(max_size=200) | MADE
LANGUAGES = st.sampled_from(("en", "de", "fr", "zh", "ar", "xx"))


def try_read(text: str, language: str, poem: bool | None) -> Script | None:
    try:
        return read(text, language=language, poem=poem, markup="none")
    except ScriptError as error:
        assert "nothing to speak" in str(error)
        return None


def letters(text: str) -> set[int]:
    """Places of all letters and digits that are no part of an emoticon."""
    hidden = {place for span in emoticons.spans(text) for place in range(span.start, span.end)}
    return {place for place, character in enumerate(text) if character.isalnum() and place not in hidden}


@given(ANY, LANGUAGES, st.booleans())
@example("!!!!!!!!!!!!!!!!!!:-ok", "en", False)
@example("。。Hello. ).World (!) Bob", "en", False)
@example("a" + "\u0301" * 5000, "en", False)
@settings(max_examples=400, deadline=None)
def test_spans_ascend_and_hold_every_letter_once(text: str, language: str, poem: bool) -> None:
    script = try_read(text, language, poem)
    plain = universal_newlines(text.removeprefix("\ufeff"))
    if script is None:
        assert not letters(plain)
        return
    assert script.text == plain
    at, found = 0, []
    for sentence in script.sentences:
        assert sentence.words
        assert sentence.source.cut(plain) == sentence.text
        assert at <= sentence.source.start < sentence.source.end
        at = sentence.source.start
        for word in sentence.words:
            assert at <= word.source.start < word.source.end <= sentence.source.end
            assert word.source.cut(plain).strip() == word.source.cut(plain)
            assert word.text in word.source.cut(plain)
            assert word.line == plain.count("\n", 0, word.source.start + word.source.cut(plain).index(word.text))
            at = word.source.end
            found += [place for place in range(*word.source) if plain[place].isalnum()]
        assert sentence.words[0].source.start == sentence.source.start
        assert sentence.words[-1].source.end == sentence.source.end
    assert len(found) == len(set(found))
    assert letters(plain) <= set(found)


@given(ANY, LANGUAGES, st.booleans())
@settings(max_examples=200, deadline=None)
def test_sentences_and_gaps_make_the_text(text: str, language: str, poem: bool) -> None:
    script = try_read(text, language, poem)
    if script is None:
        return
    assert script.sentences or script.marks
    if not script.sentences:
        return
    assert "".join(s.text + s.gap for s in script.sentences) == script.text[script.sentences[0].source.start :]
    assert script.sentences[-1].words[-1].edge == "paragraph"
    stanzas = [sentence.stanza for sentence in script.sentences]
    assert stanzas == sorted(stanzas)
    for sentence in script.sentences:
        edge = sentence.words[-1].edge
        assert (edge in ("sentence", "paragraph")) == sentence.complete
        assert all(word.edge not in ("sentence", "paragraph") for word in sentence.words[:-1])
        assert poem or all(word.edge != "line" for word in sentence.words)


@given(ANY, LANGUAGES)
@settings(max_examples=300, deadline=None)
def test_spoken_text_leads_back_into_the_word(text: str, language: str) -> None:
    script = try_read(text, language, False)
    for sentence in script.sentences if script else ():
        for word in sentence.words:
            spoken = word.spoken
            assert spoken.text.strip()
            assert word.words
            first = word is sentence.words[0]  # begins with a capital
            assert all(bare and (bare in spoken.text or (first and bare[1:] in spoken.text)) for bare in word.words)
            ends = [run.end for run in spoken.runs]
            assert all(end <= run.start < run.end for end, run in zip([0, *ends], spoken.runs, strict=False))
            for place in range(len(spoken.text)):
                source = spoken.source(place, place + 1)
                assert source is None or word.source.start <= source.start < source.end <= word.source.end
            assert "_" not in spoken.text
            assert "\n" not in spoken.text


def fed(pieces: Sequence[str], language: str, poem: bool) -> list[Sentence]:
    reader = Reader(language=language, poem=poem)
    return [sentence for piece in pieces for sentence in reader.feed(piece)] + reader.finish()


@st.composite
def cut_texts(draw: st.DrawFn) -> tuple[str, list[str]]:
    text = draw(ANY)
    cuts = sorted(draw(st.lists(st.integers(0, len(text)), max_size=12)))
    return text, [text[start:end] for start, end in zip([0, *cuts], [*cuts, len(text)], strict=True)]


@given(cut_texts(), LANGUAGES, st.booleans())
@example(("好。:D ok", ["好。", ":D ok"]), "zh", False)
@example(("Ah :-ok", ["Ah :-o", "k"]), "en", False)
@example(("<3 <3 G0", ["<3 <3 G0"]), "en", False)
@example((":<000000000000000000000000", [":<00000000000000000000000", "0"]), "en", False)
@example(("See you. X", ["See you. ", "X"]), "en", False)
@settings(max_examples=400, deadline=None)
def test_any_cutting_gives_the_same_sentences(case: tuple[str, list[str]], language: str, poem: bool) -> None:
    text, pieces = case
    script = try_read(text, language, poem)
    whole = [] if script is None else list(script.sentences)
    assert fed(pieces, language, poem) == whole
    assert fed(list(text), language, poem) == whole


@given(cut_texts(), LANGUAGES)
@settings(max_examples=400, deadline=None)
def test_small_windows_and_parts_keep_the_laws(case: tuple[str, list[str]], language: str) -> None:
    """With the sizes of windows and parts made so small that short texts meet their ends."""
    text, pieces = case
    with pytest.MonkeyPatch.context() as patch:
        for name, size in (("LONGEST", 50), ("STEP", 12), ("AHEAD", 8), ("BEHIND", 10), ("_TRIM", 8)):
            patch.setattr(reading, name, size)
        whole = fed([text], language, False)
        assert fed(pieces, language, False) == whole
        assert fed(list(text), language, False) == whole
    plain = universal_newlines(text.removeprefix("\ufeff"))
    assert all(sentence.source.cut(plain) == sentence.text for sentence in whole)
    assert "".join(s.text + s.gap for s in whole) == (plain[whole[0].source.start :] if whole else "")
    found = [place for sentence in whole for word in sentence.words for place in range(*word.source)]
    assert len(found) == len(set(found))
    assert letters(plain) <= set(found)


@given(MADE, MADE)
@settings(max_examples=200, deadline=None)
def test_what_is_given_is_final(first: str, second: str) -> None:
    reader = Reader()
    given_early = reader.feed(first)
    script = try_read(first + second, "en", False)
    assert given_early == list(script.sentences if script else ())[: len(given_early)]


def test_a_number_on_two_lines_is_said_on_one() -> None:
    """Also in a language whose numbers are the voice's own."""
    for language in ("fr", "en"):
        (sentence,) = read("000000\n00", language=language).sentences
        assert all("\n" not in word.spoken.text for word in sentence.words)
    glued = [sentence.text for sentence in read("So.😀 Then we go.:-( Is it.<3 it", markup="none").sentences]
    assert glued == ["So.", "Then we go.", "Is it.<3 it"]
    assert [sentence.text for sentence in read("..😀Hello", markup="none").sentences] == ["..😀Hello"]
