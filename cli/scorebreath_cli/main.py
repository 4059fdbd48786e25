"""The entry point: nothing but what has to happen before anything can go wrong."""

from __future__ import annotations

import atexit
import gc
import os
import signal
import sys
from types import FrameType
from typing import NoReturn

COLLECTIONS = (500_000, 20, 100)
"""Thresholds of the garbage collector: a Score of an hour is a million objects and none of them garbage, so looking
through them all again and again only takes time that grows faster than they do."""

HAND_OVER = 0.0005
"""Seconds a thread may keep others waiting for the interpreter: those that serve the engine and the voice wait often,
and their processes with them."""


def main() -> NoReturn:
    """Run the command line.

    Raises:
        SystemExit: Always; 0 done, 1 our bug, 2 bad usage or input, 3 environment, 130 interrupted.
    """
    gc.set_threshold(*COLLECTIONS)
    sys.setswitchinterval(HAND_OVER)
    atexit.register(gc.freeze)  # or the interpreter looks for garbage in all there is, just before it ends
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # nothing here multiplies matrices; a pool takes 0.1 s to start
    try:
        for name in ("SIGTERM", "SIGHUP"):
            if hasattr(signal, name):
                signal.signal(getattr(signal, name), _end)
        from scorebreath_cli import streams

        streams.prepare()
        from scorebreath_cli.app import app

        app(prog_name="scorebreath")
    except KeyboardInterrupt:
        sys.exit(130)
    sys.exit(0)


def _end(number: int, _frame: FrameType | None) -> NoReturn:
    """As an exception, so what is half-written goes and children end."""
    sys.exit(128 + number)


if __name__ == "__main__":
    main()
