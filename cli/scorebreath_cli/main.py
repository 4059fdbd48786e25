"""The entry point: nothing but what has to happen before anything can go wrong."""

from __future__ import annotations

import signal
import sys
from types import FrameType
from typing import NoReturn


def main() -> NoReturn:
    """Run the command line.

    Raises:
        SystemExit: Always; 0 done, 1 our bug, 2 bad usage or input, 3 environment, 130 interrupted.
    """
    try:
        for name in ("SIGTERM", "SIGHUP"):
            if hasattr(signal, name):
                signal.signal(getattr(signal, name), _end)
        from scorebreath_cli.app import app

        app()
    except KeyboardInterrupt:
        sys.exit(130)
    sys.exit(0)


def _end(number: int, _frame: FrameType | None) -> NoReturn:
    """As an exception, so what is half-written goes and children end."""
    sys.exit(128 + number)


if __name__ == "__main__":
    main()
