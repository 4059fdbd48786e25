"""The files of SynthDefs are what the sources make, and stand aside when they are not."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from scorebreath_synthdefs import CATALOGUE, compiled, synthdef
from scorebreath_synthdefs.catalogue import ALL

HERE = Path(compiled.__file__).parent


def test_the_files_are_up_to_date(tmp_path: Path) -> None:
    """After a change: python -m scorebreath_synthdefs.compiled."""
    compiled.write(tmp_path)
    made = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert made == {path.name: path.read_bytes() for path in (HERE / compiled.FOLDER).iterdir()}
    assert len(made) == len(ALL) + 1


def test_the_digest_is_of_every_module_that_makes_instruments() -> None:
    modules = {path.name for path in HERE.glob("*.py")}
    assert modules == {*compiled.SOURCES, "__init__.py", "compiled.py"}


def test_changed_sources_are_built_on_the_spot(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    class Changed:
        def compile(self) -> bytes:
            return b"anew"

    def build(name: str) -> Changed:
        asked.append(name)
        return Changed()

    name = next(iter(CATALOGUE))
    monkeypatch.setattr(compiled, "synthdef", build)
    assert compiled.compiled.__wrapped__(name) != b"anew"
    monkeypatch.setattr(compiled, "digest", lambda: "another")
    assert compiled.compiled.__wrapped__(name) == b"anew"
    assert asked == [name]


def test_several_are_what_supriya_makes_of_several() -> None:
    from supriya.ugens import compile_synthdefs

    names = sorted(ALL)
    assert compiled.together(names) == compile_synthdefs(*map(synthdef, names))


def test_an_unknown_name_is_refused() -> None:
    with pytest.raises(KeyError):
        compiled.compiled("scorebreath_ears_male")


def test_rendering_needs_no_supriya() -> None:
    code = (
        "import io, sys\n"
        "from scorebreath.engine.offline import render\n"
        "from scorebreath.media.store import MemoryStore\n"
        "from tests.engine.sounding import inspiration, noise, score\n"
        "render(score([inspiration(0.1, noise())], 1.0), MemoryStore(), io.BytesIO())\n"
        "print('supriya' in sys.modules)\n"
    )
    path = f"import sys; sys.path[:0] = {sys.path!r}\n"
    done = subprocess.run([sys.executable, "-c", path + code], capture_output=True, text=True, timeout=120, check=True)
    assert done.stdout == "False\n"
