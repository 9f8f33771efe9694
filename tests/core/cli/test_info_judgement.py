"""Judgement and next command at the end of `hexmend info`."""

import json
from shlex import quote

import numpy as np
import pytest

from hexmend import Mesh, gallery, io, measure, write
from hexmend.cli.main import main
from hexmend.solver_checks import QUOTED, SOLVERS
from tests.core.doctor.faulty_meshes import bent


def ended(path, mesh, capsys, *words):
    """Write the mesh; return the last line of the report, and the record."""
    io.write(path, mesh)
    assert main(["info", str(path), *words]) == 0
    line = capsys.readouterr().out.splitlines()[-1]
    assert main(["info", str(path), "--json", *words]) == 0
    record = json.loads(capsys.readouterr().out)
    assert line == " Next: ".join(filter(None, [record["judgement"], record["next"]]))
    return line, record


def test_a_good_mesh_is_fit(tmp_path, capsys):
    path = tmp_path / "cube.vtu"
    line, record = ended(path, gallery.make("cube", size=8), capsys)
    fit = "Fit for solving: no hex is invalid or has a scaled Jacobian below 0.2."
    assert line == f"{fit} Next: hexmend {quote(str(path))}"
    assert record["fit"] is True


def test_inverted_hexes_are_counted_and_the_command_mends_them(tmp_path, capsys, run_command):
    path, mesh = tmp_path / "in 1.vtu", gallery.make("cube", size=125, scramble=0.5)
    inverted = int(measure(mesh.points, mesh.hexes).inverted.sum())
    line, record = ended(path, mesh, capsys)
    assert inverted
    assert line.startswith(f"Not fit for solving: {inverted} of 125 hexes ")
    assert (record["fit"], record["next"]) == (False, f"hexmend smooth {quote(str(path))} -o OUT")
    out = tmp_path / "out.vtu"
    run_command("smooth", path, "-o", out)
    assert json.loads(run_command("info", out, "--json").out)["fit"] is True


def test_a_flat_mesh_is_poor(tmp_path, capsys):
    mesh = gallery.make("cube", size=8)
    shear = np.array([[1, 0, 0], [6.0, 1, 0], [0, 0, 1]])  # sine of the angle between edges: 1 / sqrt(37) = 0.16
    line, record = ended(tmp_path / "sheared.vtu", mesh.with_points(mesh.points @ shear), capsys)
    assert line.startswith(
        "Fit for solving, but poor: 8 of 8 hexes have a scaled Jacobian below 0.2. Next: hexmend smooth"
    )
    assert record["fit"] is True


@pytest.mark.parametrize(("solver", "verdict"), [("nastran", "passed"), ("openfoam", "failed")])
def test_a_failed_check_of_the_solver_decides(tmp_path, capsys, solver, verdict):
    mesh = gallery.make("cube", size=8)
    shear = np.array([[1, 0, 0], [30.0, 1, 0], [0, 0, 1]])
    line, record = ended(tmp_path / "sheared.vtu", mesh.with_points(mesh.points @ shear), capsys, "--for", solver)
    assert record["verdict"] == verdict
    assert record["fit"] is (verdict == "passed")
    assert line.startswith("Not fit for solving." if verdict == "failed" else "Fit for solving")


def test_parts_that_are_not_connected_may_be_meant_so(tmp_path, capsys):
    mesh = gallery.make("cube", size=8)
    two = Mesh(np.vstack([mesh.points, mesh.points + [5, 0, 0]]), np.vstack([mesh.hexes, mesh.hexes + mesh.n_nodes]))
    line, record = ended(tmp_path / "assembly.vtu", two, capsys)
    assert line.startswith("Fit for solving, if its parts need not be connected: no hex is invalid")
    assert record["fit"] is True


def test_hexes_that_are_invalid_between_their_corners_are_not_fit(tmp_path, capsys, run_command):
    path, out, repaired = tmp_path / "bent.vtu", tmp_path / "out.vtu", tmp_path / "repaired.vtu"
    line, record = ended(path, bent(inside=True), capsys)
    assert line == f"To be repaired before solving: mid nodes. Next: hexmend repair {quote(str(path))} -o OUT"
    assert record["fit"] is False
    last = run_command("smooth", path, "-o", out, status=4).out.splitlines()[-1]
    assert last.startswith("Not fit for solving: 4 hexes of second order have sound corners, but a Jacobian that is")
    assert last.endswith(f"Next: hexmend repair {quote(str(out))} -o OUT --only mid-nodes")
    assert main(["repair", str(out), "-o", str(repaired), "--only", "mid-nodes"]) == 0
    assert main(["smooth", str(repaired), "-o", str(out)]) == 0
    line, record = ended(tmp_path / "edge.vtu", bent(inside=False), capsys)
    assert line.startswith("Not fit for solving: of the hexes of second order 1 of 8 are invalid")


# `hexmend info --for SOLVER`: the table, the verdict, JSON, and unknown solvers.


@pytest.fixture
def kershaw(tmp_path):
    path = tmp_path / "kershaw.vtk"
    write(path, gallery.make("kershaw", size=1728))
    return path


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_table_and_a_verdict_are_printed(kershaw, solver, run_command):
    printed = run_command("info", kershaw, "--for", solver).out
    declared = SOLVERS[solver]
    assert f"{declared.title}: " in printed
    assert declared.omitted in printed
    assert printed.count(QUOTED) == bool(declared.reservation)
    assert declared.checks[0].name in printed


def test_json_has_the_checks(kershaw, run_command):
    answer = json.loads(run_command("info", kershaw, "--for", "OpenFOAM", "--json").out)
    first = answer["checks"][0]
    assert first["name"] == "non-orthogonality"
    assert first["limit"] == 70
    assert first["value"] == pytest.approx(79.59, abs=0.01)
    assert first["verdict"] == "warning"
    assert answer["verdict"] == "failed"  # skewness
    assert "checks" not in json.loads(run_command("info", kershaw, "--json").out)


def test_an_unknown_solver_is_told_before_the_mesh_is_read(tmp_path, capsys):
    assert main(["info", str(tmp_path / "absent.vtk"), "--for", "fluent"]) != 0
    said = capsys.readouterr().err
    assert "there is no solver 'fluent'" in said
    assert "openfoam" in said
