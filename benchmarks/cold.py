"""The modules that one rendering imports, and a process that imports just these.

python -m benchmarks.cold list TEXT FOLDER    render, and print the names as JSON
python -m benchmarks.cold import FILE         import the names in a file
"""

from __future__ import annotations

import importlib
import json
import sys
from contextlib import redirect_stdout, suppress
from io import StringIO
from pathlib import Path

EMPTY = "import typer\napp = typer.Typer()\n@app.command()\ndef main() -> None:\n    '''Nothing.'''\napp()\n"
"""A typer program that does nothing."""


def names(text: str, folder: str) -> list[str]:
    """Modules in memory after a rendering, in the order of their import."""
    from scorebreath_cli.main import main

    sys.argv = ["scorebreath", "render", text, "-o", folder, "--force"]
    with redirect_stdout(StringIO()), suppress(SystemExit):
        main()
    own = {"__main__", "benchmarks", "benchmarks.cold"}
    return [name for name in sys.modules if name not in own]


if __name__ == "__main__":
    if sys.argv[1] == "list":
        found = names(sys.argv[2], sys.argv[3])
        print(json.dumps(found))
    else:
        for name in json.loads(Path(sys.argv[2]).read_text()):
            with suppress(Exception):  # some are made by others, and cannot be imported by name
                importlib.import_module(name)
