"""What each element of SSML does: to the text, to the marks, to what is in force until it ends."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from scorebreath.errors import ScriptError
from scorebreath.script import emotions
from scorebreath.script.language import primary
from scorebreath.script.marks import Act, BreathingMark, EmotionMark, Mark, NamedMark, NoBreath, ProsodyMark, VoiceMark
from scorebreath.script.markup import values
from scorebreath.script.markup.attributes import Attributes
from scorebreath.script.markup.names import LONGEST_NAME, is_name
from scorebreath.script.markup.quantities import LONGEST_PAUSE, seconds, share
from scorebreath.script.markup.say_as import INTERPRETATIONS, say_as
from scorebreath.script.markup.values import Prosody
from scorebreath.script.markup.writer import Writer

Close = Callable[[str, str], tuple[str, str] | None]
"""What happens at an element's end, given the text in it and the closing tag; a problem and what was expected."""

VERSIONS = ("1.0", "1.1")


@dataclass(slots=True, kw_only=True)
class Document:
    """What is known about a document while it is read."""

    language: str | None
    """BCP 47, if the caller said one; else the document's"""
    told: str | None = None
    """as the document says"""
    writer: Writer = field(default_factory=Writer)
    prosody: list[Prosody] = field(default_factory=lambda: [Prosody()])
    """in force, the innermost last"""
    voices: list[str] = field(default_factory=lambda: [""])
    breathing: list[BreathingMark] = field(default_factory=lambda: [BreathingMark(at=0, written="")])

    def text(self, text: str, element: int) -> None:
        """Take what stands in an element that may hold anything.

        Args:
            text: As written.
            element: Which it is: the byte at which its tag begins.
        """
        self.writer.text(text)

    def mark_prosody(self, written: str) -> None:
        """Say how the voice speaks from here on."""
        now = self.prosody[-1]
        self.writer.mark(
            ProsodyMark(
                at=0, written=written,
                rate=now.rate, pitch=now.pitch, volume_db=now.volume_db, emphasis=now.emphasis,
            )
        )  # fmt: skip


def _speak(document: Document, attributes: Attributes) -> Close | None:
    attributes.choice("version", {version: version for version in VERSIONS}, VERSIONS[-1])
    if "xml:lang" in attributes.values:
        _primary(attributes)
        document.told = attributes.values["xml:lang"].strip()
        document.language = document.language or document.told
    return None


def check_language(document: Document, attributes: Attributes) -> None:
    """An element may name the language of the whole text again."""
    if "xml:lang" in attributes.values:
        whole = (document.language or "en").replace("_", "-").partition("-")[0].lower()
        if _primary(attributes) != whole:
            raise attributes.wrong("xml:lang", f"{whole}, as the whole text: it is read in one language")


def _primary(attributes: Attributes) -> str:
    """The primary language an element names."""
    try:
        return primary(attributes.values["xml:lang"].strip())
    except ScriptError as error:
        raise attributes.wrong("xml:lang", error.expected) from None


def _paragraph(document: Document, attributes: Attributes) -> Close:
    check_language(document, attributes)
    document.writer.paragraph()

    def close(_: str, __: str) -> None:
        document.writer.paragraph()

    return close


def _sentence(document: Document, attributes: Attributes) -> Close:
    check_language(document, attributes)
    document.writer.sentence()

    def close(_: str, __: str) -> None:
        document.writer.sentence()

    return close


def _transparent(document: Document, attributes: Attributes) -> None:
    check_language(document, attributes)


def _break(document: Document, attributes: Attributes) -> None:
    expected = f"a length of at most {LONGEST_PAUSE:g} s, such as 400ms or 1.5s"
    time = attributes.read("time", lambda text: seconds(text, LONGEST_PAUSE, bare=False), None, expected)
    pauses: Mapping[str, float | None] = {"none": None, **values.BREAKS}
    strength = attributes.choice("strength", pauses, "medium")
    if attributes.values.get("strength", "").strip() == "none":
        document.writer.mark(NoBreath(at=0, written=attributes.written))
    length = strength if time is None else time
    if length is not None:
        document.writer.mark(Act(at=0, written=attributes.written, name="pause", seconds=length))


def _mark(document: Document, attributes: Attributes) -> None:
    name = mark_name(attributes, "one name")
    document.writer.mark(NamedMark(at=0, written=attributes.written, name=name))


def mark_name(attributes: Attributes, what: str) -> str:
    """The attribute `name`, as `what` it names."""
    expected = f"{what} of at most {LONGEST_NAME} letters without spaces"
    return attributes.read("name", lambda text: text if is_name(text) else None, "", expected)


def _emotion(document: Document, attributes: Attributes) -> None:
    expected = emotions.expected(attributes.values["type"].strip())
    name = attributes.read("type", emotions.named, "", expected)
    intensity = attributes.read("intensity", share, 1.0, "a number from 0 to 1, or a percentage")
    document.writer.mark(EmotionMark(at=0, written=attributes.written, name=name, intensity=intensity))


def _emphasis(document: Document, attributes: Attributes) -> Close:
    return prosody_until_end(document, attributes, attributes.choice("level", values.EMPHASES, "moderate"))


def _prosody(document: Document, attributes: Attributes) -> Close:
    change = Prosody(
        attributes.read("rate", values.rate, 1.0, values.RATE_FORM),
        attributes.read("pitch", values.pitch, 1.0, values.PITCH_FORM),
        attributes.read("volume", values.volume, 0.0, values.VOLUME_FORM),
        document.prosody[-1].emphasis,
    )
    return prosody_until_end(document, attributes, change)


def prosody_until_end(document: Document, attributes: Attributes, change: Prosody) -> Close:
    """Another way of speaking up to the element's end."""
    document.prosody.append(document.prosody[-1].then(change))
    document.mark_prosody(attributes.written)

    def close(_: str, written: str) -> None:
        document.prosody.pop()
        document.mark_prosody(written)

    return close


def _sub(document: Document, attributes: Attributes) -> None:
    document.writer.text(attributes.values["alias"])


def _say_as(document: Document, attributes: Attributes) -> Close:
    kind = attributes.choice("interpret-as", INTERPRETATIONS, "")
    form = attributes.values.get("format", "").strip()
    if "format" in attributes.values and not kind.takes(form):
        raise attributes.wrong("format", kind.formats or "no format")

    def close(text: str, _: str) -> tuple[str, str] | None:
        said = say_as(kind, " ".join(text.split()), form, document.language or "en")
        if isinstance(said, str):
            document.writer.text(said)
            return None
        return said

    return close


def _voice(document: Document, attributes: Attributes) -> Close:
    check_language(document, attributes)
    name = mark_name(attributes, "the name of one voice")
    document.voices.append(name)
    document.writer.mark(VoiceMark(at=0, written=attributes.written, voice=name))

    def close(_: str, written: str) -> None:
        document.voices.pop()
        document.writer.mark(VoiceMark(at=0, written=written, voice=document.voices[-1]))

    return close


def _breath(document: Document, attributes: Attributes) -> None:
    document.writer.mark(
        Act(
            at=0,
            written=attributes.written,
            name="breath",
            length=attributes.choice("duration", values.BREATH_LENGTHS, "default"),
            level_db=attributes.choice("volume", values.BREATH_LEVELS, "default"),
        )
    )


def _auto_breaths(document: Document, attributes: Attributes) -> Close:
    mark = BreathingMark(
        at=0,
        written=attributes.written,
        level_db=attributes.choice("volume", values.BREATH_LEVELS, "default"),
        length=attributes.choice("duration", values.BREATH_LENGTHS, "default"),
        frequency=attributes.choice("frequency", values.BREATH_FREQUENCIES, "default"),
    )
    document.breathing.append(mark)
    document.writer.mark(mark)

    def close(_: str, written: str) -> None:
        document.breathing.pop()
        outer = document.breathing[-1]
        document.writer.mark(_again(outer, written))

    return close


def _again(mark: BreathingMark, written: str) -> Mark:
    """The same from another place on."""
    return BreathingMark(
        at=0, written=written, level_db=mark.level_db, length=mark.length, frequency=mark.frequency, silent=mark.silent
    )


MEANINGS: Mapping[str, Callable[[Document, Attributes], Close | None]] = {
    "speak": _speak,
    "p": _paragraph,
    "paragraph": _paragraph,
    "s": _sentence,
    "sentence": _sentence,
    "break": _break,
    "mark": _mark,
    "emotion": _emotion,
    "emphasis": _emphasis,
    "prosody": _prosody,
    "sub": _sub,
    "say-as": _say_as,
    "voice": _voice,
    "lang": _transparent,
    "w": _transparent,
    "token": _transparent,
    "amazon:breath": _breath,
    "amazon:auto-breaths": _auto_breaths,
}
"""Elements of `ELEMENTS` that do something."""
