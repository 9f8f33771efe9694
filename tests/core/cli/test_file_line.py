"""The line of a file that takes long: on a terminal alone, and gone before anything else is printed.

Progress: quiet where there is nothing to say, on standard error only, and Ctrl-C loses nothing.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from hexmend import gallery, io
from hexmend.cli.main import main
from hexmend.cli.output.file_line import FileLine
from hexmend.cli.output.progress import follow
from hexmend.io.storage.file_progress import FileAction, FileProgress
from hexmend.run import StoppingCriteria, iterate, progress

pty = pytest.importorskip("pty")

#: The program, whose line does not wait, so that a small file will do.
EAGER = (
    "import sys; from hexmend.cli.output import file_line; from hexmend.io.storage import file_progress; "
    "from hexmend.run import progress; file_line.DELAY = file_progress._INTERVAL = progress.BAR_INTERVAL = 0.0; "
    "from hexmend.cli.main import main; sys.exit(main(sys.argv[1:]))"
)
CLEARED = "\x1b[2K"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("line")
    io.write(path / "mesh.vtu", gallery.make("cube", size=3000, scramble=0.1))
    (path / "cut.vtu").write_bytes((path / "mesh.vtu").read_bytes()[:20_000])
    return path


def on_terminal(*words, **variables):
    """Run the program with a terminal as standard error; returns exit status, standard output and what is drawn."""
    terminal, end = pty.openpty()
    environment = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "FORCE_COLOR")}
    environment |= {"TERM": "xterm", "COLUMNS": "100", **variables}
    command = [sys.executable, "-c", EAGER, *map(str, words)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=end, env=environment, text=True) as program:
        os.close(end)
        drawn = b""
        while True:
            try:
                part = os.read(terminal, 4096)
            except OSError:  # the program has ended
                break
            if not part:
                break
            drawn += part
        out = program.stdout.read()
    os.close(terminal)
    return program.returncode, out, drawn.decode()


def test_reading_and_writing_have_a_line_on_a_terminal_that_is_removed(folder, tmp_path):
    words = ["smooth", folder / "mesh.vtu", "-o", tmp_path / "out.vtu", "--method", "laplacian"]
    status, out, drawn = on_terminal(*words, "--max-iterations", "1")
    assert status == 0
    assert "Reading mesh.vtu: " in drawn
    assert "%" in drawn
    assert "s left" in drawn
    assert "Writing out.vtu: " in drawn
    assert not re.sub(r"\x1b\[[?0-9]*[a-zA-Z]|\s", "", drawn.rpartition(CLEARED)[2])
    assert "Reading" not in out


def test_there_is_no_line_with_json(folder):
    status, out, drawn = on_terminal("info", folder / "mesh.vtu", "--json")
    assert status == 0
    assert out
    assert drawn == ""


def test_an_error_comes_after_the_line_has_gone(folder):
    status, _, drawn = on_terminal("info", folder / "cut.vtu")
    assert status == 3
    assert "cut.vtu" in drawn.rpartition(CLEARED)[2]
    assert "Traceback" not in drawn


def test_a_terminal_that_has_gone_does_not_end_the_reading(monkeypatch):
    line = FileLine()
    shown = []

    def gone(text):
        shown.append(text)
        raise OSError

    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("hexmend.cli.output.file_line.DELAY", 0.0)
    monkeypatch.setattr("sys.stderr.write", gone)
    line.show(FileProgress(Path("a"), FileAction.READING, 0.1, 0.2))
    line.show(FileProgress(Path("a"), FileAction.READING, 1.0, 4.0, ended=True))
    assert len(shown) == 2


def test_a_short_run_says_nothing_on_standard_error(mesh, tmp_path, run_command):
    assert main(["smooth", str(mesh), "-o", str(tmp_path / "out.vtu"), "--method", "laplacian"]) == 0
    assert run_command("compare", mesh, "-o", tmp_path / "tables", "--methods", "laplacian").err == ""


def test_a_long_run_tells_of_itself_in_whole_lines_and_on_standard_error_only(mesh, tmp_path, run_command, monkeypatch):
    monkeypatch.setattr(progress, "LINE_INTERVAL", 0.0)
    words = ["smooth", mesh, "-o", tmp_path / "out.vtu", "--method", "laplacian", "--max-iterations", "3"]
    said = run_command(*words, "--tolerance", "0")
    assert [line.split(",")[0] for line in said.err.splitlines()] == [
        f"laplacian: iteration {k} of at most 3" for k in (1, 2, 3)
    ]
    assert "of at most" not in said.out


def test_on_a_terminal_a_line_changes_and_vanishes(monkeypatch, capsys):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(progress, "BAR_DELAY", 0.0)
    run = iterate(
        gallery.make("cube", size=64, scramble=0.3), "laplacian", StoppingCriteria(max_iterations=4, tolerance=0)
    )
    follow(run)
    said = capsys.readouterr()
    assert said.out == ""
    assert "laplacian" in said.err
    assert "\x1b[2K" in said.err  # the line is erased
