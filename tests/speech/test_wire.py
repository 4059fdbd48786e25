"""Messages to and from a worker."""

from __future__ import annotations

import io
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.speech.wire import HEADER, WireError, pack, read_message

FIELDS = st.dictionaries(st.text(max_size=8), st.none() | st.integers() | st.text(max_size=20), max_size=4)


@given(st.lists(st.tuples(FIELDS, st.binary(max_size=60)), max_size=4))
def test_messages_come_as_they_were_sent(messages: list[tuple[dict[str, Any], bytes]]) -> None:
    stream = io.BytesIO(b"".join(pack(fields, payload) for fields, payload in messages))
    assert [read_message(stream) for _ in messages] == messages
    assert read_message(stream) is None


@given(FIELDS, st.binary(max_size=60), st.data())
def test_a_message_that_breaks_off_is_an_error(fields: dict[str, Any], payload: bytes, data: st.DataObject) -> None:
    whole = pack(fields, payload)
    cut = data.draw(st.integers(1, len(whole) - 1))
    with pytest.raises(WireError):
        read_message(io.BytesIO(whole[:cut]))


@pytest.mark.parametrize("text", [b"nothing", b"[1]", b"\xff\xfe", b""])
def test_what_is_no_object_is_an_error(text: bytes) -> None:
    with pytest.raises(WireError):
        read_message(io.BytesIO(HEADER.pack(len(text), 0) + text))


def test_lone_surrogates_survive() -> None:
    assert read_message(io.BytesIO(pack({"definition": "\udce9"}))) == ({"definition": "\udce9"}, b"")
