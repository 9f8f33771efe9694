"""The README's example runs as it stands, and its commands and methods exist."""

import re
from pathlib import Path

from hexmend.cli.main import commands
from hexmend.smoothers import METHODS

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_example_runs(tmp_path, monkeypatch, capsys):
    (program,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    monkeypatch.chdir(tmp_path)
    exec(compile(program, "README.md", "exec"), {})
    said = capsys.readouterr().out.splitlines()
    assert re.match(r"\d+ hexes were inverted, 0 are; q_min 0\.\d+", said[1])
    assert [line.split()[0] for line in said[2:]] == ["1", "2", "3"]
    assert (tmp_path / "mended.vtu").exists()


def test_commands_methods_and_files_that_are_named_exist():
    named = set(re.findall(r"^hexmend (\w+)", README, re.MULTILINE))
    assert named
    assert named <= set(commands())
    table = re.findall(r"^\| `([\w-]+)`", README, re.MULTILINE)
    assert table == sorted(METHODS, key=table.index)
    for path in re.findall(r"\((resources/[\w.-]+|docs/[\w.-]+)\)", README):
        assert (ROOT / path).exists(), path
        assert (ROOT / path).stat().st_size < 300_000, path
