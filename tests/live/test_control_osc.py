"""The OSC server, over real sockets: it answers, tells who listens, keeps time tags, and nothing sent breaks it."""

from __future__ import annotations

import socket
import struct
import threading
import time
from collections.abc import Callable, Iterator

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pythonosc.osc_bundle_builder import OscBundleBuilder
from pythonosc.osc_message_builder import OscMessageBuilder

from scorebreath.errors import EnvironmentFailure
from scorebreath.live.controls.limits import Bucket, Leave, Listeners
from scorebreath.live.controls.osc_server import FARTHEST, FLOOD, MOST_WAITING, OscServer
from scorebreath.live.controls.packets import Argument, Message, read_packet, write_message
from scorebreath.parameters.table import Parameters
from tests.live.desks import BrokenDesk, Clock, ToyDesk
from tests.live.test_control_packets import damaged

SINCE_1900 = 2_208_988_800
HERE = ("127.0.0.1", 40000)


class Client:
    """A program that sends OSC and hears the answers."""

    def __init__(self, server: OscServer) -> None:
        self.to = ("127.0.0.1", server.port)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(10.0)
        self.port = int(self.socket.getsockname()[1])

    def send(self, address: str, *arguments: Argument) -> None:
        self.socket.sendto(write_message(address, *arguments), self.to)

    def hear(self) -> tuple[Message, ...]:
        return read_packet(self.socket.recv(65536))

    def hear_until(self, address: str) -> list[Message]:
        """Everything up to the first message with this address."""
        heard: list[Message] = []
        while not any(message.address == address for message in heard):
            heard += self.hear()
        return heard

    def settled(self) -> list[Message]:
        """Everything answered to what was sent before."""
        self.send("/scorebreath/ping")
        return self.hear_until("/scorebreath/pong")[:-1]


@pytest.fixture
def desk() -> ToyDesk:
    return ToyDesk()


@pytest.fixture
def server(desk: ToyDesk) -> Iterator[OscServer]:
    with OscServer(desk, port=0) as running:
        yield running


@pytest.fixture
def client(server: OscServer) -> Iterator[Client]:
    made = Client(server)
    yield made
    made.socket.close()


def wait(until: Callable[[], bool]) -> None:
    end = time.monotonic() + 20.0
    while not until():
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.002)


def test_the_last_of_a_flood_counts() -> None:
    """A fader that is thrown: where it comes to rest is not lost."""
    desk = ToyDesk()
    with OscServer(desk, port=0) as server, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        probe = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, FLOOD)
        small = probe.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) < 2_000_000  # the system gives no more
        probe.close()
        for step in range(1, 1001):
            time.sleep(0.001 if small else 0.0)
            sender.sendto(write_message("/scorebreath/nose_share", step / 1000), ("127.0.0.1", server.port))
        limit = time.monotonic() + 20.0
        while desk.values()["nose_share"] != 1.0:
            assert time.monotonic() < limit, server.report()
            time.sleep(0.01)
        assert server.report().applied == 1000


def test_values_are_set_and_asked(client: Client, desk: ToyDesk) -> None:
    client.send("/scorebreath/nose_share", 0.8, 0.5)
    client.send("/scorebreath/nose_share")
    (answer,) = client.hear()
    assert answer.address == "/scorebreath/nose_share"
    assert answer.arguments[0] == pytest.approx(0.8)
    assert desk.calls == [("set", "nose_share", 0.8, "", 0.5)]
    client.send("/scorebreath/values")
    heard = [client.hear() for _ in range(2)]
    while len({m.address for part in heard for m in part}) < desk.told():
        heard.append(client.hear())


def test_errors_come_back_and_a_flood_of_them_does_not(client: Client, server: OscServer, desk: ToyDesk) -> None:
    client.send("/scorebreath/nose_share", 2.0)
    (answer,) = client.hear()
    assert (answer.address, answer.arguments) == ("/scorebreath/error", ("nose_share=2.0 must be a number in [0, 1]",))
    client.send("/scorebreath/nose_shar", 0.5)
    assert "did you mean nose_share" in str(client.hear()[0].arguments[0])
    answers: list[Message] = []
    for number in range(300):
        client.send("/scorebreath/nose_share", -1.0)
        client.socket.sendto(b"rubbish", client.to)
        if number % 20 == 19:  # no more at once than the system keeps
            answers += client.settled()
    assert all(message.address == "/scorebreath/error" for message in answers)
    assert 1 <= len(answers) < 60
    report = server.report()
    assert report.unanswered > 400
    assert (report.dropped, report.refused) == (300, 302)
    assert desk.calls == []


def test_errors_and_pongs_of_others_are_not_answered(server: OscServer) -> None:
    for address in ("/scorebreath/error", "/scorebreath/pong"):
        assert server.receive(write_message(address, "x"), HERE) == []


def test_two_servers_do_not_talk_to_each_other_for_ever(server: OscServer) -> None:
    with OscServer(ToyDesk(), port=0) as other:
        asked = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        asked.sendto(write_message("/scorebreath/listen", other.port), ("127.0.0.1", server.port))
        asked.close()
        wait(lambda: other.report().received > 0)
        wait(lambda: other.report().refused + other.report().applied >= ToyDesk().told())
        before = server.report().received
        client = Client(other)
        assert client.settled() == []
        client.socket.close()
        assert server.report().received - before < 20


def test_who_listens_is_told(client: Client, server: OscServer, desk: ToyDesk) -> None:
    client.send("/scorebreath/listen")
    first: set[str] = set()
    while len(first) < desk.told():
        first |= {message.address for message in client.hear()}
    desk.set("nose_share", 0.25)
    assert client.hear() == (Message(address="/scorebreath/nose_share", arguments=(0.25,)),)
    desk.set("capacity_lung", 50.0)
    desk.set("style", "spontaneous")
    told = client.hear_until("/scorebreath/style")
    assert ("/scorebreath/capacity_lung", (50.0,)) in [(m.address, m.arguments) for m in told]
    client.send("/scorebreath/unlisten")
    assert client.settled() == []
    desk.set("nose_share", 0.5)
    assert client.settled() == []
    assert server.report().listening == 0


def test_another_port_of_the_same_host_listens(client: Client, server: OscServer, desk: ToyDesk) -> None:
    other = Client(server)
    client.send("/scorebreath/listen", other.port)
    while not any(message.address == "/scorebreath/face_emotion" for message in other.hear()):
        pass
    assert client.settled() == []
    desk.set("nose_share", 0.75)
    assert other.hear_until("/scorebreath/nose_share")[-1].arguments == (0.75,)
    assert client.settled() == []
    other.socket.close()


def test_of_many_changes_the_last_is_told(client: Client, desk: ToyDesk) -> None:
    client.send("/scorebreath/listen")
    client.settled()
    for step in range(1, 1001):
        desk.set("nose_share", step / 1000)
    told = [message.arguments[0] for message in client.hear()]
    while told[-1] != 1.0:
        told += [message.arguments[0] for message in client.hear()]
    assert len(told) < 500


def test_several_bodies_are_told_apart() -> None:
    desk = ToyDesk("ann", "bob")
    with OscServer(desk, port=0) as server:
        client = Client(server)
        client.send("/scorebreath/listen")
        client.settled()
        desk.set("nose_share", 0.25, body="bob")
        assert [m.address for m in client.hear()] == ["/scorebreath/bob/nose_share"]
        desk.set("nose_share", 0.5, body="ann")
        assert [m.address for m in client.hear()] == ["/scorebreath/nose_share", "/scorebreath/ann/nose_share"]
        client.send("/scorebreath/bob/sigh")
        client.settled()
        assert desk.calls[-1] == ("command", "sigh", "bob")
        client.socket.close()


def test_time_tags() -> None:
    desk, wall = ToyDesk(), Clock(1_000_000.0)
    server = OscServer(desk, wall=wall)

    def at(when: float, *values: float) -> bytes:
        bundle = OscBundleBuilder(when)  # type: ignore[arg-type]  # says int, means s
        for value in values:
            message = OscMessageBuilder("/scorebreath/nose_share")
            message.add_arg(value, "d")
            bundle.add_content(message.build())
        return bundle.build().dgram

    assert server.receive(at(wall.now + 2.0, 0.3, 0.4), HERE) == []
    assert server.receive(at(wall.now + 1.0, 0.2), HERE) == []
    assert server.receive(at(wall.now - 5.0, 0.1), HERE) == []
    assert server.due() == []
    assert desk.moves() == [("nose_share", 0.1)]
    assert server.report().waiting == 3
    (refused,) = server.receive(at(wall.now + FARTHEST + 1.0, 0.9), HERE)
    assert "due in 61 s" in str(read_packet(refused.packets[0])[0].arguments[0])
    for step, there in ((1.0, [0.1, 0.2]), (1.0, [0.1, 0.2, 0.3, 0.4]), (100.0, [0.1, 0.2, 0.3, 0.4])):
        wall.now += step
        server.due()
        assert [value for _, value in desk.moves()] == there
    for _ in range(MOST_WAITING // 100 + 1):
        server.receive(at(wall.now + 1.0, *[0.5] * 100), HERE)
    assert server.report().waiting == MOST_WAITING


def test_a_bundle_is_done_when_it_is_due(client: Client, server: OscServer, desk: ToyDesk) -> None:
    bundle = OscBundleBuilder(time.time() + 0.05)  # type: ignore[arg-type]
    bundle.add_content(OscMessageBuilder("/scorebreath/sigh").build())
    client.socket.sendto(bundle.build().dgram, client.to)
    wait(lambda: desk.calls == [("command", "sigh", "")])
    assert server.report().waiting == 0


def test_every_second_packet_lost_loses_its_moves_only(desk: ToyDesk) -> None:
    """Values are absolute: what arrives says all that there is, and a query never lies about it."""
    server = OscServer(desk)
    names = [name for name in Parameters.model_fields if name not in ("style", "sex")][:12]
    packets = []
    for step in range(400):
        name = names[step * 7 % len(names)]
        field = Parameters.model_fields[name]
        low, high = field.metadata[0].ge, field.metadata[1].le
        value = round(low + (high - low) * ((step * 37) % 101) / 100, 5)
        packets.append((name, value, write_message(f"/scorebreath/{name}", value)))
    kept = packets[::2]
    for _, _, packet in kept:
        assert server.receive(packet, HERE) == []
    assert [name for name, _ in desk.moves()] == [name for name, _, _ in kept]
    assert [value for _, value in desk.moves()] == pytest.approx([value for _, value, _ in kept], rel=1e-6)
    last = {name: value for name, value, _ in kept}
    for name, value in last.items():
        (answer,) = server.receive(write_message(f"/scorebreath/{name}"), HERE)
        assert read_packet(answer.packets[0])[0].arguments[0] == pytest.approx(value, rel=1e-6)
    assert server.report().applied == len(kept) + len(last)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=100)
@given(packets=st.lists(st.one_of(st.binary(max_size=400), damaged()), max_size=8))
def test_fuzzed_packets_through_a_real_socket(
    packets: list[bytes], client: Client, server: OscServer, desk: ToyDesk
) -> None:
    for packet in packets:
        client.socket.sendto(packet, client.to)
    client.settled()
    assert server.report().failed == 0
    for name, value in desk.values().items():
        assert getattr(Parameters(**{name: value}), name) == value  # whatever got through, all values are in range


@given(st.one_of(st.binary(max_size=400), damaged()))
def test_fuzzed_packets_straight_in(packet: bytes) -> None:
    server = OscServer(ToyDesk("body", "body2"))
    for answer in server.receive(packet, HERE):
        assert answer.to[0] == HERE[0]
        assert all(read_packet(data) for data in answer.packets)
    assert server.report().failed == 0


def test_the_largest_packets(client: Client, server: OscServer) -> None:
    for packet in (b"/" + b"x" * 65_000, b"#bundle\0" + bytes(65_000), write_message("/scorebreath/say", "a" * 65_000)):
        client.socket.sendto(packet, client.to)
        client.settled()
    assert (server.report().dropped, server.report().applied) == (2, 4)


def test_a_desk_with_a_bug_is_survived() -> None:
    with OscServer(BrokenDesk(), port=0) as server:
        client = Client(server)
        client.send("/scorebreath/nose_share", 0.5)
        assert "ZeroDivisionError: a bug" in str(client.hear()[0].arguments[0])
        assert client.settled() == []
        assert server.report().failed == 1
        client.socket.close()


def test_it_ends_and_begins_again(desk: ToyDesk) -> None:
    server = OscServer(desk, port=0)
    for _ in range(3):
        server.start()
        server.start()
        assert desk.heard_by == 1
        with pytest.raises(EnvironmentFailure, match=str(server.port)):
            OscServer(ToyDesk(), port=server.port).start()
        client = Client(server)
        client.settled()
        client.socket.close()
        port = server.port
        server.stop()
        server.stop()
        assert desk.heard_by == 0
        assert not [thread for thread in threading.enumerate() if thread.name == "osc" and thread.is_alive()]
        again = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        again.bind(("127.0.0.1", port))  # it has let go of it
        again.close()


@pytest.mark.parametrize(("host", "port"), [("192.0.2.1", 57130), ("no host at all", 1), ("127.0.0.1", 70000)])
def test_an_address_that_is_none(host: str, port: int) -> None:
    with pytest.raises(EnvironmentFailure, match="OSC"):
        OscServer(ToyDesk(), host=host, port=port).start()


def test_leave_is_bounded_for_each_and_for_all() -> None:
    bucket = Bucket(rate=2.0, burst=3.0)
    assert [bucket.take(0.0) for _ in range(4)] == [True, True, True, False]
    assert [bucket.take(1.0) for _ in range(3)] == [True, True, False]
    leave = Leave(1.0, 2.0, 3.0)
    assert sum(leave.take((f"10.0.{n // 250}.{n % 250}", 5), 0.0) for n in range(5000)) == 6
    assert leave.take(("10.9.9.9", 5), 1.0)


def test_listeners_are_bounded_and_forgotten() -> None:
    listeners = Listeners()
    assert [listeners.add(("127.0.0.1", port), 0.0) for port in range(40)] == [True] * 32 + [False] * 8
    assert listeners.add(("127.0.0.1", 3), 30.0)
    assert (listeners.count(59.0), listeners.count(61.0)) == (32, 1)
    assert listeners.there(61.0) == (("127.0.0.1", 3),)
    assert listeners.there(91.0) == ()


def test_floats_of_32_bits_reach_the_ends_of_every_range(desk: ToyDesk) -> None:
    server = OscServer(desk)
    for name, field in Parameters.model_fields.items():
        for end in (getattr(constraint, key, None) for constraint in field.metadata for key in ("ge", "le")):
            if end is not None:
                packet = write_message(f"/scorebreath/{name}", struct.unpack("f", struct.pack("f", end))[0])
                assert server.receive(packet, HERE) == [], (name, end)
                assert desk.value(name) == end
