"""The entry point: nothing but what has to happen before anything can go wrong."""

from __future__ import annotations

import gc
import os
import signal
import sys
from types import FrameType
from typing import NoReturn

LAST_STANDARD = 2
"""Descriptors up to this one are children's as well."""

COLLECTIONS = (100_000, 20, 100)
"""Thresholds of the garbage collector: a Score of an hour is a million objects and none of them garbage, so looking
through them all again and again only takes time that grows faster than they do."""


def main() -> NoReturn:
    """Run the command line.

    Raises:
        SystemExit: Always; 0 done, 1 our bug, 2 bad usage or input, 3 environment, 130 interrupted.
    """
    gc.set_threshold(*COLLECTIONS)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # nothing here multiplies matrices; a pool takes 0.1 s to start
    try:
        for name in ("SIGTERM", "SIGHUP"):
            if hasattr(signal, name):
                signal.signal(getattr(signal, name), _end)
        _open_closed()
        from scorebreath_cli.app import app

        app(prog_name="scorebreath")
    except KeyboardInterrupt:
        sys.exit(130)
    sys.exit(0)


def _open_closed() -> None:
    """Streams that were closed when we began (`>&-`) take and give nothing."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            stream = open(os.devnull, mode, encoding="utf-8")  # noqa: PTH123, SIM115 - open until we end
            os.set_inheritable(stream.fileno(), stream.fileno() <= LAST_STANDARD)
            setattr(sys, name, stream)


def _end(number: int, _frame: FrameType | None) -> NoReturn:
    """As an exception, so what is half-written goes and children end."""
    sys.exit(128 + number)


if __name__ == "__main__":
    main()
