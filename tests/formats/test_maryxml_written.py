"""MaryXML as it is written: the published elements and attributes alone, any text, and back again as it was."""

from __future__ import annotations

import dataclasses
import io
import re
from collections.abc import Callable, Iterator
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.equations.phones import ipa_of
from scorebreath.formats import maryxml
from scorebreath.formats.formats import ExportOptions, format_named
from scorebreath.formats.mary_phones import NAMES, STRESS, name_of, syllables_of, written
from scorebreath.formats.maryxml import ACCENTS, ACCENTS_OF_WORDS, BREATH, NAMESPACE, PUBLISHED, TONES
from scorebreath.media.store import MemoryStore
from scorebreath.pipeline import compile_text
from scorebreath.score.document import Score
from scorebreath.score.events import Emotion, Level, Marker, Pause, Phone, Phrase, Pitch, Utterance, Word
from scorebreath.script.marks import Act, EmotionMark, NamedMark
from scorebreath.script.markup.marked import marked
from scorebreath.script.markup.maryxml import document
from scorebreath.script.reader import read
from scorebreath.speech.tone.voice import ToneVoice
from tests.curves.scores import MEDIA, score_of

TEXT = """Hi! ;-) It costs 23 dollars, "so to say" (Dr. Smith said) on 3 May.
Can you show me the well-known way, please? :-)

[mark chapter-2] Where the road ends - by the river - she waits... :-( It rains."""
POEM = "Die Nacht ist still,\nder Wind :-( schläft ein.\nWer weiß, was er will?\nEr will allein sein. :-)\n"
ELEMENT = re.compile(r"\{(.*)\}(.*)")
CONTENT = {
    "maryxml": {"p"},
    "p": {"s", "voice"},
    "voice": {"s"},
    "s": {"phrase"},
    "phrase": {"t", "mtu", "boundary", "mark"},
    "mtu": {"t"},
    "t": {"syllable"},
    "syllable": {"ph"},
    "ph": set(),
    "boundary": set(),
    "mark": set(),
}
"""What stands in what, of all that MaryXML.xsd 0.5 allows."""
VALUES: dict[tuple[str, str], Callable[[str], object]] = {
    ("maryxml", "version"): lambda value: value == "0.5",
    ("maryxml", "xml:lang"): lambda value: re.fullmatch("[a-z]{2,8}", value),
    ("mtu", "orig"): bool,
    ("voice", "name"): bool,
    ("t", "accent"): lambda value: value in ACCENTS_OF_WORDS,
    ("t", "ph"): bool,
    ("t", "pos"): bool,
    ("syllable", "accent"): lambda value: value in ACCENTS,
    ("syllable", "ph"): bool,
    ("syllable", "stress"): lambda value: value in {"1", "2"},
    ("ph", "d"): lambda value: int(value) > 0,
    ("ph", "end"): lambda value: float(value) >= 0.0,
    ("ph", "f0"): lambda value: re.fullmatch(r"\(50,[0-9]+\)", value),
    ("ph", "p"): bool,
    ("boundary", "breakindex"): lambda value: value in set("123456"),
    ("boundary", "duration"): lambda value: int(value) > 0,
    ("boundary", "tone"): lambda value: value in TONES,
    ("mark", "name"): lambda value: re.fullmatch(r"[A-Za-z_][A-Za-z0-9_.-]*", value),
}
"""Attributes and the values that the schema's types allow for them."""
REQUIRED = {"maryxml": {"version"}, "ph": {"p"}, "boundary": {"breakindex"}, "mark": {"name"}}


def made(score: Score) -> bytes:
    stream = io.BytesIO()
    maryxml.write(stream, score)
    return stream.getvalue()


def compiled(text: str, **options: object) -> Score:
    with ToneVoice() as voice:
        return compile_text(text, voice=voice, media=MemoryStore(), **options)  # type: ignore[arg-type]


def elements(data: bytes) -> Iterator[tuple[str, ElementTree.Element, str]]:
    """Each element with its name and its parent's."""

    def walk(element: ElementTree.Element, parent: str) -> Iterator[tuple[str, ElementTree.Element, str]]:
        match = ELEMENT.fullmatch(element.tag)
        assert match and match[1] == NAMESPACE
        yield match[2], element, parent
        for child in element:
            yield from walk(child, match[2])

    yield from walk(ElementTree.fromstring(data), "")


def check(data: bytes) -> int:
    """Walk a document against the tables; how many elements it has."""
    names, count = set(), 0
    for name, element, parent in elements(data):
        count += 1
        assert parent == "" if name == "maryxml" else name in CONTENT[parent]
        given_here = {key.replace("{http://www.w3.org/XML/1998/namespace}", "xml:"): v for key, v in element.items()}
        assert set(given_here) <= set(PUBLISHED[name])
        assert set(given_here) >= REQUIRED.get(name, set())
        for key, value in given_here.items():
            assert VALUES[name, key](value), (name, key, value)
        assert name == "t" or not (element.text or "").strip()
        assert not (element.tail or "").strip()
        if name == "mark":
            assert element.attrib["name"] not in names  # xsd:ID
            names.add(element.attrib["name"])
        if name == "syllable":
            assert len(element)
    return count


def test_the_tables_fit_each_other() -> None:
    assert set(CONTENT) == set(PUBLISHED)
    assert set(VALUES) == {(name, key) for name, row in PUBLISHED.items() for key in row} - {("maryxml", "xmlns")}
    assert ACCENTS < ACCENTS_OF_WORDS


@pytest.mark.parametrize(("text", "language"), [(TEXT, "en"), (POEM, "de")])
def test_what_is_written_is_published_and_reads_back_as_it_was(text: str, language: str) -> None:
    score = compiled(text, language=language)
    data = made(score)
    assert check(data) > 100
    assert list(score.of(Phrase))
    assert list(score.of(Emotion))
    again = marked(data.decode("utf-8"))
    script = read(again)
    assert again.language == language

    words = [word for utterance in score.of(Utterance) for word in utterance.words]
    letters = "".join(letter for word in words for letter in word.text if letter.isalnum())
    assert "".join(letter for letter in again.text if letter.isalnum()).casefold() == letters.casefold()

    heard = [word.told for sentence in script.sentences for word in sentence.words]
    accented = [one is not None and one.accent not in (None, "none") for one in heard]
    parts = [(word, part) for word in words for part, _ in enumerate(re.findall(r"[^\W_]+(?:['’]\w+)*", word.text))]
    expected = [word.accent and part == 0 for word, part in parts]
    assert accented == expected

    boundaries = [(one.break_index, one.tone) for one in heard if one is not None and one.break_index]
    assert boundaries == [(phrase.break_index, phrase.tone) for phrase in score.of(Phrase)]

    emotions = [(mark.name, mark.intensity) for mark in again.marks if isinstance(mark, EmotionMark)]
    assert emotions == [(event.name, event.intensity) for event in score.of(Emotion)]


def test_emotions_and_markers_stand_between_the_same_words() -> None:
    again = marked(made(compiled(TEXT)).decode("utf-8"))
    behind = [
        (mark.name, again.text[: mark.at].split()[-1])
        for mark in again.marks
        if isinstance(mark, (EmotionMark, NamedMark))
    ]
    assert behind == [("kidding", "Hi!"), ("happy", "please?"), ("chapter-2", "please?"), ("sad", "waits...")]


def test_punctuation_is_written_and_emoticons_are_not() -> None:
    text = marked(made(compiled(TEXT)).decode("utf-8")).text
    assert text.startswith('Hi! It costs twenty-three dollars, "so to say" (Doctor Smith said) on the third of May.')
    assert "way, please?\n\nWhere the road ends - by the river - she waits... It rains." in text


def test_numbers_keep_what_they_were_written_as() -> None:
    units = {element.attrib["orig"]: "".join(element.itertext()).split() for name, element, _ in
             elements(made(compiled(TEXT))) if name == "mtu"}  # fmt: skip
    assert units["23"] == ["twenty-three"]
    assert units["Dr."] == ["Doctor"]


def test_times_are_the_score_s() -> None:
    score = compiled("One two.")
    phones = [element.attrib for name, element, _ in elements(made(score)) if name == "ph"]
    utterance = next(score.of(Utterance))
    said = [phone for phone in utterance.phones if phone.word is not None and phone.ipa]
    assert [float(phone["end"]) for phone in phones] == pytest.approx(
        [utterance.onset + phone.onset + phone.duration for phone in said]
    )
    assert [int(phone["d"]) for phone in phones] == [max(1, round(phone.duration * 1000)) for phone in said]


def test_silences_that_were_asked_for_are_told_in_ms() -> None:
    """At a sentence's end 1.2 s go by without being asked for."""
    score = compiled("One, [pause 0.3] two. [pause 0.5] Three.")
    told = [int(e.attrib.get("duration", "0")) for name, e, _ in elements(made(score)) if name == "boundary"]
    assert told == [300, 1700, 0]
    assert [mark.seconds for mark in marked(made(score).decode()).marks if isinstance(mark, Act)] == [0.3, 0.5]
    assert BREATH == document.BREATH


@pytest.mark.parametrize(("text", "language"), [(TEXT, "en"), (POEM, "de"), (f"{POEM}\n" * 3, "de")])
def test_what_is_read_back_lasts_as_long(text: str, language: str) -> None:
    """A planned breath's pause is not asked for again, and neither is a voice's own at a comma."""
    score = compiled(text, language=language)
    again = compiled(made(score).decode("utf-8"))
    assert again.duration == pytest.approx(score.duration, rel=0.06)
    assert not [pause for pause in again.of(Pause) if pause.kind == "asked"]


@pytest.mark.parametrize("index", [4, 5, 6])
def test_the_last_boundary_is_the_score_s(index: int) -> None:
    """S3's own example ends with 4."""
    tokens = f"<s><t>One</t><boundary breakindex='{index}'/></s>"
    score = compiled(f"<maryxml version='0.5' xml:lang='en'><p>{tokens}{tokens}</p></maryxml>")
    told = [element.attrib["breakindex"] for name, element, _ in elements(made(score)) if name == "boundary"]
    assert [phrase.break_index for phrase in score.of(Phrase)] == [index, index]
    assert told == [str(index)] * 2
    assert [name for name, _, _ in elements(made(score))].count("s") == 2


@pytest.mark.parametrize(
    "text",
    [
        "See http://a.b/c?d=1 now.",
        "Is it at x.org/?q=a&b=c! or not?",
        "At 12:30 he said, “Why?” and left: gone (for good).",
        "Wait...what? Yes!",
    ],
)
def test_sentences_are_read_back_as_they_were(text: str) -> None:
    score = compiled(text)
    check(made(score))
    again = compiled(made(score).decode("utf-8"))

    def said(one: Score) -> list[str]:
        return [word.text.casefold() for utterance in one.of(Utterance) for word in utterance.words]

    def ends(one: Score) -> list[tuple[str, str]]:
        return [(p.sentence_type, p.tone) for p in one.of(Phrase) if p.position == "final"]

    assert said(again) == said(score)
    assert ends(again) == ends(score)


def test_who_speaks_is_told() -> None:
    with ToneVoice() as other:
        score = compiled("Hi. [voice tone:x] Hello you. [/voice] Hi.", voices=lambda _: other)
    first, second = score.bodies
    names = [element.attrib["name"] for name, element, _ in elements(made(score)) if name == "voice"]
    assert names == [second.voice.voice]
    check(made(score))
    assert first.id != second.id


def test_a_score_without_words_is_a_document() -> None:
    score = score_of([])
    assert check(made(score)) == 1
    assert check(made(dataclasses.replace(score, groups=()))) == 1


def test_the_format_is_in_the_table() -> None:
    stream = io.BytesIO()
    format_named("maryxml").write(stream, score_of([]), ExportOptions())
    assert stream.getvalue() == made(score_of([]))


SCRIPT = st.text(alphabet=st.characters(exclude_categories=["Cs"]), max_size=12)


@given(st.lists(st.tuples(SCRIPT, SCRIPT, SCRIPT, st.booleans()), min_size=1, max_size=6), SCRIPT)
def test_any_text_at_all_is_well_formed(said: list[tuple[str, str, str, bool]], name: str) -> None:
    words, at, text = [], 0, ""
    for number, (word, tone, pos, accent) in enumerate(said):
        source = (at, at + len(word))
        words.append(
            Word(text=word, onset=number * 0.5, duration=0.4, source=source, tone=tone, pos=pos, accent=accent)
        )
        text += word + tone
        at = len(text)
    phones = tuple(
        Phone(ipa=word.pos or "a", onset=word.onset, duration=0.4, stress=1, word=number)
        for number, word in enumerate(words)
    )
    speech = Utterance(
        id="u", body="body", onset=0.0, duration=len(words) * 0.5, media=MEDIA, gain_db=0.0, closing="final",
        words=tuple(words), phones=phones, pitch=Pitch(step=0.01, hertz=(100.0,)), level=Level(step=0.01, db=()),
    )  # fmt: skip
    marks = [
        Marker(id="m1", body="body", onset=0.0, duration=0.0, name=name),
        Marker(id="m2", body="body", onset=9.0, duration=0.0, name=name),
        Emotion(id="e", body="body", onset=0.0, duration=1.0, apex=0.5, intensity=0.5, name=name),
    ]
    check(made(score_of([speech, *marks], text=text or " ", duration=10.0)))


@pytest.mark.parametrize(
    ("phones", "expected"),
    [
        ("n aɪ", "n aɪ"),
        ("l eː z ə n", "l eː - z ə n"),
        ("v ɪ n t ɐ", "v ɪ n - t ɐ"),
        ("k ɪ s t ə", "k ɪ s - t ə"),
        ("p ɑː k l æ n d", "p ɑː - k l æ n d"),
        ("s ɪ ŋ ə", "s ɪ ŋ - ə"),
        ("ɡ eː ə n", "ɡ eː - ə n"),
        ("b ʌ t n̩ z", "b ʌ - t n̩ z"),
        ("s", "s"),
    ],
)
def test_syllables(phones: str, expected: str) -> None:
    made_of = [Phone(ipa=ipa, onset=0.0, duration=0.1) for ipa in phones.split()]
    assert " - ".join(" ".join(phone.ipa for phone in part.phones) for part in syllables_of(made_of)) == expected


@pytest.mark.parametrize("language", ["en", "de"])
def test_sounds_read_back(language: str) -> None:
    named = {name: ipa for ipa, name in reversed(list(NAMES.get(language, {}).items()))}  # MARY has one "@U"
    ipas = ("p", "ʃ", "tʃ", "ŋ", "ç", "ə", "iː", "aʊ", "ɪ", *named.values())
    for ipa in ipas:
        assert ipa_of(name_of(ipa, language), language) == ipa
    phones = [
        Phone(ipa=ipa, onset=0.0, duration=0.1, stress=stress)
        for ipa, stress in (("b", 0), ("ə", 0), ("l", 0), ("uː", 1), ("n", 0), ("aɪ", 2))
    ]
    assert ipa_of(written(syllables_of(phones), language), language).replace(".", "") == "bəˈluːˌnaɪ"
    assert STRESS == ("", "'", ",")


def test_english_names_are_mary_s() -> None:
    found = {ipa: name_of(ipa, "en") for ipa in ("oʊ", "əʊ", "ɪɹ", "ɔːɹ", "ɹ")}
    assert found == {"oʊ": "@U", "əʊ": "@U", "ɪɹ": "Ir", "ɔːɹ": "O:r", "ɹ": "r"}
    assert name_of("ɪɹ", "de") == "Ir\\"


def test_what_is_felt_without_words_is_written_and_read_back() -> None:
    felt = compile_text(":-) ... :-( \U0001f642", voice=ToneVoice(), media=MemoryStore())
    stream = io.BytesIO()
    maryxml.write(stream, felt)
    again = compile_text(stream.getvalue().decode("utf-8"), voice=ToneVoice(), media=MemoryStore())
    assert [(e.name, e.intensity) for e in again.of(Emotion)] == [(e.name, e.intensity) for e in felt.of(Emotion)]
    assert len(list(felt.of(Emotion))) == 3
