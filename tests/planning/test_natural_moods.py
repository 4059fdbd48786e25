"""`natural` follows the body: states, the person, how fast it speaks, what a long group takes; and chance."""

from __future__ import annotations

from dataclasses import replace
from statistics import mean

import pytest

from scorebreath.errors import InputError
from scorebreath.parameters.states import Blend
from scorebreath.parameters.table import Parameters
from scorebreath.planning import sites
from scorebreath.planning.lattice import Lattice
from scorebreath.planning.model import BreathGroup, plan
from scorebreath.planning.natural import Natural
from scorebreath.planning.sites import HABITS, Boundary
from scorebreath.planning.starts import LONGEST, most_syllables, preferred_syllables, start, worst
from scorebreath.planning.syllables import vowel_counter
from scorebreath.planning.timeline import Timeline
from scorebreath.planning.units import UnitReader
from scorebreath.planning.variation import Variation
from scorebreath.script.marks import Act, BreathingMark, Mark, ProsodyMark, StateMark
from scorebreath.script.model import Sentence
from tests.planning.written import sentences

LINE = "The old man went down to the harbour, where the boats lay, and looked at the sea; then he went home again. "


def state(name: str, intensity: float = 1.0, ramp: float = 0.0) -> StateMark:
    return StateMark(at=0, written=f"[state {name}]", name=name, intensity=intensity, ramp=ramp)


def marked(text: str, behind: dict[int, Mark]) -> list[Sentence]:
    """Marks behind the last word of a sentence, by its number; -1: before the text."""
    found = sentences(text)
    for place, mark in behind.items():
        if place < 0:
            found[0] = replace(found[0], before=(mark,))
        else:
            *others, last = found[place].words
            found[place] = replace(found[place], words=(*others, replace(last, after=(mark,))))
    return found


def groups(given: list[Sentence], parameters: Parameters | None = None, **more: object) -> list[BreathGroup]:
    planner = Natural(parameters or Parameters(), "en", vowel_counter, **more)  # type: ignore[arg-type]
    return list(plan(planner, given))


def size(found: list[BreathGroup]) -> float:
    return mean(group.syllables for group in found)


def test_a_state_shortens_groups_from_its_tag_on() -> None:
    text = LINE * 24
    calm = groups(marked(text, {}))
    both = groups(marked(text, {11: state("exertion"), 17: state("neutral")}))
    middle = len(LINE) * 12, len(LINE) * 18
    hard = [group for group in both if middle[0] <= group.source.start and group.source.end <= middle[1]]
    before = [group for group in both if group.source.end <= middle[0]]
    after = [group for group in both if group.source.start >= middle[1]]
    assert size(hard) < 0.7 * size(calm)
    assert size(before) > 0.85 * size(calm)
    assert size(after) > 0.85 * size(calm)


def test_a_state_the_text_begins_with() -> None:
    exerted, _ = Blend().changed(0.0, "exertion", 1.0, 0.0, held=True)
    first = groups(marked(LINE * 6, {}), blend=exerted)
    assert size(first) < 0.7 * size(groups(marked(LINE * 6, {})))
    assert [g.source for g in groups(marked(LINE * 6, {-1: state("fatigue")}))] == [
        g.source for g in groups(marked(LINE * 6, {}), blend=Blend().changed(0.0, "fatigue", 1.0, 0.0)[0])
    ]


def test_exertion_is_recovered_from_over_time() -> None:
    found = groups(marked(LINE * 60, {-1: state("exertion")}))
    assert size(found[:20]) < 0.75 * size(found[-20:])


def test_an_unknown_state_is_an_error() -> None:
    with pytest.raises(InputError, match="exertoin"):
        groups(marked(LINE, {0: state("exertoin")}))


def test_more_frequent_breaths() -> None:
    often = BreathingMark(at=0, written="<amazon:auto-breaths>", frequency=2.0)
    assert size(groups(marked(LINE * 12, {-1: often}))) < 0.75 * size(groups(marked(LINE * 12, {})))


@pytest.mark.parametrize(
    ("values", "shorter"),
    [({"age": 80.0}, True), ({"condition": "copd"}, True), ({"age": 8.0}, True), ({"prosody_rate": 1.6}, False)],
)
def test_the_person_and_the_rate(values: dict[str, object], shorter: bool) -> None:
    own, neutral = size(groups(marked(LINE * 12, {}), Parameters(**values))), size(groups(marked(LINE * 12, {})))
    assert own < 0.95 * neutral if shorter else own > 1.1 * neutral


def test_the_preferred_length() -> None:
    assert preferred_syllables(Parameters(capacity_lung=50.0)) == pytest.approx(18.0 * 0.5**0.15)
    assert preferred_syllables(Parameters(), rate=1.3) == preferred_syllables(Parameters(prosody_rate=1.3))
    assert preferred_syllables(Parameters(length_utterance=30.0, prosody_rate=2.0), 0.3) == 30.0
    assert preferred_syllables(Parameters(norm_syllables=2.0), 0.1) == 1.0


def test_what_a_breath_holds() -> None:
    at_ease = most_syllables(Parameters())
    assert most_syllables(Parameters(), volume=2.0) == at_ease // 2
    assert most_syllables(Parameters(), shift=0.08) > at_ease > most_syllables(Parameters(), shift=-0.1)
    assert (
        most_syllables(Parameters(), shift=0.3) == most_syllables(Parameters(), shift=0.2) == int(0.6 / 0.009 * 0 + 57)
    )
    slow = most_syllables(Parameters(), rate=0.5)
    assert slow / (5.0 * 0.5) + 0.42 + 0.06 + 0.01 * slow <= LONGEST


def test_a_long_group_is_followed_by_a_shorter_one() -> None:
    """The first group has no choice; the next may end behind each comma."""
    body = start(18.0, 44, 0.009)

    def second(first: int, between: int) -> int:
        lattice = Lattice(body)
        lattice.add(first, Boundary("sentence", 0.0, 3.0), body)
        for _ in range(60 // between):
            lattice.add(between, Boundary("comma", 1.2, 0.3), body)
        return (lattice.plan()[1] - 1) * between

    after_short = [second(12, between) for between in range(2, 10)]
    after_long = [second(32, between) for between in range(2, 10)]
    assert all(tired <= fresh for tired, fresh in zip(after_long, after_short, strict=True))
    assert sum(after_long) < sum(after_short)
    more = [tired - fresh for tired, fresh in zip(body.tired, body.fresh, strict=True)]
    assert more == pytest.approx([0.8 * min(1.0, n * 0.009 / 0.27) for n in range(45)])


def test_worst_is_the_worst() -> None:
    one, other = start(5.0, 9, 0.05), start(12.0, 14, 0.02)
    for here, there in ((one, other), (other, one), (one, one)):
        for more in (-3, -1, 2, 6):
            row = worst(here, False, there, True, more)
            for n in range(1, here.most + 1):
                extra = [
                    there.tired[k + more] - here.fresh[k] + (0.8 if k + more > there.much and k <= here.much else 0.0)
                    if 1 <= k + more <= there.most
                    else float("inf")
                    for k in range(n, here.most + 1)
                    if not (more > 0 and k + more > there.most)
                ]
                assert row[n] == pytest.approx(max(extra, default=float("-inf")))


def test_time_goes_on_with_the_text() -> None:
    """About 4.2 syllables a second, breaths included; pauses and slower speech take longer."""
    spoken = [unit for one in sentences(LINE * 20) for unit in UnitReader(vowel_counter, 44).read(one)]

    def last(first: Mark | None = None) -> float:
        timeline = Timeline(Parameters(), Blend(), habits=HABITS["reading"])
        timeline.heed((first,) if first else ())
        for unit in spoken:
            timeline.say(unit)
        return timeline.time

    plain = last()
    assert 3.8 < sum(unit.syllables for unit in spoken) / plain < 4.8
    assert last(Act(at=0, written="[pause 2]", name="pause", seconds=2.0)) == pytest.approx(plain + 2.0)
    assert last(ProsodyMark(at=0, written="<prosody>", rate=0.5)) > 1.5 * plain


def test_chance_has_no_bias_and_a_seed() -> None:
    words = [unit for one in sentences(LINE * 300) for unit in UnitReader(vowel_counter, 44).read(one)]
    drawn = [Variation(1, "body", 1.0, 0.3).after(unit) for unit in words[:1]]
    variation = Variation(1, "body", 1.0, 0.3)
    rows = [variation.after(unit) for unit in words]
    assert rows[0] == drawn[0]
    assert len(set(rows)) == len(rows)
    assert abs(mean(row[0] for row in rows)) < 0.06
    assert 0.98 < mean(row[1] for row in rows) / 1.04 < 1.02
    assert Variation(2, "body", 1.0, 0.3).after(words[0]) != rows[0] != Variation(1, "b", 1.0, 0.3).after(words[0])
    assert Variation(1, "body", 0.0, 0.0).after(words[0]) == (0.0, 1.0)


def test_a_sentence_put_in_leaves_the_draws_of_the_others() -> None:
    def draws(text: str) -> dict[str, list[tuple[float, float]]]:
        variation, found = Variation(0, "body", 1.0, 0.3), dict[str, list[tuple[float, float]]]()
        for one in sentences(text):
            found[one.text] = [variation.after(unit) for unit in UnitReader(vowel_counter, 44).read(one)]
        return found

    before = draws("The sea was calm. A man came by. The sea was cold.")
    after = draws("The sea was calm. Nobody else was there. A man came by. The sea was cold.")
    assert {text: after[text] for text in before} == before


def test_seeds_differ_and_repeat() -> None:
    spontaneous = Parameters(style="spontaneous")
    cuts = {seed: [g.source.end for g in groups(marked(LINE * 10, {}), spontaneous, seed=seed)] for seed in (0, 1, 2)}
    assert cuts[0] == [g.source.end for g in groups(marked(LINE * 10, {}), spontaneous, seed=0)]
    assert len({tuple(ends) for ends in cuts.values()}) == 3


def test_spontaneous_speech_breathes_inside_clauses_reading_does_not() -> None:
    text = LINE.replace(", where", " by which").replace("; then", " and then") * 40
    punctuated = {
        style: mean(group.cut.site in ("sentence", "comma", "text end") for group in found)
        for style in ("reading", "spontaneous")
        for found in [groups(marked(text, {}), Parameters(style=style))]
    }
    assert punctuated["reading"] > punctuated["spontaneous"] + 0.1
    assert HABITS.keys() == {"reading", "spontaneous"} == set(sites.HABITS)
