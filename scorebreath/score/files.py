"""Scores on disk: media first, the JSON last, so whoever finds the JSON finds what it names."""

from __future__ import annotations

import dataclasses
import os
from pathlib import Path

from scorebreath.errors import EnvironmentFailure, ScoreError
from scorebreath.media.store import FolderStore, MediaStore
from scorebreath.score.codec import dumps, loads, read_whole
from scorebreath.score.document import Score
from scorebreath.score.take import TAKE_FILE, read_take


def save(score: Score, path: Path, media: MediaStore) -> None:
    """Write `path` (JSON) and the media it names, into `speech/` and `breath/` beside it.

    Raises:
        ScoreError: A sound that the score names is not in `media`.
        EnvironmentFailure: The disk refuses.
    """
    beside = FolderStore(path.parent)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        for name, info in score.media.items():
            if name not in beside:
                held = media.get(name)
                beside.put(held.samples, held.sample_rate, info.kind)
        part = path.with_name(f".{path.name}.{os.getpid()}.part")
        part.write_bytes(dumps(score))
        part.replace(path)
    except OSError as error:
        raise EnvironmentFailure(f"{path}: cannot be written: {error.strerror}") from None


def load(path: Path) -> tuple[Score, MediaStore]:
    """A Score, from its JSON file or from a take's folder, and the store of its media.

    Raises:
        ScoreError: It is missing, broken, newer, or hostile.
    """
    if path.is_dir() or path.name == TAKE_FILE:
        folder = path if path.is_dir() else path.parent
        return read_take(folder), FolderStore(folder)
    return loads(read_whole(path), str(path)), FolderStore(path.parent)


def check_media(score: Score, media: MediaStore) -> None:
    """Every sound the score names is there and as long as it says.

    Raises:
        ScoreError: Names the first that is not.
    """
    for name, info in score.media.items():
        if name not in media:
            raise ScoreError(f"media {info.path} are missing")
        if media.frames(name) != info.frames:
            raise ScoreError(f"media {info.path} have {media.frames(name)} frames; the score says {info.frames}")


def with_media_paths(score: Score) -> Score:
    """The same score with the media paths that `save` writes."""
    return dataclasses.replace(
        score,
        media={n: dataclasses.replace(i, path=FolderStore.path(n, i.kind)) for n, i in score.media.items()},
    )
