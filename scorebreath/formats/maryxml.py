"""A Score as MaryXML 0.5, the documents of MaryTTS: what is known of its words, and nothing that is not (A9, A12).

Only elements and attributes of the published schema are written, all in `PUBLISHED`. The schema has no element for an
emotion: it becomes a `mark`, `emotion.NAME.PERCENT.NUMBER`, which is read as an emotion again.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from io import StringIO
from types import MappingProxyType
from typing import BinaryIO
from xml.sax.saxutils import escape, quoteattr

from scorebreath.curves.performed import performed
from scorebreath.formats.mary_phones import Syllable, name_of, sounds, syllables_of, written
from scorebreath.formats.mary_words import SENTENCE, Said, said
from scorebreath.score.document import Score
from scorebreath.score.events import Emotion, Event, Marker, Phone, Utterance
from scorebreath.units import snap

NAMESPACE = "http://mary.dfki.de/2002/MaryXML"
VERSION = "0.5"
PUBLISHED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "maryxml": ("version", "xmlns", "xml:lang"),
        "p": (),
        "voice": ("name",),
        "s": (),
        "phrase": (),
        "mtu": ("orig",),
        "t": ("accent", "ph", "pos"),
        "syllable": ("accent", "ph", "stress"),
        "ph": ("d", "end", "f0", "p"),
        "boundary": ("breakindex", "duration", "tone"),
        "mark": ("name",),
    }
)
"""Elements and attributes of MaryXML.xsd 0.5 that are used here, in the order in which they are written."""
ACCENTS = frozenset(
    {
        "*", "H*", "!H*", "^H*", "L*", "L+H*", "L*+H", "L+!H*", "L*+!H", "L+^H*", "L*+^H", "H+L*", "H+!H*", "H+^H*",
        "!H+!H*", "^H+!H*", "^H+^H*",
    }
)  # fmt: skip
"""Labels of accents in the schema; `*` says nothing about which."""
ACCENTS_OF_WORDS = ACCENTS | {"H*+L", "!H*+L"}
"""Those of tokens; syllables have fewer."""
TONES = frozenset(
    {
        "H-", "!H-", "L-", "H-%", "!H-%", "H-^H%", "!H-^H%", "L-H%", "L-%", "L-L%", "H-H%", "H-L%",
    }
)  # fmt: skip
"""Labels of boundary tones in the schema."""

BREATH = 1.2
"""s that a sentence's end takes by itself: whoever reads a silence there asks only for what is beyond."""

SILENCE = "_"
"""What MARY calls a phone that is none."""

_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_NOT_IN_NAME = re.compile(r"[^A-Za-z0-9_.-]")
_BLOCK = 1 << 16


@dataclass(slots=True)
class _Out:
    """Writes elements of the table, their attributes in its order; forgets what is empty."""

    stream: BinaryIO
    text: StringIO = field(default_factory=StringIO)
    names: set[str] = field(default_factory=set)
    """of marks: no two may be alike"""

    def open(self, element: str, /, **attributes: str) -> None:
        """Begin an element."""
        self.text.write(f"{self._tag(element, attributes)}>\n")

    def empty(self, element: str, /, **attributes: str) -> None:
        """An element with nothing in it."""
        self.text.write(f"{self._tag(element, attributes)}/>\n")

    def close(self, name: str) -> None:
        """End an element."""
        self.text.write(f"</{name}>\n")
        if self.text.tell() > _BLOCK:
            self.flush()

    def say(self, text: str) -> None:
        """Text of a token."""
        self.text.write(f"{escape(_clean(text))}\n")

    def flush(self) -> None:
        """Hand on what is written so far."""
        self.stream.write(self.text.getvalue().encode("utf-8"))
        self.text = StringIO()

    def _tag(self, element: str, attributes: Mapping[str, str]) -> str:
        told = {key.replace("xml_lang", "xml:lang"): _clean(value) for key, value in attributes.items()}
        known = PUBLISHED[element]
        assert told.keys() <= set(known), f"<{element}> has no {', '.join(told.keys() - set(known))}"
        return "".join((f"<{element}", *(f" {key}={quoteattr(told[key])}" for key in known if told.get(key))))


def write(stream: BinaryIO, score: Score) -> None:
    """Write what the Score knows of its words.

    Args:
        stream: Takes bytes.
        score: Any Score; without words it is a document without text, but for the marks of what is felt.
    """
    score = performed(score)
    out = _Out(stream)
    out.text.write('<?xml version="1.0" encoding="UTF-8"?>\n')
    out.open("maryxml", version=VERSION, xmlns=NAMESPACE, xml_lang=score.language)
    language = score.language.partition("-")[0].lower()
    first = score.bodies[0].id if score.bodies else ""
    voices = {body.id: "" if body.id == first else body.voice.voice for body in score.bodies}
    paragraph: list[Said] = []
    for one in said(score):
        paragraph.append(one)
        if one.ends == "paragraph":
            _paragraph(out, paragraph, voices, language)
            paragraph = []
    if paragraph:
        _paragraph(out, paragraph, voices, language)
    if not any(utterance.words for utterance in score.of(Utterance)):
        _wordless(out, score)
    out.close("maryxml")
    out.flush()


def _wordless(out: _Out, score: Score) -> None:
    """What somebody feels who says nothing."""
    felt = sorted(score.of(Emotion), key=lambda emotion: (emotion.onset + emotion.apex, emotion.id))
    if felt:
        out.open("p")
        out.open("s")
        for emotion in felt:
            _mark(out, emotion)
        out.close("s")
        out.close("p")


def _paragraph(out: _Out, words: Sequence[Said], voices: Mapping[str, str], language: str) -> None:
    """Sentences, each by one body."""
    out.open("p")
    speaking, sentence = "", list[Said]()
    for number, one in enumerate(words):
        sentence.append(one)
        last = number + 1 == len(words) or words[number + 1].utterance.body != one.utterance.body
        if not last and not one.ends:
            continue
        voice = voices[one.utterance.body]
        if voice != speaking:
            if speaking:
                out.close("voice")
            if voice:
                out.open("voice", name=voice)
            speaking = voice
        _sentence(out, sentence, language)
        sentence = []
    if speaking:
        out.close("voice")
    out.close("p")


def _sentence(out: _Out, words: Sequence[Said], language: str) -> None:
    """Phrases and their boundaries."""
    out.open("s")
    out.open("phrase")
    number = 0
    while number < len(words):
        count = 1
        while number + count < len(words) and words[number + count].merged:
            count += 1
        _unit(out, words[number : number + count], language)
        number += count
        last = words[number - 1]
        if last.break_index:
            _boundary(out, last)
            if number < len(words):
                out.close("phrase")
                out.open("phrase")
    out.close("phrase")
    out.close("s")


def _unit(out: _Out, words: Sequence[Said], language: str) -> None:
    """Words that one written text became, with the marks and the punctuation around them."""
    for event in (event for one in words for event in one.before):
        _mark(out, event)
    for mark in words[0].opening:
        _punctuation(out, mark)
    original = _original(words)
    if original:
        out.open("mtu", orig=original)
    for one in words:
        _word(out, one, language)
    if original:
        out.close("mtu")
    for mark in words[-1].closing:
        _punctuation(out, mark)
    for event in words[-1].behind:
        _mark(out, event)


def _original(words: Sequence[Said]) -> str:
    """What the words were before they were spelled out; empty where they are it."""
    group = words[0].group
    sources = [one.word.source for one in words if one.word.source]
    if group is None or not sources:
        return ""
    start, end = (
        min(first for first, _ in sources) - group.source[0],
        max(last for _, last in sources) - group.source[0],
    )
    original = " ".join(group.text[max(0, start) : max(0, end)].split())
    spelled = " ".join(one.word.text for one in words)
    return "" if original.casefold() == spelled.casefold() else original


def _punctuation(out: _Out, mark: str) -> None:
    out.open("t")
    out.say(mark)
    out.close("t")


def _word(out: _Out, one: Said, language: str) -> None:
    """A token with its sounds."""
    syllables = syllables_of(one.phones)
    accent = one.word.tone.upper() if one.word.tone.upper() in ACCENTS_OF_WORDS else "*" if one.word.accent else ""
    out.open("t", accent=accent, ph=written(syllables, language), pos=one.word.pos)
    out.say(one.word.text)
    stressed = next((part for part in syllables if part.stress == 1), None)
    for syllable in syllables:
        borne = accent if syllable is stressed and accent in ACCENTS else ""
        _syllable(out, syllable, one.utterance, borne, language)
    out.close("t")


def _syllable(out: _Out, syllable: Syllable, utterance: Utterance, accent: str, language: str) -> None:
    stress = str(syllable.stress) if syllable.stress else ""
    out.open("syllable", accent=accent, ph=sounds(syllable, language), stress=stress)
    for phone in syllable.phones:
        out.empty(
            "ph",
            d=str(max(1, round(phone.duration * 1000.0))),
            end=f"{snap(utterance.onset + phone.onset + phone.duration):.6f}",
            f0=_pitch(utterance, phone),
            p=_clean(name_of(phone.ipa, language)) or SILENCE,
        )
    out.close("syllable")


def _pitch(utterance: Utterance, phone: Phone) -> str:
    """Hertz in the middle of a phone; empty where it has none."""
    hertz, step = utterance.pitch.hertz, utterance.pitch.step
    index = int((phone.onset + phone.duration / 2.0) / step)
    return f"(50,{round(hertz[index])})" if index < len(hertz) and hertz[index] > 0.0 else ""


def _boundary(out: _Out, one: Said) -> None:
    """The boundary behind a word."""
    tone = one.phrase.tone.upper() if one.phrase else ""
    silence = round((one.asked + (BREATH if one.break_index >= SENTENCE else 0.0)) * 1000.0) if one.asked else 0
    out.empty(
        "boundary",
        breakindex=str(one.break_index),
        duration=str(silence) if silence > 0 else "",
        tone=tone if tone in TONES else "",
    )


def _mark(out: _Out, event: Event) -> None:
    """An emotion or a marker, under a name that no other has."""
    if isinstance(event, Emotion):
        name = f"emotion.{_NOT_IN_NAME.sub('_', event.name)}.{round(event.intensity * 100.0)}.{len(out.names) + 1}"
    elif isinstance(event, Marker):
        name = _NOT_IN_NAME.sub("_", event.name)
        name = name if name[:1].isalpha() or name[:1] == "_" else f"_{name}"
    else:
        return
    unique, number = name, 1
    while unique in out.names:
        number += 1
        unique = f"{name}.{number}"
    out.names.add(unique)
    out.empty("mark", name=unique)


def _clean(text: str) -> str:
    """A text of characters that XML may hold, its white space single."""
    return " ".join(_NOT_XML.sub(" ", text).split())
