"""Laws of markup, on any text at all."""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.sax.saxutils import escape

from hypothesis import example, given, settings
from hypothesis import strategies as st

from scorebreath.errors import ScriptError
from scorebreath.script.marks import Mark
from scorebreath.script.markup.marked import Marked, marked
from scorebreath.script.markup.names import TAGS
from scorebreath.script.model import Script, Sentence
from scorebreath.script.reader import Reader, read

KNOWN = (
    *("[sigh]", "[Breath]", "[pause 0.4]", "[hold]", "[no-breath]", "[state sad 0.5 over 3]", "[anxious]", "[/state]"),
    *("[mark x]", "[voice b]", "[/voice]", "[laughs]", "[gasp]"),
)
WORDS = ("One", "two", "well-known", "3.5", "Dr.", "7.30", "Uhr", "don't", "(020)", "7946", "0958", "e.g.", "ß", "你好")
GLUE = (
    " ",
    "  ",
    "\n",
    "\n\n",
    "\t",
    ", ",
    ".",
    "...",
    "! ",
    '"',
    "(",
    ")",
    "—",
    " - ",
    ":",
    ":-)",
    ";",
    "“",
    "”",
    "_",
)
WIDE = re.compile(r"[^\S\n]{2,}")
tags_in_text = st.lists(st.sampled_from((*KNOWN, *KNOWN, *WORDS, *GLUE)), max_size=40).map("".join)
hostile = st.text(alphabet="[]/\\ \n.:-0159aeghilnopsu<>&;!?\"'=CDATA", max_size=60) | st.lists(
    st.sampled_from(
        ("[", "]", "[sigh", "[pause", "[state", "[/", " sad", " 0.5", " over", "\\[", "\n", "[mark", "x", "[[", "]]")
    ),
    max_size=20,
).map("".join)
ELEMENTS = (
    *("<speak>", "</speak>", "<p>", "</p>", "<s>", "</s>", "<break/>", "<break time='1s'/>", "<mark name='a'/>", "x"),
    *("<emphasis>", "</emphasis>", "<prosody rate='slow'>", "</prosody>", "<sub alias='a b'>", "</sub>", "&amp;"),
    *("<say-as interpret-as='ordinal'>", "</say-as>", "3", "<voice name='v'>", "</voice>", "<amazon:breath/>", "&x;"),
    *("<!--", "-->", "<![CDATA[", "]]>", "<?", "?>", "<", ">", "&", "<!DOCTYPE x>", "<audio/>", " ", "\n", "Ä", "<b"),
)


def without(text: str) -> str:
    for tag in KNOWN:
        text = text.replace(tag, "")
    return text


def letters(text: str) -> str:
    return "".join(character for character in text if character.isalnum())


@given(st.lists(st.tuples(st.sampled_from(WORDS), st.lists(st.sampled_from(KNOWN), max_size=3)), min_size=1))
def test_tags_between_words_leave_the_words_and_their_places(told: list[tuple[str, list[str]]]) -> None:
    text = " ".join(" ".join((word, *tags)) for word, tags in told)
    clean = " ".join(word for word, _ in told)
    found = marked(text)
    assert found.text.rstrip() == clean
    at, expected = 0, []
    for word, tags in told:
        at += len(word)
        expected += [(tag, at) for tag in tags]
        at += 1
    assert [mark.written for mark in found.marks] == [tag for tag, _ in expected]
    assert all(mark.at in (end, end + 1) for mark, (_, end) in zip(found.marks, expected, strict=True))


@given(tags_in_text)
@example('"One [sigh]" [gasp], ([hold]two)[sigh].[sigh]')
@example("One [sigh] [gasp].” two")
@example(" [sigh]\n  [gasp] \n two")
@example(" [sigh]\t , ")
@example("One\n [sigh] \n[gasp]\n\n[hold]\ntwo")
@example('x"""""""""""""""""""""[sigh]a')
@settings(max_examples=500)
def test_a_mark_stands_beside_white_space(text: str) -> None:
    found = marked(text)
    assert [mark.written for mark in found.marks] == re.findall("|".join(map(re.escape, KNOWN)), text)
    places = [mark.at for mark in found.marks]
    assert places == sorted(places)
    for at in places:
        assert 0 <= at <= len(found.text)
        beside = found.text[at - 1 : at], found.text[at : at + 1]
        assert "" in beside or any(character.isspace() for character in beside)
    assert letters(found.text) == letters(without(text))
    assert len(WIDE.findall(found.text)) <= len(WIDE.findall(without(text)))


@given(tags_in_text)
@settings(max_examples=300)
def test_no_paragraph_begins_or_is_lost(text: str) -> None:
    """Paragraphs with a letter in them, for what is left of one of tags alone is none."""

    def paragraphs(plain: str) -> list[str]:
        return [letters(part) for part in re.split(r"\n[^\S\n]*\n", plain) if letters(part)]

    tagged = text
    for tag in KNOWN:
        tagged = tagged.replace(tag, "\x00")
    assert paragraphs(marked(text).text) == paragraphs(tagged)


@given(st.text(max_size=80))
@example("a\\[b")
def test_a_text_without_brackets_is_what_is_said(text: str) -> None:
    text = text.replace("[", "(").replace("\r", "\n").lstrip("\ufeff").replace("<", "")
    assert marked(text) == Marked(text=text)
    escaped = text.replace("\\", "/") + "[sigh]"
    assert marked(escaped.replace("[", "\\[")).text == escaped


@given(hostile)
@example("[" * 100)
@example("[sigh" * 30)
@settings(max_examples=500)
def test_hostile_tags_are_marks_text_or_errors(text: str) -> None:
    try:
        found = marked(text, markup="tags")
    except ScriptError as error:
        assert error.text in text
        assert error.text[error.column - 1] == "["
        assert error.line == text[: text.index(error.text)].count("\n") + 1 or text.count(error.text) > 1
        return
    assert letters(found.text) in letters(text) or found.marks


@given(
    st.lists(
        st.sampled_from(ELEMENTS) | st.sampled_from(("<s>x</s>", "<s>“y”</s>", "<break/>z", "<p>a</p>")), max_size=30
    ),
    st.booleans(),
)
@example(["<?"], False)
@example(["a<break/>b<s>c</s><s>d,</s>", "<s>e<break/>f!)</s>"], True)
@settings(max_examples=600)
def test_hostile_xml_is_read_or_an_error(pieces: Sequence[str], whole: bool) -> None:
    text = "".join(pieces)
    text = f"<speak>{text}</speak>" if whole else text
    try:
        found = marked(text, markup="ssml")
    except ScriptError as error:
        assert error.line >= 1
        assert 1 <= error.column <= len(text) + 1
        return
    assert all(0 <= mark.at <= len(found.text) for mark in found.marks)
    assert list(found.ends) == sorted(set(found.ends))
    for end in found.ends:
        assert not found.text[end].isalnum() and not found.text[end].isspace()
        assert found.text[end + 1 : end + 2] in ("", " ", "\n")


@given(st.text(max_size=200))
def test_any_text_is_read_or_an_error(text: str) -> None:
    for prefix in ("<speak>", "<?xml ", ""):
        try:
            read(prefix + text)
        except ScriptError as error:
            assert str(error)


@st.composite
def documents(draw: st.DrawFn) -> tuple[str, str, list[str]]:
    """An SSML document, the words in it, and its empty elements."""
    pieces: list[str] = []
    words: list[str] = []
    empty: list[str] = []
    for _ in range(draw(st.integers(1, 12))):
        kind = draw(st.sampled_from(("text", "text", "break", "mark", "wrap")))
        word = draw(st.sampled_from(("one", "two & three", "<four>", "Fünf.", "'six'")))
        if kind == "text":
            pieces.append(escape(word))
        elif kind == "wrap":
            name = draw(st.sampled_from(("emphasis", "prosody", "w", "amazon:auto-breaths")))
            pieces.append(f"<{name}>{escape(word)}</{name}>")
        else:
            pieces.append("<break/>" if kind == "break" else "<mark name='m'/>")
            empty.append(pieces[-1])
            continue
        words.append(word)
    return f"<speak> {' '.join(pieces)} </speak>", " ".join(words), empty


@given(documents())
def test_a_document_gives_back_its_words_and_marks(case: tuple[str, str, list[str]]) -> None:
    text, words, empty = case
    found = marked(text)
    assert found.text == words
    assert [mark.written for mark in found.marks if mark.written.endswith("/>")] == empty
    for mark in found.marks:
        assert mark.at in (0, len(words)) or words[mark.at - 1] == " " or words[mark.at] == " "


def try_read(text: str, language: str) -> Script | None:
    try:
        return read(text, language=language)
    except ScriptError as error:
        assert "nothing to speak" in str(error)
        return None


@given(tags_in_text, st.sampled_from(("en", "de", "zh")))
@example("Ring (020) [sigh] 7946 0958", "en")
@example("7.30 [sigh] Uhr", "de")
@settings(max_examples=400, deadline=None)
def test_every_mark_hangs_on_one_word_in_order(text: str, language: str) -> None:
    script = try_read(text, language)
    if script is None or not script.sentences:
        return
    assert all(not sentence.before for sentence in script.sentences[1:])
    hung: list[Mark] = list(script.sentences[0].before)
    words = [word for sentence in script.sentences for word in sentence.words]
    assert all(mark.at <= words[0].source.start for mark in hung)
    for word, following in zip(words, [*words[1:], None], strict=True):
        hung += word.after
        assert not (word.after and word.edge == "joint")
        for mark in word.after:
            assert mark.at > word.source.start
            assert following is None or mark.at <= following.source.start
            said = script.text[word.source.start : word.source.end]
            inner = mark.at - word.source.start
            assert not letters(said[inner:]), "a mark inside a word"
    assert hung == list(script.marks)


@given(tags_in_text, st.data())
@settings(max_examples=200, deadline=None)
def test_any_cutting_gives_the_same_sentences_with_marks(text: str, data: st.DataObject) -> None:
    clean = marked(text)
    cuts = sorted(data.draw(st.lists(st.integers(0, len(clean.text)), max_size=8)))
    pieces = [clean.text[start:end] for start, end in zip([0, *cuts], [*cuts, len(clean.text)], strict=True)]

    def fed(parts: Sequence[str]) -> list[Sentence]:
        reader = Reader(marks=clean.marks, ends=clean.ends)
        return [sentence for piece in parts for sentence in reader.feed(piece)] + reader.finish()

    assert fed(pieces) == fed([clean.text])


def test_marks_alone_are_a_text() -> None:
    script = read(" ".join(tag.form.split(" ")[0].rstrip("]") + "]" for tag in TAGS if "SECONDS" not in tag.form and
                           "NAME" not in tag.form))  # fmt: skip
    assert script.sentences == ()
    assert len(script.marks) >= 6
    assert read("<speak><amazon:breath/></speak>").marks


def test_huge_texts_of_tags() -> None:
    found = marked("Hello [sigh], you. " * 20_000)
    assert len(found.marks) == 20_000
    assert found.text == "Hello, you. " * 20_000
    assert marked("[" * 300_000).text == "[" * 300_000
    assert marked("[abc " * 60_000).text == "[abc " * 60_000
    assert marked("[sigh]" * 20_000).text == ""
    for piece in ("[sigh]! ", '[sigh]" ', "[sigh],", "[sigh]\n", ' "[sigh]', "[sigh]" + " " * 70):
        assert len(marked("x " + piece * 10_000).marks) == 10_000
