"""The commands of the doctor report problems and repair files."""

import numpy as np
import pytest

from hexmend import Mesh, io
from hexmend.cli.main import main
from hexmend.doctor import Finding
from hexmend.mesh.hexahedron import UNIT_CUBE, VOXEL_ORDER
from tests.core.doctor.faulty_meshes import SOUND, blocks, flipped, with_hexes


def test_info_says_where_and_by_which_command(tmp_path, run_command):
    io.write(tmp_path / "blocks.vtu", blocks())
    said = run_command("info", tmp_path / "blocks.vtu", "--doctor").out
    assert "9 pairs of boundary faces lie on each other" in said
    assert "--only coincident-nodes" in said
    assert "nodes 64, " in said
    assert "finds nothing" not in said


def test_repair_writes_the_mended_mesh_and_says_what_was_done(tmp_path, run_command):
    io.write(tmp_path / "blocks.vtu", blocks())
    assert "Done: merge them" in run_command("repair", tmp_path / "blocks.vtu", "-o", tmp_path / "whole.vtu").out
    assert io.read(tmp_path / "whole.vtu").n_nodes == 112
    assert "No problems were found." in run_command("repair", tmp_path / "whole.vtu", "-o", tmp_path / "again.vtu").out
    assert main(["repair", str(tmp_path / "whole.vtu"), "-o", str(tmp_path / "x.vtu"), "--only", "fleas"]) == 2


@pytest.mark.parametrize("also", [[], ["--boundary", "slide"]])
def test_smoothing_names_hexes_that_are_there_twice_and_holds_their_boundary(also, tmp_path, run_command):
    given, out = tmp_path / "twice.vtk", tmp_path / "out.vtk"
    io.write(given, Mesh(UNIT_CUBE + 0.1 * np.sin(np.arange(24)).reshape(8, 3), [range(8), range(8)]))
    assert (
        "1 hex stands on the nodes of others. Run: hexmend repair" in run_command("smooth", given, "-o", out, *also).err
    )
    before, after = io.read(given), io.read(out)
    np.testing.assert_allclose(after.points, before.points, atol=0.2 * bool(also))
    assert io.read(given).topology.boundary.all()
    assert main(["repair", str(given), "-o", str(out), "--only", "duplicate-hexes"]) == 0
    assert io.read(out).n_hexes == 1


def test_nodes_without_a_place_are_put_between_their_neighbours(tmp_path, run_command):
    path = tmp_path / "nan.vtk"
    io.write(path, SOUND, encoding="ascii")
    lines = path.read_text().splitlines()
    row = next(k for k, line in enumerate(lines) if line.startswith("POINTS")) + 1
    numbers = " ".join(lines[row:]).split()
    inner = int(np.flatnonzero(SOUND.free)[0])
    numbers[3 * inner] = "nan"
    path.write_text("\n".join([*lines[:row], " ".join(numbers[: 3 * 64]), *_rest(lines, row)]) + "\n")
    assert "hexmend repair" in run_command("info", path, status=3).err
    assert main(["repair", str(path), "-o", str(tmp_path / "whole.vtk")]) == 0
    np.testing.assert_allclose(io.read(tmp_path / "whole.vtk").points[inner], SOUND.points[inner])


def _rest(lines, row):
    """What comes after the coordinates."""
    return lines[next(k for k, line in enumerate(lines[row:], row) if line[:1].isalpha()) :]


@pytest.mark.parametrize(
    ("mesh", "option"),
    [(flipped(13), ["--as-is"]), (with_hexes(SOUND.hexes[:, VOXEL_ORDER]), [])],
    ids=["flipped", "voxels"],
)
def test_smooth_gives_the_diagnosis_and_the_command(mesh, option, tmp_path, capsys):
    io.write(tmp_path / "bad.vtu", mesh)
    main(["smooth", str(tmp_path / "bad.vtu"), "-o", str(tmp_path / "out.vtu"), "--max-iterations", "1", *option])
    assert (tmp_path / "out.vtu").exists() is not bool(option)  # refused before a node moves
    assert f"Run: hexmend repair {tmp_path / 'bad.vtu'} -o OUT --only" in capsys.readouterr().err


def test_places_have_the_numbers_of_the_file_too(tmp_path, run_command):
    mesh, path = with_hexes(SOUND.hexes[[0, 26]]), tmp_path / "deck.inp"
    io.write(path, mesh.replace(hex_data={"id": np.array([11, 512])}))
    assert "hex 1 (in the file 512)" in run_command("info", path, "--doctor").out
    wide = Finding("parts", 3, "", hexes=np.array([0, 1, 0]))
    assert wide.location_text(2, io.read(path)) == "hexes 0, 1 (in the file 11, 512, ...)"
