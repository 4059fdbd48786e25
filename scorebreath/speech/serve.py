"""The worker's side: answer one message after the other, and never outlive the program that asked.

Speech engines can crash or hang, keep state between calls, and print where they please. So each runs in a process of
its own: what it prints goes to stderr, and a thread reads ahead, so that the end of the program is noticed even while
the engine hangs.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Callable
from queue import SimpleQueue
from threading import Thread
from typing import Any, BinaryIO

from scorebreath.speech.wire import WireError, read_message, write_message

Handler = Callable[[dict[str, Any], bytes], tuple[dict[str, Any], bytes]]
"""From a request's fields and payload to the answer's."""
GARBAGE = 20_000
"""Objects after which the collector looks for it: requests come and go, and hardly leave any."""


def serve(handle: Handler) -> None:
    """Answer requests from stdin on stdout until stdin ends.

    An answer carries its request's `ticket`. An exception in the handler becomes an answer with an `error`; the
    worker goes on.

    Args:
        handle: What answers.
    """
    gc.freeze()  # what has been imported is no garbage
    gc.set_threshold(GARBAGE)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the program; it ends us by closing stdin
    answers = _claim_stdout()
    waiting: SimpleQueue[tuple[dict[str, Any], bytes]] = SimpleQueue()
    Thread(target=_listen, args=(sys.stdin.buffer, waiting), daemon=True).start()
    while True:
        fields, payload = waiting.get()
        try:
            answer, samples = handle(fields, payload)
        except Exception as error:
            answer, samples = {"error": f"{type(error).__name__}: {error}"}, b""
        try:
            write_message(answers, {**answer, "ticket": fields.get("ticket")}, samples)
        except OSError:  # nobody listens any more
            os._exit(0)


def _claim_stdout() -> BinaryIO:
    """Keep the real stdout for answers; whatever else prints there goes to stderr."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return answers


def _listen(requests: BinaryIO, waiting: SimpleQueue[tuple[dict[str, Any], bytes]]) -> None:
    status = 0
    try:
        while (message := read_message(requests)) is not None:
            waiting.put(message)
    except WireError:
        status = 1
    os._exit(status)
