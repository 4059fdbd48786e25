"""Utterances of given phones, for the tests of the lips."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from scorebreath.curves.curve_set import curves
from scorebreath.curves.lips.lips import Lips
from scorebreath.curves.lips.targets import CLOSE, JAW, targets
from scorebreath.curves.tracks import Array
from scorebreath.media.store import MemoryStore
from scorebreath.pipeline import compile_text
from scorebreath.score.document import Score
from scorebreath.score.events import Level, Phone, Pitch, Utterance
from scorebreath.speech.voices import open_voice
from scorebreath.units import snap
from tests.curves.scores import MEDIA, score_of

Said = Sequence[tuple[str, float]]
LETTERS = tuple(targets().rows)
CLOSED = ("p", "b", "m")
SENTENCES = {
    "en-us": "My brother Bob bought five blue boats, but Mum preferred warm plums. Perhaps all moved away? Maybe.",
    "de": "Zwei kerzengerade Seelen und aus solidem Haus. Bald wollten sie beide, bum, den Apfel pflücken: ach, üben!",
}


def utterance_of(said: Said, onset: float, id: str = "u") -> Utterance:  # noqa: A002
    """Phones one after the other; a pause is an empty one."""
    phones: list[Phone] = []
    at = 0.0
    for ipa, length in said:
        phones.append(Phone(ipa=ipa, onset=at, duration=snap(length)))
        at = snap(at + snap(length))
    return Utterance(
        id=id, body="body", onset=snap(onset), duration=at, media=MEDIA, gain_db=0.0, closing="final", words=(),
        phones=tuple(phones), pitch=Pitch(step=0.01, hertz=()), level=Level(step=0.01, db=()),
    )  # fmt: skip


def lips_of(*utterances: Utterance) -> Lips:
    """Their lips."""
    return curves(score_of(utterances, duration=100.0)).sources.lips


def sample(lips: Lips, times: Array, *, gate: bool = True, mouth: float = 0.0) -> Array:
    """All channels; the breath holds the mouth open so far."""
    return lips.sample(times, np.full(len(times), mouth), closure_gate=gate)


def aperture(values: Array, mouth: float) -> Array:
    """Of the lips, where the breath holds the mouth open so far."""
    return np.asarray(np.maximum(values[:, JAW], mouth) * (1.0 - values[:, CLOSE]), dtype=np.float64)


def fine(start: float, end: float, step: float = 0.001) -> NDArray[np.float64]:
    """Moments from start to end."""
    return np.arange(start, end, step)


@cache
def spoken(language: str) -> Score:
    """Some sentences as eSpeak NG says them."""
    voice = open_voice("espeak", language)
    try:
        return compile_text(SENTENCES[language], voice=voice, media=MemoryStore())
    finally:
        voice.close()


def strings(shortest: float = 0.005, longest: float = 0.4, letters: Sequence[str] = LETTERS) -> st.SearchStrategy[Said]:
    """Any phones and pauses, many of them very short."""
    length = st.sampled_from([shortest, 0.02, 0.04, 0.08, 0.16, longest]) | st.integers(
        round(shortest * 1e6), round(longest * 1e6)
    ).map(lambda n: n / 1e6)
    ipa = st.sampled_from([*letters, "", "aɪ", "tʃ", "pf", "ɑːɹ", "ɐ̃ʊ̃"])
    some = st.lists(st.tuples(ipa, length), min_size=1, max_size=14)
    few = st.lists(st.tuples(st.sampled_from(["p", "a", "f", "u"]), st.just(shortest)), min_size=1, max_size=40)
    return some | few
