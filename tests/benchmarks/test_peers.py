"""Programs that smooth meshes, compared: a script stands for a program that is not installed."""

import stat
import sys

import pytest

from benchmarks.peers import HEXSMOOTHING, MESQUITE
from benchmarks.peers.compare import compare, run
from benchmarks.peers.hexmend_program import FIXED
from benchmarks.peers.peer import MissingPeer, PythonPeer
from benchmarks.peers.tables import comparison_tables
from hexmend import io
from hexmend.gallery import make


@pytest.fixture
def program(tmp_path, monkeypatch):
    """Install a script that copies the mesh in place of the program of hexsmoothing."""
    path = tmp_path / "smoothing"
    path.write_text(f"#!{sys.executable}\nimport shutil, sys\nshutil.copy(sys.argv[1], sys.argv[2])\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("HEXMEND_HEXSMOOTHING", str(path))
    monkeypatch.setenv("HEXMEND_MESQUITE", "/nowhere/msqshape")
    monkeypatch.setenv("HEXMEND_PEERS", "/nowhere/python")


@pytest.fixture
def meshes(tmp_path):
    """Folder of a mesh with inverted hexes, and of a file that is no mesh."""
    (tmp_path / "meshes").mkdir()
    io.write(tmp_path / "meshes/bridge.vtk", make("bridge-sharp", size=256, scramble=0.6))
    (tmp_path / "meshes/torn.vtk").write_text("# vtk DataFile Version 3.0\n")
    return tmp_path / "meshes"


@pytest.mark.slow
def test_every_mesh_has_a_row_for_each_installed_program(program, meshes):
    record = compare(sorted(meshes.iterdir()), [FIXED, HEXSMOOTHING, MESQUITE], 60)
    ours, theirs, *torn = record.rows
    assert record.missing.keys() == {"mesquite"}
    assert (ours["status"], theirs["status"]) == ("done", "done")
    assert [row["status"] for row in torn] == ["unreadable"] * 2
    assert ours["inverted_before"] == theirs["inverted_after"] > ours["inverted_after"] == 0
    assert ours["boundary_distance"] == 0
    assert theirs["boundary_distance"] == pytest.approx(0, abs=1e-9)
    programs, meshes, *_ = comparison_tables(record)
    assert [row[1] for row in programs.rows] == ["1 of 2", "1 of 2", "not installed"]
    assert {len(row) for row in meshes.rows} == {len(meshes.head)}
    assert meshes.rows[1][-1] == torn[0]["reason"]


def test_a_program_that_is_missing_says_how_it_is_named(program):
    with pytest.raises(MissingPeer, match="there is no /nowhere/msqshape; HEXMEND_MESQUITE names the program"):
        MESQUITE.version()
    with pytest.raises(MissingPeer, match="/nowhere/python cannot be run"):
        PythonPeer("gone", "Gone", "nothing", package="no_such_package").version()


@pytest.mark.slow
def test_tables_replace_what_is_between_the_marks_of_a_page(program, meshes, tmp_path):
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- collection -->\nold\n<!-- end -->\nafter\n")
    run([str(meshes)], 60, str(page))
    text = page.read_text("utf-8")
    assert text.startswith("before\n<!-- collection -->\nStarted on: ")
    assert text.endswith("\n<!-- end -->\nafter\n")
    assert "bridge.vtk" in text
    assert "\nold\n" not in text
