"""A Chromium in real time: a page is opened, asked, and looked at, over the browser's own debugging protocol."""

from __future__ import annotations

import base64
import itertools
import json
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from websockets.sync.client import ClientConnection, connect

PATIENCE = 60.0
"""s"""
QUIET = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--no-first-run", "--remote-debugging-port=0", "--window-size=1280,800",
)  # fmt: skip


class Page:
    """A page that is open."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket, self._numbers = socket, itertools.count(1)
        self.complaints: list[str] = []
        """errors and warnings of its scripts, what was refused or could not be loaded, in their order"""
        self.requested: list[str] = []
        """what it asked any network for"""
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.do(f"{domain}.enable")

    def do(self, method: str, **options: object) -> dict[str, Any]:
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": options}))
        while True:
            told = json.loads(self._socket.recv(PATIENCE))
            if told.get("id") == number:
                assert "error" not in told, told
                result: dict[str, Any] = told["result"]
                return result
            self._notice(told.get("method", ""), told.get("params", {}))

    def ask(self, script: str) -> Any:
        """What a piece of JavaScript gives, waited for if need be."""
        told = self.do("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in told, told
        return told["result"].get("value")

    def until(self, script: str) -> None:
        """Wait until a piece of JavaScript is true."""
        end = time.monotonic() + PATIENCE
        while not self.ask(script):
            if time.monotonic() > end:
                pytest.fail(f"never true: {script}; complaints: {self.complaints}")
            time.sleep(0.05)

    def go(self, address: str) -> None:
        """To another page; not to the one that is shown."""
        self.do("Page.navigate", url=address)
        self.until(f"document.readyState === 'complete' && location.href === {json.dumps(address)}")

    def picture(self, file: Path) -> None:
        """Write a PNG of it."""
        file.write_bytes(base64.b64decode(self.do("Page.captureScreenshot")["data"]))

    def _notice(self, method: str, told: dict[str, Any]) -> None:
        if method == "Runtime.exceptionThrown":
            self.complaints.append(json.dumps(told["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.complaints.append(json.dumps(told["args"]))
        elif method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            self.complaints.append(f"{told['entry']['text']} {told['entry'].get('url', '')}")
        elif method == "Network.requestWillBeSent":
            self.requested.append(told["request"]["url"])
        elif method == "Network.webSocketCreated":
            self.requested.append(told["url"])


@contextmanager
def browsing(chromium: str, folder: Path) -> Iterator[Page]:
    """A browser with one empty page; it is ended behind."""
    command = [chromium, *QUIET, f"--user-data-dir={folder}", "about:blank"]
    browser = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        port = _port(browser, folder / "DevToolsActivePort")
        with connect(f"ws://127.0.0.1:{port[0]}{port[1]}", open_timeout=PATIENCE, max_size=None) as whole:
            whole.send(json.dumps({"id": 1, "method": "Target.getTargets"}))
            targets = json.loads(whole.recv(PATIENCE))["result"]["targetInfos"]
        page = next(each["targetId"] for each in targets if each["type"] == "page")
        address = f"ws://127.0.0.1:{port[0]}/devtools/page/{page}"
        with connect(address, open_timeout=PATIENCE, max_size=None) as socket:
            yield Page(socket)
            socket.send(json.dumps({"id": 0, "method": "Browser.close"}))
            browser.wait(PATIENCE)
    finally:
        if browser.poll() is None:
            browser.kill()
            browser.wait(PATIENCE)


def _port(browser: subprocess.Popen[bytes], file: Path) -> tuple[str, str]:
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end and browser.poll() is None:
        lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
        if len(lines) == 2:
            return lines[0], lines[1]
        time.sleep(0.05)
    pytest.fail("the browser did not start")
