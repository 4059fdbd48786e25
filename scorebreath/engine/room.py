"""A temporary folder on a disk that has room."""

from __future__ import annotations

import errno
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from scorebreath.errors import EnvironmentFailure

_FULL = (errno.ENOSPC, errno.EDQUOT)


@contextmanager
def temporary_folder(needed: int) -> Iterator[Path]:
    """A folder that is gone afterwards.

    Args:
        needed: Bytes that will be written there.

    Raises:
        EnvironmentFailure: The disk has no room, now or while it is used.
    """
    try:
        with tempfile.TemporaryDirectory(prefix="scorebreath-", ignore_cleanup_errors=True) as name:
            free = shutil.disk_usage(name).free
            if free < needed:
                raise EnvironmentFailure(
                    f"{tempfile.gettempdir()}: rendering needs {needed / 1e9:.2g} GB for temporary files,"
                    f" {free / 1e9:.2g} GB are free; TMPDIR names another folder"
                )
            yield Path(name)
    except OSError as error:
        if error.errno not in _FULL:
            raise
        raise EnvironmentFailure(f"the disk is full: {error}; TMPDIR names another folder") from None
