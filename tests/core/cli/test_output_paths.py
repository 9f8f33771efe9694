"""Files to write that are none: folders, links to themselves, pipes, empty names; and streams that are closed."""

import os
import shlex
import subprocess
import sys

import pytest

from hexmend import io
from tests.core.grids import grid


@pytest.fixture
def mesh(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    io.write("mesh.vtu", grid(2))
    return "mesh.vtu"


WRITING = {
    "smooth": ["smooth", "mesh.vtu", "-o"],
    "pad": ["pad", "mesh.vtu", "-o"],
    "repair": ["repair", "mesh.vtu", "-o"],
    "gallery": ["gallery", "cube", "--size", "8", "-o"],
    "report of a run": ["smooth", "mesh.vtu", "-o", "out.vtu", "--json"],
}


@pytest.mark.parametrize("words", WRITING.values(), ids=WRITING)
def test_a_folder_cannot_be_written(words, mesh, run_command):
    assert run_command(*words, ".", status=3).err.startswith(
        "hexmend: .: is a folder: expected the name of a file to write."
    )
    assert os.listdir() == [mesh]


@pytest.mark.skipif(os.name == "nt", reason="Windows lets few users make links")
@pytest.mark.parametrize("words", WRITING.values(), ids=WRITING)
def test_a_link_to_itself_cannot_be_written(words, mesh, run_command):
    os.symlink("loop.vtu", "loop.vtu")
    printed = run_command(*words, "loop.vtu", status=3).err
    assert "loop.vtu: is a link to itself. Remove it, or choose another name." in printed
    assert sorted(os.listdir()) == ["loop.vtu", mesh]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names on this system")
@pytest.mark.parametrize("words", [WRITING["smooth"], pytest.param(WRITING["report of a run"], marks=pytest.mark.slow)])
def test_a_named_pipe_is_not_waited_for(words, mesh):
    os.mkfifo("pipe.vtu")
    done = run(shlex.join([*words, "pipe.vtu"]))
    assert done.returncode == 3
    assert "pipe.vtu: is a named pipe: expected the name of a file to write." in done.stderr


@pytest.mark.parametrize(
    "words",
    [
        ["info", ""],
        ["smooth", "mesh.vtu", "-o", ""],
        ["smooth", "mesh.vtu", "-o", "out.vtu", "--recipe", ""],
        ["smooth", "mesh.vtu", "-o", "out.vtu", "--fix", ""],
        ["study", "recipe.toml", "mesh.vtu", "--scheduler", ""],
    ],
)
def test_empty_words_are_refused(words, mesh, run_command):
    assert "is empty: expected a value." in run_command(*words, status=2).err
    assert os.listdir() == [mesh]


@pytest.mark.skipif(os.name == "nt", reason="the shell of Windows does not close streams")
@pytest.mark.parametrize("closed", ["<&- >&- 2>&-", pytest.param(">&-", marks=pytest.mark.slow)])
def test_a_command_works_without_the_streams_that_are_closed(closed, mesh):
    done = run(f"smooth mesh.vtu -o out.vtu {closed}")
    assert (done.returncode, done.stderr) == (0, "")
    assert io.read("out.vtu").n_hexes == 8
    assert run(f"info mesh.vtu {closed}").returncode == 0
    assert run(f"info missing.vtu {closed}").returncode == 3


def run(words):
    return subprocess.run(
        f"{shlex.quote(sys.executable)} -m hexmend {words}", shell=True, capture_output=True, text=True, timeout=100
    )
