"""A case that is written keeps all but its points, or is a new polyMesh as OpenFOAM wants it."""

import gzip
import os

import numpy as np
import pytest

from hexmend import Cells, FileError, Mesh, io
from hexmend.io import Original
from hexmend.io.formats.openfoam.case import find_case
from hexmend.io.formats.openfoam.reader import read_poly_mesh
from tests.core.grids import grid, scrambled
from tests.core.io.formats.openfoam.foam_cases import write_cube
from tests.core.io.kept import read_back

ENCODINGS = [None, (32, 64), (64, 32)]


def moved(mesh: Mesh) -> Mesh:
    """The mesh with other points, which binary and decimals of all kinds hold but for 32 bits."""
    return mesh.with_points(mesh.points * [1, 1, 1.1] + [1 / 3, 0, 1e-17])


def tree(folder):
    """The content of all files below a folder."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


@pytest.mark.parametrize(
    ("place", "binary", "compressed"),
    [("copy", None, True), ("in place", None, False), ("copy", (32, 64), False), ("in place", (64, 32), True)],
)
def test_points_alone_are_replaced(place, binary, compressed, tmp_path):
    mesh = write_cube(tmp_path / "cube", binary=binary, compressed=compressed)
    for name in ("0/U", "system/controlDict", "constant/g", "cube.foam"):
        (tmp_path / "cube" / name).parent.mkdir(exist_ok=True)
        (tmp_path / "cube" / name).write_bytes(b"of the case // " + name.encode())
    before, given = tree(tmp_path / "cube"), io.read(tmp_path / "cube")
    out = tmp_path / ("cube" if place == "in place" else "mended")
    written = io.write_as_given(out, moved(given), Original(tmp_path / "cube", given))
    assert (written.replaced, written.in_place) == (True, place == "in place")
    after, name = tree(out), f"constant/polyMesh/points{'.gz' if compressed else ''}"
    assert {key: data for key, data in after.items() if key != name} == {
        key: data for key, data in before.items() if key != name
    }
    expected = moved(given).points.astype("f4" if binary and binary[1] == 32 else "f8")
    np.testing.assert_array_equal(io.read(out).points, expected)
    unpacked = [gzip.decompress(data[name]) if compressed else data[name] for data in (before, after)]
    head = [data.split(b"8\n(")[0] for data in unpacked]
    assert head[0] == head[1]
    assert find_case(out).points.parent.name == mesh.name
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted({"cube", out.name})


def test_results_are_not_copied_and_it_is_said(tmp_path):
    write_cube(tmp_path / "cube")
    for name in ("0", "0.5", "10", "processor0", "postProcessing"):
        (tmp_path / "cube" / name).mkdir()
        (tmp_path / "cube" / name / "U").write_text("field")
    given = io.read(tmp_path / "cube")
    written = io.write_as_given(tmp_path / "copy", given, Original(tmp_path / "cube", given))
    assert written.notes == ("The results of the case (0.5, 10, postProcessing, processor0) are not copied.",)
    assert sorted(os.listdir(tmp_path / "copy")) == ["0", "constant"]


def test_links_of_a_case_do_not_lead_back_to_it(tmp_path):
    """A mesh that the case has by a link is copied, since its points change."""
    write_cube(tmp_path / "base")
    (tmp_path / "case/constant").mkdir(parents=True)
    (tmp_path / "case/constant/polyMesh").symlink_to(tmp_path / "base/constant/polyMesh")
    (tmp_path / "case/gone").symlink_to(tmp_path / "nothing")
    given, before = io.read(tmp_path / "case"), tree(tmp_path / "base")
    io.write(tmp_path / "copy", moved(given), like=tmp_path / "case")
    assert tree(tmp_path / "base") == before
    np.testing.assert_array_equal(io.read(tmp_path / "copy").points, moved(given).points)
    assert not (tmp_path / "copy/constant/polyMesh").is_symlink()


def test_a_later_time_is_written_as_the_mesh_of_the_copy(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    (tmp_path / "cube/0.5/polyMesh").mkdir(parents=True)
    (tmp_path / "cube/0.5/polyMesh/points").write_bytes((mesh / "points").read_bytes().replace(b"1.0", b"1.5"))
    later, before = io.read(tmp_path / "cube/0.5"), tree(mesh)
    assert read_back(tmp_path / "copy", later, like=tmp_path / "cube/0.5").points.max() == 1.5
    io.write(tmp_path / "cube/0.5", moved(later), like=tmp_path / "cube/0.5")
    np.testing.assert_array_equal(io.read(tmp_path / "cube/0.5").points, moved(later).points)
    assert tree(mesh) == before


def test_a_folder_with_other_files_is_left_alone(tmp_path):
    write_cube(tmp_path / "cube")
    (tmp_path / "other").mkdir()
    (tmp_path / "other/precious").write_text("kept")
    given = io.read(tmp_path / "cube")
    with pytest.raises(FileError, match="holds other files, but no OpenFOAM mesh"):
        io.write(tmp_path / "other", given, like=tmp_path / "cube")
    assert tree(tmp_path / "other") == {"precious": b"kept"}
    assert sorted(os.listdir(tmp_path)) == ["cube", "other"]


def test_a_case_with_another_mesh_is_left_alone(tmp_path):
    write_cube(tmp_path / "cube")
    io.write(tmp_path / "grid/grid.foam", grid(2))
    before = tree(tmp_path / "grid")
    for like in (None, tmp_path / "cube"):
        with pytest.raises(FileError, match="has another mesh"):
            io.write(tmp_path / "grid", io.read(tmp_path / "cube"), like=like)
    assert tree(tmp_path / "grid") == before


def test_a_mesh_of_another_format_gives_its_points_to_a_case_with_the_same_mesh(tmp_path):
    io.write(tmp_path / "grid/grid.foam", grid(2))
    before, mesh = tree(tmp_path / "grid"), read_back(tmp_path / "grid.vtk", scrambled(io.read(tmp_path / "grid"), 0.2))
    io.write(tmp_path / "grid", mesh)
    after = tree(tmp_path / "grid")
    assert [name for name in before if before[name] != after[name]] == ["constant/polyMesh/points"]
    np.testing.assert_array_equal(io.read(tmp_path / "grid").points, mesh.points)


def test_a_case_that_changed_meanwhile_is_not_overwritten(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    given = io.read(tmp_path / "cube")
    (mesh / "points").write_bytes((mesh / "points").read_bytes().replace(b"1.0", b"1.5"))
    before = tree(tmp_path / "cube")
    with pytest.raises(FileError, match="has changed since it was read"):
        io.write_as_given(tmp_path / "cube", moved(given), Original(tmp_path / "cube", given))
    assert tree(tmp_path / "cube") == before


@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_a_new_mesh_keeps_the_rules_of_openfoam(encoding, tmp_path):
    mesh = scrambled(grid(3, 2, 4), 0.2)
    sides = {"inlet": np.array([[0, 0], [3, 0]]), "inner": np.array([[0, 1], [4, 1]]), "wall": np.array([[2, 1]])}
    named = mesh.replace(side_sets=sides, side_set_types={"wall": "wall", "inlet": "mappedWall"})
    io.write(tmp_path / "case/case.foam", named, encoding=encoding)
    poly = read_poly_mesh(find_case(tmp_path / "case"))
    assert (tmp_path / "case/case.foam").read_bytes() == b""
    inner = len(poly.neighbour)
    assert (poly.owner[:inner] < poly.neighbour).all()
    rows = list(zip(poly.owner[:inner].tolist(), poly.neighbour.tolist(), strict=True))
    assert rows == sorted(rows)
    assert [patch.first for patch in poly.patches] == np.cumsum(
        [inner, *(patch.count for patch in poly.patches)]
    ).tolist()[:-1]
    assert sum(patch.count for patch in poly.patches) + inner == len(poly.owner)
    assert [(patch.name, patch.type) for patch in poly.patches] == [
        ("inlet", "patch"), ("wall", "wall"), ("defaultFaces", "patch"),
    ]  # fmt: skip
    corners = poly.points[poly.faces.values.reshape(-1, 4)]
    area = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    closed, volume = np.zeros((mesh.n_hexes, 3)), np.zeros(mesh.n_hexes)
    flow = np.einsum("fi,fi->f", area, corners.mean(axis=1)) / 3
    np.add.at(closed, poly.owner, area)
    np.add.at(closed, poly.neighbour, -area[:inner])
    np.add.at(volume, poly.owner, flow)
    np.add.at(volume, poly.neighbour, -flow[:inner])
    assert np.abs(closed).max() < 1e-12
    assert (volume > 0).all()
    back = io.read(tmp_path / "case")
    assert back.side_sets["inner"].tolist() == sides["inner"].tolist()
    assert back.side_sets["inlet"].tolist() == sides["inlet"].tolist()


def test_cyclic_patches_keep_the_order_of_their_faces(tmp_path):
    mesh = grid(3, 1, 2)
    low, high = np.array([[3, 0], [0, 0]]), np.array([[5, 1], [2, 1]])
    named = mesh.replace(
        side_sets={"high": high, "low": low},
        side_set_types={"low": "cyclic", "high": "cyclic"},
        periodic_pairs=[("low", "high")],
    )
    io.write(tmp_path / "case/case.foam", named)
    back = io.read(tmp_path / "case")
    assert (back.side_sets["low"].tolist(), back.side_sets["high"].tolist()) == (low.tolist(), high.tolist())
    assert set(back.periodic_pairs[0]) == {"low", "high"}


def test_sets_of_quads_are_patches_and_names_are_words_of_openfoam(tmp_path):
    bare = grid(2)
    faces = bare.topology.boundary_faces
    quads = Cells("quad", faces[:5], sets={"in let (1)": np.array([0, 2]), "wall": np.array([1])})
    mesh = Mesh(bare.points, bare.hexes, cells=(quads,), hex_sets={"a b": np.array([1, 3])})
    assert any("in let (1)" in part for part in io.unsupported_data(tmp_path / "case/case.foam", mesh))
    io.write(tmp_path / "case/case.foam", mesh)
    back = io.read(tmp_path / "case")
    assert {name: len(rows) for name, rows in back.side_sets.items()} == {"in_let_1": 2, "wall": 1, "defaultFaces": 21}
    assert back.hex_sets["a_b"].tolist() == [1, 3]


def test_a_mesh_that_is_no_polyhedra_is_refused(tmp_path):
    mesh = grid(1)
    collapsed = Mesh(mesh.points, [[0, 0, 3, 2, 4, 5, 7, 6]])
    with pytest.raises(FileError, match="hex 0 has a node twice"):
        io.write(tmp_path / "case/case.foam", collapsed)
    thrice = Mesh(np.vstack([mesh.points, mesh.points[4:] + [0, 0, 1], mesh.points[4:] + [0, 0, 2]]), [
        mesh.hexes[0], [*mesh.hexes[0][4:], 8, 9, 11, 10], [*mesh.hexes[0][4:], 12, 13, 15, 14],
    ])  # fmt: skip
    with pytest.raises(FileError, match="belongs to 3 cells"):
        io.write(tmp_path / "other/case.foam", thrice)


def test_a_name_without_a_suffix_is_a_case_only_for_a_case(tmp_path):
    with pytest.raises(FileError, match="the name has no suffix"):
        io.write(tmp_path / "case", grid(1))
    io.write(tmp_path / "case/a.foam", grid(1))
    assert io.read(tmp_path / "case").n_hexes == 1
