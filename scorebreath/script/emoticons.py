r"""Emoticons (A11) and emoji: found as written, compact `:-)` or with the inner spaces the paper prints, `: - )`.

They are no punctuation: they end nothing and are not spoken. Nor does a mark of punctuation end anything that stands
behind one of them where another mark stands before it, as in S3's `Grab: :-( .`: the sentence goes on as it would
without both. What they mean is in `emotions`; in links and in what looks like code they mean nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from scorebreath.script.emotions import meaning
from scorebreath.spans import Span

_MEASURED = (
    r"(?:milli|cent|zent|kilo|deci)?(?:meter|metre)s?n?|(?:nano|micro|mikro|milli)?sec(?:ond)?s?|(?:Milli)?Sekunden?|"
    r"min(?:ute)?[sn]?|hours?|hrs?|Stunden?|days?|Tagen?|weeks?|Wochen?|months?|Monaten?|years?|yrs?|Jahren?|miles?|"
    r"inch(?:es)?|feet|foot|degrees?|Grad|per\s?cent|Prozent|points?|Punkten?|dollars?|euros?|times|Personen|"
    r"[munk]?m|[mk]?g|ms|[sh]|[kMG]?B|[kM]?Hz|°"
)
"""What is counted often enough to show that `<3` before it is "less than three"."""

_LABELLED = (
    *(
        "a",
        "and",
        "answer",
        "appendix",
        "at",
        "block",
        "case",
        "chapter",
        "class",
        "column",
        "drive",
        "exhibit",
        "figure",
    ),
    *("flat", "from", "gate", "grade", "group", "hepatitis", "in", "item", "key", "letter", "level", "line", "major"),
    *(
        "minor",
        "model",
        "note",
        "of",
        "on",
        "option",
        "or",
        "page",
        "part",
        "phase",
        "plan",
        "point",
        "question",
        "room",
    ),
    *("row", "section", "sharp", "step", "string", "table", "team", "the", "to", "type", "version", "vitamin", "zone"),
    *("Abbildung", "Abschnitt", "am", "Anhang", "Antwort", "auf", "Buchstabe", "das", "der", "die", "Frage", "Gruppe"),
    *("im", "Klasse", "Laufwerk", "mit", "oder", "Punkt", "Seite", "Stufe", "Tabelle", "Teil", "und", "von", "zu"),
)
"""Words behind which `D:` is a letter: `vitamin D: yes`."""

_EMOJI = "[\u2639-\u263b\u2665\u2763\u2764\U0001f300-\U0001faff]"
_OPENER = r"\"'“„‘«»(\["
_BEGIN = rf"(?<![^\s{_OPENER}])(?<![^\s{_OPENER}][{_OPENER}])"
"""Before it stand space or nothing, perhaps with opening quotes or brackets."""
_CLOSED = r"(?![^\s.,!?;:…\"'”’»«“)\]])"
"""Behind it stands no more than punctuation."""
_LETTER = "".join(rf"(?<!\b(?i:{word})[ ])" for word in _LABELLED)
_PATTERN = re.compile(
    rf"""
    >?[:;]-(?: [|<oO?/\\DPp*] | ([)(])\1{{0,4}} )         (?![^\W_])  # :-)   >:-<   :-o   :-))
    | (?<!\S) >?\ ?[:;]\ ?-\ ?[)(|<oO]                     (?![^\W_])  # : - )   :- )   > : - <
    # :)   ;)   :D   >:(   :'-(   (:P)   :o), but (:o) is of two
    | {_BEGIN} >?[:;=]'?-?(?: (?:(?<!\([:;=])|(?=o\)\))) o\) | [|DPpoO] | ([)(])\2{{0,4}} ) (?![^\W_])
    | {_BEGIN} (?: \([:;=] (?!\)|'-?\() | \(-[:;=] | \)-?[:=] ) {_CLOSED}  # (:   (-:   ):   )-:
    | {_BEGIN} [xX]D{{1,4}}             (?![^\W_])  # XD
    | {_BEGIN} D-:                      {_CLOSED}
    | (?: (?<=[\w.!?…;)\]"'”’»-]\ ) {_LETTER} (?<!\b\w[ ]) (?<!\d[ ]) | (?<=[^\W\d],\ ) (?<!\b\w,\ )
      | (?<=[{_OPENER}]) {_BEGIN} (?=D:[\"'”’»«“)\]]) | (?<={_EMOJI}\ ) ) D:  {_CLOSED}
      # late D:   No! D:   (D:)   but not "vitamin D: yes", "A, B, C, D: all", nor at the beginning of a line
    | {_BEGIN} (?: ([oOTuUxX^.;*-])_{{1,3}}(?i:\3) | >_{{1,3}}< ) {_CLOSED}  # o_O   -_-
    | (?: {_BEGIN} (?<!\s) (?<=.) (?= </ | <3{{1,4}}[.!?…]{{0,3}}[\"'”’»«“)\]] ) | (?<!\S) )
      (?: (?<!\d[ ]) | (?<=<3[ ]) | (?<=<33[ ]) )   # <3   </3   <3 <3   (<3), but 5 <3, x <3, in <3 days, <3 %
      (?<!\b[a-hj-tv-z][ ]) (?: (?<![\w,][ ]) | (?<=\b[Ii][ ]) | (?! <3[ ](?i:{_MEASURED})\b) )
      </?3{{1,4}} (?! \w | [.,:]\d | [-–]\d | [ ]?[%‰°€$£+*/=] )
    | {_EMOJI}[\ufe0e\ufe0f\U0001f3fb-\U0001f3ff]*+ (?: \u200d[\u2190-\u2bff\U0001f300-\U0001faff]
      [\ufe0e\ufe0f\U0001f3fb-\U0001f3ff]*+ )*+ \u200d?+
    """,
    re.VERBOSE,
)
_SIGN = re.compile(rf"[-:;=<_]|[xX]D|{_EMOJI}")
_OPEN = re.compile(rf"{_BEGIN}(?:[oOTuUxX]_{{0,3}}|D-?:?)\Z")
_MARKED = re.compile(r"[.!?:;,…–—][\"'”’»«“)\]]{0,3}[ \n]{0,2}$")
_CLOSERS = "\"'”’»«“)\\]"
_IDLE = re.compile(rf"(?P<space>[ ]{{0,2}})[.,;:…]{{1,3}}(?=[\s{_CLOSERS}]|\Z)")
_SMALL = "[ ]{1,2}[a-zß-öø-ÿ]"
_GOES_ON = re.compile(rf"[ ]{{0,2}}(?:\.(?!\.)(?=[{_CLOSERS}]{{0,3}}{_SMALL})|[.!?…]{{1,3}}(?={_SMALL}))")
"""Marks that end nothing: a small letter follows."""
_APART = re.compile(r"[ \t]{1,3}|(?!\s)")
_BEFORE = re.compile(r"(?:(?:\A|(?<=\s))[\"'“„‘«»(\[*_]*[\w'’-]*[.,!?;:…\"'”’)*_]*)$")
"""What may stand directly before an emoticon that means something: nothing, or a word with its marks."""
_BEHIND = re.compile(r"[\s.,!?;:…)\]\"'”’»«*_~<>^-]|\Z")
_OPENING = re.compile(rf"(?:\A|\s)[{_OPENER}]*\Z")
_CLOSING = re.compile(r"[.,!?;:…\"'”’»«)\]]|\Z")
_TOKEN = re.compile(r"\S*$")
_OPENED, _CLOSED_AGAIN = re.compile(r"(?<!\S)\((?=[\w\"'“„‘«])"), re.compile(r"(?<=[\w.,!?;\"'”’»])\)")
"""Brackets around words."""
_NEAR = 64
"""Code points that are looked at before an emoticon."""

LONGEST = 8
"""Code points of the longest emoticon, with a margin. Sequences of emoji may be longer; no letters are in them."""


class Sign(NamedTuple):
    """An emotion as written: an emoticon or an emoji, or several of one emotion in a row."""

    span: Span
    name: str
    """one of `score.acting.EMOTIONS`"""
    intensity: float
    """0..1; the highest of them"""


def possible(text: str) -> bool:
    """Whether an emoticon or an emoji may stand in `text`: quick, and never wrongly False.

    >>> possible("Hi <3"), possible("Hi there.")
    (True, False)
    """
    return _SIGN.search(text) is not None


def spans(text: str, start: int = 0, end: int | None = None) -> Iterator[Span]:
    """Where emoticons and emoji stand in `text[start:end]`, each with what around it ends nothing, either.

    That is a mark behind it, or brackets that hold it alone.

    >>> [span.cut("Hi :-) it's a Grab: : - ( . (a:)") for span in spans("Hi :-) it's a Grab: : - ( . (a:)")]
    [':-)', ': - ( .']
    >>> [span.cut("So (:-)) I said (again :-))") for span in spans("So (:-)) I said (again :-))")]
    ['(:-))', ':-)']
    """
    last = len(text) if end is None else end
    behind, marked = -1, False
    for first, stop in _found(text, start, last):
        marked = _marked(text, first) or (marked and not text[behind:first].strip(" \n"))
        behind = stop
        if on := _GOES_ON.match(text, stop, last):
            behind = on.end()
        elif marked and (idle := _IDLE.match(text, stop, last)) and not _PATTERN.match(text, idle.end("space"), last):
            behind = idle.end()
        before = first - (text[first - 1 : first] == " ") - 1
        after = behind + (text[behind : behind + 1] == " ")
        if start <= before and after < last and text[before] + text[after] in ("()", "[]"):
            yield Span(before, after + 1)
        else:
            yield Span(first, behind)


def without(text: str) -> str:
    """A text as it would be written without them.

    >>> without("Well :-) so."), without("Go on: :-( . So :-)."), without("Plain , text ")
    ('Well so.', 'Go on: So.', 'Plain , text ')
    """
    found = list(spans(text)) if possible(text) else []
    if not found:
        return text
    left = text[: found[0].start]
    for span, end in zip(found, [*(span.start for span in found[1:]), len(text)], strict=True):
        left, piece = left.rstrip(), text[span.end : end].lstrip()
        left += piece if _OPENING.search(left) or _CLOSING.match(piece) else f" {piece}"
    return left


def idle(text: str, place: int) -> bool:
    """Whether the mark at a place ends nothing, as it stands behind an emoticon and another mark before that.

    >>> idle("to the Grab: :-( . It", 17), idle("to the Grab :-( . It", 16)
    (True, False)
    """
    near = text[max(0, place - _NEAR) : place + 4]
    place = min(place, _NEAR)
    return possible(near[:place]) and any(span.start < place < span.end for span in spans(near))


def whole(text: str, place: int, start: int) -> int:
    """A place, or where the emoticon begins in whose midst it is; one half of it would not be known again.

    >>> whole("so o_O then", 5, 0), whole("so o_O then", 7, 0)
    (3, 7)
    """
    near = spans(text, max(start, place - LONGEST), min(len(text), place + LONGEST))
    return next((span.start for span in near if span.start < place < span.end), place)


def unfinished(text: str, place: int) -> bool:
    """Whether the letter at a place may turn out to begin an emoticon when more text has come.

    >>> unfinished("Oh! o_", 4), unfinished("Oh! or", 4)
    (True, False)
    """
    return _OPEN.match(text, place) is not None


def signs(text: str, start: int = 0) -> Iterator[Sign]:
    """Emotions in `text` from `start` on: several of one kind in a row are one.

    >>> [(sign.span.cut("Ah 😀😂 :-) (see http://a.b/:-))"), sign.name) for sign in signs("Ah 😀😂 :-) (see http://a.b/:-))")]
    [('😀😂 :-)', 'happy')]
    """
    waiting: Sign | None = None
    for first, stop in _found(text, start, len(text)):
        found = meaning(text[first:stop])
        if found is None or not _meant(text, first, stop):
            continue
        if waiting and waiting.name == found.name and _APART.fullmatch(text, waiting.span.end, first):
            waiting = Sign(Span(waiting.span.start, stop), found.name, max(waiting.intensity, found.intensity))
            continue
        if waiting:
            yield waiting
        waiting = Sign(Span(first, stop), found.name, found.intensity)
    if waiting:
        yield waiting


def _found(text: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    """What looks like an emoticon, without the last bracket of `:-))` where that closes one that was opened."""
    for match in _PATTERN.finditer(text, start, end):
        first, stop = match.span()
        if text[stop - 2 : stop] == "))":
            line = _PATTERN.sub(" ", text[max(0, first - _NEAR) : first].rpartition("\n")[2])
            stop -= line[-1:] == "(" or len(_OPENED.findall(line)) > len(_CLOSED_AGAIN.findall(line))
        yield first, stop


def _marked(text: str, place: int) -> bool:
    """Whether a mark of punctuation stands before a place, perhaps with a space or a line's end between."""
    return _MARKED.search(text[max(0, place - LONGEST) : place]) is not None


def _meant(text: str, first: int, stop: int) -> bool:
    """Whether an emoticon is no part of a link or of code."""
    line = text[max(0, first - _NEAR) : first].rpartition("\n")[2]
    if line.count("`") % 2:
        return False
    token = _TOKEN.search(line)
    before = token.group() if token else ""
    if not text[first].isascii():
        return "://" not in before and not before.startswith("www.")
    while (sign := _last_sign(before)) is not None:
        before = before[:sign]
    return _BEFORE.search(before) is not None and (_BEHIND.match(text, stop) is not None or not text[stop].isascii())


def _last_sign(token: str) -> int | None:
    """Where an emoticon begins that ends a token."""
    return next((match.start() for match in _PATTERN.finditer(token) if match.end() == len(token)), None)
