"""The languages and variants eSpeak NG has, read from its data folder, and the lines that define a voice."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from scorebreath.errors import InputError, VoiceError, did_you_mean

DEFAULTS = {"en": "en-us", "en-uk": "en-gb"}
"""Language of a script: which of the voices that call themselves so. Else the one with the best priority."""
SUBTAG = re.compile(r"-(?:x(?:-[a-z0-9]{1,8})+|[a-z]{2}|[0-9]{3}|[a-z]{4}|[0-9][a-z0-9]{3}|[a-z0-9]{5,8})\Z", re.ASCII)
"""The last subtag of a BCP 47 tag where a less special one may do without: private use, region, script, variant."""
CLOSE = 0.85
"""Likeness from which a name or code is offered for a misspelt one: `germn` for German, but not Dutch for `deutsch`."""
PRIORITY = 5
"""of a language line that gives none; lower is better"""
PITCH = (82, 118)
"""Hz; of a voice that gives none: base and top"""
CONTINUATION = "c2"
"""Tune of a clause that goes on.

With the voices' own (mostly c1), the last 250 ms of a group that goes on lie 2.1 st below its mean, the median over 118
voices; with c2 1.0 st. Questions keep their own tunes, which end in a rise of 4 st (physiology 5).
"""
KEPT = frozenset({"c3", "chrc"})
"""Tunes left to their voices: French and Kyrgyz c3 ends level (0.1 st above the mean), Cherokee has its own tones."""
LEFT_OUT = frozenset({"language", "name", "gender", "maintainer", "status", "echo"})
"""Lines of a variant that are not used: those that say what it is; and the echo that 29 of them have, which fills the
closures of stops, hides where the speech ends, and would not be on the breath."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Language:
    """One language file."""

    code: str
    """its first language, lower case: `en-us`"""
    codes: tuple[tuple[str, int], ...]
    """all it answers to, each with its priority"""
    name: str
    """e.g. `English (America)`"""
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Chosen:
    """A language with or without a variant."""

    language: Language
    variant: str
    lines: tuple[str, ...]
    """language and variant together"""

    @property
    def name(self) -> str:
        """e.g. `en-us+f3`."""
        return f"{self.language.code}+{self.variant}" if self.variant else self.language.code

    @property
    def pitch(self) -> tuple[int, int]:
        """Hz: base and top of its range."""
        found = [_numbers(line) for line in self.lines if line.split()[0] == "pitch"]
        return next(((one[0], one[1]) for one in reversed(found) if len(one) > 1), PITCH)

    def definition(self, pitch: tuple[int, int] | None = None, *, continuing: bool = False) -> str:
        """The lines of a voice file.

        Args:
            pitch: Instead of its own.
            continuing: With the tune that tells a continuation from an ending. Only then: a line of tunes also undoes
                an `intonation` that the language may have.
        """
        own = {word for line in self.lines if line.split()[0] == "tunes" for word in line.split()[1:]}
        tunes = [f"tunes NULL {CONTINUATION}"] if continuing and not own & KEPT else []
        more = [f"pitch {pitch[0]} {pitch[1]}"] if pitch else []
        return "\n".join([*self.lines, *tunes, *more, ""])


@dataclass(frozen=True, slots=True, kw_only=True)
class Catalogue:
    """All there is in one data folder."""

    folder: Path
    languages: tuple[Language, ...]
    variants: tuple[str, ...]

    def choose(self, code: str, variant: str = "") -> Chosen:
        """A voice by language code and variant.

        Args:
            code: As `find` takes it.
            variant: As the file is named, any case; may be empty.

        Raises:
            InputError: There is no such language or variant; names a close one.
        """
        language = self.find(code)
        if language is None:
            raise InputError(f"voice 'espeak:{code}': eSpeak NG has no language {code!r}{self.hint(code)}")
        lines = language.lines
        if variant:
            file = next((name for name in self.variants if name.lower() == variant.lower()), None)
            if file is None:
                close = did_you_mean(variant, self.variants)
                raise InputError(f"voice 'espeak:{code}+{variant}': there is no variant {variant!r}{close}")
            variant = file
            lines += _sound_lines(self.folder / "voices" / "!v" / file)
        return Chosen(language=language, variant=variant, lines=lines)

    def find(self, code: str) -> Language | None:
        """The language that answers best to a code, or None.

        A tag more special than any here falls back, subtag by subtag (RFC 4647, 3.4): `de-AT` to `de`.

        Args:
            code: As the user or the script gives it, any case, `_` for `-` allowed.
        """
        wanted = _plain(code)
        while (found := self._named(wanted)) is None:
            shorter = SUBTAG.sub("", wanted)
            if shorter == wanted:
                return None
            wanted = shorter
        return found

    def hint(self, code: str) -> str:
        """A tail for the message about a language that is not there: the one that is meant, or what a code is.

        Both codes and English names are looked at: for `german` it offers `de`.
        """
        from difflib import get_close_matches

        wanted = _plain(code)
        offers = {known: known for one in self.languages for known, _ in one.codes}
        words: dict[str, str] = {}
        for one in sorted(self.languages, key=lambda one: len(one.code)):
            name, _, _ = one.name.lower().partition(" (")
            primary = one.code.partition("-")[0]
            offers.setdefault(name, primary if self._named(primary) else one.code)
            for word in re.findall(r"\w{4,}", one.name.lower()):
                words.setdefault(word, one.code)
        close = get_close_matches(wanted, offers, n=1, cutoff=CLOSE)
        offer = offers[close[0]] if close else words.get(wanted)
        return f"; did you mean {offer}?" if offer else "; expected a code as en, de or fr-FR"

    def _named(self, wanted: str) -> Language | None:
        """The one with this very code, that has the best priority."""
        wanted = DEFAULTS.get(wanted, wanted)
        ranked = [
            (priority, language.code, language)
            for language in self.languages
            for known, priority in language.codes
            if known == wanted
        ]
        return min(ranked, key=lambda one: one[:2])[2] if ranked else None


@cache
def catalogue(folder: str) -> Catalogue:
    """Read a data folder.

    Raises:
        VoiceError: It is not one.
    """
    data = Path(folder)
    dictionaries = {path.name.removesuffix("_dict") for path in data.glob("*_dict")}
    read = [_language(path) for path in sorted((data / "lang").rglob("*")) if path.is_file()]
    languages = tuple(one for one in read if one is not None and _dictionary(one) in dictionaries)
    if not languages:
        raise VoiceError(f"eSpeak NG has no voices in {folder}: pip install --force-reinstall espeakng-loader")
    variants = tuple(sorted(path.name for path in (data / "voices" / "!v").glob("*") if path.is_file()))
    return Catalogue(folder=data, languages=languages, variants=variants)


def _plain(code: str) -> str:
    return code.lower().replace("_", "-")


def _language(path: Path) -> Language | None:
    lines = _lines(path)
    said = [line.split() for line in lines if line.split()[0] == "language"]
    codes = tuple((one[1].lower(), int(one[2]) if len(one) > 2 else PRIORITY) for one in said if len(one) > 1)
    if not codes:
        return None
    name = next((line.split(None, 1)[1] for line in lines if line.split()[0] == "name" and " " in line), path.name)
    return Language(code=codes[0][0], codes=codes, name=name, lines=tuple(lines))


def _dictionary(language: Language) -> str:
    named = [line.split()[1] for line in language.lines if line.split()[0] == "dictionary"]
    return named[-1] if named else language.code.partition("-")[0]


def _sound_lines(path: Path) -> tuple[str, ...]:
    return tuple(line for line in _lines(path) if line.split()[0] not in LEFT_OUT)


def _lines(path: Path) -> list[str]:
    """Lines that say something; comments are dropped, some of which are in encodings of their own."""
    text = path.read_text(encoding="utf-8", errors="surrogateescape")
    lines = (line.partition("//")[0].strip() for line in text.splitlines())
    return [line for line in lines if line and not line.startswith("#")]


def _numbers(line: str) -> list[int]:
    return [int(word) for word in line.split()[1:] if word.lstrip("-").isdigit()]


def codes_of(languages: Iterable[Language]) -> tuple[str, ...]:
    """First code of each, sorted."""
    return tuple(sorted(language.code for language in languages))
