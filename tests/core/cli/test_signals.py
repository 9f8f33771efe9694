"""What a signal leaves: the best iterate written, the old file whole, nothing beside them."""

import json
import os
import shlex
import signal
import subprocess
import sys

import pytest

from hexmend import io, summarise
from hexmend.cli.main import main
from tests.core.grids import grid
from tests.patience import PATIENCE

#: The program, which tells of every iteration.
TALKATIVE = """
import signal, sys
signal.signal(signal.SIGHUP, signal.SIG_DFL)  # who runs the tests may ignore it
from hexmend.run import progress
from hexmend.cli.main import main
progress.LINE_INTERVAL = 0.0
sys.exit(main(sys.argv[1:]))
"""
#: The program, which takes its time to write.
SLOW_TO_WRITE = """
import signal, sys, time
signal.signal(signal.SIGHUP, signal.SIG_DFL)
from hexmend.cli.main import main
import hexmend.io
from hexmend.io.base.format import FORMATS
whole = FORMATS["vtu"].write
def write(path, mesh, encoding):
    whole(path, mesh, encoding)
    print("writing", file=sys.stderr, flush=True)
    time.sleep(60)
object.__setattr__(FORMATS["vtu"], "write", write)
sys.exit(main(sys.argv[1:]))
"""


def signalled(program, number, at, *words, again_at=None):
    """Run the program and send it a signal at its first line on stderr that begins with `at`; wait for its end.

    Another one follows at the first line after that which begins with `again_at`.
    """
    done = subprocess.Popen(
        [sys.executable, "-c", program, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    with done:
        for line in done.stderr:
            if line.startswith(at):
                done.send_signal(number)
                if again_at is None:
                    break
                at, again_at = again_at, None
        else:
            pytest.fail(f"the program ended before {at!r}")
        out, err = done.communicate(timeout=PATIENCE / 1000)
    assert "Traceback" not in err
    return done.returncode, out, err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, pytest.param(signal.SIGHUP, marks=pytest.mark.slow)])
def test_what_a_run_reached_is_written_and_nothing_else_is_left(mesh, tmp_path, number):
    out, report = tmp_path / "out.vtu", tmp_path / "report.json"
    words = ["smooth", mesh, "-o", out, "--method", "local-sd", "--json", report]
    endless = ["--tolerance", "0", "--max-iterations", "1000000"]
    status, said, err = signalled(TALKATIVE, number, "local-sd: iteration", *words, *endless)
    assert status == 0
    assert "Interrupted: the result so far is kept." in err
    assert f"Written to {out}" in said
    answer = json.loads(report.read_text())
    assert answer["outcome"] == "stopped"
    assert answer["after"] == summarise(io.read(out)).to_dict()
    assert answer["after"]["q_mean"] > answer["before"]["q_mean"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mesh.vtu", "out.vtu", "report.json"]


@pytest.mark.slow
def test_a_signal_ends_compare_with_a_table_of_what_was_done(mesh, tmp_path):
    words = ["compare", mesh, "-o", tmp_path, "--methods", "laplacian,local-sd,smart-laplacian", "--tolerance", "0"]
    # Laplacian ends at its own limit; the second method is the one that is stopped.
    words += ["--max-iterations", "3000"]
    status, said, err = signalled(TALKATIVE, signal.SIGTERM, "local-sd: iteration", *words)
    assert status == 128 + signal.SIGTERM
    assert "Interrupted" in err
    assert "interrupted" in said
    record = json.loads((tmp_path / "comparison.json").read_text())
    assert record["interrupted"]
    assert [(row["method"], row["outcome"]) for row in record["rows"]] == [
        ("laplacian", "max-iterations"),
        ("local-sd", "stopped"),
    ]


@pytest.mark.parametrize("number", [signal.SIGINT, pytest.param(signal.SIGHUP, marks=pytest.mark.slow)])
def test_an_end_while_writing_leaves_the_old_file_whole(mesh, tmp_path, number):
    before = mesh.read_bytes()
    words = ["smooth", mesh, "-o", mesh, "--method", "laplacian"]
    status, _, err = signalled(SLOW_TO_WRITE, number, "writing", *words, again_at="Writing the result")
    assert status == 128 + number
    assert "hexmend: interrupted" in err
    assert mesh.read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["mesh.vtu"]


@pytest.mark.slow
def test_a_program_that_is_killed_while_writing_leaves_the_old_file_whole(mesh):
    before = mesh.read_bytes()
    signalled(SLOW_TO_WRITE, signal.SIGKILL, "writing", "smooth", mesh, "-o", mesh, "--method", "laplacian")
    assert mesh.read_bytes() == before


@pytest.mark.parametrize("option", ["--json", "--history", "--save-recipe"])
def test_a_report_that_cannot_be_written_is_said_before_the_run(mesh, tmp_path, option, run_command):
    out = tmp_path / "out.vtu"
    for place, said in (
        (mesh, "is the mesh"),
        (tmp_path / "no" / "a.toml", "there is no folder"),
        (tmp_path, "is a folder"),
    ):
        assert said in run_command("smooth", mesh, "-o", out, option, place, status=3).err
    assert not out.exists()


def test_a_mesh_that_cannot_be_written_is_said_before_the_run(mesh, tmp_path, run_command):
    assert main(["smooth", str(mesh), "-o", str(tmp_path / "no" / "out.vtu")]) == 3
    (tmp_path / "folder.vtu").mkdir()
    assert "is a folder" in run_command("smooth", mesh, "-o", tmp_path / "folder.vtu", status=3).err


def test_letters_that_a_terminal_has_not_and_a_full_disk_are_no_traceback(mesh):
    command = [sys.executable, "-m", "hexmend", "info", str(mesh)]
    done = subprocess.run(command, capture_output=True, env={**os.environ, "PYTHONIOENCODING": "ascii"}, check=False)
    assert done.returncode == 0
    assert b"Traceback" not in done.stderr
    if os.path.exists("/dev/full"):
        with open("/dev/full", "w") as full:
            done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        assert done.returncode == 3
        assert "cannot be written" in done.stderr
        assert "Traceback" not in done.stderr


def test_codes_that_steer_a_terminal_are_not_printed(tmp_path, run_command):
    path = tmp_path / "a\x1b[2Jb.vtu"
    path.write_text("no mesh")
    assert "\x1b" not in run_command("info", path, status=3).err


@pytest.mark.parametrize("scale", [1e103, 1e-110, 1e300])
def test_lengths_beyond_numbers_are_one_clear_error(tmp_path, scale, run_command):
    text = "\n".join(f"{x * scale!r} {y * scale!r} {z * scale!r}" for z in (0, 1) for y in (0, 1) for x in (0, 1))
    path = tmp_path / "far.vtk"
    path.write_text(
        "# vtk DataFile Version 2.0\nv\nASCII\nDATASET UNSTRUCTURED_GRID\n"
        f"POINTS 8 double\n{text}\nCELLS 1 9\n8 0 1 3 2 4 5 7 6\nCELL_TYPES 1\n12\n"
    )
    assert "unit of length" in run_command("info", path, "--json", status=3).err


# Files to write that are none: folders, links to themselves, pipes, empty names; and streams that are closed.


@pytest.fixture
def mesh_name(tmp_path, monkeypatch):
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
def test_a_folder_cannot_be_written(words, mesh_name, run_command):
    assert run_command(*words, ".", status=3).err.startswith(
        "hexmend: .: is a folder: expected the name of a file to write."
    )
    assert os.listdir() == [mesh_name]


@pytest.mark.skipif(os.name == "nt", reason="Windows lets few users make links")
@pytest.mark.parametrize("words", WRITING.values(), ids=WRITING)
def test_a_link_to_itself_cannot_be_written(words, mesh_name, run_command):
    os.symlink("loop.vtu", "loop.vtu")
    printed = run_command(*words, "loop.vtu", status=3).err
    assert "loop.vtu: is a link to itself. Remove it, or choose another name." in printed
    assert sorted(os.listdir()) == ["loop.vtu", mesh_name]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names on this system")
@pytest.mark.parametrize("words", [WRITING["smooth"], pytest.param(WRITING["report of a run"], marks=pytest.mark.slow)])
def test_a_named_pipe_is_not_waited_for(words, mesh_name):
    os.mkfifo("pipe.vtu")
    done = run(shlex.join([*words, "pipe.vtu"]))
    assert done.returncode == 3
    assert "pipe.vtu: is a named pipe: expected the name of a file to write." in done.stderr


EMPTY_WORDS = [
    ["info", ""],
    ["smooth", "mesh.vtu", "-o", ""],
    ["smooth", "mesh.vtu", "-o", "out.vtu", "--recipe", ""],
    ["smooth", "mesh.vtu", "-o", "out.vtu", "--fix", ""],
    ["study", "recipe.toml", "mesh.vtu", "--scheduler", ""],
]


@pytest.mark.parametrize("words", EMPTY_WORDS)
def test_empty_words_are_refused(words, mesh_name, run_command):
    assert "is empty: expected a value." in run_command(*words, status=2).err
    assert os.listdir() == [mesh_name]


@pytest.mark.skipif(os.name == "nt", reason="the shell of Windows does not close streams")
@pytest.mark.parametrize("closed", ["<&- >&- 2>&-", pytest.param(">&-", marks=pytest.mark.slow)])
def test_a_command_works_without_the_streams_that_are_closed(closed, mesh_name):
    done = run(f"smooth mesh.vtu -o out.vtu {closed}")
    assert (done.returncode, done.stderr) == (0, "")
    assert io.read("out.vtu").n_hexes == 8
    assert run(f"info mesh.vtu {closed}").returncode == 0
    assert run(f"info missing.vtu {closed}").returncode == 3


def run(words):
    return subprocess.run(
        f"{shlex.quote(sys.executable)} -m hexmend {words}", shell=True, capture_output=True, text=True, timeout=100
    )
