"""`hexmend info --for SOLVER`: the table, the verdict, JSON, and unknown solvers."""

import json

import pytest

from hexmend.cli.main import main
from hexmend.gallery import make
from hexmend.io import write
from hexmend.solver_checks import QUOTED, SOLVERS


@pytest.fixture
def kershaw(tmp_path):
    path = tmp_path / "kershaw.vtk"
    write(path, make("kershaw", size=1728))
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
