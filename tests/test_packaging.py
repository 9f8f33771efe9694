"""What an installation has beside its modules: one version, and what a desktop knows the viewer and its files by."""

import configparser
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
import xml.etree.ElementTree as ET
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import hexmend
from hexmend import gallery, io
from hexmend.cli.main import main
from hexmend.io import FORMATS
from hexmend_app.formats.session import SUFFIX
from scripts.check_layers import CORE, SEES_THE_FACE, WINDOWS, broken, circle, import_graph
from tests.programs import run_python

ROOT = Path(__file__).resolve().parents[1]
DESKTOP = ROOT / "desktop"
NAMESPACE = "{http://www.freedesktop.org/standards/shared-mime-info}"

#: Suffixes that many other kinds of files have: these are opened from the viewer.
COMMON = {".e", ".g", ".gen", ".dat"}

#: Prints the type of each file named, as desktops tell it.
TYPES = """
import json, sys
from PySide6.QtCore import QMimeDatabase
database = QMimeDatabase()
print(json.dumps({path: database.mimeTypeForFile(path).name() for path in sys.argv[1:]}))
"""


def suffixes():
    """Types and suffixes by the file for desktops."""
    types = ET.parse(DESKTOP / "hexmend.xml").getroot()
    return {
        one.get("type"): [glob.get("pattern").removeprefix("*") for glob in one.iter(f"{NAMESPACE}glob")]
        for one in types
    }


def entry():
    """The desktop entry."""
    parser = configparser.ConfigParser(interpolation=None)
    parser.optionxform = str
    parser.read(DESKTOP / "hexmend.desktop", encoding="utf-8")
    return parser["Desktop Entry"]


def test_there_is_one_version(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"hexmend {hexmend.__version__}\n"
    assert version("hexmend") == hexmend.__version__
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert "version" in project["dynamic"]


def test_the_viewer_opens_all_types_and_no_others():
    assert sorted(entry()["MimeType"].strip(";").split(";")) == sorted(suffixes())
    assert entry()["Exec"].split()[:2] == ["hexmend", "view"]


def test_every_format_has_a_type():
    known = {suffix for some in suffixes().values() for suffix in some}
    assert known == {suffix for format in FORMATS.values() for suffix in format.suffixes} - COMMON | {SUFFIX}


def test_icons_are_of_their_sizes_and_installed():
    build = (ROOT / "core/native/CMakeLists.txt").read_text(encoding="utf-8")
    (listed,) = re.findall(r"foreach\(size ([\d ]+)\)", build)
    assert sorted(map(int, listed.split())) == sorted(int(path.stem) for path in (DESKTOP / "icons").iterdir())
    for path in (DESKTOP / "icons").iterdir():
        with Image.open(path) as icon:
            assert icon.size == (int(path.stem), int(path.stem))


@pytest.mark.skipif(not shutil.which("desktop-file-validate"), reason="needs Debian's desktop-file-utils")
def test_the_desktop_entry_is_valid():
    done = subprocess.run(
        ["desktop-file-validate", str(DESKTOP / "hexmend.desktop")], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout + done.stderr) == (0, "")


@pytest.mark.skipif(not shutil.which("update-mime-database"), reason="needs Debian's shared-mime-info")
def test_files_are_told_apart(tmp_path):
    packages = tmp_path / "share/mime/packages"
    packages.mkdir(parents=True)
    shutil.copy(DESKTOP / "hexmend.xml", packages)
    environment = os.environ | {"XDG_DATA_HOME": str(tmp_path / "share"), "XDG_DATA_DIRS": "/usr/share"}
    subprocess.run(["update-mime-database", str(packages.parent)], env=environment, capture_output=True, check=True)
    expected = {}
    mesh = gallery.make("cube", size=27)
    for type, some in suffixes().items():
        for suffix in set(some) & set(io.writable_suffixes()):
            path = tmp_path / f"mesh{suffix}"
            io.write(path, mesh)
            expected[str(path)] = type
    assert len(expected) > 10
    font = tmp_path / "font.bdf"
    font.write_text("STARTFONT 2.1\n")
    expected[str(font)] = "application/x-font-bdf"
    done = subprocess.run([sys.executable, "-c", TYPES, *expected], env=environment, capture_output=True, text=True)
    assert json.loads(done.stdout) == expected


@pytest.mark.skipif(os.name != "posix", reason="a script of the shell")
def test_a_command_that_fails_shows_its_last_lines(tmp_path):
    words = [ROOT / "scripts" / "logged", tmp_path / "log", "sh", "-c"]
    numbers = [str(k) for k in range(1, 101)]
    where = f"hexmend: sh failed (above: its last lines; all of them: {tmp_path / 'log'})"
    for script, status, shown in (("seq 100; exit 3", 3, [*numbers[70:], where]), ("seq 100", 0, [])):
        done = subprocess.run([*words, script], capture_output=True, text=True, check=False)
        assert done.returncode == status
        assert done.stderr.splitlines() == shown
        assert (tmp_path / "log").read_text().split() == numbers


def test_files_for_others_have_the_version_and_the_dependencies_of_the_package():
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    recipe = (ROOT / "conda/recipe.yaml").read_text(encoding="utf-8")
    assert f"\nversion: {hexmend.__version__}\n" in citation
    assert f"\n  version: {hexmend.__version__}\n" in recipe
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    for needed in project["dependencies"]:
        name, least = needed.split(">=")
        assert f"    - {name} >={least}\n" in recipe
    assert f"    - python {project['requires-python']}\n" in recipe
    for file in project["license-files"]:
        assert (ROOT / file).is_file()
        assert file in re.search(r"license_file: \[(.*)\]", recipe)[1]


def test_the_newest_section_of_the_changelog_is_that_of_the_version():
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    sections = re.findall(r"^## (.*)$", text, re.MULTILINE)
    assert re.fullmatch(rf"\[{re.escape(hexmend.__version__)}\] - (Unreleased|\d{{4}}-\d\d-\d\d)", sections[0])
    kinds = re.findall(r"^### (.*)$", text.split("\n## ")[1], re.MULTILINE)
    assert kinds == [k for k in ("Added", "Changed", "Deprecated", "Removed", "Fixed", "Security") if k in kinds]


def test_workflows_build_the_same_pythons_and_call_scripts_that_exist():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    texts = {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / ".github/workflows").glob("*.yml")}
    pythons = re.findall(r'"(3\.\d+)"', re.search(r"python: (\[.*\])", texts["test"])[1])
    built = project["tool"]["cibuildwheel"]["build"].split()
    assert [f"cp{version.replace('.', '')}-*" for version in pythons] == built
    named = [f"Programming Language :: Python :: {version}" for version in pythons]
    assert [one for one in project["project"]["classifiers"] if "Python ::" in one] == named
    targets = re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    for text in texts.values():
        assert set(re.findall(r"run: make ([\w-]+)", text)) <= set(targets)
        for called in re.findall(r"(?:uses|run): (\./?[.\w/-]+)", text):
            assert (ROOT / called).exists(), called


def test_what_is_linked_into_the_kernels_has_its_notice():
    build = (ROOT / "core/native/CMakeLists.txt").read_text(encoding="utf-8")
    notices = (ROOT / "THIRD_PARTY.md").read_text(encoding="utf-8")
    for package in set(re.findall(r"find_package\((\w+)", build)) - {"Python", "Threads"}:
        assert f"**{package}**: Copyright" in notices
    assert ("-static-libstdc++" in build) == ("libstdc++" in notices)


def test_every_colour_map_that_a_wheel_contains_is_listed():
    notices = (ROOT / "THIRD_PARTY.md").read_text(encoding="utf-8")
    with np.load(ROOT / "resources/colour_maps.npz") as maps:
        assert all(re.search(rf"\b{name}\b", notices) for name in maps.files)


# Layers: the core needs no window, and the check of make lint sees what breaks them.


def package(folder: Path, **files: str) -> Path:
    """Write the modules of a package `hexmend`, with __ for / in their names."""
    for name, text in files.items():
        path = folder / "hexmend" / f"{name.replace('__', '/')}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder / "hexmend"


@pytest.mark.parametrize("line", [
    "from hexmend.mesh import upper",
    "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from hexmend.mesh.upper import X",
    "import importlib\n\ndef late():\n    importlib.import_module('hexmend.mesh.upper')",
])  # fmt: skip
def test_a_circle_is_named(tmp_path, line):
    found = circle(import_graph(package(tmp_path, mesh__lower=line, mesh__upper="import hexmend.mesh.lower")))
    assert found.split(" -> ").count("hexmend.mesh.upper") > 0
    assert circle(import_graph(package(tmp_path, mesh__lower="import os"))) == ""


@pytest.mark.parametrize(("module", "line", "complaint"), [
    ("mesh__mesh", "from hexmend.run import smooth", "not below mesh"),
    ("mesh__mesh", "import importlib\nimportlib.import_module('hexmend.quality')", "not below mesh"),
    ("run__recipe", "from hexmend import Mesh", "public face"),
    ("run__recipe", "from .recipe_files import read_recipe", "absolute name"),
    ("magic", "import os", "has no layer"),
    ("cli__info", "from hexmend import read", None),
])  # fmt: skip
def test_a_broken_floor_is_seen(tmp_path, module, line, complaint):
    rows = broken(package(tmp_path, **{module: line}), CORE, SEES_THE_FACE)
    assert [complaint in row for row in rows] == ([True] if complaint else [])


def test_importing_all_of_the_core_brings_no_window_along():
    program = (
        "import importlib, pkgutil, sys, hexmend\n"
        "for one in pkgutil.walk_packages(hexmend.__path__, 'hexmend.'):\n"
        "    if not one.name.endswith('__main__'):\n"
        "        importlib.import_module(one.name)\n"
        f"print(sorted({{name.split('.')[0] for name in sys.modules}} & set({WINDOWS!r})))\n"
    )
    done = run_python("-c", program, check=True)
    assert done.stdout == "[]\n"
