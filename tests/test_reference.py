"""The tables and pages of docs that are written from registries and declarations are as those are now."""

import argparse
import importlib.util
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from hexmend.io import FORMATS
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


tables, reference = script("tables"), script("write_reference")


@pytest.mark.parametrize(("name", "registry"), [("methods", METHODS), ("metrics", METRICS), ("formats", FORMATS)])
def test_what_is_added_is_in_the_table(name, registry, monkeypatch):
    text = (ROOT / tables.TABLES[name][0]).read_text(encoding="utf-8")
    some = {key: entry for key, entry in registry.items() if key != list(registry)[-1]}
    monkeypatch.setattr(tables, name.upper(), some)
    assert tables.written(name, text).count("\n") == text.count("\n") - 1


def test_a_file_without_a_place_for_its_table_is_told():
    with pytest.raises(ValueError, match="0 places"):
        tables.written("methods", "# Methods")


def test_a_page_without_its_mark_is_told():
    with pytest.raises(ValueError, match="0 marks"):
        reference.written("methods.md", "# Methods")


def test_a_parameter_that_many_methods_share_stands_once():
    shared, own = ("`p`", "2"), ("`rho`", "1")
    sections = [reference.Section(name, [], [shared, own] if name == "a" else [shared]) for name in "abc"]
    text = "\n".join(reference.page(sections, ("name", "default"), "Common parameters"))
    assert text.count("| `p` |") == text.count("| `rho` |") == 1
    assert text.index("| `p` |") < text.index("## a") < text.index("| `rho` |") < text.index("## b")
    assert text.count("Common parameters: `p`.") == 3


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


def test_a_public_name_without_a_page_is_named(monkeypatch):
    api_names = script("api_names")
    monkeypatch.setattr(api_names, "directives", lambda: {"hexmend.quality": "quality.md"})
    with pytest.raises(LookupError, match=r"hexmend\.METHODS"):
        list(api_names.names())
