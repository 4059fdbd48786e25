"""A performance that goes on and on: what comes late, how far ahead bundles are sent, and what memory it takes.

python -m benchmarks.soak                               ten minutes on the wall clock, the silent engine
python -m benchmarks.soak --engine scsynth --minutes 1  a real one (without a sound card: under jackd -d dummy)

Texts come as a language model streams them, knobs are moved, commands are given, curves go out to two targets. The
report is one JSON object.
"""

from __future__ import annotations

import argparse
import json
import random
import resource
import socket
import sys
import time
from pathlib import Path
from typing import Any

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
EVERY = 0.1
"""s between two looks."""


def resident() -> float:
    """Memory in use now, MB."""
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    return pages * resource.getpagesize() / 1e6


def soak(engine: str, minutes: float, seed: int, lookahead: float) -> dict[str, Any]:
    """Perform for so long."""
    from scorebreath.engine.live.making import sounder_named
    from scorebreath.live.conditions import Timing
    from scorebreath.live.show import Setting, Show
    from scorebreath.live.streams.addresses import open_stream
    from scorebreath.live.streams.sender import Sender

    chance = random.Random(seed)
    leads: list[float] = []
    late: list[float] = []

    def journal(entry: Any) -> None:
        leads.append(entry.lead)
        if entry.late > 0:
            late.append(entry.late)

    troubles: list[str] = []
    text = (EXAMPLES / "radio_chat.txt").read_text("utf-8")
    sink = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sink.bind(("127.0.0.1", 0))
    port = sink.getsockname()[1]
    targets = [open_stream(f"osc://127.0.0.1:{port}"), open_stream(f"livelink://127.0.0.1:{port}")]
    memory: list[float] = []
    with (
        sounder_named(engine, journal=journal, on_trouble=troubles.append, lookahead=lookahead) as sounder,
        Show(Setting(), sounder=sounder, tell=troubles.append, timing=Timing(lookahead=lookahead)) as show,
    ):
        sender = Sender(show.curves, lambda: show.now, show.start_unix, targets, latency=sounder.latency)
        sender.start()
        try:
            end, at, following = 60.0 * minutes, 0, 0.0
            while show.now < end:
                if show.now > following:
                    piece = text[at : at + chance.choice([3, 8, 20])]
                    show.desk.stream(piece)
                    at = (at + len(piece)) % len(text)
                    following = show.now + len(piece) / 16.0 * chance.uniform(0.8, 1.2)
                if chance.random() < EVERY / 5.0:
                    show.desk.set("nose_share", chance.random())
                if chance.random() < EVERY / 20.0:
                    show.desk.command(chance.choice(["sigh", "breathe", "laugh", "hold"]))
                if chance.random() < EVERY / 60.0:
                    show.desk.say("Wait, there is something else.", cut_in=True)
                memory.append(resident())
                time.sleep(EVERY)
            show.desk.command("end")
            show.wait(120.0)
            counts, status, sent = show.counts, sounder.status(), sender.counts
            events = len(show.score().events)
        finally:
            sender.stop()
            sink.close()
    leads.sort()
    tenth = max(1, len(memory) // 10)
    return {
        "engine": status.engine, "minutes": minutes, "groups": counts.groups, "events": events, "cuts": counts.cuts,
        "groups_late": counts.late, "latest_s": round(counts.latest, 3), "unspoken": counts.unspoken,
        "stalls": counts.stalls, "bundles": status.sent, "bundles_late_by_the_engine": status.late,
        "bundles_sent_late": status.late_sent, "sounds_lost": status.lost, "restarts": status.restarts,
        "lead_ms": {
            "min": round(1e3 * leads[0], 1), "p1": round(1e3 * leads[len(leads) // 100], 1),
            "median": round(1e3 * leads[len(leads) // 2], 1),
        },
        "latest_bundle_ms": round(1e3 * max(late, default=0.0), 1),
        "pictures": [[one.sent, one.skipped, one.failed] for one in sent],
        "memory_mb": {"begin": round(memory[tenth], 1), "end": round(memory[-1], 1)},
        "troubles": len(troubles),
    }  # fmt: skip


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--engine", default="silent")
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--lookahead", type=float, default=0.15)
    given = parser.parse_args()
    json.dump(soak(given.engine, given.minutes, given.seed, given.lookahead), sys.stdout, indent=1)
    print()
    return 0


if __name__ == "__main__":
    sys.exit(main())
