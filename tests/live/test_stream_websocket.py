"""Pictures over WebSocket, with clients that are not ours."""

from __future__ import annotations

import importlib.util
import json
import socket
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Origin

from scorebreath.errors import EnvironmentFailure, InputError, MissingExtraError
from scorebreath.live.streams.addresses import open_stream
from scorebreath.live.streams.datagrams import found
from scorebreath.live.streams.lines import line
from scorebreath.live.streams.origins import may
from scorebreath.live.streams.websocket import LARGEST_HEARD, PictureServer, WebSocketTarget
from tests.live.pictures import picture

PAGE = {"/": ("text/html; charset=utf-8", b"<p>moving</p>"), "/figure.js": ("text/javascript", b"1")}


@contextmanager
def serving(**options: object) -> Iterator[PictureServer]:
    server = PictureServer(port=0, **options)  # type: ignore[arg-type]
    try:
        yield server
    finally:
        server.close()


def client(server: PictureServer, path: str = "/", **options: Any) -> ClientConnection:
    found: ClientConnection = connect(f"ws://127.0.0.1:{server.port}{path}", open_timeout=20, **options)
    return found


def until(what: Callable[[], bool]) -> None:
    """Wait until something is so; half a minute at most."""
    for _ in range(3000):
        if what():
            return
        time.sleep(0.01)
    pytest.fail("it did not come about")


def test_every_client_gets_every_picture_of_the_bodies_it_wants() -> None:
    with serving() as server, client(server) as every, client(server, "/pictures?body=body2") as second:
        target = WebSocketTarget("ws", server, rig="arkit")
        until(lambda: server.clients == 2)
        for number in range(5):
            target.send(picture(number / 60))
            target.send(picture(number / 60, body="body2"))
        got = [every.recv(20) for _ in range(10)]
        assert [(json.loads(each)["number"], json.loads(each)["body"]) for each in got] == [
            (number, body) for number in range(5) for body in ("body", "body2")
        ]
        assert got[0] == line(picture(0.0), "arkit").decode().rstrip("\n")
        assert [json.loads(second.recv(20))["body"] for _ in range(5)] == ["body2"] * 5


def test_fixed_pages_stand_beside_the_pictures() -> None:
    with serving(routes=PAGE) as server, client(server) as listening:
        for path, (media, content) in PAGE.items():
            with urllib.request.urlopen(f"http://127.0.0.1:{server.port}{path}", timeout=20) as answer:
                assert (answer.read(), answer.headers["content-type"].split(";")[0]) == (content, media.split(";")[0])
        with pytest.raises(urllib.error.HTTPError, match="404"):
            urllib.request.urlopen(f"http://127.0.0.1:{server.port}/secret", timeout=20)
        until(lambda: server.clients == 1)
        server.publish("body", "a")
        assert listening.recv(20) == "a"


def test_a_slow_client_loses_pictures_and_the_others_none() -> None:
    with serving(waiting=4) as server, ExitStack() as clients:
        slow = clients.enter_context(client(server, max_queue=1, compression=None))
        quick = clients.enter_context(client(server, max_queue=None))
        until(lambda: server.clients == 2)
        for number in range(300):
            server.publish("body", f"{number} " + "x" * 50_000)
            assert quick.recv(20).partition(" ")[0] == str(number)  # type: ignore[arg-type]
        found = [int(str(slow.recv(20)).partition(" ")[0])]
        while found[-1] != 299:
            found.append(int(str(slow.recv(20)).partition(" ")[0]))
        assert found == sorted(set(found)) and len(found) < 300


def test_what_clients_say_is_thrown_away_and_too_much_ends_them() -> None:
    with serving() as server, client(server) as talker, client(server) as shouter:
        until(lambda: server.clients == 2)
        for _ in range(200):
            talker.send("hello")
            talker.send(b"\x00\xff")
        shouter.send("x" * (LARGEST_HEARD + 1))
        with pytest.raises(ConnectionClosed):
            shouter.recv(20)
        until(lambda: server.clients == 1)
        server.publish("body", "on we go")
        assert talker.recv(20) == "on we go"


def test_clients_have_a_bound_and_leave_room_when_they_go() -> None:
    with serving(most=2) as server:
        with client(server), client(server):
            until(lambda: server.clients == 2)
            with pytest.raises((InvalidStatus, ConnectionClosed)), client(server) as third:
                third.recv(20)
        until(lambda: server.clients == 0)
        with client(server) as again:
            until(lambda: server.clients == 1)
            server.publish("body", "welcome")
            assert again.recv(20) == "welcome"


@pytest.mark.parametrize(
    ("origin", "allowed", "reads"),
    [
        ("http://localhost:3000", (), True),
        ("http://127.0.0.1:8000", (), True),
        ("https://example.org", (), False),
        ("null", (), False),
        ("https://example.org", ("https://example.org",), True),
        ("https://evil.example.org", ("https://example.org",), False),
        ("https://example.org", ("*",), True),
    ],
)
def test_pages_of_other_hosts_read_only_if_they_may(origin: str, allowed: tuple[str, ...], reads: bool) -> None:
    with serving(origins=allowed) as server:
        try:
            with client(server, origin=origin) as reader:
                until(lambda: server.clients == 1)
                server.publish("body", "a")
                got = reader.recv(20) == "a"
        except (InvalidStatus, ConnectionClosed):
            got = False
        assert got is reads


@given(name=st.from_regex(r"[a-z]{1,10}\.(com|org|local)", fullmatch=True), port=st.integers(1, 65535))
def test_a_name_that_points_here_is_not_believed(name: str, port: int) -> None:
    assert not may(f"http://{name}:{port}", f"{name}:{port}")
    assert may(f"http://{name}:{port}", f"{name}:{port}", own=name)


@given(origin=st.text(max_size=30), host=st.none() | st.text(max_size=30))
def test_no_header_breaks_the_check(origin: str, host: str | None) -> None:
    assert may(origin, host) in (True, False)
    assert may(None, host)


def test_a_server_that_ended_is_an_error_of_its_target() -> None:
    with serving() as server:
        pass
    with pytest.raises(OSError, match="ended"):
        server.publish("body", "a")


def test_closing_ends_the_clients() -> None:
    with serving() as server, client(server) as listening:
        until(lambda: server.clients == 1)
        server.close()
        with pytest.raises(ConnectionClosed):
            listening.recv(20)


def test_a_port_that_is_taken_is_said() -> None:
    with serving() as server, pytest.raises(EnvironmentFailure, match=f"port {server.port} at 127"):
        open_stream(f"ws://127.0.0.1:{server.port}")
    with pytest.raises(InputError, match="cannot be found"):
        PictureServer("no such host", 0)


def test_an_address_opens_a_server_for_this_machine_alone() -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    stream = open_stream(f"ws://127.0.0.1:{port}?rig=oculus&origins=https://a.example")
    try:
        with connect(f"ws://127.0.0.1:{port}", origin=Origin("https://a.example"), open_timeout=20) as listening:
            for _ in range(1000):
                stream.target.send(picture())
                try:
                    got = listening.recv(0.05)
                    break
                except TimeoutError:
                    continue
            assert json.loads(got)["rig"]["aa"] == pytest.approx(picture().rig("oculus")["aa"], abs=1e-6)
    finally:
        stream.target.close()


def test_the_extra_is_named_where_it_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    real = importlib.util.find_spec
    monkeypatch.setattr(
        "scorebreath.live.streams.websocket.find_spec", lambda name: None if name == "uvicorn" else real(name)
    )
    with pytest.raises(MissingExtraError, match=r"scorebreath\[live\]"):
        PictureServer(port=0)


@given(rubbish=st.binary(min_size=1, max_size=300), upgraded=st.booleans())
@settings(max_examples=20, deadline=None)
def test_rubbish_costs_its_own_connection(open_server: PictureServer, rubbish: bytes, upgraded: bool) -> None:
    with socket.create_connection(("127.0.0.1", open_server.port), timeout=20) as vandal:
        if upgraded:
            vandal.sendall(
                b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"
            )
            assert vandal.recv(4096).startswith(b"HTTP/1.1 101")
        vandal.sendall(rubbish)
    until(lambda: open_server.clients == 0)


def test_after_rubbish_all_is_well_and_nothing_was_said(
    open_server: PictureServer, capfd: pytest.CaptureFixture[str]
) -> None:
    test_rubbish_costs_its_own_connection(open_server)
    with client(open_server) as listening:
        until(lambda: open_server.clients == 1)
        open_server.publish("body", "all is well")
        assert listening.recv(20) == "all is well"
    assert capfd.readouterr() == ("", "")


@pytest.fixture(scope="module")
def open_server() -> Iterator[PictureServer]:
    with serving() as server:
        yield server


def test_a_host_with_several_addresses_is_met_at_the_usual_one(monkeypatch: pytest.MonkeyPatch) -> None:
    six = (socket.AF_INET6, socket.SOCK_DGRAM, 17, "", ("::1", 9, 0, 0))
    four = (socket.AF_INET, socket.SOCK_DGRAM, 17, "", ("127.0.0.1", 9))
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_, **__: [six, four])
    assert found("localhost", 9, socket.SOCK_DGRAM) == four
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_, **__: [six])
    assert found("localhost", 9, socket.SOCK_DGRAM) == six
