"""Who tells what happens: to a person (messages on stderr, data on stdout), or to a program (`--json`)."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, Protocol

from scorebreath_cli.streams import stdout_is_shut

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

    from scorebreath_cli.failures import Failure

EVENT_SCHEMA = "scorebreath.event/1"
Row = Mapping[str, Any]
_SHOWN_AS_CODE = {
    code: f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"
    for code in (
        *range(0x20), *range(0x7F, 0xA0),  # C0, DEL and C1: a terminal obeys them
        0x061C, 0x200E, 0x200F, *range(0x2028, 0x202F), *range(0x2066, 0x206A),  # lines and directions
    )
}  # fmt: skip
"""What a text or a file name must not do to a terminal."""
_IN_TEXT = {code: shown for code, shown in _SHOWN_AS_CODE.items() if chr(code) not in "\n\t"}
_IN_JSON = {code: f"\\u{code:04x}" for code in _SHOWN_AS_CODE if code >= 0x7F}
STAGES = {"listen": "Listening", "speak": "Speaking", "sound": "Rendering"}
"""Stages of a long command, in their order, and what people are told."""


WIDEST = 32
"""Characters to which a column of a plain table is padded, at most."""


class Printer(Protocol):
    """Tells what happens."""

    def started(self, source: str, output: str) -> None:
        """Work on one input began."""

    def progress(self, stage: str, fraction: float) -> None:
        """How much of a stage is done, 0..1."""

    def written(self, path: str, size: int) -> None:
        """A file is in its place; bytes."""

    def note(self, text: str) -> None:
        """Something worth knowing that stops nothing."""

    def table(self, event: str, rows: Sequence[Row], columns: Sequence[str], below: Sequence[str] = ()) -> None:
        """Data: one event a row, each with all of its row; people see `columns`.

        On a terminal, those of them that are in `below` stand under their row.
        """

    def item(self, event: str, row: Row, text: str) -> None:
        """Data that does not fit a table; people see `text`."""

    def failed(self, failure: Failure, source: str = "") -> None:
        """An input, or the whole command, failed."""

    def done(self, status: int, said: str = "", **summary: Any) -> None:
        """Work on all inputs ended; people see `said`."""

    def close(self) -> None:
        """Take down what is drawn."""


def make(json_lines: bool, source: str = "") -> Printer:
    """The printer for `--json`, or for people; errors are about `source` until work on another begins."""
    return JsonPrinter(source) if json_lines else HumanPrinter()


_current: ContextVar[Printer] = ContextVar("printer")


def current() -> Printer:
    """Who tells what happens in the command that runs."""
    return _current.get(None) or HumanPrinter()


def set_current(printer: Printer) -> None:
    """From now on this one does."""
    _current.set(printer)


class JsonPrinter:
    """One event a line on stdout, each with its schema."""

    def __init__(self, source: str = "") -> None:
        """Nothing told yet."""
        self._last = ("", -1)
        self._source = source

    def started(self, source: str, output: str) -> None:
        """`started`."""
        self._source, self._last = source, ("", -1)
        self._emit("started", source=source, output=output)

    def progress(self, stage: str, fraction: float) -> None:
        """`progress`, at most once a percent."""
        percent = round(fraction * 100)
        if (stage, percent) != self._last:
            self._last = (stage, percent)
            self._emit("progress", source=self._source, stage=stage, fraction=percent / 100)

    def written(self, path: str, size: int) -> None:
        """`written`."""
        self._emit("written", source=self._source, path=path, bytes=size)

    def note(self, text: str) -> None:
        """`note`, and a line on stderr: whoever started the program may see it as well."""
        self._emit("note", source=self._source, text=text)
        HumanPrinter().note(text)

    def table(self, event: str, rows: Sequence[Row], columns: Sequence[str], below: Sequence[str] = ()) -> None:
        """One event a row."""
        for row in rows:
            self._emit(event, **row)

    def item(self, event: str, row: Row, text: str) -> None:
        """One event."""
        self._emit(event, **row)

    def failed(self, failure: Failure, source: str = "") -> None:
        """`error`."""
        place = {"line": failure.line, "column": failure.column} if failure.line else {}
        self._emit(
            "error", source=source or self._source, status=int(failure.status), kind=failure.kind,
            message=failure.message, **place,
        )  # fmt: skip

    def done(self, status: int, said: str = "", **summary: Any) -> None:
        """`done`."""
        self._emit("done", status=int(status), **summary)

    def close(self) -> None:
        """Nothing is drawn."""

    def _emit(self, event: str, **fields: Any) -> None:
        line = json.dumps({"schema": EVENT_SCHEMA, "event": event, **fields}, ensure_ascii=False, allow_nan=False)
        line = line.translate(_IN_JSON)
        sys.stdout.write(line.encode("utf-8", "backslashreplace").decode("utf-8") + "\n")
        sys.stdout.flush()


class HumanPrinter:
    """Messages and a progress bar on stderr (the bar on a terminal only), data and paths on stdout."""

    def __init__(self) -> None:
        """Nothing drawn yet."""
        self._bar: Progress | None = None
        self._task: TaskID | None = None
        self._source = ""

    def started(self, source: str, output: str) -> None:
        """Remember whose progress it is."""
        self.close()
        self._source = source.translate(_SHOWN_AS_CODE)

    def progress(self, stage: str, fraction: float) -> None:
        """Move the bar."""
        if not sys.stderr.isatty():
            return
        if self._bar is None:
            self._bar, self._task = _bar()
        assert self._task is not None
        self._bar.update(self._task, description=f"{STAGES.get(stage, stage)} {self._source}", completed=fraction)

    def written(self, path: str, size: int) -> None:
        """The path, on stdout, in one line; the file is there whether or not anybody wants to know."""
        self.close()
        if not stdout_is_shut():
            _print(path.translate(_SHOWN_AS_CODE))

    def note(self, text: str) -> None:
        """On stderr."""
        self._message(f"scorebreath: {text}")

    def table(self, event: str, rows: Sequence[Row], columns: Sequence[str], below: Sequence[str] = ()) -> None:
        """Ruled on a terminal; elsewhere plain columns, one line a row."""
        self.close()
        if not sys.stdout.isatty():
            _print("\n".join(plain_table(rows, columns)))
            return
        from rich import box
        from rich.console import Console
        from rich.padding import Padding
        from rich.table import Table
        from rich.text import Text

        console = Console()
        shown = [column for column in columns if column not in below]
        if below:
            head, *lines = plain_table(rows, shown)
            console.print(Text(head, style="bold", no_wrap=True, overflow="ellipsis"))
            for row, line in zip(rows, lines, strict=True):
                console.print(Text(line, no_wrap=True, overflow="ellipsis"))
                said = (_small(name, row.get(name)) for name in below)
                small = Text(" \N{MIDDLE DOT} ".join(filter(None, said)), style="dim")
                console.print(Padding(small, (0, 0, 0, 4)))
            return
        table = Table(box=box.HORIZONTALS, pad_edge=False)
        for column in shown:
            table.add_column(column.replace("_", " "), overflow="fold")
        for row in rows:
            table.add_row(*(Text(_cell(row.get(column))) for column in shown))
        console.print(table)

    def item(self, event: str, row: Row, text: str) -> None:
        """The text, on stdout, where there is any."""
        if not text:
            return
        self.close()
        _print(text)

    def failed(self, failure: Failure, source: str = "") -> None:
        """On stderr: the place, the problem, and the caret if it has one."""
        said = failure.message
        if source and source not in said:
            said = f"{source}: {said}"
        self._message(f"scorebreath: {said}")

    def done(self, status: int, said: str = "", **summary: Any) -> None:
        """A summary on stderr where there is one."""
        if said:
            self._message(f"scorebreath: {said}")

    def close(self) -> None:
        """Take the bar down."""
        if self._bar is not None:
            self._bar.stop()
            self._bar = self._task = None

    def _message(self, text: str) -> None:
        self.close()
        sys.stdout.flush()
        encoding = sys.stderr.encoding or "utf-8"
        sys.stderr.write(printable(text).encode(encoding, "backslashreplace").decode(encoding) + "\n")
        sys.stderr.flush()


def plain_table(rows: Sequence[Row], columns: Sequence[str]) -> list[str]:
    """Aligned columns, one line a row, a header first; none is padded to more than `WIDEST`.

    A longer cell is shown whole, and what follows it in its line begins later.

    >>> plain_table([{"name": "a", "value": 1.5}, {"name": "bcd", "value": None}], ["name", "value"])
    ['name  value', 'a     1.5', 'bcd']
    """
    cells = [[column.replace("_", " ") for column in columns]]
    cells += [[" ".join(_cell(row.get(column)).split()) for column in columns] for row in rows]
    widths = [min(WIDEST, max(len(line[n]) for line in cells)) for n in range(len(columns))]
    return [_line(line, widths) for line in cells]


def _line(cells: Sequence[str], widths: Sequence[int]) -> str:
    said, start = "", 0
    for cell, width in zip(cells, widths, strict=True):
        if cell:
            said = (f"{said}  " if said else "").ljust(start) + cell
        start += width + 2
    return said


def printable(text: str) -> str:
    r"""A text that a terminal shows and does not obey: other controls than line ends and tabs become their codes.

    >>> printable("bell" + chr(7) + chr(27) + "[31m")
    'bell\\x07\\x1b[31m'
    """
    return text.translate(_IN_TEXT)


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        from scorebreath.units import plain

        return plain(value)
    if isinstance(value, (list, tuple)):
        return ", ".join(_cell(part) for part in value)
    return printable(str(value))


def _small(column: str, value: object) -> str:
    """Where no column head says what a number is."""
    return f"{column.replace('_', ' ')} {value}" if isinstance(value, (int, float)) else _cell(value)


def _print(text: str) -> None:
    encoding = sys.stdout.encoding or "utf-8"
    sys.stdout.write(printable(text).encode(encoding, "backslashreplace").decode(encoding) + "\n")


def _bar() -> tuple[Progress, TaskID]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

    bar = Progress(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        console=Console(stderr=True),
        transient=True,
        redirect_stdout=False,
        redirect_stderr=False,
        refresh_per_second=5,
    )
    task = bar.add_task("", total=1.0)
    bar.start()
    return bar, task


def write_binary(data: bytes) -> None:
    """Data on stdout as it is."""
    sys.stdout.flush()
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()
