"""What a question asks for: a word ("Who came?"), or yes or no ("Did she come?"). The first ends low, as statements."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from scorebreath.script.accents import plain
from scorebreath.script.lexicon import Lexicon, lexicon

OPENING = 4
"""Words at the beginning of a phrase that tell."""


def asks_for_word(openings: Sequence[Sequence[str]], language: str) -> bool:
    """Whether a question asks for a word: told by what its first phrase that asks begins with.

    A question word says so, perhaps behind a conjunction or a preposition; an auxiliary says that it asks for yes or
    no. Behind the first phrase, and where the question word also opens clauses ("When she came, did you see her?"), an
    auxiliary must follow it, or nothing at all.

    Args:
        openings: The first words of each of the sentence's phrases, `OPENING` of them or more, the next phrase's too.
        language: BCP 47; of one without a table, no question is known to ask for a word.

    >>> asks_for_word([["And", "what", "is", "it"]], "en"), asks_for_word([["Is", "it", "you"]], "en")
    (True, False)
    >>> asks_for_word([["When", "I", "came"], ["did", "you", "go"]], "en")
    False
    >>> asks_for_word([["Sag", "mal"], ["was", "machst", "du"]], "de"), asks_for_word([["Siehst", "du"], ["wie"]], "de")
    (True, True)
    >>> asks_for_word([["Siehst", "du"], ["was", "geschehen", "ist"]], "de")
    False
    """
    known = lexicon(language)
    for number, opening in enumerate(openings):
        words = [plain(word) for word in opening[:OPENING]]
        while len(words) > 1 and words[0] in known.leading and words[0] not in known.questions:
            del words[0]
        if not words:
            continue
        if _auxiliary(words[0], known):
            return False
        first, _, hanging = words[0].partition("'")
        if first not in known.questions:
            continue
        free = len(words) == 1 or (number == 0 and first not in known.clauses)
        if free or hanging or (len(words) > 1 and _auxiliary(words[1], known)):
            return True
        if len(words) > 1 and _verb(opening[len(opening[:OPENING]) - len(words) + 1], known):
            return all(_address(before, behind, known) for before, behind in pairwise(openings[: number + 1]))
    return False


def _verb(word: str, known: Lexicon) -> bool:
    """Whether a word behind a question word must be a verb: no subject of a clause, which have articles or capitals."""
    return bool(known.subjects) and word[:1].islower() and plain(word) not in known.function


def _address(opening: Sequence[str], behind: Sequence[str], known: Lexicon) -> bool:
    """Whether a phrase, up to the next one, only calls somebody: "Hallo", "Sag mal", but not "Siehst du"."""
    ends = (place for place in range(len(opening)) if list(opening[place:]) == list(behind[: len(opening) - place]))
    own = opening[: next(ends, len(opening))]
    return len(own) == 1 or not any(plain(word) in known.subjects for word in own)


def _auxiliary(word: str, known: Lexicon) -> bool:
    """Whether it is one, perhaps with "n't"."""
    return word in known.auxiliaries or word.partition("'")[0].removesuffix("n") in known.auxiliaries
