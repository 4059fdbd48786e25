"""Whose web pages may read a server on this machine.

Any page that a browser shows may try to open a WebSocket to 127.0.0.1, and browsers leave it to the server to refuse.
A page from the same host may; so may a program, which sends no Origin. A name that is no address is not believed to be
this host unless the server was told so: whoever owns a domain can let it point here.
"""

from __future__ import annotations

import ipaddress
from collections.abc import Collection
from urllib.parse import urlsplit

ANY = "*"
"""Among what is allowed: every page."""


def may(origin: str | None, host: str | None, allowed: Collection[str] = (), own: str = "") -> bool:
    """Whether a page may read.

    Args:
        origin: Header of that name, None where there is none.
        host: Header of that name: what the page believes to talk to.
        allowed: Origins that are allowed besides, such as `http://stage.example:8000`; ANY for all.
        own: Name under which the server was opened.

    >>> may(None, "127.0.0.1:8765"), may("http://localhost:8000", "127.0.0.1:8765"), may("http://a.example", "[::1]")
    (True, True, False)
    >>> may("http://a.example:8765", "a.example:8765"), may("http://a.example", "127.0.0.1", ["http://a.example"])
    (False, True)
    """
    if origin is None or ANY in allowed or origin in allowed:
        return True
    there, here = _name(origin), _name(f"//{host or ''}")
    if not there or not here or here not in (there, *(_LOCAL if there in _LOCAL else ())):
        return False
    return here in _LOCAL or here == own.lower() or _is_address(here)


_LOCAL = ("localhost", "127.0.0.1", "::1")


def _name(address: str) -> str:
    try:
        return urlsplit(address).hostname or ""
    except ValueError:
        return ""


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
