"""Targets as they are written: defaults, options, and what is refused."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import EnvironmentFailure, InputError
from scorebreath.live.picture import EVERYBODY
from scorebreath.live.streams.addresses import COMMON_OPTIONS, SCHEMES, open_stream, parse

NETWORK = sorted(name for name, row in SCHEMES.items() if row.host)


@pytest.mark.parametrize("name", NETWORK)
def test_what_is_left_out_is_filled_in(name: str) -> None:
    row = SCHEMES[name]
    for text in (name, f"{name}:", f"{name}://", f"{name}://127.0.0.1", f"{name}://127.0.0.1:{row.port}/"):
        found = parse(text)
        assert (found.scheme, found.host, found.port, found.path) == (name, "127.0.0.1", row.port, "")
        assert found.name == f"{name}://127.0.0.1:{row.port}"
        assert dict(found.options) == {each: default for each, (default, _) in row.options.items()}
        assert (found.body, found.rate) == (row.body, None)


@pytest.mark.parametrize("name", NETWORK)
@pytest.mark.parametrize("host", ["10.0.0.7", "::1", "fe80::2", "stage.example"])
def test_hosts_and_ports_are_read(name: str, host: str) -> None:
    written = f"[{host}]" if ":" in host else host
    found = parse(f"{name}://{written}:7000?body=body2&rate=29.97")
    assert (found.host, found.port, found.body, found.rate) == (host, 7000, "body2", 29.97)
    assert found.name == f"{name}://{written}:7000"
    assert parse(f"{name}://{written}").port == SCHEMES[name].port


@pytest.mark.parametrize(
    ("text", "path", "rig"),
    [
        ("-", "-", ""), ("jsonl:-", "-", ""), ("-?rig=arkit", "-", "arkit"),
        ("jsonl:a b/c#1.jsonl", "a b/c#1.jsonl", ""), ("jsonl:/srv/x.jsonl?rig=fap", "/srv/x.jsonl", "fap"),
        ("jsonl:C:\\x.jsonl", "C:\\x.jsonl", ""),
    ],
)  # fmt: skip
def test_files_and_stdout_are_read(text: str, path: str, rig: str) -> None:
    found = parse(text)
    assert (found.scheme, found.path, found.options["rig"], found.host) == ("jsonl", path, rig, "")
    assert found.body == EVERYBODY


@pytest.mark.parametrize("name", sorted(SCHEMES))
def test_every_option_can_be_given(name: str) -> None:
    row = SCHEMES[name]
    begin = f"{name}://h" if row.host else f"{name}:f"
    for option in row.options:
        assert parse(f"{begin}?{option}=a%2Cb").options[option] == "a,b"
    assert not set(row.options) & set(COMMON_OPTIONS)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("vmx://127.0.0.1", "no kind of target is called 'vmx'; did you mean vmc"),
        ("", "expected osc://HOST:9000"),
        ("127.0.0.1:9000", "no kind of target is called '127.0.0.1'"),
        ("vmc://h:0", "expected vmc://HOST:39539"),
        ("vmc://h:99999", "expected vmc://HOST:39539"),
        ("vmc://h:x", "expected vmc://HOST:39539"),
        ("vmc://[::1", "expected vmc://HOST:39539"),
        ("vmc://h/path", "expected vmc://HOST:39539"),
        ("vmc://me@h", "expected vmc://HOST:39539"),
        ("vmc:h:39539", "expected vmc://HOST:39539"),
        ("vmc://h?nmes=vrm1", "vmc has no option 'nmes'; did you mean names"),
        ("osc://h?names=vrm1", "osc has no option 'names'"),
        ("vmc://h?names", "expected NAME=VALUE"),
        ("vmc://h?rate=30&rate=60", "rate is there twice"),
        ("vmc://h?rate=fast", r"rate='fast' must be a number in \[0.01, 1000\]"),
        ("vmc://h?rate=nan", "rate='nan' must be"),
        ("jsonl:", "expected jsonl:FILE"),
        ("osc://" + "h" * 3000, "at most 2000"),
        ("osc://a\nb", "plain characters"),
    ],
)
def test_wrong_ones_are_refused_and_say_what_would_be_right(text: str, expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        parse(text)


@given(
    text=st.text(max_size=60) | st.from_regex(r"(osc|vmc|ws|livelink|jsonl|-):?/?/?.{0,30}(\?.{0,20})?", fullmatch=True)
)
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        found = parse(text)
    except InputError as error:
        assert str(error)
    else:
        assert found.scheme in SCHEMES and (0 < found.port < 65536 or found.path)


def test_reading_an_address_loads_no_server(root: Path) -> None:
    code = (
        "import sys; from scorebreath.live.streams.addresses import parse; parse('ws'); "
        "print(*{'starlette', 'uvicorn', 'websockets', 'supriya', 'mido'} & set(sys.modules))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=root)
    assert (run.returncode, run.stdout.strip()) == (0, ""), run.stderr


def test_a_file_that_is_there_is_not_written_over(tmp_path: Path) -> None:
    path = tmp_path / "film.jsonl"
    path.write_text("mine")
    with pytest.raises(InputError, match="is there already"):
        open_stream(f"jsonl:{path}")
    assert path.read_text() == "mine"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no FIFOs here")
def test_a_fifo_that_nobody_reads_is_refused_and_not_waited_for(tmp_path: Path) -> None:
    path = tmp_path / "fifo"
    os.mkfifo(path)
    with pytest.raises(EnvironmentFailure, match="nobody reads"):
        open_stream(f"jsonl:{path}")
    reading = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    stream = open_stream(f"jsonl:{path}")
    stream.target.close()
    os.close(reading)
