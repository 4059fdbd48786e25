"""The face of the preview in a browser: each channel moves it, to the side and as far as it should."""

from __future__ import annotations

import dataclasses
import html as markup
import json
import re
from pathlib import Path
from typing import Any

import pytest

from scorebreath.curves.curve_set import curves
from scorebreath.report import preview
from scorebreath.score.acting import EMOTIONS
from scorebreath.score.document import Score
from scorebreath.score.events import Utterance
from tests.curves.scores import Breath, build, score_of
from tests.report.faced import faced
from tests.report.test_preview import page
from tests.report.test_preview_browser import dump

pytestmark = pytest.mark.browser

SEEN = """<script>{
const still = window.scorebreath.pose(0);
for (const name in still) still[name] = name.endsWith("_level") ? -80 : 0;
const part = id => {
  const {x, y, width, height} = document.getElementById(id).getBBox(), line = document.getElementById(id).getCTM();
  const middle = new DOMPoint(x + width / 2, y + height / 2).matrixTransform(line);
  const shown = Number(document.getElementById(id).getAttribute("opacity") ?? 1);
  return {x: middle.x, y: middle.y, width, height, shown};
};
const PARTS = ["mouth", "seam", "lip-upper", "lip-lower", "eye-left-white", "eye-right-white", "eye-left-iris",
  "eye-right-iris", "brow-left", "brow-right", "nose-group", "skin", "wrinkle-forehead", "wrinkle-glabella"];
const told = {};
for (const [name, values] of Object.entries(POSES)) {
  const pose = typeof values === "number" ? window.scorebreath.pose(values) : {...still, ...values};
  if (typeof values !== "number") figure(pose, 1, true);
  told[name] = Object.fromEntries(PARTS.map(id => [id, part("face-" + id)]));
  told[name].all = document.getElementById("figure").innerHTML;
  told[name].roll = document.getElementById("face-head").getAttribute("transform");
  told[name].jaw = document.getElementById("jaw").getAttribute("transform");
}
document.body.dataset.told = JSON.stringify(told);
}</script>"""
STILL = {"lung_volume", "airflow", "thorax", "abdomen", "shoulder", "speech_level", "breath_level"}
"""Drawn by the figure in profile, and tested there."""
POSES: dict[str, dict[str, float]] = {
    "neutral": {},
    **{name: {name: 6.0 if "head" in name or "eye" in name else 0.8} for name in preview.CHANNELS if name not in STILL},
    "tongue_tip": {"tongue_tip": 0.8, "jaw_open": 0.4},
    "aa": {"jaw_open": 0.4},
    "pbm": {"jaw_open": 0.4, "lip_close": 1.0},
    "pbm, happy": {"jaw_open": 0.4, "mouth_open": 0.5, "lip_close": 1.0, "emotion_happy": 1.0},
    "pbm, surprised": {"lip_close": 1.0, "emotion_surprised": 1.0, "lip_tuck": 0.5},
    "up": {"head_pitch": 8.0},
    "down": {"head_pitch": -8.0},
    "shut": {"lid_left": 1.0, "lid_right": 1.0},
    "wink": {"lid_right": 1.0},
    "wide": {"lid_left": -0.5, "lid_right": -0.5},
}


def seen(chromium: str, folder: Path, html: str, poses: dict[str, Any]) -> dict[str, Any]:
    """Where everything is, at each pose: channels by name, or seconds."""
    file = folder / "preview.html"
    file.write_text(html + SEEN.replace("POSES", json.dumps(poses)), encoding="utf-8")
    found = re.search(r'data-told="([^"]*)"', dump(chromium, folder, file, 0.0))
    assert found
    told: dict[str, Any] = json.loads(markup.unescape(found[1]))
    return told


@pytest.fixture(scope="module")
def told(chromium: str, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    return seen(chromium, tmp_path_factory.mktemp("face"), page(faced()), POSES)


def test_every_channel_is_drawn(told: dict[str, Any]) -> None:
    drawn = {name: told[name]["all"] for name in POSES if name in preview.CHANNELS}
    assert len(drawn) == len(preview.CHANNELS) - len(STILL)
    before = {**dict.fromkeys(drawn, told["neutral"]["all"]), "tongue_tip": told["aa"]["all"]}
    assert [name for name, svg in drawn.items() if svg == before[name]] == []
    assert drawn.pop("mouth_open") == drawn["jaw_open"], "the larger of the two opens the mouth"
    assert len(set(drawn.values())) == len(drawn), "two channels do the same"
    assert "NaN" not in "".join(one["all"] for one in told.values())


@pytest.mark.parametrize("closed", ["pbm", "pbm, happy", "pbm, surprised"])
def test_lips_close_whatever_opens_them(told: dict[str, Any], closed: str) -> None:
    """Upper and lower edge are one arc, seen as one line; the profile's jaw is up."""
    edges = re.search(r'id="face-mouth"[^>]* d="M ([^"]*) Z"', told[closed]["all"])
    assert edges
    numbers = [float(number) for number in re.findall(r"-?\d+\.\d+", edges[1])]
    there, back = numbers[2:8], numbers[8:14]
    assert there[:4] == pytest.approx([back[2], back[3], back[0], back[1]], abs=2.5)
    assert there[1] == back[1] == there[3] == back[3]
    assert told[closed]["seam"]["shown"] == 1.0
    assert "rotate(0.00 " in told[closed]["jaw"]


def test_an_open_mouth_is_open(told: dict[str, Any]) -> None:
    neutral, vowel = told["neutral"], told["aa"]
    assert vowel["mouth"]["height"] > neutral["mouth"]["height"] + 12
    assert vowel["seam"]["shown"] == 0.0
    assert vowel["skin"]["height"] > neutral["skin"]["height"], "the chin goes down"
    assert told["lip_round"]["lip-lower"]["width"] < neutral["lip-lower"]["width"] - 15
    assert told["lip_spread"]["lip-lower"]["width"] > neutral["lip-lower"]["width"] + 8


def test_left_is_the_characters_own(told: dict[str, Any]) -> None:
    """Who looks at us has the left eye, brow and nostril on the right of the page."""
    neutral = told["neutral"]
    assert neutral["eye-left-white"]["x"] > neutral["skin"]["x"] > neutral["eye-right-white"]["x"]
    assert neutral["brow-left"]["x"] > neutral["brow-right"]["x"]
    raised = told["brow_left"]
    assert raised["brow-left"]["y"] < neutral["brow-left"]["y"] - 5
    assert raised["brow-right"]["y"] == neutral["brow-right"]["y"]
    wink = told["wink"]
    assert wink["eye-right-white"]["height"] < 14 < 20 < neutral["eye-right-white"]["height"]
    assert wink["eye-left-white"]["height"] == neutral["eye-left-white"]["height"]


def test_lids_close_and_widen(told: dict[str, Any]) -> None:
    for side in ("left", "right"):
        name = f"eye-{side}-white"
        heights = [told[pose][name]["height"] for pose in ("shut", "neutral", "wide")]
        assert heights[0] < heights[1] - 8
        assert heights[1] < heights[2] - 1


def test_the_head_turns_nods_and_tilts(told: dict[str, Any]) -> None:
    neutral = told["neutral"]
    assert told["head_yaw"]["nose-group"]["x"] > neutral["nose-group"]["x"] + 4, "to the character's left"
    assert told["up"]["nose-group"]["y"] < neutral["nose-group"]["y"] - 4 < told["down"]["nose-group"]["y"] - 8
    assert "rotate(-6.00 " in told["head_roll"]["roll"], "towards the character's right shoulder: against the clock"
    assert told["head_roll"]["brow-left"]["y"] < told["head_roll"]["brow-right"]["y"]


def test_the_eyes_look_where_they_should(told: dict[str, Any]) -> None:
    for side in ("left", "right"):
        iris = f"eye-{side}-iris"
        assert told["eye_yaw"][iris]["x"] > told["neutral"][iris]["x"] + 1
        assert told["eye_pitch"][iris]["y"] < told["neutral"][iris]["y"] - 1


def test_wrinkles_appear_with_what_folds_them(told: dict[str, Any]) -> None:
    assert told["neutral"]["wrinkle-forehead"]["shown"] == told["neutral"]["wrinkle-glabella"]["shown"] == 0
    assert told["wrinkle_forehead"]["wrinkle-forehead"]["shown"] > 0.5
    assert told["wrinkle_glabella"]["wrinkle-glabella"]["shown"] > 0.5


def test_every_emotion_has_a_face_of_its_own(told: dict[str, Any]) -> None:
    assert len({told[f"emotion_{name}"]["all"] for name in EMOTIONS}) == len(EMOTIONS)
    corner = {name: told[f"emotion_{name}"]["seam"]["y"] for name in EMOTIONS}
    assert corner["happy"] < corner["sad"]
    assert told["emotion_happy"]["lip-lower"]["width"] > told["neutral"]["lip-lower"]["width"] + 10
    assert told["emotion_angry"]["brow-left"]["y"] > told["neutral"]["brow-left"]["y"]
    assert told["emotion_surprised"]["brow-left"]["y"] < told["neutral"]["brow-left"]["y"] - 5


def test_the_page_shows_the_events_of_its_score(chromium: str, tmp_path: Path) -> None:
    score = faced()
    times = {"before": 0.1, "blink": 0.38, "wink": 2.285, "brows": 1.4, "away": 2.0, "glance": 3.2}
    told = seen(chromium, tmp_path, page(score), times)
    values = dict(zip(times, curves(score).sample(list(times.values()), ["eye_yaw", "lid_left"]), strict=True))
    assert told["blink"]["eye-left-white"]["height"] < 14 < 20 < told["before"]["eye-left-white"]["height"]
    assert told["wink"]["eye-right-white"]["height"] < 14 < 18 < told["wink"]["eye-left-white"]["height"]
    assert told["brows"]["brow-left"]["y"] < told["before"]["brow-left"]["y"] - 3
    assert values["away"][0] < -5
    assert told["away"]["eye-left-iris"]["x"] < told["glance"]["eye-left-iris"]["x"] - 2


def test_lips_follow_the_loudness_where_nothing_is_known_of_phones(chromium: str, tmp_path: Path) -> None:
    """A Score whose utterances have no phones still speaks."""
    score = build([Breath(speech=2.0)])
    stripped = faced_without_phones(score)
    assert curves(stripped).sample([1.5], ["jaw_open"])[0, 0] == 0.0
    told = seen(chromium, tmp_path, page(stripped), {"silent": 0.05, "loud": 1.5})
    assert told["silent"]["jaw"].startswith("rotate(0.00 ")
    assert not told["loud"]["jaw"].startswith("rotate(0.00 ")


def test_a_score_of_nothing_has_a_calm_face(chromium: str, tmp_path: Path) -> None:
    told = seen(chromium, tmp_path, page(score_of([], duration=1.0)), {"page": 0.5, "neutral": {}})
    for part in ("mouth", "eye-left-white", "brow-right"):
        assert told["page"][part] == told["neutral"][part]


def faced_without_phones(score: Score) -> Score:
    """The same, but that nobody knows what is said."""
    events = tuple(dataclasses.replace(e, phones=()) if isinstance(e, Utterance) else e for e in score.events)
    return dataclasses.replace(score, events=events)
