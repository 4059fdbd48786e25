"""Voices for the tests of this room, each opened once."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from scorebreath.speech.espeak.voice import EspeakVoice


@pytest.fixture(scope="session")
def english() -> Iterator[EspeakVoice]:
    with EspeakVoice("en") as voice:
        yield voice


@pytest.fixture(scope="session")
def german() -> Iterator[EspeakVoice]:
    with EspeakVoice("de") as voice:
        yield voice
