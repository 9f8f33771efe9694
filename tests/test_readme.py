"""The README's example runs as it stands, its commands and files exist, and the tables are those of the registries."""

import importlib.util
import re
from pathlib import Path

import pytest

from hexmend.cli.main import commands
from hexmend.io import FORMATS
from hexmend.quality import METRICS
from hexmend.smoothers import METHODS

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


spec = importlib.util.spec_from_file_location("tables", ROOT / "scripts/tables.py")
tables = importlib.util.module_from_spec(spec)
spec.loader.exec_module(tables)


def test_the_example_runs(tmp_path, monkeypatch, capsys):
    (program,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    monkeypatch.chdir(tmp_path)
    exec(compile(program, "README.md", "exec"), {})
    said = capsys.readouterr().out.splitlines()
    assert re.match(r"\d+ hexes were inverted, 0 are; q_min 0\.\d+", said[1])
    assert [line.split()[0] for line in said[2:]] == ["1", "2", "3"]
    assert (tmp_path / "mended.vtu").exists()


def test_commands_and_files_that_are_named_exist():
    named = set(re.findall(r"^hexmend (\w+)", README, re.MULTILINE))
    assert named
    assert named <= set(commands())
    for path in re.findall(r"\((resources/[\w.-]+|docs/[\w.-]+)\)", README):
        assert (ROOT / path).exists(), path
        assert (ROOT / path).stat().st_size < 300_000, path


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
