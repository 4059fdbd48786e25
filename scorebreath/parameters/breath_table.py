"""The table's rows of breathing and speaking: name, unit, range, default, meaning, source, MIDI controller."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict

from scorebreath.parameters.row import row


class BreathTable(BaseModel):
    """What moves breath and voice."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    # The abstract model: S1 3.2.1, B25-B29

    abdomen_share: float = row(
        0.35, "Chest (0) or belly (1) breathing; the papers' ThoraxVsAbdomen", low=0, high=1,
        level="abstract", source="B25, X11; default: physiology 2.3 (thorax 0.65 upright)", cc=20,
    )  # fmt: skip
    nose_share: float = row(
        0.35, "Breathing in through the mouth (0) or the nose (1); the papers' MouthVsNose", low=0, high=1,
        level="abstract", source="B26, X11; default: physiology 0.3", cc=21,
    )  # fmt: skip
    capacity_lung: float = row(
        100.0, "Overall capacity of the lungs; 100 is what is predicted for the person", unit="%", low=10, high=200,
        level="abstract", source="B27, X3, X13", cc=22,
    )  # fmt: skip
    amplitude_breathing_sound: float = row(
        1.0, "Overall loudness of the inspiration sounds, as a gain", low=0, high=4,
        level="abstract", source="B28", cc=23,
    )  # fmt: skip
    opening_inspiration_channels: float = row(
        0.3, "How far nostrils and mouth open to breathe in", low=0, high=1,
        level="abstract", source="B29; default: physiology 6 (6 mm between the lips)", cc=24,
    )  # fmt: skip

    # Low level, independent: B30

    speaking_loudness: float = row(
        100.0, "Loudness of speaking; Eq. 1 divides by it", unit="%", low=10, high=400,
        level="low", source="B30, X3", cc=25,
    )  # fmt: skip
    norm_syllables: float = row(
        18.0, "Syllables said on one breath at capacity = loudness", unit="syllables", low=2, high=45,
        level="low", source="B37, X13; physiology 1.1", cc=26,
    )  # fmt: skip
    prosody_rate: float = row(
        1.0, "Speaking rate, relative to the voice's own", low=0.5, high=2,
        level="low", source="B13, B30", cc=27,
    )  # fmt: skip
    prosody_pitch: float = row(
        1.0, "Mean pitch, relative to the voice's own", low=0.5, high=2,
        level="low", source="speech synthesis; not in the papers", cc=28,
    )  # fmt: skip
    amplitude_neck_motion: float = row(
        0.6, "Chin raised by a full breath", unit="deg", low=0, high=10,
        level="low", source="B8, B11, B30; default: physiology 6", cc=29,
    )  # fmt: skip

    # Low level, derived by Eq. 1 unless set: B31-B39

    length_inspiration: float | None = row(
        None, "Length of an inspiration of the Bernardet models; default: capacity_lung / 100", unit="s",
        low=0.05, high=5, level="low", source="B5, B38, X1; 5 s: B45", cc=30,
    )  # fmt: skip
    length_utterance: float | None = row(
        None, "Syllables to step through before a pause is looked for; default: sqrt(capacity_lung / "
        "speaking_loudness) * norm_syllables", unit="syllables", low=1, high=100, level="low", source="B37, X2", cc=31,
    )  # fmt: skip
    urgency_limit: float | None = row(
        None, "How far a pause marker may be from that place; default: 2 * length_utterance", unit="characters",
        low=0, high=1000, level="low", source="B39, X4", cc=85,
    )  # fmt: skip
    amplitude_sound_nose: float | None = row(
        None, "Gain of the nose's sound; default: nose_share * amplitude_breathing_sound", low=0, high=4,
        level="low", source="B31", cc=86,
    )  # fmt: skip
    amplitude_sound_mouth: float | None = row(
        None, "Gain of the mouth's sound; default: (1 - nose_share) * amplitude_breathing_sound", low=0, high=4,
        level="low", source="B32", cc=87,
    )  # fmt: skip
    amplitude_nostril_flare: float | None = row(
        None, "Flare of the nostrils; default: nose_share * opening_inspiration_channels", low=0, high=1,
        level="low", source="B33", cc=88,
    )  # fmt: skip
    amplitude_mouth_open: float | None = row(
        None, "Opening of the mouth; default: (1 - nose_share) * opening_inspiration_channels", low=0, high=1,
        level="low", source="B34", cc=89,
    )  # fmt: skip
    volume_abdomen: float | None = row(
        None, "Maximum of the abdomen's shape; default: abdomen_share * capacity_lung / 100", low=0, high=4,
        level="low", source="B35", cc=90,
    )  # fmt: skip
    volume_thorax: float | None = row(
        None, "Maximum of the thorax's shape; default: (1 - abdomen_share) * capacity_lung / 100", low=0, high=4,
        level="low", source="B36", cc=102,
    )  # fmt: skip
    prosody_loudness: float | None = row(
        None, "Loudness of the voice, 100 as it speaks by itself; default: speaking_loudness", unit="%",
        low=1, high=400, level="low", source="B13, X12", cc=103,
    )  # fmt: skip

    # The person: whose body it is

    sex: Literal["male", "female"] = row(
        "male", "For vital capacity and vocal tract", level="person", source="physiology 2.1, 3.4"
    )
    age: float = row(
        30.0, "For vital capacity, vocal tract, and how children and old people breathe", unit="years", low=5, high=95,
        level="person", source="physiology 2.1, 1.5",
    )  # fmt: skip
    height: float = row(
        178.0, "For vital capacity and vocal tract", unit="cm", low=80, high=230,
        level="person", source="physiology 2.1",
    )  # fmt: skip
    posture: Literal["upright", "reclined", "supine"] = row(
        "upright", "Lying down moves speech to lower volumes and to the belly",
        level="person", source="physiology 1.5, 2.2, 2.3 (Hixon 1973; Hoit 1995)",
    )  # fmt: skip
    condition: Literal["none", "parkinson", "copd"] = row(
        "none", "A condition that changes speech breathing",
        level="person", source="physiology 1.5 (Solomon & Hixon 1993; Lee, Loudon 1993)",
    )  # fmt: skip
    capacity_equation: Literal["gli-2022", "ecsc-1993"] = row(
        "gli-2022", "Which equation predicts vital capacity: GLI Global 2022 (5 years and older) or ECSC 1993 (adults)",
        level="person", source="physiology 2.1 (Bowerman 2023; Quanjer 1993)",
    )  # fmt: skip
    vital_capacity: float | None = row(
        None, "Vital capacity at capacity_lung 100; default: predicted from sex, age and height", unit="L",
        low=0.5, high=9, level="person", source="physiology 2.1", cc=113,
    )  # fmt: skip
    resting_volume: float | None = row(
        None, "Volume above residual volume at rest; default: by posture", unit="fraction of VC", low=0.16, high=0.6,
        level="person", source="physiology 2.2", cc=112,
    )  # fmt: skip
    vocal_tract_length: float | None = row(
        None, "From lips to larynx, scales the breaths' resonances; default: by sex, age and height", unit="cm",
        low=8, high=22, level="person", source="physiology 3.4 (Fitch & Giedd 1999)",
    )  # fmt: skip
    style: Literal["reading", "spontaneous"] = row(
        "reading", "Reading breathes at boundaries of the text, spontaneous speech elsewhere too, and less often",
        level="person", source="physiology 1.1, 1.2 (Wang 2010; Henderson 1965)",
    )  # fmt: skip
    resting_rate: float = row(
        15.0, "Breaths a minute at rest", unit="1/min", low=4, high=60,
        level="person", source="physiology 1.6",
    )  # fmt: skip
    tidal_volume: float = row(
        0.10, "Depth of a breath at rest", unit="fraction of VC", low=0.02, high=0.5,
        level="person", source="physiology 1.6 (0.5 L)",
    )  # fmt: skip
    breath_variability: float = row(
        0.15, "Coefficient of variation of resting cycles", low=0, high=0.6,
        level="person", source="physiology 1.6 (Benchetrit 2000)",
    )  # fmt: skip

    # The natural model

    inspiration_base: float = row(
        0.42, "Length of an inspiration before nothing", unit="s", low=0.1, high=2,
        level="natural", source="physiology 1.3", cc=104,
    )  # fmt: skip
    inspiration_per_syllable: float = row(
        0.010, "What each coming syllable adds to it", unit="s/syllable", low=0, high=0.05,
        level="natural", source="physiology 1.3 (Fuchs 2013; Whalen & Kinsella-Shaw 1997)", cc=105,
    )  # fmt: skip
    inspiration_spread: float = row(
        0.12, "Standard deviation of its length from breath to breath", unit="s", low=0, high=0.5,
        level="natural", source="physiology 1.3", cc=106,
    )  # fmt: skip
    silence_before_breath: float = row(
        0.08, "Silence between the last phone and the breath within a sentence", unit="s", low=0, high=1,
        level="natural", source="physiology 1.4", cc=107,
    )  # fmt: skip
    silence_after_sentence: float = row(
        0.18, "The same after a sentence", unit="s", low=0, high=2,
        level="natural", source="physiology 1.4", cc=108,
    )  # fmt: skip
    silence_after_paragraph: float = row(
        0.45, "The same after a paragraph or a stanza", unit="s", low=0, high=4,
        level="natural", source="design: longer than any sentence's; physiology 1.4 (total pause up to 1.8 s)", cc=109,
    )  # fmt: skip
    silence_after_breath: float = row(
        0.06, "Silence between the breath and the first phone", unit="s", low=0, high=1,
        level="natural", source="physiology 1.4", cc=110,
    )  # fmt: skip
    volume_per_syllable: float = row(
        0.009, "Volume spent on a syllable", unit="fraction of VC", low=0.001, high=0.03,
        level="natural", source="physiology 2.2", cc=111,
    )  # fmt: skip
    termination_volume: float = row(
        0.36, "Volume at which speech usually ends, upright", unit="fraction of VC", low=0.16, high=0.6,
        level="natural", source="physiology 2.2 (Hixon 1973; Hoit & Hixon 1987)",
    )  # fmt: skip
    initiation_spread: float = row(
        0.04, "Standard deviation of the volume at which speech begins", unit="fraction of VC", low=0, high=0.2,
        level="natural", source="physiology 2.2 (Winkworth 1994, 1995)",
    )  # fmt: skip
    recovery_share: float = row(
        0.3, "Share of what the group before left too much or too little that the next breath carries over",
        low=0, high=1, level="natural", source="physiology 2.2",
    )  # fmt: skip
    breathless_pause: float = row(
        0.25, "Pause without a breath, inside a breath group", unit="s", low=0, high=2,
        level="natural", source="physiology 1.4 (Trouvain 2016)",
    )  # fmt: skip
    flow_exponent: float = row(
        1.66, "A breath's loudness goes with its highest flow to this power; its envelope always with 1.66",
        low=0, high=3, level="natural", source="physiology 3.1 (Gavriely & Cugell 1996)",
    )  # fmt: skip
    breath_envelope: Literal["flow", "trapezoid"] = row(
        "flow", "Loudness of a breath over time: as its flow, or the papers' trapezoid (theirs is always that)",
        level="natural", source="physiology 3.3; B46",
    )  # fmt: skip

    # Output

    breath_level: float = row(
        -24.0, "Level of a breath at the defaults, relative to the voice's reference", unit="dB", low=-60, high=0,
        level="output", source="physiology 3.2", cc=114,
    )  # fmt: skip
    motion_gain: float = row(
        1.0, "Scales thorax, abdomen, shoulder and neck; 1 is physiological", low=0, high=4,
        level="output", source="design; B62: stylised motion reads as more casual", cc=115,
    )  # fmt: skip
    breath_sound: bool = row(
        True, "Whether breaths are heard; times stay as they are", level="output", source="E1, B62", cc=116
    )
    breath_motion: bool = row(
        True, "Whether breaths are seen; times stay as they are", level="output", source="E1, B62", cc=117
    )
    breath_brightness: float = row(
        1.0, "Brightness of breaths: x their resonances and tilt, on top of what flow and states do", low=0.5, high=2,
        level="output", source="physiology 3.4; for performers", cc=118,
    )  # fmt: skip
    period_marker: Literal["bare", "sentence"] = row(
        "bare", "What the Bernardet models take as the marker '.': every full stop, or the end of a sentence",
        level="low", source="B19, X10",
    )  # fmt: skip
