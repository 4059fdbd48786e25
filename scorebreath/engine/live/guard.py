"""Ends an engine when whoever started it is gone without a word, be it by `kill -9`.

Runs as a file in a process of its own and imports nothing of this package: its input ends when its parent does.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys

DONE = b"done\n"
"""What a parent says that has ended the engine itself."""


def main() -> None:
    """Wait for the end of the input; the one argument is the engine's process."""
    if sys.stdin.buffer.read() != DONE:
        with contextlib.suppress(OSError):
            os.kill(int(sys.argv[1]), getattr(signal, "SIGKILL", signal.SIGTERM))


if __name__ == "__main__":
    main()
