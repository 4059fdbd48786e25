"""How long breaths and silences are (physiology 1.3, 1.4)."""

from __future__ import annotations

from math import exp, log, pi

from scorebreath.compose.chances import Chances, lognormal
from scorebreath.equations.breath import inspiration_length
from scorebreath.parameters.modifiers import Modifiers
from scorebreath.parameters.table import Parameters
from scorebreath.score.document import Site
from scorebreath.score.events import PauseKind
from scorebreath.units import snap

SITE_FACTOR: dict[Site, float] = {"word": 0.7, "phrase": 0.7, "paragraph": 1.15}
"""Inspirations are shorter where the text has no boundary, longer after a paragraph (physiology 1.3)."""
FASTEST_FLOW = 8.0
"""L/s, the most a chest can do (physiology 10)."""
NEUTRAL_VARIATION = 0.15
"""At which the parameters' own spreads hold; states make breathing more or less regular (physiology 4.2)."""
OWN_SHARE = 0.6
"""Of the spread of lengths, what is not already due to the spread of depths (`for_depth`)."""
SMALL_VOLUME = 0.03
"""Fraction of VC, see `for_depth`."""
SILENCES: dict[PauseKind, tuple[float, float]] = {
    "edge": (0.02, 0.6),
    "sentence": (0.06, 1.2),
    "paragraph": (0.2, 3.0),
    "phrase": (0.1, 1.0),
}
"""Shortest and longest silence of each kind, s (physiology 1.4)."""
SILENCE_VARIATION = 2.0
"""Silences vary so many times as much as resting cycles do."""


def speech_inspiration(
    p: Parameters, m: Modifiers, chances: Chances, *, syllables: float, site: Site, asked: float = 1.0
) -> float:
    """Length of the inspiration before speech, s: coupled to what is to be said, varied from breath to breath."""
    mean = (p.inspiration_base + p.inspiration_per_syllable * syllables) * SITE_FACTOR.get(site, 1.0)
    variation = OWN_SHARE * p.inspiration_spread / max(mean, 0.1) * m.variation / NEUTRAL_VARIATION
    factor = m.inspiration * asked
    if variation > 0:
        factor *= lognormal(chances.normal("inspiration.length"), variation)
    return inspiration_length(
        p.inspiration_base, p.inspiration_per_syllable, syllables, 0.0, SITE_FACTOR.get(site, 1.0) * factor
    )


def for_depth(moved: float, usual: float) -> float:
    r"""How much longer a breath takes that is deeper than usual: :math:`((V + v) / (V_0 + v))^{0.3}`, in 0.75..1.35.

    Breaths are drawn deeper partly by faster and partly by longer flow; their lengths and depths go together over a
    speaker's breaths with r = 0.3 to 0.6 (physiology 1.3). :math:`v` keeps the smallest breaths from counting double.

    >>> [round(for_depth(volume, 0.16), 3) for volume in (0.16, 0.25, 0.09)]
    [1.0, 1.123, 0.871]
    """
    ratio = (max(0.0, moved) + SMALL_VOLUME) / (max(0.0, usual) + SMALL_VOLUME)
    return min(1.35, max(0.75, exp(0.3 * log(ratio))))


def unhurried(length: float, volume: float, vital_capacity: float, steepness: float = pi / 2) -> float:
    r"""`length`, made longer where the air would otherwise go faster than a chest can: :math:`k V / T` L/s.

    Args:
        length: s.
        volume: Fraction of VC that moves.
        vital_capacity: L.
        steepness: :math:`k`: highest flow of the profile, relative to its mean.

    >>> unhurried(0.6, 0.16, 5.1), round(unhurried(0.25, 0.5, 5.1), 3)
    (0.6, 0.511)
    """
    return max(length, abs(volume) * vital_capacity * steepness / (0.98 * FASTEST_FLOW))


def silence(p: Parameters, m: Modifiers, chances: Chances, site: Site) -> tuple[PauseKind, float]:
    """Kind and length of the silence between the last phone and the breath."""
    kind: PauseKind = "edge"
    mean = p.silence_before_breath
    if site in ("paragraph", "text end"):
        kind, mean = "paragraph", p.silence_after_paragraph
    elif site == "sentence":
        kind, mean = "sentence", p.silence_after_sentence
    return kind, _varied(p, m, chances, kind, mean * m.pause)


def breathless(p: Parameters, m: Modifiers, chances: Chances, site: Site) -> tuple[PauseKind, float]:
    """Kind and length of a pause inside a group, where a sentence or a paragraph ends without a breath."""
    mean = p.breathless_pause * (1.6 if site == "paragraph" else 1.0)
    return ("sentence" if site in ("sentence", "paragraph") else "phrase"), _varied(
        p, m, chances, "phrase", mean * m.pause
    )


def delay(p: Parameters, m: Modifiers, chances: Chances) -> float:
    """Silence between the breath and the first phone, s."""
    mean = p.silence_after_breath * m.delay
    if mean == 0:
        return 0.0
    drawn = chances.about("silence.after", mean, SILENCE_VARIATION * m.variation)
    return snap(min(max(drawn, 0.01), 0.2 * m.delay, mean * 3))


def _varied(p: Parameters, m: Modifiers, chances: Chances, kind: PauseKind, mean: float) -> float:
    if mean == 0:
        return 0.0
    low, high = SILENCES[kind]
    drawn = chances.about(f"silence.{kind}", mean, SILENCE_VARIATION * m.variation)
    return snap(min(max(drawn, min(low, mean)), max(high, mean)))
