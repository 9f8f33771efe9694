"""The benchmark against other programs runs those that are installed and names the others."""

import stat
import sys

import pytest

from hexmend.gallery import make
from hexmend.study import peers
from hexmend.study.peers import PEERS
from hexmend.study.peers.programs import GMSH, TMOP

HEX = "Hexmend, mend"


@pytest.fixture(autouse=True)
def one_small_mesh(monkeypatch):
    """Nothing of this machine's: neither meshes nor programs."""
    monkeypatch.setattr(peers, "MESHES", [("cube", 27, 0.6)])
    for name in ("HEXMEND_MESHES", "HEXMEND_PEERS", "HEXMEND_HEXSMOOTHING", "HEXMEND_PEERS_SECONDS"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(peers, "PROGRAMS", {key: peers.PROGRAMS[key] for key in (HEX, "hexsmoothing")})


@pytest.fixture
def program(tmp_path, monkeypatch):
    """Install what stands for the program of the hexsmoothing project."""

    def install(body):
        path = tmp_path / "smoothing"
        path.write_text(f"#!{sys.executable}\nimport sys\n{body}\n")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        monkeypatch.setenv("HEXMEND_HEXSMOOTHING", str(path))

    return install


def scaled(mesh, factor):
    return mesh.with_points(mesh.points * factor)


def rows():
    figures = PEERS.measure()
    return {row["program"]: row for row in figures["rows"]}, PEERS.lines(figures)


def test_missing_programs_are_named(monkeypatch):
    monkeypatch.setenv("PATH", "")
    monkeypatch.setitem(peers.PROGRAMS, "Gone", peers.PythonPeer("no_such_package", GMSH))
    found, lines = rows()
    assert set(found) == {"before", HEX}
    assert "HEXMEND_HEXSMOOTHING names the program" in lines[-2]
    assert "pip install no_such_package" in lines[-1]


def test_programs_are_measured_by_their_results(program):
    program(
        "import hexmend as hx\nmesh = hx.read(sys.argv[1])\n"
        "hx.write(sys.argv[2], hx.smooth(mesh, 'mend', hx.StoppingCriteria(max_iterations=1000), goal='shape').mesh)"
    )
    found, lines = rows()
    ours, others = found[HEX], found["hexsmoothing"]
    assert found["before"]["inverted"] > 0 == ours["inverted"]
    for key in ("inverted", "q_min", "q_mean", "scaled_jacobian_min"):
        assert others[key] == pytest.approx(ours[key], abs=1e-9)
    assert others["seconds"] > 0
    assert not any("moved the boundary" in line for line in lines)


def test_the_unit_of_length_is_the_mean_edge(program, monkeypatch):
    """hexsmoothing's method depends on the unit; what it leaves beside the mesh does not stay."""
    monkeypatch.setattr(peers, "make", lambda *args, **kwargs: scaled(make(*args, **kwargs), 1e-3))
    program(
        "import hexmend as hx\nfrom pathlib import Path\nmesh = hx.read(sys.argv[1])\n"
        "assert abs(mesh.mean_edge_length - 1) < 1e-9, mesh.mean_edge_length\n"
        "assert Path.cwd() == Path(sys.argv[1]).parent.resolve(), Path.cwd()\nhx.write(sys.argv[2], mesh)"
    )
    found, _ = rows()
    assert found["hexsmoothing"]["q_mean"] == pytest.approx(found["before"]["q_mean"], abs=1e-9)
    assert found["hexsmoothing"]["boundary_moved"] < 1e-9


def test_a_moved_boundary_is_reported(program):
    program(
        "import hexmend as hx\nmesh = hx.read(sys.argv[1])\nhx.write(sys.argv[2], mesh.with_points(mesh.points * 1.1))"
    )
    _, lines = rows()
    assert [line.split()[0] for line in lines if "moved the boundary" in line] == ["hexsmoothing"]


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("sys.exit('it has no licence')", "it has no licence"),
        ("sys.exit(7)", "it ended with status 7"),
        ("", "no such file"),
    ],
)
def test_a_program_that_fails_has_a_row_with_the_reason(program, body, said):
    program(body)
    found, lines = rows()
    assert said in found["hexsmoothing"]["failure"]
    assert any(said in line for line in lines)


def test_a_program_that_takes_too_long_is_ended(program, monkeypatch):
    program("import time; time.sleep(1000)")
    monkeypatch.setenv("HEXMEND_PEERS_SECONDS", "0.5")
    found, _ = rows()
    assert "not done in" in found["hexsmoothing"]["failure"]


@pytest.mark.parametrize("source", [GMSH, TMOP])
def test_scripts_for_other_pythons_compile(source):
    compile(source, "program", "exec")


def test_a_package_of_another_python_is_run_on_the_mesh_and_its_boundary(tmp_path, monkeypatch):
    source = (
        "import sys, numpy as np\ndata = np.load(sys.argv[1])\n"
        "assert len(data['quads']) == 54\n"
        "np.savez(sys.argv[2], points=data['points'], seconds=2.5)"
    )
    monkeypatch.setitem(peers.PROGRAMS, "Still", peers.PythonPeer("json", source))
    found, _ = rows()
    assert found["Still"]["seconds"] == 2.5
    assert found["Still"]["q_mean"] == found["before"]["q_mean"]
