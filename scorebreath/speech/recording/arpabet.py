"""ARPAbet, as the CMU dictionary writes English, and the International Phonetic Alphabet."""

from __future__ import annotations

IPA = {
    "AA": "ɑ", "AE": "æ", "AH": "ʌ", "AO": "ɔ", "AW": "aʊ", "AY": "aɪ", "B": "b", "CH": "tʃ", "D": "d", "DH": "ð",
    "EH": "ɛ", "ER": "ɚ", "EY": "eɪ", "F": "f", "G": "ɡ", "HH": "h", "IH": "ɪ", "IY": "i", "JH": "dʒ", "K": "k",
    "L": "l", "M": "m", "N": "n", "NG": "ŋ", "OW": "oʊ", "OY": "ɔɪ", "P": "p", "R": "ɹ", "S": "s", "SH": "ʃ",
    "T": "t", "TH": "θ", "UH": "ʊ", "UW": "u", "V": "v", "W": "w", "Y": "j", "Z": "z", "ZH": "ʒ",
}  # fmt: skip
"""What each is in IPA."""
OTHERS = {
    "ɐ": "AH", "ə": "AH", "ɜ": "ER", "ɝ": "ER", "ɒ": "AA", "a": "AA", "e": "EY", "o": "OW", "ɾ": "T", "ʔ": "T",
    "ᵻ": "IH", "ᵿ": "UH", "ɨ": "IH", "ɬ": "L", "ɫ": "L", "x": "K", "r": "R", "ʁ": "R", "g": "G", "y": "UW", "ʏ": "UH",
    "ø": "ER", "œ": "ER", "ç": "HH", "ɲ": "N", "ʍ": "W", "β": "V", "ʎ": "L", "ɣ": "G",
}  # fmt: skip
"""Letters that eSpeak NG writes besides."""
_FROM_IPA = {ipa: name for name, ipa in IPA.items()} | OTHERS
_LONGEST = max(map(len, _FROM_IPA))


def from_ipa(ipa: str) -> list[str]:
    """The nearest sounds of ARPAbet; what has none is left out.

    >>> from_ipa("weɪskoʊt"), from_ipa("ɔːɫ")
    (['W', 'EY', 'S', 'K', 'OW', 'T'], ['AO', 'L'])
    """
    found: list[str] = []
    at = 0
    while at < len(ipa):
        for length in range(_LONGEST, 0, -1):
            name = _FROM_IPA.get(ipa[at : at + length])
            if name is not None and len(ipa[at : at + length]) == length:
                found.append(name)
                at += length
                break
        else:
            at += 1
    return found
