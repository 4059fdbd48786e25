"""Which events make a breath group."""

from __future__ import annotations

import dataclasses
from typing import get_args, get_type_hints

from scorebreath.score.events import Inspiration, Utterance
from scorebreath.score.spoken import FOR_SPEECH, spoken_groups
from tests.curves.acts import breathe_in
from tests.curves.scores import Breath, build, utterance, without


def test_kinds_that_speech_follows_are_kinds_there_are() -> None:
    assert set(FOR_SPEECH) < set(get_args(get_type_hints(Inspiration)["kind"]))


def test_the_last_breath_before_the_first_word_counts() -> None:
    score = build([Breath(before=3.0)])
    early = breathe_in(id="early", onset=0.5, duration=0.5, group="g1")
    late = breathe_in(id="late", onset=6.5, duration=0.5, group="g1")
    tidal = breathe_in(id="tidal", kind="tidal", onset=3.6, duration=0.05, group="g1")
    for events in ((early, late, tidal, *score.events), (*score.events, tidal, late, early)):
        spoken = spoken_groups(dataclasses.replace(score, events=events))["g1"]
        assert spoken.inspiration and spoken.inspiration.id == "g1.in"
    gasp = dataclasses.replace(tidal, kind="gasp")
    spoken = spoken_groups(dataclasses.replace(score, events=(*score.events, gasp)))["g1"]
    assert spoken.inspiration and spoken.inspiration.id == "tidal"


def test_groups_have_what_they_have() -> None:
    score = build([Breath(), Breath()])
    first, second = (spoken_groups(score)[name] for name in ("g1", "g2"))
    assert (first.onset, first.end) == (0.1, 3.26)
    assert [e.id for e in second.utterances] == ["g2.say"]
    assert [e.id for e in second.spent] == ["g2.out"]
    unbreathed = spoken_groups(without(score, "g1.in"))["g1"]
    assert unbreathed.inspiration is None
    assert unbreathed.onset == next(score.of(Utterance)).onset
    silent = spoken_groups(without(score, "g1.say"))["g1"]
    assert silent.end is None
    assert silent.onset == 0.1
    assert spoken_groups(dataclasses.replace(score, events=()))["g1"].onset is None


def test_parts_come_in_order_of_time_and_another_body_s_are_not_taken() -> None:
    score = build([Breath()])
    other = dataclasses.replace(score.bodies[0], id="other")
    later = utterance(Breath(speech=1.0), 9.0, 0, id="later", group="g1")
    foreign = dataclasses.replace(later, id="foreign", body="other", onset=20.0)
    both = dataclasses.replace(score, bodies=(*score.bodies, other), events=(foreign, later, *score.events))
    spoken = spoken_groups(both)["g1"]
    assert [event.id for event in spoken.utterances] == ["g1.say", "later"]
    assert spoken.end == 10.0
