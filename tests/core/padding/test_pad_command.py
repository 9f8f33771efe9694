"""The command `hexmend pad`."""

import json

import numpy as np
import pytest

from hexmend import io
from tests.core.grids import grid
from tests.core.padding.conforming import check_layer


@pytest.fixture
def block(tmp_path):
    path = tmp_path / "block.vtu"
    io.write(path, grid(3))
    return path


def test_pad_writes_the_mesh_and_a_report(block, tmp_path, run_command):
    out, report = tmp_path / "out.vtu", tmp_path / "report.json"
    printed = run_command("pad", block, "-o", out, "--json", report).out
    assert "The layer has 54 hexes" in printed
    values = json.loads(report.read_text())
    assert values["before"]["hexes"] == 27
    assert values["after"]["hexes"] == 81
    assert values["layer"]["first_hex"] == 27
    assert values["run"]["method"] == "mend"
    check_layer(io.read(block), io.read(out))


def test_pad_without_mending_says_what_is_inverted(tmp_path, run_command):
    mesh = grid(3)
    points = mesh.points.copy()
    points[0] = [0.9, 0.9, 0.9]
    path, out = tmp_path / "dent.vtu", tmp_path / "out.vtu"
    io.write(path, mesh.with_points(points))
    printed = run_command("pad", path, "-o", out, "--no-mend", "--thickness", "0.1", status=4).out
    assert "inverted. Mend the mesh." in printed
    np.testing.assert_array_equal(io.read(out).points[: mesh.n_nodes], points)


@pytest.mark.parametrize(("options", "status", "words"), [
    (["--set", "wall"], 3, "there is no set 'wall'"),
    (["--thickness", "0"], 2, "expected a positive length"),
    (["--around", "locked"], 3, "no hex of the mesh is locked"),
])  # fmt: skip
def test_errors_leave_no_file(block, tmp_path, run_command, options, status, words):
    out = tmp_path / "out.vtu"
    assert words in run_command("pad", block, "-o", out, *options, status=status).err
    assert not out.exists()
