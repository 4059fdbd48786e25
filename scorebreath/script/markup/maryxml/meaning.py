"""What each element of MaryXML does."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from scorebreath.equations.phones import ipa_of
from scorebreath.errors import InputError
from scorebreath.score.acting import EMOTIONS
from scorebreath.script import emotions
from scorebreath.script.marks import Act, ActName, EmotionMark, NamedMark, VoiceMark
from scorebreath.script.markup.attributes import Attributes
from scorebreath.script.markup.maryxml import labels, quantities
from scorebreath.script.markup.maryxml.document import MaryDocument, Token
from scorebreath.script.markup.meaning import Close, check_language, prosody_until_end
from scorebreath.script.markup.names import is_name
from scorebreath.script.markup.quantities import share
from scorebreath.script.markup.values import Prosody

VOCALIZATIONS: Mapping[str, ActName] = {
    "laughter": "laugh", "laugh": "laugh", "sigh": "sigh", "breath": "breath", "gasp": "gasp", "sniff": "sniff",
}  # fmt: skip
"""Sounds that are no words, and what the body does for them; any other is a named place in the Score."""
EMOTION = re.compile(r"emotion\.(?P<name>[a-z]+)(?:\.(?P<percent>[0-9]{1,3}))?(?:\.[0-9]+)?")
"""A mark's name that stands for an emotion, as we write it: the published schemas have no element for one."""
DIMENSIONS = frozenset({"activation", "evaluation", "power"})
"""What an emotion without a name is told by; nothing is made of them."""
BODY_PREFIX = ":"
"""What is in every name of a voice of ours, such as `espeak:de`, and in none of MaryTTS's."""
LONGEST_POS = 32
"""Letters of a part of speech."""
LANGUAGE = "de"
"""Of a document without a language and a version: before its schemas, MARY spoke German alone (S3 7)."""

_SPACES = re.compile(r"\s+")


def _maryxml(document: MaryDocument, attributes: Attributes) -> Close:
    if "xml:lang" in attributes.values:
        attributes.read("xml:lang", _tag, "", "a BCP 47 tag such as en, de or pt-BR")
        document.told = attributes.values["xml:lang"].strip()
    elif "version" not in attributes.values:
        document.told = LANGUAGE
    document.language = document.language or document.told

    def close(_: str, __: str) -> None:
        document.implied = -1

    return close


def _tag(text: str) -> str | None:
    """A language tag, or None."""
    return text if re.fullmatch(r"[A-Za-z]{2,8}([-_][A-Za-z0-9]{1,8})*", text) else None


def _paragraph(document: MaryDocument, attributes: Attributes) -> Close:
    check_language(document, attributes)
    document.writer.paragraph()

    def close(_: str, __: str) -> None:
        document.end_paragraph()

    return close


def _sentence(document: MaryDocument, attributes: Attributes) -> Close:
    check_language(document, attributes)
    document.end_sentence()

    def close(_: str, __: str) -> None:
        document.end_sentence()

    return close


def _division(document: MaryDocument, attributes: Attributes) -> Close:
    return (_paragraph if "paragraph" in attributes.values.get("type", "") else _sentence)(document, attributes)


def _speaker(document: MaryDocument, attributes: Attributes) -> None:
    _advice(document, attributes, "speaker", attributes.values.get("gender", ""))


def _voice(document: MaryDocument, attributes: Attributes) -> Close | None:
    check_language(document, attributes)
    name = attributes.values.get("name", "").strip()
    if BODY_PREFIX not in name:
        _advice(document, attributes, "voice", name or attributes.values.get("gender", ""))
        return None
    if not is_name(name):
        raise attributes.wrong("name", "the name of one voice, without spaces")
    document.voices.append(name)
    document.writer.mark(VoiceMark(at=0, written=attributes.written, voice=name))

    def close(_: str, written: str) -> None:
        document.voices.pop()
        document.writer.mark(VoiceMark(at=0, written=written, voice=document.voices[-1]))

    return close


def _advice(document: MaryDocument, attributes: Attributes, what: str, told: str) -> None:
    """Whose voice it should be is kept as a named place: another body comes with a voice of ours alone."""
    name = _SPACES.sub("-", f"{what}:{told.strip()}")
    if told.strip() and is_name(name):
        document.writer.mark(NamedMark(at=0, written=attributes.written, name=name))


def _prosody(document: MaryDocument, attributes: Attributes) -> Close:
    forced = attributes.values.get("force-accent", "").strip()
    change = Prosody(
        attributes.read("rate", quantities.rate, 1.0, quantities.RATE_FORM),
        attributes.read("pitch", quantities.pitch, 1.0, quantities.PITCH_FORM),
        attributes.read("volume", quantities.volume, 0.0, quantities.VOLUME_FORM),
        forced in {"word", "syllable"} or (document.prosody[-1].emphasis and forced != "none"),
    )
    if document.prosody[-1].then(change) == document.prosody[-1]:
        return lambda _, __: None
    return prosody_until_end(document, attributes, change)


def _phrase(document: MaryDocument, _: Attributes) -> Close:
    began = document.last

    def close(_: str, __: str) -> None:
        document.end_phrase(began)

    return close


def _token(document: MaryDocument, attributes: Attributes) -> Close:
    values = attributes.values
    sounds = (values.get("ph") or values.get("sampa") or "").strip()
    document.token = Token(
        accent=attributes.read("accent", labels.accent, "", labels.ACCENT_FORM) or None,
        pos="".join(values.get("pos", "").split())[:LONGEST_POS],
        ipa=_pronounced(sounds, document.language or "en"),
        sounds_like=values.get("sounds_like", ""),
    )

    def close(_: str, __: str) -> tuple[str, str] | None:
        assert document.token is not None
        empty = not "".join(document.token.pieces).strip() and not document.token.sounds_like.strip()
        if empty and sounds:
            return "<t> with its sounds alone", "the word as it is written in it: a voice says words"
        document.close_token()
        return None

    return close


def _pronounced(sounds: str, language: str) -> str:
    """A pronunciation in IPA; nothing where a language has names of phones that are not SAMPA's."""
    try:
        return ipa_of(sounds, language)
    except InputError:
        return ""


def _boundary(document: MaryDocument, attributes: Attributes) -> None:
    index = attributes.read("breakindex", quantities.break_index, 0, quantities.INDEX_FORM)
    pause = attributes.read("duration", quantities.length, 0.0, quantities.LENGTH_FORM)
    tone = attributes.read("tone", labels.tone, "", labels.TONE_FORM)
    document.boundary(attributes.written, index or None, tone, pause or None)


def _mark(document: MaryDocument, attributes: Attributes) -> None:
    name = attributes.values["name"].strip()
    match = EMOTION.fullmatch(name)
    if match and match["name"] in EMOTIONS:
        share = min(int(match["percent"] or 100), 100) / 100.0
        mark = EmotionMark(at=0, written=attributes.written, name=match["name"], intensity=share)
        document.writer.mark(mark)
    elif is_name(name):
        document.writer.mark(NamedMark(at=0, written=attributes.written, name=name))
    else:
        raise attributes.wrong("name", "one name without spaces")


def _emotion(document: MaryDocument, attributes: Attributes) -> None:
    if "type" not in attributes.values and attributes.values.keys() & DIMENSIONS:
        return
    if "type" not in attributes.values:
        raise attributes.origin.error(attributes.place(), "<emotion> without type", emotions.expected(""))
    told = attributes.values["type"].strip()
    name = attributes.read("type", emotions.named, "", emotions.expected(told))
    intensity = attributes.read("intensity", share, 1.0, "a number from 0 to 1, or a percentage")
    document.writer.mark(EmotionMark(at=0, written=attributes.written, name=name, intensity=intensity))


def _vocalization(document: MaryDocument, attributes: Attributes) -> None:
    name = attributes.values.get("name", "").strip()
    act = VOCALIZATIONS.get(name.lower())
    if act:
        document.writer.mark(Act(at=0, written=attributes.written, name=act))
    else:
        _advice(document, attributes, "vocalization", name)


MEANINGS: Mapping[str, Callable[[MaryDocument, Attributes], Close | None]] = {
    "maryxml": _maryxml,
    "p": _paragraph,
    "s": _sentence,
    "div": _division,
    "speaker": _speaker,
    "voice": _voice,
    "prosody": _prosody,
    "phrase": _phrase,
    "t": _token,
    "boundary": _boundary,
    "mark": _mark,
    "emotion": _emotion,
    "vocalization": _vocalization,
}
"""Elements of `ELEMENTS` that do something; text in the others is said as if they were not there."""
