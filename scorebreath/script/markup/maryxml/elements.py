"""The elements of MaryXML, as a table: those of the published schemas 0.4 and 0.5, and S3's, which are older (A12).

MaryTTS's modules leave attributes of their own behind (`units`, `src`, `start`, a syllable's `root`), so an attribute
nobody knows is accepted.
"""

from __future__ import annotations

from collections.abc import Mapping

from scorebreath.script.markup.elements import Element

IN_WORDS = ("t", "syllable", "ph")
"""Elements of a word: nothing that structures a text stands in them."""

_BLOCK = Element(attributes=("xml:lang",), outside=IN_WORDS)

ELEMENTS: Mapping[str, Element] = {
    "maryxml": Element(attributes=("xml:lang",), idle=("version", "lexicon"), outside=("maryxml",)),
    "p": _BLOCK,
    "s": _BLOCK,
    "div": Element(attributes=("xml:lang", "type"), outside=IN_WORDS),
    "speaker": Element(attributes=("gender",), idle=("age",), outside=IN_WORDS),
    "voice": Element(
        attributes=("name", "gender", "xml:lang"), idle=("age", "variant", "style", "effect"), outside=IN_WORDS
    ),
    "phonology": Element(
        idle=("precision", "schwa-elision", "nasal-assimilation", "schwa_elision", "nasal_assimilation"),
        outside=IN_WORDS,
    ),
    "prosody": Element(
        attributes=("rate", "pitch", "volume", "force-accent"),
        idle=(
            "contour", "pitch-dynamics", "range", "range-dynamics", "accent-prominence", "preferred-accent-shape",
            "accent-slope", "preferred-boundary-type", "number-of-pauses", "pause-duration", "vowel-duration",
            "plosive-duration", "fricative-duration", "nasal-duration", "liquid-duration", "glide-duration", "rules",
            "duration", "style",
        ),
        outside=IN_WORDS,
    ),
    "say-as": Element(idle=("type",), outside=IN_WORDS),
    "audio": Element(idle=("src",), outside=IN_WORDS),
    "phrase": Element(outside=("phrase", *IN_WORDS)),
    "mtu": Element(idle=("orig", "accent"), outside=IN_WORDS),
    "t": Element(
        attributes=("accent", "pos", "ph", "sampa", "sounds_like"),
        idle=("g2p_method", "ending", "syn_attach", "syn_phrase", "given", "contrast", "xml:lang"),
        outside=IN_WORDS,
    ),
    "syllable": Element(idle=("ph", "sampa", "tone", "stress", "accent"), outside=("syllable", "ph")),
    "ph": Element(content="empty", idle=("p", "d", "end", "f0", "vq"), outside=("ph",)),
    "boundary": Element(content="empty", attributes=("breakindex", "tone", "duration"), outside=IN_WORDS),
    "mark": Element(content="empty", attributes=("name",), required=("name",), outside=IN_WORDS),
    "emotion": Element(attributes=("type", "intensity"), idle=("activation", "evaluation", "power"), outside=IN_WORDS),
    "vocalization": Element(
        content="ignored", attributes=("name",), idle=("voicequality", "intonation", "meaning", "variant"),
        outside=IN_WORDS,
    ),
}  # fmt: skip
"""`emotion`, `speaker` and `div` are of the paper's time; the published schemas have none of them."""
