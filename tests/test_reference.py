"""The tables and pages of docs that are written from registries and declarations are as those are now."""

import argparse
import importlib.util
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from hexmend.cli.main import commands
from hexmend.io import FORMATS
from hexmend.parameters import declared
from hexmend.quality import METRICS
from hexmend.smoothers import METHODS

ROOT = Path(__file__).resolve().parents[1]


def script(name):
    """A module of scripts, which finds its siblings."""
    spec = importlib.util.spec_from_file_location(name, ROOT / f"scripts/{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(ROOT / "scripts"))
    try:
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(ROOT / "scripts"))
    return module


tables, reference, draw_floors = script("tables"), script("write_reference"), script("draw_floors")


@pytest.mark.parametrize("name", tables.TABLES)
def test_a_table_is_that_of_the_registry(name):
    text = (ROOT / tables.TABLES[name][0]).read_text(encoding="utf-8")
    assert tables.written(name, text) == text, "run make docs"


@pytest.mark.parametrize(("name", "registry"), [("methods", METHODS), ("metrics", METRICS), ("formats", FORMATS)])
def test_what_is_added_is_in_the_table(name, registry, monkeypatch):
    text = (ROOT / tables.TABLES[name][0]).read_text(encoding="utf-8")
    some = {key: entry for key, entry in registry.items() if key != list(registry)[-1]}
    monkeypatch.setattr(tables, name.upper(), some)
    assert tables.written(name, text).count("\n") == text.count("\n") - 1


def test_a_file_without_a_place_for_its_table_is_told():
    with pytest.raises(ValueError, match="0 places"):
        tables.written("methods", "# Methods")


@pytest.mark.parametrize("name", reference.PAGES)
def test_a_page_is_as_declared(name):
    text = (ROOT / "docs" / name).read_text(encoding="utf-8")
    assert reference.written(name, text) == text, "run make docs"


def test_a_page_without_its_mark_is_told():
    with pytest.raises(ValueError, match="0 marks"):
        reference.written("methods.md", "# Methods")


def test_every_method_and_parameter_has_its_place():
    page = (ROOT / "docs/methods.md").read_text(encoding="utf-8")
    for name, method in METHODS.items():
        section = page.split(f"\n## {name}\n")[1].split("\n## ")[0]
        for one in declared(method):
            assert f"| `{one.name}` |" in section
            assert one.help.replace("|", "\\|") in section


@dataclass
class Odd:
    """A command of all kinds of options."""

    help = "Does nothing."

    def arguments(self, parser):
        parser.add_argument("mesh", metavar="MESH", nargs="+", help="the meshes")
        parser.add_argument("-o", "--output", metavar="OUT", required=True, help="where to")
        parser.add_argument("--as-is", action="store_true", help="100 %% as it is")
        parser.add_argument("--size", type=int, default=7, help="how many (default %(default)s)")
        parser.add_argument("--boundary", choices=("fixed", "slide"), help="this | that")
        parser.add_argument("--set", metavar="K=V", action="append", help="a value")
        parser.add_argument("--hidden", help=argparse.SUPPRESS)


def test_options_are_as_argparse_has_them(monkeypatch):
    monkeypatch.setattr(reference, "commands", lambda: {"odd": Odd})
    title, what, usage, options = reference.every_command()
    assert (title, what) == ("## odd", "Does nothing.")
    assert usage == "```\nhexmend odd MESH... -o OUT [OPTION]...\n```"
    assert options.splitlines()[2:] == [
        "| `MESH` | the meshes |",
        "| `-o OUT`, `--output OUT` | where to |",
        "| `--as-is` | 100 % as it is |",
        "| `--size SIZE` | how many (default 7) |",
        "| `--boundary {fixed,slide}` | this \\| that |",
        "| `--set K=V` | a value; may be repeated |",
    ]


def test_every_command_has_its_place():
    page = (ROOT / "docs/commands.md").read_text(encoding="utf-8")
    for name in commands():
        assert f"\n## {name}\n" in page, "run make docs"


def test_the_floors_are_drawn_as_they_are(tmp_path):
    draw_floors.main(tmp_path)
    for name, levels in draw_floors.floors().items():
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert text == (ROOT / "docs" / name).read_text(encoding="utf-8"), "run make docs"
        for one in set().union(*levels):
            assert f">{one}</text>" in text


def test_a_public_name_without_a_page_is_named(monkeypatch):
    api_names = script("api_names")
    monkeypatch.setattr(api_names, "directives", lambda: {"hexmend.quality": "quality.md"})
    with pytest.raises(LookupError, match=r"hexmend\.METHODS"):
        list(api_names.names())
