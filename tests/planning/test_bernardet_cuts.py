"""The two readings of the papers' parser, worked by hand (B16-B22, X4-X10).

Eq. 1 with capacity 64, loudness 100, norm 20: length_utterance = sqrt(64/100) * 20 = 16 syllables, urgency_limit =
2 * 16 = 32 characters, length_inspiration = 64/100 = 0.64 s (B37-B39). The 2017 search for a marker ends at twice the
limit, 64 characters. The texts are words of one syllable, so that syllables are words.
"""

from __future__ import annotations

import pytest

from scorebreath.parameters.derive import derive
from scorebreath.parameters.table import Parameters
from scorebreath.planning.bernardet_2017 import Bernardet2017
from scorebreath.planning.bernardet_2019 import Bernardet2019
from scorebreath.planning.model import BreathGroup, plan
from scorebreath.planning.syllables import pyphen_counter
from tests.planning.written import sentences

PAPER = Parameters(capacity_lung=64.0, speaking_loudness=100.0, norm_syllables=20.0)
FIFTEEN = "The cat sat on the mat and the dog lay in the sun all day"
TAIL = " The next day it rained and they both stayed in bed and read old books to while the time till noon."


def cuts(
    model: type[Bernardet2017 | Bernardet2019], text: str, poem: bool = False, **more: object
) -> list[BreathGroup]:
    parameters = PAPER.with_values(more)
    return list(plan(model(parameters, pyphen_counter("en"), poem), sentences(text, poem)))


def first(model: type[Bernardet2017 | Bernardet2019], text: str, poem: bool = False, **more: object) -> str:
    return cuts(model, text, poem, **more)[0].text


def test_equation_1_drives_the_cut() -> None:
    low = derive(PAPER)
    assert (low.length_utterance, low.urgency_limit, low.length_inspiration) == (16.0, 32.0, 0.64)
    assert pyphen_counter("en")(FIFTEEN.split()) == [1] * 15
    # 16 syllables end with "long". The full stop is " and up by the old red clay wall" = 4+3+3+4+4+4+5+5 = 32 ahead.
    text = FIFTEEN + " long and up by the old red clay wall." + TAIL
    assert text.index(".") - text.index(" and up") == 32
    for model in (Bernardet2017, Bernardet2019):
        assert first(model, text) == FIFTEEN + " long and up by the old red clay wall."
        # One character more, and it is beyond: break at the word.
        assert first(model, text.replace("clay", "brick")) == FIFTEEN + " long"
        # A norm of 15 gives 12 syllables and 24 characters: after "the" the full stop is far beyond.
        assert first(model, text, norm_syllables=15.0) == "The cat sat on the mat and the dog lay in the"


def test_x6_one_marker_beyond_the_limit_or_both() -> None:
    # Split after "with" (16). "." is " us" = 3 characters ahead, "_" is " us. Then both went in to eat all their food",
    # 44 ahead: beyond 32, within the search of 64. That breaks at the word in the chart, not in the bullets.
    text = FIFTEEN + " with us. Then both went in to eat all their food_ and slept." + TAIL
    assert first(Bernardet2017, text) == FIFTEEN + " with"
    assert first(Bernardet2019, text) == FIFTEEN + " with us."


def test_x6_a_marker_that_does_not_occur_is_not_beyond_the_limit() -> None:
    # As before without "_": the chart would never break at a full stop if a missing "_" counted as far away.
    text = FIFTEEN + " with us. Then both went in to eat all their food and slept." + TAIL
    assert first(Bernardet2017, text) == FIFTEEN + " with us."
    assert first(Bernardet2019, text) == FIFTEEN + " with us."


def test_x7_the_nearer_marker_or_the_full_stop() -> None:
    # Split after "with". "_" is 3 ahead, "." is " us_ in peace" = 13 ahead, both within 32.
    text = FIFTEEN + " with us_ in peace. Then both went in." + TAIL
    assert first(Bernardet2017, text) == FIFTEEN + " with us_"
    assert first(Bernardet2019, text) == FIFTEEN + " with us_ in peace."


def test_x8_only_ahead_or_behind_too() -> None:
    # Split after "long" (16). "." is 14 characters behind the split: " All day long" and itself.
    # Ahead there is none for " they ... snow" = more than 64 characters: the chart has nothing and breaks at the word.
    text = "The cat sat on the mat and the dog lay in the sun. All day long they played and ran and jumped and "
    text += "fought and ate and drank and then they slept in the deep snow till dawn." + TAIL
    assert text.index(" they") - text.index(".") == 14
    assert text.index(".", 60) - text.index(" they") > 64
    assert first(Bernardet2017, text) == "The cat sat on the mat and the dog lay in the sun. All day long"
    assert first(Bernardet2019, text) == "The cat sat on the mat and the dog lay in the sun."


def test_x9_a_guard_at_the_end_of_the_text_or_none() -> None:
    # 12 words. The chart: 6 syllables are not more than 6 remaining words, 7 are more than 5: split after "fresh". "."
    # is " bread straight through thronged streets" = 6+9+8+9+8 = 40 ahead: beyond 32, break at the word. Then 5 words:
    # 3 > 2, split after "through", "." is " thronged streets" = 17 ahead. The bullets: 12 of 16 syllables, all is left.
    text = "Those strong young scouts brought us fresh bread straight through thronged streets."
    chart = [group.text for group in cuts(Bernardet2017, text)]
    assert chart == ["Those strong young scouts brought us fresh", "bread straight through thronged streets."]
    assert [group.text for group in cuts(Bernardet2019, text)] == [text]


def test_x4_x5_characters_from_the_split_point() -> None:
    # The split word's own full stop is 0 characters ahead: urgency_limit 0 still allows it, and nothing else.
    text = FIFTEEN + " long. Then both went in to eat all their food and slept." + TAIL
    for model in (Bernardet2017, Bernardet2019):
        assert first(model, text, urgency_limit=0.0) == FIFTEEN + " long."
        assert first(model, text.replace("long.", "long so."), urgency_limit=0.0) == FIFTEEN + " long"
        assert first(model, text.replace("long.", "long so."), urgency_limit=3.0) == FIFTEEN + " long so."


def test_two_full_stops_equally_far_ahead_before_behind() -> None:
    # Split after "long". Behind: " All day long" and "." itself, 14. Ahead: " they slept on", 14.
    text = "The cat sat on the mat and the dog lay in the sun. All day long they slept on." + TAIL
    assert text.rindex(".", 0, 90) - text.index(" they") == text.index(" they") - text.index(".")
    assert (
        first(Bernardet2019, text) == "The cat sat on the mat and the dog lay in the sun. All day long they slept on."
    )
    nearer = text.replace("they slept on", "they slept for")
    assert first(Bernardet2019, nearer) == "The cat sat on the mat and the dog lay in the sun."


@pytest.mark.parametrize("model", [Bernardet2017, Bernardet2019])
def test_x10_bare_and_sentence_full_stops(model: type[Bernardet2017 | Bernardet2019]) -> None:
    # Split after "with". The bare "." of "Dr." is " Dr" = 3 ahead and breaks after the word it hangs on.
    doctor = FIFTEEN + " with Dr. Black and his wife. Then both went in." + TAIL
    assert first(model, doctor) == FIFTEEN + " with Dr."
    assert first(model, doctor, period_marker="sentence") == FIFTEEN + " with Dr. Black and his wife."
    # The "." inside "3.14" is " of 3" = 5 ahead: a break falls after the whole word.
    number = FIFTEEN + " with 3.14 pies and a large cake and more and more and cream. Then both went in." + TAIL
    assert first(model, number) == FIFTEEN + " with 3.14"
    # Only "sentence" takes other marks for the end of one: "!" is 3 ahead, the first "." more than 64.
    cried = (
        FIFTEEN
        + " with us! Then both went in to eat all their food and drink and slept through the night and day"
        + TAIL
    )
    assert first(model, cried) == FIFTEEN + " with"
    assert first(model, cried, period_marker="sentence") == FIFTEEN + " with us!"


@pytest.mark.parametrize("model", [Bernardet2017, Bernardet2019])
def test_paragraphs_lines_and_stanzas_are_markers(model: type[Bernardet2017 | Bernardet2019]) -> None:
    heading = FIFTEEN + " with us\n\nThen both went in to eat all their food and slept." + TAIL
    assert first(model, heading) == FIFTEEN + " with us"
    # A line of verse ends 3 characters ahead of the split: "_"; the stanza's end is farther than 64: no ".".
    verse = FIFTEEN + " with us\nand then they both went in to eat all their food and slept\n"
    verse += "and woke and ran and played and slept once more\n\nThe next day it rained" + TAIL
    assert first(model, verse, poem=True) == FIFTEEN + " with us"
    assert first(model, verse, poem=False) == FIFTEEN + " with"
    # So it does with a comma behind the line's last word, which makes its edge a comma.
    assert first(model, verse.replace("us\n", "us,\n"), poem=True) == FIFTEEN + " with us,"


def test_a_full_stop_at_a_line_end_is_a_full_stop() -> None:
    verse = FIFTEEN + " with us.\nand then they both went in to eat all their food and slept_" + TAIL
    rule = cuts(Bernardet2017, verse.replace("slept_", "slept"), poem=True)[0].cut.rule
    assert rule == "bernardet-2017 X7: '.' 3 characters ahead, before '_' 3 characters ahead, within 32"


def test_a_marker_before_the_first_word_is_no_candidate() -> None:
    # Backward from the split after "long" there is only the "." of ".The": a break there would leave nothing.
    text = (
        "." + FIFTEEN + " long they played and ran and jumped and fought and ate and drank and slept till dawn" + TAIL
    )
    assert first(Bernardet2019, text, urgency_limit=70.0) == "." + FIFTEEN + " long"


def test_the_reason_names_the_rule_and_the_distances() -> None:
    text = FIFTEEN + " with us_ in peace. Then both went in." + TAIL
    chart, bullets = cuts(Bernardet2017, text)[0].cut, cuts(Bernardet2019, text)[0].cut
    assert chart.rule == "bernardet-2017 X7: '_' 3 characters ahead, before '.' 13 characters ahead, within 32"
    assert bullets.rule == "bernardet-2019 X7: '.' 13 characters ahead, before '_' 3 characters ahead, within 32"
    assert [(c.site, c.cost) for c in chart.candidates] == [("marker", 3.0), ("sentence", 13.0), ("word", 0.0)]
    assert [(c.site, c.cost) for c in bullets.candidates] == [("sentence", 13.0), ("marker", 3.0), ("word", 0.0)]
    assert (chart.site, bullets.site) == ("marker", "sentence")
    assert text[: bullets.candidates[1].position].endswith("with us_")
