"""PocketSphinx's ears on one recording: what they understand, how well words fit, and where words and phones are."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scorebreath.errors import InputError, MissingExtraError
from scorebreath.signal.resample import resample
from scorebreath.speech.recording.arpabet import from_ipa
from scorebreath.speech.recording.matching import Difference, Token
from scorebreath.speech.recording.model import Take, Written
from scorebreath.speech.recording.pronounce import Pronouncer

EXTRA = "align"
RATE = 16_000
FRAME = 0.01
"""s between two of its values"""
BEAMS = (1e-64, 1e-120, 1e-200)
"""How much is looked at: more, where less found no way through. The widest is no surer: its sums overflow."""
PEAK = 0.7
"""Full scale 1; what it is given"""
NOISE = 20
"""Of 32767: noise that is added to it, 64 dB below the peaks; at silence without any it fails"""
MORE_NOISE = (0, 60, 150)
"""Of 32767: what is added besides where words cannot be laid over a sound, as over one that is all too clean"""
AROUND = 0.05
"""s of sound around a phrase that belong to it"""
BESIDE = 0.1
"""s of silence around words that are tried"""
STILL = 0.25
"""s of nearly nothing before and after words that are tried: where the sound ends with a word, that is not found"""
QUIET = 0.06
"""s between two words that are understood, that are a silence"""
MARGIN, MOST = 0.6, 3.0
"""What is written may fit worse by so much a frame, in a phrase of so many seconds at most, and is still what is said.
Read by a neural voice, right words were worse by 0.5 at most, and wrong ones by 0.7 at least."""
UNLIKE, FEW = 3, 5
"""Times as many words, and words more, on one side than on the other: that is no mishearing"""
WIDE = 60.0
"""s; a stretch that is longer is doubted without trying"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Said:
    """A word to be laid over the sound."""

    text: str
    """as the dictionary has it"""
    word: int | None
    """its place in the transcript; None: it is not written there"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """A word where it was found."""

    said: Said
    start: float
    end: float
    phones: tuple[tuple[str, float, float], ...]
    """ARPAbet, start and end, s"""


class Listener:
    """PocketSphinx over one recording."""

    def __init__(self, take: Take, say: Pronouncer) -> None:
        """Get the sound ready."""
        try:
            from pocketsphinx import Decoder
        except ImportError as error:
            raise MissingExtraError("pocketsphinx", EXTRA) from error
        self._open, self._say, self._take = Decoder, say, take
        sound = take.samples if take.sample_rate == RATE else resample(take.samples, take.sample_rate, RATE)
        peak = max(1e-6, float(np.abs(sound).max()))
        noise = np.random.Generator(np.random.Philox(0))
        loud = np.round(sound * (PEAK / peak * 32767)) + noise.integers(-NOISE, NOISE + 1, len(sound))
        self._sound: NDArray[np.int16] = loud.astype(np.int16)
        self._still = noise.integers(-NOISE, NOISE + 1, round(STILL * RATE)).astype(np.int16).tobytes()
        self._decoder = Decoder(samprate=RATE, loglevel="FATAL")
        self._own: dict[str, str] = {}
        self._decoders: dict[float, Any] = {}

    def understand(self) -> list[Token]:
        """What is said, as far as it is understood."""
        decoder = self._decoder
        decoder.start_utt()
        decoder.process_raw(self._sound.tobytes(), full_utt=True)
        decoder.end_utt()
        out = []
        for part in decoder.seg() or ():
            if part.word[0] in "<[+":
                continue
            sounds = tuple((decoder.lookup_word(part.word) or "").split())
            start, end = part.start_frame * FRAME, (part.end_frame + 1) * FRAME
            out.append(Token(text=_bare(part.word), sounds=sounds, at=start, until=end))
        return out

    def known(self, word: Written) -> list[str]:
        """The words it is said as, each in the dictionary, perhaps since now."""
        out = []
        for spoken in word.spoken:
            text = "".join(c for c in spoken.lower().replace("’", "'") if c.isalnum() or c == "'").strip("'")
            if text and (self._decoder.lookup_word(text) is not None or text in self._own or self._learn(text, spoken)):
                out.append(text)
        return out

    def sounds(self, text: str) -> tuple[str, ...]:
        """How a word is said."""
        return tuple((self._own.get(text) or self._decoder.lookup_word(text) or "").split())

    def doubts(self, part: Difference, told: Sequence[Token], heard: Sequence[Token]) -> bool:
        """Whether a stretch sounds rather like what was understood than like what is written.

        Both are laid over it, and over what is said around it up to a silence. What was understood is what is likely in
        any English; if what is written fits the sound as well, it is what is said.
        """
        here, there = part.written, part.heard
        if len(here) > UNLIKE * len(there) + FEW or len(there) > UNLIKE * len(here) + FEW:
            return True
        first, last = _phrase(heard, there)
        before, behind = heard[first : there.start], heard[there.stop : last]
        if first == last or heard[last - 1].until - heard[first].at > WIDE:
            return True
        start, end = max(0.0, heard[first].at - BESIDE), heard[last - 1].until + BESIDE
        texts = [
            [word.text for word in (*before, *(line[place] for place in places), *behind)]
            for line, places in ((told, here), (heard, there))
        ]
        for beam in BEAMS:
            scores = [self._fit(words, start, end, beam) for words in texts]
            if scores[1] is not None:
                break
        if scores[1] is None:  # what was understood does not fit either: nobody knows
            return False
        return scores[0] is None or scores[0] < scores[1] - MARGIN * min(MOST, end - start) / FRAME

    def lay(self, said: Sequence[Said], start: float, end: float) -> list[Found]:
        """Words over a part of the sound.

        Raises:
            InputError: There is no way to hear them there.
        """
        if not said:
            return []
        laid = self._laid([one.text for one in said], start, end)
        if laid is None:
            raise InputError(
                f"{self._take.path}: from {start:.1f} to {end:.1f} s it does not say "
                f"{' '.join(one.text for one in said)[:60]!r}; expected the recording of the transcript"
            )
        out: list[Found] = []
        for phrase in _phrases(laid):
            own = said[len(out) : len(out) + len(phrase)]
            finer = self._phones([text for text, _, _ in phrase], phrase[0][1], phrase[-1][2])
            for number, (one, (_, begin, over)) in enumerate(zip(own, phrase, strict=True)):
                if finer is None:
                    out.append(Found(said=one, start=begin, end=over, phones=()))
                else:
                    out.append(Found(said=one, start=finer[number][0], end=finer[number][1], phones=finer[number][2]))
        return out

    def _laid(self, texts: Sequence[str], start: float, end: float) -> list[tuple[str, float, float]] | None:
        """Words and silences, `` for those, with their times; None: no way was found."""
        sound = np.frombuffer(self._cut(start, end), dtype=np.int16).astype(np.int32)
        for noise, beam in itertools.product(MORE_NOISE, BEAMS):
            added = np.random.Generator(np.random.Philox(noise)).integers(-noise, noise + 1, len(sound))
            decoder = self._decoder_for(texts, beam)
            try:
                decoder.set_align_text(" ".join(texts))
                _listen(decoder, (sound + added).clip(-32768, 32767).astype(np.int16).tobytes())
            except RuntimeError:
                continue
            found = [
                ("" if part.word[0] in "<[+(" else _bare(part.word), _time(start, part.start_frame),
                 _time(start, part.end_frame + 1))
                for part in decoder.seg() or ()
            ]  # fmt: skip
            if [text for text, _, _ in found if text] == list(texts):
                return found
        return None

    def _phones(
        self, texts: Sequence[str], start: float, end: float
    ) -> list[tuple[float, float, tuple[tuple[str, float, float], ...]]] | None:
        """Start, end and phones of each word of a phrase."""
        start, end = max(0.0, start - AROUND), end + AROUND
        for beam in BEAMS:
            decoder = self._decoder_for(texts, beam)
            try:
                decoder.set_align_text(" ".join(texts))
                _listen(decoder, self._cut(start, end))
                decoder.set_alignment()
                _listen(decoder, self._cut(start, end))
                words = list(_read(decoder.get_alignment(), start))
            except RuntimeError:
                continue
            if [text for text, *_ in words] == list(texts):
                return [(begin, over, phones) for _, begin, over, phones in words]
        return None

    def _fit(self, texts: Sequence[str], start: float, end: float, beam: float) -> float | None:
        """How well words fit a part of the sound: a logarithm; None where they do not at all."""
        decoder = self._decoder_for(texts, beam)
        try:
            decoder.set_align_text(" ".join(texts))
            _listen(decoder, self._still + self._cut(start, end) + self._still)
            parts = [(part.word, part.ascore) for part in decoder.seg() or ()]
        except RuntimeError:
            return None
        if [_bare(word) for word, _ in parts if word[0] not in "<[+("] != list(texts):
            return None  # the sound was over before the words were
        return sum(math.log(max(score, 1e-300)) for _, score in parts)

    def _decoder_for(self, texts: Sequence[str], beam: float) -> Any:
        if beam not in self._decoders:
            self._decoders[beam] = self._open(
                samprate=RATE, beam=beam, wbeam=beam, pbeam=beam, lm=None, loglevel="FATAL"
            )
        decoder = self._decoders[beam]
        for text in set(texts) & self._own.keys():
            if decoder.lookup_word(text) is None:
                decoder.add_word(text, self._own[text], True)
        return decoder

    def _cut(self, start: float, end: float) -> bytes:
        return self._sound[round(start * RATE) : round(end * RATE)].tobytes()

    def _learn(self, text: str, spoken: str) -> bool:
        """A word that is in no dictionary, as eSpeak NG says it."""
        (sounds,) = self._say.words([spoken])
        names = [name for sound in sounds for name in from_ipa(sound.ipa)]
        if not names:
            return False
        self._own[text] = " ".join(names)
        return True


def _phrase(heard: Sequence[Token], some: range) -> tuple[int, int]:
    """The places from silence to silence around some words, or around the place where there are none."""
    first, last = some.start, some.stop
    while first > 0 and (first == len(heard) or heard[first].at - heard[first - 1].until < QUIET):
        first -= 1
    while last < len(heard) and (last == first or heard[last].at - heard[last - 1].until < QUIET):
        last += 1
    return first, last


def _phrases(laid: Sequence[tuple[str, float, float]]) -> Iterator[list[tuple[str, float, float]]]:
    """Runs of words without a silence between them."""
    run: list[tuple[str, float, float]] = []
    for part in laid:
        if part[0]:
            run.append(part)
        elif run:
            yield run
            run = []
    if run:
        yield run


def _read(alignment: Any, start: float) -> Iterator[tuple[str, float, float, tuple[tuple[str, float, float], ...]]]:
    """Text, start, end and phones of each word, taken as they come: none of its values outlives the next."""
    for word in alignment:
        name, begin, end = word.name, _time(start, word.start), _time(start, word.start + word.duration)
        phones = tuple((one.name, _time(start, one.start), _time(start, one.start + one.duration)) for one in word)
        if name[0] not in "<[+(":
            yield _bare(name), begin, end, phones


def _listen(decoder: Any, sound: bytes) -> None:
    decoder.start_utt()
    decoder.process_raw(sound, full_utt=True)
    decoder.end_utt()


def _time(start: float, frame: int) -> float:
    return max(0.0, start + frame * FRAME)


def _bare(word: str) -> str:
    """Without the number of its pronunciation.

    >>> _bare("to(2)")
    'to'
    """
    return word.partition("(")[0]
