"""The README is short, its example runs as it stands, and its commands, pages and picture exist."""

import re
from pathlib import Path

from hexmend.cli.main import commands
from tests.examples import run_page

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_example_runs(tmp_path):
    said = run_page(ROOT / "README.md", tmp_path).splitlines()
    assert re.match(r"\d+ hexes were inverted, 0 are; q_min 0\.\d+", said[1])
    assert [line.split()[0] for line in said[2:]] == ["1", "2", "3"]
    assert (tmp_path / "mended.vtu").exists()


def test_commands_and_files_that_are_named_exist():
    named = set(re.findall(r"^hexmend ([a-z]+)", README, re.MULTILINE))
    assert named
    assert named <= set(commands())
    targets = {line.split(":")[0] for line in (ROOT / "Makefile").read_text(encoding="utf-8").splitlines()}
    assert set(re.findall(r"`make (\w+)`", README)) <= targets
    linked = re.findall(r"\]\(([^)#]+)", README)
    assert linked
    for path in linked:
        assert (ROOT / path).exists(), path


def test_it_is_short():
    assert len(README.splitlines()) < 80
    assert len(re.findall(r"!\[", README)) == 1
