"""Adapters of other programs: each is given the mesh in its own format, and its result is that of its process."""

import os
import stat
import subprocess
import sys

import numpy as np
import pytest

from hexmend import io
from hexmend.errors import HexmendError
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure, objective, summarise
from hexmend.run import StoppingCriteria, smooth
from hexmend.study.batch.peer_case import PeerCase, bare_mesh
from hexmend.study.peers import PEERS, MissingPeer
from hexmend.study.peers.peer import PythonPeer

COPY = "import shutil; shutil.copy(sys.argv[1], sys.argv[2])"


@pytest.fixture(autouse=True)
def nothing_of_this_machine(monkeypatch):
    for name in ("HEXMEND_PEERS", "HEXMEND_HEXSMOOTHING", "HEXMEND_MESQUITE"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def program(tmp_path, monkeypatch):
    """Install a script in place of the program of a peer."""

    def install(body, variable="HEXMEND_HEXSMOOTHING"):
        path = tmp_path / "smoothing"
        path.write_text(f"#!{sys.executable}\nimport sys\n{body}\n")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        monkeypatch.setenv(variable, str(path))

    return install


def run(name, mesh, seconds=0.0):
    """The positions that a program leaves, and its seconds."""
    peer = PEERS[name]
    after, taken = PeerCase(peer, peer.version()).run(bare_mesh(mesh), seconds)
    return after, taken


@pytest.mark.parametrize(("name", "variable"), [
    ("hexsmoothing", "HEXMEND_HEXSMOOTHING"), ("mesquite", "HEXMEND_MESQUITE"),
])  # fmt: skip
def test_a_program_that_is_missing_says_how_it_is_named(name, variable, monkeypatch):
    monkeypatch.setenv("PATH", "")
    with pytest.raises(MissingPeer, match=f"{variable} names the program"):
        PEERS[name].version()
    monkeypatch.setenv(variable, "/nowhere/smoother")
    with pytest.raises(MissingPeer, match="there is no /nowhere/smoother"):
        PEERS[name].version()


@pytest.mark.parametrize(("python", "message"), [
    (sys.executable, "pip install no_such_package; HEXMEND_PEERS names the Python"),
    ("/nowhere/python", "/nowhere/python cannot be run"),
])  # fmt: skip
def test_a_package_that_is_missing_says_how_it_is_installed(python, message, monkeypatch):
    monkeypatch.setenv("HEXMEND_PEERS", python)
    with pytest.raises(MissingPeer, match=message):
        PythonPeer("gone", "Gone", "nothing", package="no_such_package").version()


def test_another_build_of_a_program_is_another_version(program):
    program(COPY)
    first = PEERS["hexsmoothing"].version()
    assert PEERS["hexsmoothing"].version() == first
    program("sys.exit(1)")
    assert PEERS["hexsmoothing"].version() != first


def test_the_unit_of_length_of_hexsmoothing_is_the_mean_edge(program):
    program(
        "import hexmend as hx\nfrom pathlib import Path\nmesh = hx.read(sys.argv[1])\n"
        "assert abs(mesh.mean_edge_length - 1) < 1e-9, mesh.mean_edge_length\n"
        "assert Path.cwd() == Path(sys.argv[1]).parent.resolve(), Path.cwd()\nhx.write(sys.argv[2], mesh)"
    )
    cube = make("cube", size=27, scramble=0.6)
    given = cube.with_points(1e-3 * cube.points)
    after, taken = run("hexsmoothing", given)
    assert after.points == pytest.approx(given.points, abs=1e-12)
    assert taken > 0


def test_mesquite_is_told_which_nodes_are_fixed(program):
    program(
        "words = open(sys.argv[1]).read().split()\nat = words.index('LOOKUP_TABLE')\n"
        "assert words[words.index('ASCII') + 1] == 'DATASET'\n"
        "fixed = words[at + 2 :]\nassert len(fixed) == 64 and fixed.count('0') == 8, fixed\n" + COPY,
        "HEXMEND_MESQUITE",
    )
    given = make("cube", size=27, scramble=0.6)
    after, _ = run("mesquite", given)
    assert np.array_equal(after.points, given.points)


@pytest.mark.parametrize(("body", "message"), [
    ("sys.exit('it has no licence')", "it has no licence"),
    ("sys.exit(7)", "it ended with status 7 and gave no reason"),
    ("", "it left no mesh: left.mesh: there is no such file"),
    ("open(sys.argv[2], 'w').write('MeshVersionFormatted 2')", "it left no mesh: left.mesh"),
    ("import hexmend as hx; hx.write(sys.argv[2], hx.gallery.make('cube', size=8))", "27"),
])  # fmt: skip
def test_a_program_that_fails_gives_its_reason(program, body, message):
    program(body)
    with pytest.raises(HexmendError, match=message):
        run("hexsmoothing", make("cube", size=27))


def test_a_program_that_takes_too_long_is_ended(program):
    program("import time; time.sleep(1000)")
    with pytest.raises(subprocess.TimeoutExpired):
        run("hexsmoothing", make("cube", size=27), 0.5)


def test_a_package_is_given_the_mesh_and_its_boundary():
    source = (
        "import sys, numpy as np\ndata = np.load(sys.argv[1])\n"
        "assert data['quads'].shape == (54, 4) and data['hexes'].shape == (27, 8)\n"
        "np.savez(sys.argv[2], points=data['points'] + 1)"
    )
    peer = PythonPeer("moved", "Moved", "a translation", package="json", program=source)
    assert peer.version().startswith("json ")
    given = make("cube", size=27)
    after, taken = PeerCase(peer, "1").run(given, 0.0)
    assert after.points == pytest.approx(given.points + 1)
    assert taken > 0


def test_a_package_that_writes_something_else_gives_its_reason():
    peer = PythonPeer("odd", "Odd", "", package="json", program="import sys; open(sys.argv[2], 'w').write('nothing')")
    with pytest.raises(HexmendError, match="it left no positions"):
        PeerCase(peer, "1").run(make("cube", size=27), 0.0)


@pytest.mark.parametrize("name", ["gmsh", "tmop"])
def test_scripts_for_other_pythons_compile(name):
    compile(PEERS[name].program, "program", "exec")


def test_hexmend_as_a_program_is_the_method_with_these_options():
    given = make("bridge-sharp", size=300, scramble=0.3)
    after, _ = run("mend-p1", given)
    stop = StoppingCriteria(max_iterations=1000, keep_last=True)
    expected = smooth(bare_mesh(given), "mend", stop, goal="shape", p=1, layers="free")
    assert after.points == pytest.approx(expected.mesh.points, abs=1e-12)


def test_hexes_that_stay_inverted_are_a_result():
    """The hex is inverted by nodes of the boundary alone, and the program ends with another status."""
    cube = make("cube", size=27)
    points = cube.points.copy()
    corner = int(np.argmin(np.linalg.norm(points - points.min(axis=0), axis=1)))
    points[corner] += 2 * cube.mean_edge_length
    after, _ = run("mend-fixed", cube.with_points(points))
    assert summarise(after).inverted > 0


def test_a_bare_mesh_has_the_nodes_of_its_hexes_and_only_the_boundary_is_fixed():
    cube = make("cube", size=27)
    given = Mesh(np.vstack([[[9.0, 9, 9]], cube.points]), cube.hexes + 1, pinned=np.arange(65) < 60)
    bare = bare_mesh(given)
    assert np.array_equal(bare.points, cube.points)
    assert np.array_equal(bare.hexes, cube.hexes)
    assert np.array_equal(np.flatnonzero(bare.fixed), np.flatnonzero(cube.topology.boundary))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["tmop", "gmsh"])
def test_packages_keep_the_boundary_and_tmop_ends_at_the_objective_of_mend(name, monkeypatch, tmp_path):
    """`HEXMEND_TEST_PEERS` names a Python with the packages; without it this is skipped."""
    python = os.environ.get("HEXMEND_TEST_PEERS")
    if not python:
        pytest.skip("HEXMEND_TEST_PEERS names no Python")
    monkeypatch.setenv("HEXMEND_PEERS", python)
    given = bare_mesh(make("five-side", size=500))
    after, _ = run(name, given)
    assert np.array_equal(after.points[given.fixed], given.points[given.fixed])
    assert not np.array_equal(after.points, given.points)
    ours, _ = run("mend-p1", given)
    values = [objective(measure(mesh.points, mesh.hexes), p=1.0) for mesh in (after, ours)]
    if name == "tmop":
        assert values[0] == pytest.approx(values[1], rel=1e-7)
    assert values[1] <= values[0] * (1 + 1e-9)
    io.write(tmp_path / "after.vtk", after)
