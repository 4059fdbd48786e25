from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scorebreath.errors import ScriptError
from scorebreath.script import decode as decoding
from scorebreath.script.decode import decode


def test_utf8_with_mark_and_any_line_ends() -> None:
    assert decode("\ufeffÄ\r\nb\rc\n".encode()) == "Ä\nb\nc\n"


def test_a_wrong_byte_is_shown_in_its_line() -> None:
    with pytest.raises(ScriptError) as caught:
        decode(b"first\r\n\xc3\xa4b\xff rest\nlast", "poem.txt")
    error = caught.value
    assert (error.file, error.line, error.column) == ("poem.txt", 2, 3)
    assert "0xff" in error.problem
    assert "UTF-8" in error.expected
    head, shown, caret = str(error).split("\n")
    assert head.startswith("poem.txt:2:3: ")
    assert caret.index("^") - 2 == shown.index("�") - 2 == 2
    assert "last" not in shown


def test_columns_do_not_count_the_byte_order_mark() -> None:
    with pytest.raises(ScriptError) as caught:
        decode(b"\xef\xbb\xbfab\xff", "a.txt")
    assert (caught.value.line, caught.value.column) == (1, 3)


@pytest.mark.parametrize(
    ("data", "found"), [(b"a\nb\0c", "NUL"), ("hi".encode("utf-16"), "UTF-16"), (b"\xfe\xff\0h", "UTF-16")]
)
def test_binary_files_are_refused(data: bytes, found: str) -> None:
    with pytest.raises(ScriptError, match=found):
        decode(data, "x")


def test_size_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(decoding, "LIMIT", 10)
    assert decode(b"0123456789") == "0123456789"
    with pytest.raises(ScriptError, match="11 bytes"):
        decode(b"0123456789a")


@given(st.binary(max_size=60))
def test_any_bytes_are_text_or_a_script_error(data: bytes) -> None:
    try:
        text = decode(data, "f")
    except ScriptError as error:
        assert error.exit_status == 2
        if error.column:
            before = error.text[: error.column - 1]
            assert data.decode("utf-8", "replace").removeprefix("\ufeff").count(before) >= 1
    else:
        assert "\r" not in text


@given(st.text(alphabet=st.characters(exclude_characters="\0\r\ufeff\x1b\x9b\x9d", codec="utf-8")))  # no escapes
def test_text_comes_back(text: str) -> None:
    assert decode(text.encode()) == text


@pytest.mark.parametrize(
    ("written", "read"),
    [
        ("Hello \x1b[31mred\x1b[0m world.", "Hello red world."),
        ("\x1b[1;38;5;196mBold\x1b[m, \x9b4mdrawn\x9b0m.", "Bold, drawn."),
        ("\x1b]0;a title\x07One \x1b]8;;https://x.org\x1b\\link\x1b]8;;\x1b\\.\x1b(B", "One link."),
        ("An \x1b escape, \x1b]unfinished\nand \x1b[31", "An \x1b escape, \x1b]unfinished\nand \x1b[31"),
        ("[31m] stays, \x9bas does this", "[31m] stays, \x9bas does this"),
    ],
)
def test_what_was_meant_for_a_terminal_is_left_out_whole(written: str, read: str) -> None:
    assert decode(written.encode()) == read


def test_terminal_sequences_without_end_cost_no_time() -> None:
    for sign in ("\x1b[3", "\x1b]", "\x9d", "\x9b1"):
        assert decode((sign * 100_000).encode()) == sign * 100_000
