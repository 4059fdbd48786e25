"""Ratios that are moved while it sounds: measured in what the engines make."""

from __future__ import annotations

import dataclasses
import io
import itertools
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.engine import offline
from scorebreath.engine.breaths import ROUTES
from scorebreath.engine.moves import AS_WRITTEN, Ratios, moves
from scorebreath.engine.onsets import Onset
from scorebreath.engine.segments import segments
from scorebreath.media.store import MemoryStore
from scorebreath.score.events import Event
from scorebreath.score.performing import Heard
from scorebreath_synthdefs import CATALOGUE, RECORDING, SPEECH
from scorebreath_synthdefs.catalogue import HEARD, NASAL, Route
from tests.engine.listening import Signal, level_db
from tests.engine.sounding import babble, cut, inspiration, move, noise, samples, score, utterance, wave
from tests.engine.test_cuts import ENGINES
from tests.synthdefs.playing import STORE as RECORDED
from tests.synthdefs.playing import onset, played
from tests.synthdefs.spectra import measures

RATE = 48000
STORE = MemoryStore()
SPOKEN = STORE.put(babble(3.0, RATE, 3), RATE, "speech")
LONG = noise(0.1, 2.8, 0.1)
BREATH, SPEECH_EVENT = inspiration(0.2, LONG), utterance(0.2, SPOKEN, 3.0)


def sound(*events: Event, engine: str = "embedded") -> Signal:
    return samples(wave(score(events, 3.5, STORE), STORE, engine=engine, encoding="float32"))[0]


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("event", "route"), [(BREATH, "mouth"), (SPEECH_EVENT, "speech")])
def test_a_ratio_of_2_in_a_tenth_of_a_second_is_6_db_without_a_click(event: Event, route: str, engine: str) -> None:
    plain = sound(event, engine=engine)
    moved = sound(event, move(1.0, 0.1, **{route: 2.0}), engine=engine)
    before, after = slice(0, RATE - 64), slice(round(1.2 * RATE), None)
    np.testing.assert_array_equal(moved[before], plain[before])
    np.testing.assert_allclose(moved[after], 2 * plain[after], rtol=1e-4, atol=1e-6)
    sounding = np.abs(plain) > 1e-3
    gain = np.where(sounding, moved / np.where(sounding, plain, 1), np.nan)
    middle = gain[round(0.95 * RATE) : round(1.25 * RATE)]
    steps = np.abs(np.diff(middle[~np.isnan(middle)]))
    assert steps.max() < 0.01  # a click is a step of the gain; the glide's own is 0.0002 a frame
    assert np.nanmedian(gain[round(1.045 * RATE) : round(1.055 * RATE)]) == pytest.approx(1.5, abs=0.1)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_jump_is_smoothed(engine: str) -> None:
    plain, moved = sound(SPEECH_EVENT, engine=engine), sound(SPEECH_EVENT, move(1.0, 0.0, speech=0.0), engine=engine)
    sounding = np.abs(plain) > 1e-3
    gain = (moved[sounding] / plain[sounding])[RATE // 2 :]
    assert np.abs(np.diff(gain)).max() < 0.02
    assert np.abs(moved[round(1.1 * RATE) :]).max() < 1e-4


def test_a_sound_that_begins_later_begins_with_what_is_in_force() -> None:
    late = utterance(1.5, SPOKEN, 3.0)
    plain, moved = sound(late), sound(late, move(0.5, 0.2, speech=0.25))
    np.testing.assert_array_equal(moved, plain * 0.25)


def test_ratios_of_1_change_not_one_bit() -> None:
    events = (inspiration(0.2, LONG, nose=0.5), utterance(0.4, SPOKEN, 3.0))
    np.testing.assert_array_equal(sound(*events, move(0.1, 0.0)), sound(*events))


@pytest.mark.parametrize("brightness", [0.5, 2.0])
def test_brightness_moves_the_centroid_but_not_the_level(brightness: float) -> None:
    plain, moved = sound(BREATH), sound(BREATH, move(1.0, 0.1, brightness=brightness))
    late = slice(round(1.3 * RATE), round(2.9 * RATE))
    np.testing.assert_array_equal(moved[: RATE - 64], plain[: RATE - 64])
    ratio = measures(moved[late])["centroid"] / measures(plain[late])["centroid"]
    assert (1.3 < ratio < 2.2) if brightness > 1 else (0.45 < ratio < 0.8)
    assert level_db(moved[late]) == pytest.approx(level_db(plain[late]), abs=1.0)
    steps = np.abs(np.diff(moved[round(0.99 * RATE) : round(1.3 * RATE)]))
    assert steps.max() < 1.5 * max(np.abs(np.diff(one[late])).max() for one in (plain, moved))


def test_every_instrument_follows_its_row_of_the_table_and_no_other() -> None:
    """Each ratio by itself: who gets louder, who gets brighter, who stays bit for bit."""
    louder: dict[str, Route] = {SPEECH: "speech", RECORDING: "mouth"}
    for name in CATALOGUE:
        louder.setdefault(name, "nose" if any(f"_{kind}_" in name for kind in NASAL) else "mouth")
    names = [name for name in CATALOGUE if name.endswith("_male") or name in louder.keys() & {SPEECH, RECORDING}]
    sounds = [onset(name, 0.0, 5, media_seconds=0.6, heard=0.0) for name in names]
    for name, one in zip(names, sounds, strict=True):
        plain = heard_alone(one, AS_WRITTEN)
        for route in HEARD:
            moved = heard_alone(one, Heard(**{route: 2.0}))
            if route == louder[name]:
                np.testing.assert_allclose(moved, 2 * plain, rtol=1e-5, atol=1e-7)
            elif route == "brightness" and name not in {SPEECH, RECORDING}:
                assert measures(moved)["centroid"] > 1.15 * measures(plain)["centroid"]
            else:
                np.testing.assert_array_equal(moved, plain)


def heard_alone(one: Onset, heard: Heard) -> Signal:
    stream = io.BytesIO()
    moved = Ratios().move(time=0.0, body="b", heard=heard, glide=0.0)
    controls = {key: value for key, value in one.controls.items() if key != "heard"}
    offline.render_sounds(
        [dataclasses.replace(one, body="b", controls=controls)], RECORDED, stream,
        duration=0.7, moved=[moved], encoding="float32",
    )  # fmt: skip
    return samples(stream.getvalue())[0]


def test_the_routes_of_the_score_and_of_the_instruments_agree() -> None:
    for routes in ROUTES.values():
        assert routes.nose is None or routes.nose in NASAL
        assert routes.mouth not in NASAL


def test_pieces_carry_what_is_in_force(monkeypatch: pytest.MonkeyPatch) -> None:
    """Also a glide in a silence, which no piece is cut through."""
    events: list[Event] = [inspiration(1.7 * index + 0.1, noise(seed=index + 1), nose=0.5) for index in range(6)]
    moved = [move(0.3, 0.1, mouth=2.0), move(1.9, 0.4, nose=0.0), move(4.0, 1.2, mouth=0.5, brightness=1.5)]
    made = score(sorted([*events, *moved], key=lambda event: event.onset), 11.0)
    whole = wave(made)
    runs: list[int] = []
    in_pieces = partial(segments, length=1.0)

    def counted(*args: object, **settings: object) -> object:
        pieces = list(in_pieces(*args, **settings))  # type: ignore[arg-type]
        for piece in pieces:
            for one in moves(made):
                edge = piece.start / RATE
                assert not one.time < edge < one.end
        runs.append(len(pieces))
        return pieces

    monkeypatch.setattr(offline, "segments", counted)
    assert wave(made) == whole
    assert runs[0] > 3


def test_a_cut_parameter_never_moves() -> None:
    told = move(1.0, 0.1, mouth=2.0)
    assert moves(score([told, cut(0.5, told.id)], 2.0)) == ()
    assert len(moves(score([told, cut(1.5, told.id)], 2.0))) == 1


DRAWN = st.lists(
    st.tuples(st.integers(0, 3000), st.integers(0, 1000), st.floats(0, 16)), min_size=1, max_size=6,
    unique_by=lambda one: one[0],
)  # fmt: skip


@given(DRAWN)
def test_moves_meet(drawn: list[tuple[int, int, float]]) -> None:
    """Each begins where the last one was then, and no mover outlives one that came later."""
    made = moves(score([move(ms / 1000, glide / 1000, mouth=round(to, 6)) for ms, glide, to in drawn], 9.0))
    assert [one.time for one in made] == sorted(ms / 1000 for ms, _, _ in drawn)
    assert made[0].before == AS_WRITTEN
    for one, following in itertools.pairwise(made):
        assert following.before == one.at(following.time)
        assert following.end >= one.end - 1e-6
        assert one.at(one.time + one.glide) == one.after


def test_an_interrupted_glide_stays_interrupted() -> None:
    """A slow move, and a quick one on its way: the slow one does not come back."""
    events = (SPEECH_EVENT, move(0.5, 2.0, speech=4.0), move(1.0, 0.1, speech=0.5))
    plain, moved = sound(SPEECH_EVENT), sound(*events)
    late = slice(round(1.3 * RATE), None)
    np.testing.assert_allclose(moved[late], plain[late] * 0.5, rtol=1e-4, atol=1e-6)


def test_sounds_with_a_bus_need_no_mover() -> None:
    """A bus nobody wrote to is 0, which is a ratio, too."""
    name = next(name for name in CATALOGUE if name.endswith("mouth_male"))
    assert not played([onset(name, 0.0, 3, heard=0.0)], 0.7).any()
