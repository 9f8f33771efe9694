"""`--goal`: the short form of `--set goal=`, for methods that have goals."""

import pytest

from hexmend.cli.main import main
from hexmend.gallery import make
from hexmend.io import read, write
from hexmend.quality.corner_heights import least_heights


@pytest.fixture
def mesh(tmp_path):
    path = tmp_path / "cube.vtk"
    write(path, make("cube", size=64, scramble=0.3))
    return path


def step_of(path):
    mesh = read(path)
    return least_heights(mesh.points, mesh.hexes).min()


def test_the_goal_is_that_of_the_setting(mesh, tmp_path, run_command):
    short, long = tmp_path / "short.vtk", tmp_path / "long.vtk"
    assert "The minimum time step of the corners" in run_command("smooth", mesh, "-o", short, "--goal", "time-step").out
    assert main(["smooth", str(mesh), "-o", str(long), "--set", "goal=time-step"]) == 0
    assert step_of(short) == step_of(long) > step_of(mesh)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--goal", "time-step", "--set", "goal=shape"], "--goal and --set goal=... set the same value"),
        (["--goal", "shape", "--method", "laplacian"], "only mend has goals, not laplacian"),
        (["--goal", "shape", "--recipe", "absent.toml"], "--recipe names its methods and their values"),
    ],
)
def test_what_contradicts_is_told(mesh, tmp_path, options, said, run_command):
    assert said in run_command("smooth", mesh, "-o", tmp_path / "out.vtk", *options, status=2).err
