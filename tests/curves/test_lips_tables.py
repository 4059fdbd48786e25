"""The lips' tables, walked."""

from __future__ import annotations

import numpy as np
import pytest

from scorebreath.curves.channels import CHANNELS
from scorebreath.curves.lips.gates import CONTACTS, LEAST, RAMP
from scorebreath.curves.lips.targets import LIP_CHANNELS, TUCK, parts_of, targets
from scorebreath.equations.phones import is_vowel, makings

SPEEDS = {channel.name: channel.speed for channel in CHANNELS}
CLASSES = {
    "bilabial": {"bilabial"}, "bilabial_open": {"bilabial_open"}, "labiodental": {"labiodental"},
    "labiodental_open": {"labiodental"}, "rounded": {"rounded"}, "hushing": {"hushing"}, "dental": {"tip"},
    "alveolar": {"tip"}, "sibilant": {"sibilant"}, "retroflex": {"tip", "hushing"}, "palatal": {"back", "front"},
    "velar": {"back"}, "uvular": {"back"}, "throat": {"throat"},
    "vowel": {"open", "front", "round_vowel", "neutral"},
}  # fmt: skip


def test_every_letter_has_targets_and_only_letters_have() -> None:
    assert set(targets().rows) == set(makings())
    assert set(CLASSES) == set(makings().values())


@pytest.mark.parametrize("letter", makings())
def test_a_letter_is_moved_by_what_makes_it(letter: str) -> None:
    table = targets()
    row = table.row(letter)
    assert table.classes[row] in CLASSES[makings()[letter]]
    value = dict(zip(LIP_CHANNELS, table.target[row], strict=True))
    assert (value["lip_close"] == 1.0) == (makings()[letter] == "bilabial")
    assert (value["lip_tuck"] == 1.0) == (makings()[letter] == "labiodental")
    if is_vowel(letter):
        assert value["lip_close"] == value["lip_tuck"] == 0.0 < 0.15 < value["jaw_open"]
        assert value["lip_round"] * value["lip_spread"] < 0.01


def test_numbers_are_in_range() -> None:
    table = targets()
    assert table.target.shape == table.alpha.shape == (len(table.classes), len(LIP_CHANNELS))
    assert table.target.min() >= 0.0
    assert table.target.max() <= 1.0
    assert table.alpha.min() >= 0.15  # lower ones would let a phone far away win all at once
    assert table.alpha.max() <= 1.0
    assert min(table.before.min(), table.after.min()) >= 10.0


@pytest.mark.parametrize("column", range(len(LIP_CHANNELS)))
def test_no_dominance_falls_too_fast_for_its_channel(column: int) -> None:
    """Of a weighted mean whose weights' logarithms change by theta: |dF/dt| <= theta * range / 2."""
    table = targets()
    theta = max(float(side[:, 0 if column == 0 else 1].max()) for side in (table.before, table.after))
    speed = SPEEDS[LIP_CHANNELS[column]]
    assert speed is not None
    assert theta * float(np.ptp([0.0, *table.target[:, column]])) / 2.0 < speed


def test_contacts_are_those_of_the_lips() -> None:
    touching = {letter for letter, making in makings().items() if making in ("bilabial", "labiodental")}
    assert set(CONTACTS) == touching
    for letter, contact in CONTACTS.items():
        assert contact.channel == ("lip_tuck" if targets().target[targets().row(letter), TUCK] == 1.0 else "lip_close")
        assert 0.5 < contact.share <= 1.0
    speed = SPEEDS["lip_close"]
    assert speed is not None
    assert speed > 1.5 / RAMP
    assert LEAST > 1 / 23.976


@pytest.mark.parametrize(("ipa", "letters"), [("aɪ", "aɪ"), ("tʃ", "tʃ"), ("pf", "pf"), ("ɑːɹ", "ɑɹ"), ("kː", "k")])
def test_diphthongs_and_affricates_have_two_targets_in_time(ipa: str, letters: str) -> None:
    parts = parts_of(ipa)
    assert [row for row, _ in parts] == [targets().row(letter) for letter in letters]
    ends = [end for _, end in parts]
    assert ends == sorted(set(ends))
    assert ends[-1] == 1.0


def test_what_is_unknown_is_neutral_and_weak() -> None:
    ((row, end),) = parts_of("ʘ")
    table = targets()
    assert end == 1.0
    assert np.array_equal(table.target[row], table.target[table.row("ə")])
    assert np.array_equal(table.alpha[row], table.alpha[table.row("h")])
    assert parts_of("") == parts_of("ː") == parts_of("ʘ")
