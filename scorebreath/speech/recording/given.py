"""Times that somebody else has found: a Praat TextGrid, or words as JSON, as Whisper and others write them."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from scorebreath.errors import InputError, MissingExtraError, shortened
from scorebreath.speech.recording.labels import as_ipa, silent
from scorebreath.speech.recording.matching import Token, check_share, differences
from scorebreath.speech.recording.model import Alignment, HeardPhone, HeardWord, Take, Written

LARGEST = 50_000_000
"""bytes"""
MOST = 200_000
"""words or phones"""
SHORTEST = 0.005
"""s of a label"""
BEYOND = 0.25
"""s by which times may go beyond the recording, or a TextGrid be longer or shorter than it"""
WORD_TIERS = ("words", "word", "ort-mau", "ort", "orthography", "wrd")
PHONE_TIERS = ("phones", "phone", "phonemes", "phoneme", "mau", "phn", "segments")
"""Names of tiers, in small letters, as tools give them; a speaker's name and ` - ` may stand before them."""
_PARTS = re.compile(r"[^\W_]+(?:['’][^\W_]+)*")

Spoken = Callable[[str], Sequence[str]]
"""The bare words that a word is said as: ("twenty", "three") for 23."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Label:
    """A text with its times."""

    text: str
    start: float
    """s"""
    end: float
    """s"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Given:
    """What a file tells."""

    path: Path
    words: tuple[Label, ...]
    """in order, without silences"""
    phones: tuple[Label, ...] = ()
    """likewise; their texts as written"""

    @property
    def text(self) -> str:
        """All words."""
        return " ".join(word.text for word in self.words)


def read_textgrid(path: Path, take: Take) -> Given:
    """The words of a TextGrid, and its phones where it has them.

    Args:
        path: Of a file as Praat, MFA, MAUS write them: long or short text, or binary.
        take: The recording it is of.

    Raises:
        InputError: It is none, has no words, or is of another recording.
        MissingExtraError: parselmouth is not installed.
    """
    try:
        import parselmouth
        from parselmouth.praat import call
    except ImportError as error:
        raise MissingExtraError("parselmouth", "all") from error

    if b"TextGrid" not in _bytes(path)[:400].replace(b"\0", b""):
        raise InputError(f"{path}: is no TextGrid; expected a file that Praat has written")
    try:
        grid = parselmouth.read(str(path))
        tiers = dict(_tiers(grid, call))
        length = float(call(grid, "Get total duration"))
    except parselmouth.PraatError as error:
        raise InputError(f"{path}: is broken: {str(error).splitlines()[0]}") from None
    if abs(length - take.duration) > BEYOND:
        raise InputError(
            f"{path}: lasts {length:.2f} s, and {take.path} {take.duration:.2f} s; "
            "expected the TextGrid of the recording"
        )
    words = _named(tiers, WORD_TIERS) or _fullest(tiers, PHONE_TIERS)
    if not words:
        raise InputError(f"{path}: holds no words; expected a tier of intervals called words, say")
    phones = _named(tiers, PHONE_TIERS)
    return Given(path=path, words=_ordered(path, words, take), phones=_ordered(path, phones, take) if phones else ())


def read_words(path: Path, take: Take) -> Given:
    """The words of a JSON file: a list of `{"word", "start", "end"}`, alone, under `words`, or in `segments`.

    A word may be called `text`; what has no times is passed over, as some tools give none to numbers.

    Args:
        path: As Whisper with word times, WhisperX or Gentle write it.
        take: The recording it is of.

    Raises:
        InputError: It is none, or of another recording.
    """
    data = _bytes(path)
    try:
        told = json.loads(data)
    except (ValueError, RecursionError) as error:
        where = f": line {error.lineno}, column {error.colno}" if isinstance(error, json.JSONDecodeError) else ""
        raise InputError(f"{path}: is no JSON{where}; expected words with their times") from None
    found = [_label(path, one, number) for number, one in enumerate(_entries(path, told))]
    words = [label for label in found if label is not None and not silent(label.text)]
    if not words:
        raise InputError(f'{path}: holds no words with times; expected {{"words": [{{"word", "start", "end"}}, ...]}}')
    return Given(path=path, words=_ordered(path, words, take))


def align(take: Take, written: Sequence[Written], given: Given, spoken: Spoken) -> Alignment:
    """The words of the transcript where a file says they are.

    Args:
        take: The recording.
        written: Its transcript.
        given: What the file tells.
        spoken: How a word of the file is said.

    Raises:
        InputError: Most of the transcript is not in the file.
    """
    told = [
        (place, Token(text=_plain(word), sounds=tuple(_plain(word))))
        for place, one in enumerate(written)
        for word in one.spoken or (one.text,)
        if _plain(word)
    ]
    heard: list[tuple[Label, Token]] = []
    for label in given.words:
        said = [text for part in _PARTS.findall(label.text) for word in spoken(part) if (text := _plain(word))]
        for number, text in enumerate(said):
            share = (label.end - label.start) / len(said)
            start = label.start + number * share
            token = Token(text=text, sounds=tuple(text), at=start, until=start + share)
            heard.append((Label(text=text, start=start, end=start + share), token))
    parts = differences([token for _, token in told], [token for _, token in heard], exact=True)
    mismatches = tuple(part.mismatch for part in parts)
    check_share(take.path, mismatches, sum(len(part.written) for part in parts), len(told))
    owners = _owners([place for place, _ in told], len(heard), parts)
    words = _gathered(owners, [label for label, _ in heard], written)
    with_phones = _with_phones(words, given.phones)
    return Alignment(words=tuple(with_phones), mismatches=mismatches, by=str(given.path.name))


def _owners(told: Sequence[int], count: int, parts: Sequence[Any]) -> list[int | None]:
    """The written word that each heard one is; None for those that nobody wrote."""
    owners: list[int | None] = []
    at = 0
    for part in [*parts, None]:
        stop = part.written.start if part else len(told)
        owners += told[at:stop]
        if part is None:
            break
        if part.written:
            share = len(part.written) / max(1, len(part.heard))
            owners += [told[part.written.start + int(number * share)] for number in range(len(part.heard))]
        else:
            owners += [None] * len(part.heard)
        at = part.written.stop
    return owners[:count]


def _gathered(owners: Sequence[int | None], labels: Sequence[Label], written: Sequence[Written]) -> list[HeardWord]:
    out: list[HeardWord] = []
    for owner, label in zip(owners, labels, strict=True):
        if out and owner is not None and out[-1].word == owner:
            out[-1] = HeardWord(word=owner, text=out[-1].text, start=out[-1].start, end=label.end)
        else:
            text = label.text if owner is None else written[owner].text
            out.append(HeardWord(word=owner, text=text, start=label.start, end=label.end))
    return out


def _with_phones(words: Sequence[HeardWord], phones: Sequence[Label]) -> Iterator[HeardWord]:
    """Each word with the phones whose middles are in it."""
    ipa = as_ipa([phone.text for phone in phones])
    at = 0
    for word in words:
        own: list[HeardPhone] = []
        while at < len(phones) and (phones[at].start + phones[at].end) / 2 < word.end:
            if (phones[at].start + phones[at].end) / 2 >= word.start:
                own.append(HeardPhone(ipa=ipa[at], start=phones[at].start, end=phones[at].end))
            at += 1
        if own:
            own[0] = HeardPhone(ipa=own[0].ipa, start=word.start, end=own[0].end)
            own[-1] = HeardPhone(ipa=own[-1].ipa, start=own[-1].start, end=word.end)
        yield HeardWord(word=word.word, text=word.text, start=word.start, end=word.end, phones=tuple(own))


def _tiers(grid: Any, call: Callable[..., Any]) -> Iterator[tuple[str, list[Label]]]:
    """The tiers of intervals, by their names."""
    for tier in range(1, int(call(grid, "Get number of tiers")) + 1):
        if not call(grid, "Is interval tier", tier):
            continue
        name = str(call(grid, "Get tier name", tier)).strip()
        labels = []
        for number in range(1, int(call(grid, "Get number of intervals", tier)) + 1):
            text = str(call(grid, "Get label of interval", tier, number)).strip()
            if not silent(text):
                start = float(call(grid, "Get start time of interval", tier, number))
                labels.append(
                    Label(text=text, start=start, end=float(call(grid, "Get end time of interval", tier, number)))
                )
        yield name, labels


def _named(tiers: dict[str, list[Label]], names: Sequence[str]) -> list[Label]:
    """The first tier with one of the names that holds anything."""
    for wanted in names:
        for name, labels in tiers.items():
            if labels and name.lower().rpartition(" - ")[2] == wanted:
                return labels
    return []


def _fullest(tiers: dict[str, list[Label]], but: Sequence[str]) -> list[Label]:
    """The tier with the most words, whatever it is called."""
    others = [labels for name, labels in tiers.items() if name.lower().rpartition(" - ")[2] not in but]
    return max(others, key=len, default=[])


def _entries(path: Path, told: object) -> Iterator[object]:
    """What may be words."""
    if isinstance(told, list):
        yield from told[: MOST + 1]
    elif isinstance(told, dict) and isinstance(told.get("words"), list):
        yield from told["words"][: MOST + 1]
    elif isinstance(told, dict) and isinstance(told.get("segments"), list):
        for number, segment in enumerate(told["segments"]):
            if not isinstance(segment, dict) or not isinstance(segment.get("words"), list):
                raise InputError(f"{path}: segments[{number}] has no words; expected times of words, not of sentences")
            yield from segment["words"]
    else:
        raise InputError(f'{path}: holds neither "words" nor "segments"; expected words with their times')


def _label(path: Path, told: object, number: int) -> Label | None:
    if not isinstance(told, dict):
        raise InputError(f"{path}: words[{number}] is {shortened(repr(told), 40)}; expected an object")
    text = told.get("word", told.get("text"))
    if not isinstance(text, str):
        raise InputError(f'{path}: words[{number}] has no text; expected "word"')
    times = [told.get(key) for key in ("start", "end")]
    if None in times:
        return None
    if not all(isinstance(time, int | float) and not isinstance(time, bool) and math.isfinite(time) for time in times):
        raise InputError(f"{path}: words[{number}].start and .end must be numbers, s")
    start, end = (float(time) for time in times if time is not None)
    if not 0 <= start <= end:
        raise InputError(f"{path}: words[{number}] {shortened(text, 40)!r} goes from {start:g} to {end:g} s")
    return Label(text=text.strip(), start=start, end=end)


def _ordered(path: Path, labels: Sequence[Label], take: Take) -> tuple[Label, ...]:
    """In order of time, none before the one before it ends, all within the recording.

    Raises:
        InputError: They are of another recording.
    """
    if len(labels) > MOST:
        raise InputError(f"{path}: holds {len(labels)} labels; expected at most {MOST}")
    last = max(labels, key=lambda label: label.end)
    if last.end > take.duration + BEYOND:
        raise InputError(
            f"{path}: {shortened(last.text, 40)!r} ends at {last.end:.2f} s, and {take.path} lasts "
            f"{take.duration:.2f} s; expected the times of the recording"
        )
    out: list[Label] = []
    for label in sorted(labels, key=lambda label: (label.start, label.end)):
        start = max(label.start, out[-1].end if out else 0.0)
        end = min(label.end, take.duration)
        if end - start < SHORTEST and out:  # none is left: it has to share with the one before
            before = out[-1]
            start, end = (before.start + before.end) / 2, max(end, before.end)
            out[-1] = Label(text=before.text, start=before.start, end=start)
        if end - start < SHORTEST:
            raise InputError(
                f"{path}: {shortened(label.text, 40)!r} at {label.start:.2f} s has no time of its own; "
                "expected labels one after the other"
            )
        out.append(Label(text=label.text, start=start, end=end))
    return tuple(out)


def _bytes(path: Path) -> bytes:
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST + 1)
    except (FileNotFoundError, NotADirectoryError):
        raise InputError(f"{path}: no such file") from None
    except IsADirectoryError:
        raise InputError(f"{path}: is a folder; expected a file") from None
    if len(data) > LARGEST:
        raise InputError(f"{path}: is larger than {LARGEST // 1_000_000} MB")
    return data


def _plain(word: str) -> str:
    return "".join(c for c in word.casefold().replace("’", "'") if c.isalnum() or c == "'").strip("'")
