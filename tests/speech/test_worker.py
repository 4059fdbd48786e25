"""A worker that dies, hangs, says no, or outlives its program: none of it reaches the user as more than one error."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from scorebreath.errors import VoiceError
from scorebreath.speech.process import module_command
from scorebreath.speech.worker import Worker

WORKER = """
import os, signal, sys, time
from pathlib import Path
from scorebreath.speech.serve import serve

marks = Path(sys.argv[1])

def handle(fields, payload):
    wish = fields["wish"]
    if wish == "print":
        print("noise on stdout", flush=True)
        os.system("echo more noise")
    if wish == "fail":
        raise ValueError("no such thing")
    if wish.startswith("die"):
        with marks.open("a") as file:
            file.write("x")
        if len(marks.read_text()) <= int(wish[3:]):
            print("about to die", file=sys.stderr, flush=True)
            os.kill(os.getpid(), signal.SIGSEGV)
    if wish == "hang":
        time.sleep(1000)
    return {"did": wish}, payload * 2

def main():
    serve(handle)
"""


@pytest.fixture
def worker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Worker]:
    (tmp_path / "wishful_worker.py").write_text(WORKER, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    made = Worker(module_command("wishful_worker", str(tmp_path / "marks")), "wishful")
    yield made
    made.close()


def ask(worker: Worker, wish: str, payload: bytes = b"", deadline: float = 30.0) -> tuple[object, bytes]:
    answer = worker.receive(worker.send({"wish": wish}, payload, deadline=deadline))
    return answer.fields["did"], answer.payload


def gone(pid: int, patience: float = 10.0) -> bool:
    """Whether a process has ended, or does so soon; one that nobody has waited for yet counts as ended."""
    until = time.monotonic() + patience
    while time.monotonic() < until:
        try:
            if Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z":
                return True
        except FileNotFoundError:
            return True
        time.sleep(0.01)
    return False


def test_answers_carry_fields_and_payload(worker: Worker) -> None:
    assert worker.pid is None, "it starts when first needed"
    assert ask(worker, "echo", b"ab") == ("echo", b"abab")


def test_answers_may_be_collected_in_any_order(worker: Worker) -> None:
    tickets = [worker.send({"wish": wish}, deadline=30) for wish in ("a", "b", "c", "d")]
    worker.forget(tickets[2])
    assert [worker.receive(tickets[index]).fields["did"] for index in (3, 0, 1)] == ["d", "a", "b"]


def test_more_than_a_pipe_holds_does_not_block(worker: Worker) -> None:
    tickets = [worker.send({"wish": "echo"}, bytes(1_000_000), deadline=30) for _ in range(4)]
    assert [len(worker.receive(ticket).payload) for ticket in tickets] == [2_000_000] * 4


def test_what_an_engine_prints_does_not_harm(worker: Worker) -> None:
    assert ask(worker, "print") == ("print", b"")
    assert ask(worker, "echo") == ("echo", b"")


def test_an_exception_is_an_error_and_the_worker_goes_on(worker: Worker) -> None:
    ask(worker, "echo")
    pid = worker.pid
    with pytest.raises(VoiceError, match="wishful: ValueError: no such thing"):
        ask(worker, "fail")
    assert ask(worker, "echo") == ("echo", b"")
    assert worker.pid == pid


def test_one_crash_is_not_noticed(worker: Worker, tmp_path: Path) -> None:
    assert ask(worker, "die1") == ("die1", b"")
    assert (tmp_path / "marks").read_text() == "xx"


def test_two_crashes_are_an_error_with_the_last_words(worker: Worker) -> None:
    with pytest.raises(VoiceError, match=r"wishful, 2 times: its worker crashed \(exit status -11\): about to die"):
        ask(worker, "die9")
    assert ask(worker, "echo") == ("echo", b""), "the next request finds a new worker"


def test_only_the_request_that_kills_fails(worker: Worker) -> None:
    tickets = [worker.send({"wish": wish}, deadline=30) for wish in ("a", "die9", "b")]
    assert worker.receive(tickets[2]).fields["did"] == "b"
    assert worker.receive(tickets[0]).fields["did"] == "a"
    with pytest.raises(VoiceError):
        worker.receive(tickets[1])


def test_a_killed_worker_is_replaced_in_mid_work(worker: Worker) -> None:
    ask(worker, "echo")
    ticket = worker.send({"wish": "a"}, bytes(500_000), deadline=30)
    assert worker.pid is not None
    os.kill(worker.pid, signal.SIGKILL)
    assert len(worker.receive(ticket).payload) == 1_000_000


def test_a_hanging_worker_misses_its_deadline(worker: Worker) -> None:
    ask(worker, "echo")
    first = worker.pid
    assert first is not None
    with pytest.raises(VoiceError, match=r"wishful, 2 times: no answer within 0\.3 s"):
        ask(worker, "hang", deadline=0.3)
    assert gone(first)
    assert ask(worker, "echo") == ("echo", b"")


def test_a_worker_that_does_not_even_listen_misses_its_deadline(worker: Worker) -> None:
    ask(worker, "echo")
    assert worker.pid is not None
    os.kill(worker.pid, signal.SIGSTOP)
    assert ask(worker, "echo", bytes(1_000_000), deadline=3) == ("echo", bytes(2_000_000))


def test_nothing_is_left_after_close(worker: Worker) -> None:
    ask(worker, "echo")
    open_ticket = worker.send({"wish": "hang"}, deadline=30)
    pid = worker.pid
    assert pid is not None
    worker.close()
    assert gone(pid, patience=0.1)
    for use in (lambda: worker.receive(open_ticket), lambda: worker.send({"wish": "a"}, deadline=1)):
        with pytest.raises(VoiceError, match="wishful was closed"):
            use()
    worker.close()


@pytest.mark.parametrize("wish", ["echo", "hang"])
def test_the_worker_ends_with_its_program_however_that_ends(wish: str, tmp_path: Path) -> None:
    (tmp_path / "wishful_worker.py").write_text(WORKER, encoding="utf-8")
    program = f"""
import os, sys, time
sys.path[:0] = [{str(tmp_path)!r}]
from scorebreath.speech.process import module_command
from scorebreath.speech.worker import Worker
worker = Worker(module_command("wishful_worker", "unused"), "wishful")
worker.receive(worker.send({{"wish": "echo"}}, deadline=30))
worker.send({{"wish": {wish!r}}}, deadline=30)
print(worker.pid, flush=True)
os.kill(os.getpid(), 9)
"""
    where = {**os.environ, "PYTHONPATH": os.pathsep.join(entry for entry in sys.path if entry)}
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, env=where)
    assert run.returncode == -9, run.stderr
    assert gone(int(run.stdout))


def test_a_command_that_cannot_start_is_an_error() -> None:
    with pytest.raises(VoiceError, match="does not start"):
        Worker(("/nonexistent/program",), "lost").start()


def test_a_command_that_ends_at_once_is_an_error_with_its_words() -> None:
    lost = Worker((sys.executable, "-c", "raise SystemExit('cannot find my library')"), "lost")
    with pytest.raises(VoiceError, match=r"exit status 1.*cannot find my library"):
        lost.receive(lost.send({}, deadline=30))
    lost.close()
