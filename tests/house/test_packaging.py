"""What people install: the wheel holds everything and works outside the checkout, and so does an editable install."""

from __future__ import annotations

import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = {"scorebreath": ROOT, "scorebreath_cli": ROOT / "cli", "scorebreath_synthdefs": ROOT / "synthdefs"}

pytestmark = pytest.mark.wheel

IMPORT_ALL = """
import importlib, pkgutil, sys
for name in ("scorebreath", "scorebreath_cli", "scorebreath_synthdefs"):
    package = importlib.import_module(name)
    print(name, package.__file__)
    for module in pkgutil.walk_packages(package.__path__, f"{name}."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
            print(module.name)
"""


def run(*command: str | Path, cwd: Path) -> str:
    done = subprocess.run([str(part) for part in command], cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{' '.join(map(str, command))}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def stored(package: str) -> set[str]:
    """Every file of a package that git knows or would add, relative to where the package lies."""
    listed = run("git", "ls-files", "--cached", "--others", "--exclude-standard", "-z", package, cwd=PACKAGES[package])
    return {name for name in listed.split("\0") if name and (PACKAGES[package] / name).is_file()}


def module_names() -> set[str]:
    names = {name for package in PACKAGES for name in stored(package) if name.endswith(".py")}
    dotted = {name.removesuffix(".py").replace("/", ".").removesuffix(".__init__") for name in names}
    return {name for name in dotted if not name.endswith("__main__")}


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The checkout as git would hand it to somebody; building leaves the real one clean."""
    target = tmp_path_factory.mktemp("source") / "p"
    listed = run("git", "ls-files", "--cached", "--others", "--exclude-standard", "-z", cwd=ROOT)
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target / name)
    return target


@pytest.fixture(scope="module")
def wheel(copy: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", out, copy, cwd=out)
    return next(out.glob("*.whl"))


def environment(where: Path, *install: str | Path) -> Path:
    """A fresh environment that sees this one's libraries but not the checkout; returns its bin folder."""
    run(sys.executable, "-m", "venv", "--without-pip", where, cwd=where.parent)
    libraries = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    site = next(where.glob("lib/python*/site-packages"))
    (site / "libraries.pth").write_text("\n".join(sorted(libraries)) + "\n", encoding="utf-8")
    python = where / "bin" / "python"
    pip = (sys.executable, "-m", "pip", "--python", python, "install", "--quiet", "--no-deps", "--no-index")
    run(*pip, "--disable-pip-version-check", "--force-reinstall", "--no-build-isolation", *install, cwd=where.parent)
    return where / "bin"


@pytest.fixture(scope="module", params=["wheel", "editable"])
def installed(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    where = tmp_path_factory.mktemp(f"installed_{request.param}") / "venv"
    what = ("--editable", request.getfixturevalue("copy")) if request.param == "editable" else None
    return environment(where, *(what or (request.getfixturevalue("wheel"),)))


def test_the_wheel_holds_every_file_of_the_packages_and_no_other(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
    assert names == {name for package in PACKAGES for name in stored(package)}


def test_the_wheel_carries_licence_and_command(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        texts = {
            name.partition("/")[2]: archive.read(name).decode() for name in archive.namelist() if "dist-info" in name
        }
    assert "GNU GENERAL PUBLIC LICENSE" in texts["licenses/LICENSE"]
    assert "scorebreath = scorebreath_cli.main:main" in texts["entry_points.txt"]
    assert "License-Expression: GPL-3.0-or-later" in texts["METADATA"]


def test_every_module_imports_from_where_it_was_installed(installed: Path, tmp_path: Path) -> None:
    lines = run(installed / "python", "-I", "-c", IMPORT_ALL, cwd=tmp_path).splitlines()
    assert {line.split()[0] for line in lines} == module_names()
    places = [line.split()[1] for line in lines if " " in line]
    assert len(places) == len(PACKAGES) and not any(Path(place).is_relative_to(ROOT) for place in places)


def test_the_command_works_outside_the_checkout(installed: Path, tmp_path: Path) -> None:
    command = installed / "scorebreath"
    assert "render" in run(command, "--help", cwd=tmp_path)
    assert "casual-human" in run(command, "presets", cwd=tmp_path)
    assert "nose_share" in run(command, "params", cwd=tmp_path)
    assert "scorebreath.score/1" in run(command, "schema", cwd=tmp_path)


def test_an_installed_scorebreath_renders(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "hello.txt").write_text("Hello there. This is one more sentence.\n", encoding="utf-8")
    run(installed / "scorebreath", "render", "hello.txt", "-o", "out", "--voice", "tone", cwd=tmp_path)
    assert {"mix.wav", "score.json", "curves.csv", "timeline.png", "preview.html"} <= {
        path.name for path in (tmp_path / "out").iterdir()
    }
