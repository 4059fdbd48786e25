"""Rows about time: breath groups, inspirations, cycles, silences (physiology 1.1, 1.3, 1.4, 1.6)."""

from __future__ import annotations

from scorebreath.report.norms import timing
from scorebreath.report.norms.figures import ADULT, Figure, When
from scorebreath.report.norms.row import PAIRS, Row

GROUPS, BREATHS, PAUSES, REST = "Breath groups", "Breathing in", "Silences", "At rest"
READING, SPONTANEOUS = When(style="reading"), When(style="spontaneous")
YOUNG, OLD = When(style="reading", age=(18.0, 50.0)), When(style="reading", age=(65.0, 200.0))
PAPERS, OTHERS = When(papers=True), When(papers=False)
EXTREMES = Figure(
    of="each", source="bernardet", mark="V", low=0.3, high=12.6,
    note="the shortest and the longest of Winkworth's six women, as S1 quotes them",
)  # fmt: skip

ROWS: tuple[Row, ...] = (
    Row(
        name="group_speech", title="Breath group, speech alone", part=GROUPS, unit="s",
        measure=timing.group_speech,
        measured="from the first phone to the last one said on one inspiration, pauses between them included",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=3.3, high=4.8, when=READING,
                   note="acceptance window"),
            Figure(of="sd", source="scorebreath", mark="E", low=1.0, high=2.2, when=READING, note="acceptance window"),
            EXTREMES,
            Figure(of="mean", source="wang", mark="V2", mean=4.05, sd=1.5, when=READING,
                   note="16 adults; inspirations from the airflow, lengths from the sound: speech alone"),
            Figure(of="mean", source="wang", mark="V2", mean=4.88, sd=1.93, when=SPONTANEOUS,
                   note="16 adults; inspirations from the airflow, lengths from the sound: speech alone"),
            Figure(of="mean", source="rochet", mark="V", mean=3.5, when=SPONTANEOUS,
                   note="26 women, German; the interval of speech on a single exhalation"),
            Figure(of="mean", source="korean", mark="V", mean=3.06, sd=0.62, when=READING, judges=False,
                   note="18 women, from the airflow; the SD is between speakers; with 16 groups a minute this must be "
                        "speech alone"),
            Figure(of="mean", source="bernardet", mark="V", mean=3.84, sd=2.05, when=SPONTANEOUS, judges=False,
                   note="Winkworth 1995, 6 women; S1 calls a group one breath in and out, the usual meaning is "
                        "speech on one expiration: uncertain which"),
        ),
    ),
    Row(
        name="group_with_inspiration", title="Breath group, with inspiration", part=GROUPS, unit="s",
        measure=timing.group_with_inspiration,
        measured="from the onset of the inspiration to the last phone (B52: one breath in and out)",
        figures=(
            Figure(of="mean", source="bernardet", mark="V", mean=3.84, sd=2.05,
                   note="Winkworth 1995, 6 women, spontaneous; S1 calls a group one breath in and out: so taken here, "
                        "though the study may mean the speech alone"),
            EXTREMES,
        ),
    ),
    Row(
        name="syllables", title="Syllables in a breath group", part=GROUPS, unit="syllables", measure=timing.syllables,
        digits=1,
        measured="as the planner counted what is said on one inspiration",
        figures=(
            Figure(of="mean", source="hoit", mark="M", low=13.0, high=20.0, when=When(style="reading", age=ADULT),
                   note="men reading: 18 to 20 at 25 years, 13 to 16 at 75"),
            Figure(of="mean", source="hoit", mark="M", low=18.0, high=20.0, when=YOUNG, judges=False,
                   note="at 25 years"),
            Figure(of="mean", source="hoit", mark="M", low=13.0, high=16.0, when=OLD, judges=False, note="at 75 years"),
            Figure(of="mean", source="korean", mark="V", mean=17.95, when=READING),
            Figure(of="each", source="scorebreath", mark="E", low=2.0, high=45.0, judges=False, note="usual extremes"),
        ),
    ),
    Row(
        name="articulation_rate", title="Articulation rate", part=GROUPS, unit="syllables/s",
        measure=timing.articulation_rate,
        measured="syllables of a group over its length, silences of 50 ms and more left out",
        figures=(
            Figure(of="mean", source="jacewicz", mark="M", low=3.5, high=6.5, when=When(age=ADULT),
                   note="with Hoit & Hixon 1987"),
        ),
    ),
    Row(
        name="cycle_rate", title="Breaths a minute, speaking", part=GROUPS, unit="/min",
        measure=timing.speech_rate, digits=1,
        measured="60 s over the time from the onset of a speech inspiration to the next inspiration",
        figures=(
            Figure(of="mean", source="korean", mark="V", mean=16.03, sd=3.1, when=READING, note="18 women reading"),
        ),
    ),
    Row(
        name="inspiration", title="Inspiration", part=BREATHS, unit="s", measure=timing.ti,
        measured="length of the movement of a speech inspiration, which is longer than its sound",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=0.50, high=0.72, note="acceptance window"),
            Figure(of="each", source="scorebreath", mark="E", low=0.25, high=1.10, note="acceptance window"),
            Figure(of="mean", source="mcfarland", mark="M", low=0.5, high=0.7, judges=False, note="typical"),
            Figure(of="each", source="mcfarland", mark="M", low=0.2, high=1.2, judges=False, note="extremes"),
        ),
    ),
    Row(
        name="inspiration_syllables", title="r(inspiration, syllables)", part=BREATHS, unit="",
        measure=timing.ti_and_syllables, kind="relation", labels=("inspiration, s", "syllables"), fewest=PAIRS,
        measured="Pearson's correlation of a speech inspiration's length with the syllables said on it; 0 where one of "
                 "the two never changes",
        figures=(
            Figure(of="value", source="scorebreath", mark="E", low=0.3, high=0.8, when=OTHERS,
                   note="acceptance window"),
            Figure(of="value", source="papers", mark="V", low=-0.1, high=0.1, when=PAPERS,
                   note="S1 and S2 say that an inspiration's length mostly does not depend on the utterance"),
            Figure(of="value", source="whalen", mark="V", low=0.29, high=0.65, judges=False,
                   note="three speakers: .65, .50, .29; of breath intake with utterance length"),
            Figure(of="value", source="winkworth94", mark="M", low=0.2, high=0.5, judges=False,
                   note="usual; also Winkworth 1995, Rochet-Capellan & Fuchs 2013"),
        ),
    ),
    Row(
        name="inspiratory_fraction", title="Inspiration's share of the cycle", part=BREATHS, unit="",
        measure=timing.speech_fraction, digits=3,
        measured="length of a speech inspiration over the time from its onset to the next inspiration",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=0.10, high=0.20, note="acceptance window"),
            Figure(of="mean", source="textbook", mark="V", low=0.10, high=0.16, judges=False, note="10/90; 0.16"),
            Figure(of="mean", source="korean", mark="V", mean=0.167, judges=False, note="in to out as 1 to 5, reading"),
            Figure(of="mean", source="autesserre", mark="V", mean=0.20, when=SPONTANEOUS, judges=False,
                   note="breathing out lasts four times as long; of a dialogue's time a quarter is breathing in"),
        ),
    ),
    Row(
        name="breath_pause", title="Pause with a breath", part=PAUSES, unit="s", measure=timing.breath_pause,
        measured="from the last phone of a group to the first of the next, one inspiration between them, nothing "
                 "asked for "
                 "by the markup",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=0.35, high=1.8),
            Figure(of="mean", source="scorebreath", mark="E", low=0.75, high=0.95, judges=False, note="default"),
        ),
    ),
    Row(
        name="silence_in_sentence", title="Before a breath, in a sentence", part=PAUSES, unit="s", digits=3,
        measure=lambda m: timing.before_breath(m, "semicolon", "comma", "line", "marker", "clause", "phrase", "word"),
        measured="silence from the last phone to the breath's sound (to its movement where it makes none)",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=0.02, high=0.20, note="default 0.08; that there are "
                   "silent rims: Ruinskiy & Lavner 2007, Fukuda 2018"),
        ),
    ),
    Row(
        name="silence_after_sentence", title="Before a breath, sentence end", part=PAUSES, unit="s",
        digits=3,
        measure=lambda m: timing.before_breath(m, "sentence"),
        measured="silence from the last phone to the breath's sound (to its movement where it makes none)",
        figures=(Figure(of="mean", source="scorebreath", mark="E", low=0.06, high=0.40, note="default 0.18"),),
    ),
    Row(
        name="silence_after_paragraph", title="Before a breath, paragraph end", part=PAUSES, unit="s",
        digits=3,
        measure=lambda m: timing.before_breath(m, "paragraph"),
        measured="silence from the last phone to the breath's sound (to its movement where it makes none)",
    ),
    Row(
        name="silence_after_breath", title="Between a breath and speech", part=PAUSES, unit="s",
        measure=timing.after_breath, digits=3,
        measured="silence from the end of the breath's sound (of its movement where it makes none) to the first phone",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=0.01, high=0.20, when=When(age=ADULT),
                   note="default 0.06; "
                   "short in adults, longer in children (Godde 2021)"),
        ),
    ),
    Row(
        name="breathless_pause", title="Pause without a breath", part=PAUSES, unit="s",
        measure=timing.breathless_pause, digits=3,
        measured="silences of 50 ms and more between two phones of a group, nothing asked for by the markup",
        figures=(Figure(of="mean", source="trouvain", mark="M", low=0.1, high=0.5),),
    ),
    Row(
        name="rest_rate", title="Breaths a minute, at rest", part=REST, unit="/min", measure=timing.rest_rate, digits=1,
        measured="60 s over the time from the onset of a tidal inspiration to the next tidal one",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=10.0, high=20.0, when=When(age=ADULT)),
            Figure(of="mean", source="tobin", mark="M", mean=16.6, sd=2.8, when=When(age=ADULT), judges=False),
        ),
    ),
    Row(
        name="rest_inspiration", title="Inspiration, at rest", part=REST, unit="s", measure=timing.rest_ti,
        measured="length of tidal inspirations that a tidal one follows",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=1.2, high=2.2, when=When(age=ADULT)),
            Figure(of="mean", source="tobin", mark="M", mean=1.62, sd=0.31, when=When(age=ADULT), judges=False),
        ),
    ),
    Row(
        name="rest_fraction", title="Inspiration's share, at rest", part=REST, unit="", digits=3,
        measure=timing.rest_fraction,
        measured="length of a tidal inspiration over the time from its onset to the next tidal one",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=0.35, high=0.45, note="acceptance window"),
            Figure(of="mean", source="tobin", mark="M", mean=0.42, sd=0.03, judges=False),
            Figure(of="mean", source="textbook", mark="V", low=0.40, high=0.45, judges=False, note="40/60; 0.45"),
        ),
    ),
    Row(
        name="rest_volume", title="Depth of a breath, at rest", part=REST, unit="L", measure=timing.rest_volume,
        measured="volume of tidal inspirations that a tidal one follows",
        figures=(
            Figure(of="mean", source="scorebreath", mark="E", low=0.30, high=0.80, when=When(age=ADULT),
                   note="7 mL a kg"),
            Figure(of="mean", source="tobin", mark="M", mean=0.383, sd=0.091, when=When(age=ADULT), judges=False),
        ),
    ),
)  # fmt: skip
"""Rows about time."""
