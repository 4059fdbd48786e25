"""English in a recording, found by PocketSphinx: what is understood, and when each phone of the transcript is said.

It listens twice. First it writes down what it understands; where that and the transcript part, the recording says
something else (`matching`). Then the transcript, so corrected, is laid over the sound, from silence to silence.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib import metadata

from scorebreath.speech.recording.arpabet import IPA
from scorebreath.speech.recording.ears import Found, Listener, Said
from scorebreath.speech.recording.matching import Difference, Token, check_share, differences
from scorebreath.speech.recording.model import Alignment, HeardPhone, HeardWord, Progress, Take, Written
from scorebreath.speech.recording.pronounce import Pronouncer, stressed

PIECE = 40.0
"""s; the transcript is laid over so much sound at a time, if there are silences to cut it at"""
UNDERSTOOD, DOUBTED = 0.5, 0.8
"""Share of the work that is done when all is understood, and when all is doubted that is to be"""
CUT = 0.25
"""s; shortest silence to cut at"""


def align(take: Take, written: Sequence[Written], say: Pronouncer, on_progress: Progress | None = None) -> Alignment:
    """Find the words of an English transcript.

    Args:
        take: The recording.
        written: Its transcript.
        say: Says words that no dictionary has.
        on_progress: Told the fraction that is done, 0..1.

    Raises:
        InputError: The transcript is not that of the recording.
        MissingExtraError: PocketSphinx is not installed.
    """
    listener = Listener(take, say)
    heard = listener.understand()
    said = [Said(text=text, word=place) for place, word in enumerate(written) for text in listener.known(word)]
    told = [Token(text=one.text, sounds=listener.sounds(one.text)) for one in said]
    tell = on_progress or (lambda _: None)
    tell(UNDERSTOOD)
    parts: list[Difference] = []
    doubtful = differences(told, heard)
    for number, part in enumerate(doubtful, 1):
        parts += [part] if listener.doubts(part, told, heard) else []
        tell(UNDERSTOOD + (DOUBTED - UNDERSTOOD) * number / len(doubtful))
    check_share(take.path, [part.mismatch for part in parts], sum(len(part.written) for part in parts), len(said))
    line = list(_corrected(said, heard, parts))
    words = []
    for first, last, start, end in _pieces(line, heard, take.duration):
        words += listener.lay([one for one, _ in line[first:last]], start, end)
        tell(DOUBTED + (1.0 - DOUBTED) * end / take.duration)
    found = _words(words, written, say)
    return Alignment(
        words=tuple(found), mismatches=tuple(part.mismatch for part in parts),
        by=f"pocketsphinx {metadata.version('pocketsphinx')}",
    )  # fmt: skip


def _corrected(
    said: Sequence[Said], heard: Sequence[Token], parts: Sequence[Difference]
) -> Iterator[tuple[Said, float | None]]:
    """What is said in truth: without words that are missing, with those that nobody wrote; and when, if it is known."""
    from difflib import SequenceMatcher

    matcher = SequenceMatcher(None, [one.text for one in said], [one.text for one in heard], autojunk=False)
    when = {}
    for block in matcher.get_matching_blocks():
        for offset in range(block.size):
            when[block.a + offset] = heard[block.b + offset].at
    missing = {place for part in parts if part.mismatch.kind == "missing" for place in part.written}
    extra: dict[int, list[Token]] = {}
    for part in parts:
        if part.mismatch.kind == "extra":
            extra.setdefault(part.written.start, []).extend(heard[place] for place in part.heard)
    for place in range(len(said) + 1):
        for token in extra.get(place, ()):
            yield Said(text=token.text, word=None), token.at
        if place < len(said) and place not in missing:
            yield said[place], when.get(place)


def _pieces(
    line: Sequence[tuple[Said, float | None]], heard: Sequence[Token], duration: float
) -> Iterator[tuple[int, int, float, float]]:
    """From where to where the words are laid over which part of the sound."""
    ends = {token.at: token.until for token in heard}
    first, begun = 0, 0.0
    for place in range(1, len(line)):
        before, here = line[place - 1][1], line[place][1]
        if before is None or here is None or here - begun < PIECE:
            continue
        silent = here - ends.get(before, here)
        if silent >= CUT:
            cut = here - silent / 2
            yield first, place, begun, cut
            first, begun = place, cut
    yield first, len(line), begun, duration


def _words(found: Sequence[Found], written: Sequence[Written], say: Pronouncer) -> Iterator[HeardWord]:
    """Words as they are written, those that are said as several put together."""
    groups: list[list[Found]] = []
    for one in found:
        if groups and one.said.word is not None and groups[-1][0].said.word == one.said.word:
            groups[-1].append(one)
        else:
            groups.append([one])
    spoken = say.words([part.said.text for group in groups for part in group])
    told = iter(spoken)
    for group in groups:
        phones: list[HeardPhone] = []
        for part in group:
            ipa = [IPA[name] for name, _, _ in part.phones]
            stress = stressed(ipa, next(told))
            for name, level, (_, start, end) in zip(ipa, stress, part.phones, strict=True):
                weak = "ə" if name == "ʌ" and not level else name
                phones.append(HeardPhone(ipa=weak, start=start, end=end, stress=level))
        place = group[0].said.word
        yield HeardWord(
            word=place, text=group[0].said.text if place is None else written[place].text, start=group[0].start,
            end=group[-1].end, phones=tuple(phones),
        )  # fmt: skip
