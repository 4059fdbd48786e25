"""Pictures over WebSocket, and a few fixed pages beside them, served from a thread of its own.

Every client gets every picture as a text message (see `lines`); `ws://HOST:PORT/?body=body2` gets one body's. A client
that is slow loses pictures, the oldest first, never the others' time or our memory. What clients send is thrown away.
"""

from __future__ import annotations

import asyncio
import socket
import threading
from collections.abc import Callable, Collection, Mapping
from importlib.util import find_spec
from types import MappingProxyType
from typing import TYPE_CHECKING

from scorebreath.curves.rigs.table import rig_named
from scorebreath.errors import EnvironmentFailure, MissingExtraError
from scorebreath.live.picture import Picture
from scorebreath.live.streams.datagrams import found
from scorebreath.live.streams.lines import line
from scorebreath.live.streams.origins import may

if TYPE_CHECKING:
    from starlette.applications import Starlette
    from starlette.requests import Request
    from starlette.responses import Response
    from starlette.websockets import WebSocket

MOST_CLIENTS = 16
WAITING = 32
"""Pictures that wait for a client: half a second of one body at the usual rate."""
LARGEST_HEARD = 1024
"""Bytes of a message from a client; a larger one ends the connection."""
PATIENCE = 5.0
"""s that opening and closing may take"""
REFUSED, CROWDED = 4403, 1013
"""Codes with which a connection ends: the page may not read; there are too many clients."""
Route = tuple[str, bytes]
"""Media type and content of a page."""
_Queue = asyncio.Queue[tuple[str, str]]
"""Of bodies and their pictures."""


class PictureServer:
    """A web server that sends pictures to whoever listens.

    Args:
        host: Address to listen at.
        port: Port; 0 for any that is free.
        routes: Path to media type and content, such as `{"/": ("text/html; charset=utf-8", page)}`.
        origins: Pages of other hosts that may read; `origins.ANY` for all.
        most: Clients at a time.
        waiting: Pictures that wait for a slow one.

    Raises:
        MissingExtraError: starlette, uvicorn or websockets are not installed.
        EnvironmentFailure: The port is taken.
        InputError: The host is not known.
    """

    def __init__(
        self, host: str = "127.0.0.1", port: int = 8765, *, routes: Mapping[str, Route] = MappingProxyType({}),
        origins: Collection[str] = (), most: int = MOST_CLIENTS, waiting: int = WAITING,
    ) -> None:  # fmt: skip
        """Listen, and serve from now on."""
        if not all(map(find_spec, ("starlette", "uvicorn", "websockets"))):
            raise MissingExtraError("WebSocket", "live")
        self._host, self._routes, self._origins = host, dict(routes), tuple(origins)
        self._most, self._waiting = most, waiting
        self._clients: set[_Queue] = set()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._socket = _listening(host, port)
        self.port: int = self._socket.getsockname()[1]
        """where it listens"""
        self._serve()

    @property
    def clients(self) -> int:
        """How many listen."""
        return len(self._clients)

    def publish(self, body: str, text: str) -> None:
        """A picture for every client that wants that body's; from any thread.

        Raises:
            OSError: The server has ended.
        """
        if self._loop is None or not self._thread.is_alive():
            raise OSError("the server has ended")
        try:
            self._loop.call_soon_threadsafe(self._spread, body, text)
        except RuntimeError as error:  # the loop was closed just now
            raise OSError(str(error)) from None

    def close(self) -> None:
        """Say goodbye to the clients and end."""
        self._server.should_exit = True
        self._thread.join(PATIENCE)
        self._socket.close()

    def _serve(self) -> None:
        import uvicorn

        config = uvicorn.Config(
            self._application(), ws="auto", http="h11", lifespan="off", log_config=None, log_level="critical",
            access_log=False, server_header=False, ws_max_size=LARGEST_HEARD, ws_max_queue=4,
            ws_per_message_deflate=False, limit_concurrency=4 * self._most, timeout_graceful_shutdown=1,
        )  # fmt: skip
        self._server = uvicorn.Server(config)
        ready = threading.Event()

        async def serve() -> None:
            self._loop = asyncio.get_running_loop()
            ready.set()
            await self._server.serve(sockets=[self._socket])

        self._thread = threading.Thread(target=lambda: asyncio.run(serve()), name="pictures", daemon=True)
        self._thread.start()
        if not ready.wait(PATIENCE):
            raise EnvironmentFailure(f"the server at {self._host}:{self.port} did not start within {PATIENCE:g} s")

    def _application(self) -> Starlette:
        from starlette.applications import Starlette
        from starlette.responses import Response
        from starlette.routing import BaseRoute, Route, WebSocketRoute

        def page(path: str, media: str, content: bytes) -> BaseRoute:
            async def answer(request: Request) -> Response:
                return Response(content, media_type=media, headers={"X-Content-Type-Options": "nosniff"})

            return Route(path, answer)

        pages = [page(path, media, content) for path, (media, content) in self._routes.items()]
        return Starlette(routes=[*pages, WebSocketRoute("/{path:path}", self._client)])

    async def _client(self, client: WebSocket) -> None:
        from starlette.websockets import WebSocketDisconnect

        headers = client.headers
        allowed = may(headers.get("origin"), headers.get("host"), self._origins, self._host)
        if not allowed or len(self._clients) >= self._most:
            await client.close(CROWDED if allowed else REFUSED)
            return
        waiting: _Queue = asyncio.Queue(self._waiting)
        self._clients.add(waiting)
        heard = sent = None
        try:
            await client.accept()
            wanted = client.query_params.get("body", "")
            heard = asyncio.create_task(_deaf(client))
            sent = asyncio.create_task(_talk(client, waiting, wanted))
            await asyncio.wait((heard, sent), return_when=asyncio.FIRST_COMPLETED)
        except (WebSocketDisconnect, OSError, RuntimeError):
            pass  # it is gone
        finally:
            self._clients.discard(waiting)
            for task in (heard, sent):
                if task is not None:
                    task.cancel()
            await asyncio.gather(*filter(None, (heard, sent)), return_exceptions=True)

    def _spread(self, body: str, text: str) -> None:
        for waiting in self._clients:
            if waiting.full():
                waiting.get_nowait()
            waiting.put_nowait((body, text))


async def _deaf(client: WebSocket) -> None:
    """Throw away what it says, until it goes."""
    while (await client.receive())["type"] != "websocket.disconnect":
        pass


async def _talk(client: WebSocket, waiting: _Queue, wanted: str) -> None:
    while True:
        body, text = await waiting.get()
        if wanted in ("", body):
            await client.send_text(text)


def _listening(host: str, port: int) -> socket.socket:
    family, kind, protocol, _, address = found(host, port, socket.SOCK_STREAM)
    listener = socket.socket(family, kind, protocol)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(address)
        listener.listen(64)
    except OSError as error:
        listener.close()
        raise EnvironmentFailure(f"port {port} at {host} cannot be opened: {error.strerror or error}") from None
    return listener


class WebSocketTarget:
    """The clients of a server.

    Args:
        name: What it is, for people.
        server: Whose clients; it is closed with the target.
        rig: Whose columns are added; empty for none.
        more: Further keys of a picture, with values that JSON has.

    Raises:
        InputError: There is no such rig.
    """

    def __init__(
        self, name: str, server: PictureServer, *, rig: str = "",
        more: Callable[[Picture], Mapping[str, object]] = lambda _: {},
    ) -> None:  # fmt: skip
        """Look at the options."""
        if rig:
            rig_named(rig)
        self._name, self._server, self._rig, self._more = name, server, rig, more

    @property
    def name(self) -> str:
        """What it is, for people."""
        return self._name

    def send(self, picture: Picture) -> None:
        """Send one picture to whoever listens.

        Raises:
            OSError: The server has ended.
        """
        if self._server.clients:
            text = line(picture, self._rig, self._more(picture)).decode("ascii").rstrip("\n")
            self._server.publish(picture.body, text)

    def close(self) -> None:
        """End the server."""
        self._server.close()
