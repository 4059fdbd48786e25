"""Labels of accents and of boundary tones, as the published schema lists them; small letters are S3's (A12)."""

from __future__ import annotations

from scorebreath.script.told import NO_ACCENT

ACCENT_UNKNOWN, ACCENT_ANY = "unknown", "*"
ACCENTS = frozenset(
    {
        ACCENT_ANY, "h*", "!h*", "^h*", "l*", "l+h*", "l*+h", "l+!h*", "l*+!h", "l+^h*", "l*+^h", "h+l*", "h+!h*",
        "h+^h*", "!h+!h*", "^h+!h*", "^h+^h*", "h*+l", "!h*+l",
    }
)  # fmt: skip
"""ToBI labels of accents; `*` says nothing about which."""
TONES = frozenset(
    {"h-", "!h-", "l-", "h-%", "!h-%", "h-^h%", "!h-^h%", "l-h%", "l-%", "l-l%", "h-h%", "h-l%"}
)  # fmt: skip
"""ToBI labels of boundary tones."""
NOT_TOLD = frozenset({"", NO_ACCENT, ACCENT_UNKNOWN})
"""What stands for no label."""
ACCENT_FORM = f"none, unknown, or a ToBI label of the published schema: {', '.join(sorted(ACCENTS))}"
TONE_FORM = f"none, unknown, or a ToBI label of the published schema: {', '.join(sorted(TONES))}"


def accent(text: str) -> str | None:
    """A label of an accent in small letters, or `none`; empty: none is told; None: it is no label.

    >>> accent("L+H*"), accent("unknown"), accent("none"), accent(""), accent("X*")
    ('l+h*', '*', 'none', '', None)
    """
    label = text.lower()
    if label in NOT_TOLD:
        return ACCENT_ANY if label == ACCENT_UNKNOWN else label
    return label if label in ACCENTS else None


def tone(text: str) -> str | None:
    """A label of a boundary tone in small letters; empty: none is told; None: it is no label.

    >>> tone("H-L%"), tone("none"), tone("zz")
    ('h-l%', '', None)
    """
    label = text.lower()
    if label in NOT_TOLD:
        return ""
    return label if label in TONES else None
