"""Cases of OpenFOAM, as text and binary, become meshes with patches and zones as sets."""

import gzip
import shutil

import numpy as np
import pytest

from hexmend import FileError, io, smooth, summarise
from hexmend.io.formats.openfoam import times
from hexmend.io.formats.openfoam.foam_text import read_times
from hexmend.mesh.hexahedron import FACES
from hexmend.study.batch.task import content_hash
from tests.core.grids import grid
from tests.core.io.formats.openfoam.foam_cases import (
    CUBE,
    CUBE_FACES,
    ascii_list,
    binary_list,
    boundary,
    header,
    write_case,
    write_cube,
)
from tests.core.io.kept import assert_refused
from tests.core.linear_motions import scrambled_within
from tests.core.smoothers.test_hanging_nodes import octree

ENCODINGS = [None, (32, 64), (64, 64), (32, 32), (64, 32)]
#: A cube and a second one behind it in x, which is cut into two wedges, or has another kind of cell.
TWO = [*CUBE, *((2.0, y, z) for z in (0.0, 1.0) for y in (0.0, 1.0))]


@pytest.mark.parametrize(
    ("binary", "order", "compressed"),
    [
        (binary, order, k % 2 == 1)
        for k, (binary, order) in enumerate(zip(2 * ENCODINGS, 5 * ["LSB", "MSB"], strict=True))
    ],
)
def test_a_case_is_read_in_every_encoding(binary, order, compressed, tmp_path):
    write_cube(tmp_path / "cube", binary=binary, order=order, compressed=compressed)
    mesh = io.read(tmp_path / "cube")
    assert mesh.name == "cube"
    np.testing.assert_array_equal(mesh.points, CUBE)
    assert mesh.hexes.tolist() == [[0, 1, 3, 2, 4, 5, 7, 6]]
    assert summarise(mesh).q_min == pytest.approx(1)
    assert dict(mesh.side_set_types) == {"walls": "wall", "ends": "patch"}


def test_patches_are_side_sets_on_the_right_faces(tmp_path):
    write_cube(tmp_path / "cube")
    mesh = io.read(tmp_path / "cube")
    for name, faces in (("walls", CUBE_FACES[:4]), ("ends", CUBE_FACES[4:])):
        rows = mesh.side_sets[name]
        found = mesh.hexes[rows[:, :1], FACES[rows[:, 1]]]
        assert [sorted(face) for face in found.tolist()] == [sorted(face) for face in faces]


@pytest.mark.parametrize("named", ["", "constant", "constant/polyMesh", "constant/polyMesh/boundary", "cube.foam"])
def test_a_case_is_named_by_its_folders_and_files(named, tmp_path):
    write_cube(tmp_path / "cube")
    (tmp_path / "cube" / "cube.foam").touch()
    assert io.read(tmp_path / "cube" / named).name == "cube"


def test_a_study_knows_a_case_by_the_files_of_its_mesh(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    before = content_hash(tmp_path / "cube")
    (tmp_path / "cube/0").mkdir()
    assert content_hash(mesh / "points") == before
    (mesh / "owner").write_bytes((mesh / "owner").read_bytes() + b"// a comment")
    assert content_hash(tmp_path / "cube") != before


def test_times_with_moved_points_are_listed_and_read(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    for time in ("0.002", "0.01", "10", "0.5"):
        folder = tmp_path / "cube" / time
        folder.mkdir()
        if time != "0.5":
            (folder / "polyMesh").mkdir()
            moved = header("vectorField", "points") + ascii_list([(x * float(time), y, z) for x, y, z in CUBE])
            (folder / "polyMesh/points").write_bytes(moved)
    assert [time for time, _ in times(mesh)] == [0.002, 0.01, 10]
    assert io.read(tmp_path / "cube/0.01").points.max(axis=0).tolist() == [0.01, 1, 1]
    assert io.read(times(mesh)[2][1]).points.max() == 10
    assert io.read(tmp_path / "cube").points.max() == 1


def test_prisms_are_read_beside_hexes(tmp_path):
    """A hex with two wedges behind it: faces of 3 and 4 nodes."""
    faces = [
        (1, 3, 7, 5), (3, 7, 10, 8),  # between hex and wedge, and between the wedges
        (0, 4, 6, 2), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6),
        (1, 8, 10, 5), (1, 3, 8), (5, 10, 7),
        (7, 11, 9, 3), (8, 9, 11, 10), (3, 9, 8), (7, 10, 11),
    ]  # fmt: skip
    owner = [0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2]
    patches = {"hex": ("patch", 2, 5), "wedges": ("wall", 7, 7)}
    write_case(tmp_path / "two", TWO, faces, owner, [1, 2], patches)
    mesh = io.read(tmp_path / "two")
    assert mesh.n_hexes == 1
    assert {cells.kind: len(cells.nodes) for cells in mesh.cells} == {"wedge": 2, "triangle": 4, "quad": 3}
    assert [mesh.pinned, mesh.n_elements] == [None, 3]
    assert not mesh.quality().inverted
    assert [set(cells.sets) for cells in mesh.cells if cells.kind != "wedge"] == [{"wedges"}, {"wedges"}]
    assert mesh.hex_data["id"].tolist() == [0]


def test_cells_with_hanging_nodes_stay_in_the_case_and_their_nodes_are_fixed(tmp_path):
    """A face of the second cell is cut in two, as beside a refined cell."""
    points = [*TWO, (2.0, 0.5, 0.0), (2.0, 0.5, 1.0)]
    faces = [
        (1, 3, 7, 5),
        (0, 4, 6, 2), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6),
        (1, 8, 10, 5), (3, 7, 11, 9), (1, 3, 9, 12, 8), (5, 10, 13, 11, 7), (8, 12, 13, 10), (12, 9, 11, 13),
    ]  # fmt: skip
    write_case(tmp_path / "two", points, faces, [0] * 6 + [1] * 6, [1], {"all": ("patch", 1, 11)})
    mesh = io.read(tmp_path / "two")
    assert mesh.n_hexes == 1
    assert {cells.kind for cells in mesh.cells} == {"quad"}
    assert mesh.pinned.nonzero()[0].tolist() == [1, 3, 5, 7, 8, 9, 10, 11, 12, 13]
    assert "1 polyhedron is kept in the case alone" in " ".join(mesh.notes)
    out = tmp_path / "copy"
    io.write(out, mesh, like=tmp_path / "two")
    for name in ("faces", "owner", "neighbour", "boundary"):
        path = f"constant/polyMesh/{name}"
        assert (out / path).read_bytes() == (tmp_path / "two" / path).read_bytes()


def split_loops(mesh):
    """Faces as OpenFOAM has them, with their cells: hanging nodes are in their edges, and none covers others."""
    middle = {frozenset(row[1:].tolist()): int(row[0]) for row in mesh.topology.hanging}
    sides = {}
    for cell, row in enumerate(mesh.hexes[:, FACES].tolist()):
        for face in row:
            sides.setdefault(frozenset(face), []).append((cell, face))
    coarse = {middle[face]: sides.pop(face)[0][0] for face in middle if face in sides}
    loops = []
    for (cell, face), *others in sides.values():
        ends = zip(face, face[1:] + face[:1], strict=True)
        loop = [node for a, b in ends for node in (a, middle.get(frozenset((a, b)))) if node is not None]
        across = [other for other, _ in others] or [coarse[node] for node in face if node in coarse]
        loops.append((loop, [cell, *across]))
    return loops


def test_cells_beside_refined_ones_are_hexes_whose_hanging_nodes_move_with_them(tmp_path):
    perfect = octree()
    mesh = scrambled_within(perfect, 0.1)
    loops = split_loops(mesh)
    inner = [(loop, cells) for loop, cells in loops if len(cells) == 2]
    outer = [(loop, cells) for loop, cells in loops if len(cells) == 1]
    turned = [(loop[::-1], cells[::-1]) if cells[0] > cells[1] else (loop, cells) for loop, cells in inner]
    faces, owner = [loop for loop, _ in turned + outer], [cells[0] for _, cells in turned + outer]
    patch = {"walls": ("wall", len(inner), len(outer))}
    write_case(tmp_path / "case", mesh.points.tolist(), faces, owner, [cells[1] for _, cells in turned], patch)
    read = io.read(tmp_path / "case")
    assert max(map(len, faces)) > 4
    assert [read.n_hexes, read.notes, read.pinned] == [mesh.n_hexes, (), None]
    np.testing.assert_array_equal(np.sort(read.hexes, axis=1), np.sort(mesh.hexes, axis=1))
    np.testing.assert_array_equal(read.topology.hanging[:, 0], mesh.topology.hanging[:, 0])
    assert len(read.side_sets["walls"]) == len(outer)
    after = smooth(read, "mend").mesh
    np.testing.assert_allclose(after.points, perfect.points, atol=1e-6)


@pytest.mark.parametrize("binary", [False, True])
def test_zones_are_sets(binary, tmp_path):
    mesh = write_cube(tmp_path / "cube")
    encoding = "binary" if binary else "ascii"

    def labels(values):
        return binary_list(values, "<i4") if binary else b"%d(%s)" % (len(values), b" ".join(b"%d" % v for v in values))

    flips = b"2\n(\x00\x01)" if binary else b"2(0 1)"
    parts = {
        "cellZones": b"rotor { type cellZone; cellLabels List<label> " + labels([0]) + b"; }",
        "faceZones": b"lid { type faceZone; faceLabels List<label> " + labels([5]) + b"; flipMap List<bool> 1{0}; }\n"
        b"sides { type faceZone; faceLabels List<label> " + labels([0, 1]) + b"; flipMap List<bool> " + flips + b"; }",
        "pointZones": b"// some\nprobe { type pointZone; pointLabels List<label> " + labels([3, 4, 7]) + b"; }",
    }
    for name, text in parts.items():
        count = b"2" if name == "faceZones" else b"1"
        (mesh / name).write_bytes(header("regIOobject", name, encoding) + count + b"\n(\n" + text + b"\n)\n")
    found = io.read(tmp_path / "cube")
    assert {name: nodes.tolist() for name, nodes in found.node_sets.items()} == {"probe": [3, 4, 7]}
    assert {name: hexes.tolist() for name, hexes in found.hex_sets.items()} == {"rotor": [0]}
    assert found.side_sets["lid"].tolist() == [[0, 5]]
    assert found.side_sets["sides"].tolist() == [[0, 0], [0, 1]]


def test_cyclic_patches_are_periodic_pairs(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    text = (
        header("polyBoundaryMesh", "boundary")
        + b"""3
    (
        low { type cyclic; neighbourPatch high; nFaces 1; startFace 0; }
        high { type cyclic; neighbourPatch low; nFaces 1; startFace 1; matchTolerance 1e-4; transform { type none; } }
        rest { type patch; nFaces 4; startFace 2; physicalType "in let"; }
    )"""
    )
    (mesh / "boundary").write_bytes(text)
    found = io.read(tmp_path / "cube")
    assert found.periodic_pairs == (("low", "high"),)
    assert found.replace(name="other").with_points(found.points).periodic_pairs == found.periodic_pairs


def test_patches_may_be_included(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    walls = boundary({"walls": ("wall", 0, 4)}).split(b"(\n", 1)[1].rstrip().removesuffix(b")")
    (mesh / "walls.inc").write_bytes(walls)
    ends = b"ends { type patch; nFaces 2; startFace 4; }"
    whole = header("polyBoundaryMesh", "boundary") + b'2\n(\n#include "walls.inc"\n#includeIfPresent "none"\n'
    (mesh / "boundary").write_bytes(whole + ends + b"\n)\n")
    assert dict(io.read(tmp_path / "cube").side_set_types) == {"walls": "wall", "ends": "patch"}


def test_comments_among_numbers_and_uniform_lists_are_read(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    owner = header("labelList", "owner") + b"6{0} // all of one cell (one)\n"
    (mesh / "owner").write_bytes(owner)
    points = (mesh / "points").read_bytes().replace(b"(0.0 0.0 0.0)", b"(0 /* ( */ 0 0) // the first (of 8)")
    (mesh / "points").write_bytes(points)
    np.testing.assert_array_equal(io.read(tmp_path / "cube").points, CUBE)


def test_a_neighbour_list_of_old_versions_has_an_entry_for_every_face(tmp_path):
    mesh = grid(2)
    io.write(tmp_path / "case/case.foam", mesh)
    path = tmp_path / "case/constant/polyMesh/neighbour"
    head, body = path.read_bytes().split(b"}\n", 1)
    labels = body.split(b"(")[1].split(b")")[0].split()
    labels += [b"-1"] * (36 - len(labels))
    path.write_bytes(head + b"}\n36\n(\n" + b"\n".join(labels) + b"\n)\n")
    np.testing.assert_array_equal(io.read(tmp_path / "case").hexes, mesh.hexes)


def test_real_cases_are_read(real_mesh):
    piston, plate = io.read(real_mesh("piston")), io.read(real_mesh("flat_plate"))
    assert (piston.n_hexes, list(piston.side_sets)) == (27544, ["piston", "liner", "cylinderHead"])
    assert sum(map(len, piston.side_sets.values())) == len(piston.topology.boundary_faces)
    assert (plate.n_hexes, plate.side_set_types["frontAndBack"]) == (1800, "empty")


def test_a_case_that_is_divided_or_not_built_or_none_is_refused_with_advice(tmp_path):
    write_cube(tmp_path / "cube/processor0")
    with pytest.raises(io.files.FileError, match=r"divided among processes .* Run reconstructParMesh .*processor0\."):
        io.read(tmp_path / "cube")
    shutil.rmtree(tmp_path / "cube/processor0")
    with pytest.raises(io.files.FileError, match="is a folder: expected a mesh file or the folder of an OpenFOAM case"):
        io.read(tmp_path / "cube")
    (tmp_path / "cube" / "cube.foam").touch()
    with pytest.raises(io.files.FileError, match="there is no OpenFOAM mesh next to it"):
        io.read(tmp_path / "cube" / "cube.foam")
    (tmp_path / "cube/system").mkdir()
    for name in ("controlDict", "blockMeshDict"):
        (tmp_path / "cube/system" / name).touch()
    for path in (tmp_path / "cube", tmp_path / "cube" / "cube.foam"):
        with pytest.raises(io.files.FileError, match=r"its mesh is not built\. Run blockMesh in it\."):
            io.read(path)


def test_the_times_of_a_region_are_its_own(tmp_path):
    write_cube(tmp_path / "cube")
    (tmp_path / "cube/constant/fluid").mkdir()
    (tmp_path / "cube/constant/polyMesh").rename(tmp_path / "cube/constant/fluid/polyMesh")
    for folder in ("1/polyMesh", "2/fluid/polyMesh"):
        (tmp_path / "cube" / folder).mkdir(parents=True)
        shutil.copy(tmp_path / "cube/constant/fluid/polyMesh/points", tmp_path / "cube" / folder)
    region = tmp_path / "cube/constant/fluid/polyMesh"
    assert [time for time, _ in times(region)] == [2]
    (read,) = read_times(region, 8)
    np.testing.assert_array_equal(read.points, CUBE)


def test_points_of_a_time_are_those_of_the_same_mesh_or_an_error(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    contents = {
        "1": ascii_list(CUBE),
        "2": ascii_list(CUBE[:7]),
        "3": b"8\n((0 0 0)",
        "4": ascii_list(CUBE).replace(b"(1.0 1.0 1.0)", b"(1.0 1.0 nan)"),
    }
    for time, content in contents.items():
        (tmp_path / "cube" / time / "polyMesh").mkdir(parents=True)
        (tmp_path / "cube" / time / "polyMesh/points").write_bytes(header("vectorField", "points") + content)
    read = list(read_times(mesh, 8))
    assert [time.value for time in read] == [1, 2, 3, 4]
    assert [time.error is None for time in read] == [True, False, False, False]
    assert all(str(time.error.problem).startswith(f"t = {time.value:g}: ") for time in read[1:])
    assert list(read_times(tmp_path / "cube/1", 8)) == []


# Damaged cases give one clear error that names the file, whatever is cut or changed.


PARTS = ("points", "faces", "owner", "neighbour", "boundary")


def spoil(mesh, name, *changes):
    """Replace texts in a file of a case."""
    data = (mesh / name).read_bytes()
    for old, new in changes:
        assert old in data
        data = data.replace(old, new, 1)
    (mesh / name).write_bytes(data)


@pytest.mark.parametrize(("name", "old", "new", "words"), [
    ("points", b"(1.0 0.0 0.0)", b"(1.0 x 0.0)", "points: points holds 'x' in row 2 of 8 (line 18): expected a number"),
    ("points", b"(1.0 0.0 0.0)\n", b"", "points ends after 7 of 8 rows"),
    ("points", b"8\n(", b"7\n(", "more points than the 7"),
    ("points", b"8\n(", b"eight\n(", "the number of points is 'eight'"),
    ("points", b"(1.0 0.0 0.0)", b"(nan 0.0 0.0)", "finite"),
    ("points", b"FoamFile", b"Foam", "does not begin with the header FoamFile"),
    ("points", b"format ascii", b"format cipher", "its format is 'cipher': expected ascii or binary"),
    ("points", b"format ascii;", b"format ascii", "the entry 'format' of the header FoamFile is not a word"),
    ("faces", b"4(0 4 6 2)", b"4(0 4 6 9)", "a face refers to point 9: expected 0 to 7"),
    ("faces", b"4(0 4 6 2)", b"3(0 4 6 2)", "faces holds"),
    ("faces", b"4(0 4 6 2)", b"4(0 4 6)", "faces holds"),
    ("owner", b"\n0\n", b"\n7\n", "owner: refers to cells from 0 to 7: expected 0 to 5"),
    ("owner", b"\n0\n", b"\n-1\n", "refers to cells from -1 to 0"),
    ("owner", b"6\n(", b"5\n(", "owner holds more than the 5 items"),
    ("owner", b"6\n(\n0\n", b"5\n(\n", "owner holds 5 numbers: expected 6"),
    ("neighbour", b"0\n(", b"9\n(", "neighbour ends after 0 of 9 rows"),
    ("boundary", b"type wall;", b"", "patch 'walls' has no entry 'type'"),
    ("boundary", b"nFaces 4;", b"nFaces four;", "nFaces of patch 'walls' is 'four': expected a natural number"),
    ("boundary", b"nFaces 4;", b"nFaces 40;", "patch 'walls' has the faces 0 to 39: expected faces of the boundary, 0 to 5"),
    ("boundary", b"nFaces 4;", b"nFaces 4", "the entry 'nFaces' of patch 'walls' is not a word"),
    ("boundary", b"type patch;", b"type cyclic; neighbourPatch gone;", "the neighbourPatch 'gone', which does not exist"),
    ("boundary", b"    ends", b'#include "gone"\n    ends', "includes 'gone', which does not exist"),
    ("boundary", b"    ends", b'#include "boundary"\n    ends', "Check that no file includes itself."),
])  # fmt: skip
def test_what_is_wrong_is_named(name, old, new, words, tmp_path):
    mesh = write_cube(tmp_path / "cube")
    spoil(mesh, name, (old, new))
    assert_refused(tmp_path / "cube", words)


@pytest.mark.parametrize("name", PARTS)
def test_a_missing_file_is_named(name, tmp_path):
    mesh = write_cube(tmp_path / "cube")
    (mesh / name).unlink()
    with pytest.raises(
        FileError, match="is a folder: expected" if name == "faces" else f"polyMesh: has no file {name}"
    ):
        io.read(tmp_path / "cube")


def test_binary_files_of_other_widths_are_refused(tmp_path):
    mesh = write_cube(tmp_path / "cube", binary=(32, 64))
    spoil(mesh, "owner", (b"label=32", b"label=64"))
    with pytest.raises(FileError, match=r"owner: owner (of 6 items does not end at byte|ends after)"):
        io.read(tmp_path / "cube")


def test_old_binary_faces_are_refused_with_the_program_that_converts_them(tmp_path):
    mesh = write_cube(tmp_path / "cube", binary=(32, 64))
    spoil(mesh, "faces", (b"faceCompactList", b"faceList"))
    with pytest.raises(FileError, match="foamFormatConvert"):
        io.read(tmp_path / "cube")


def test_a_damaged_archive_is_named(tmp_path):
    mesh = write_cube(tmp_path / "cube", compressed=True)
    (mesh / "points.gz").write_bytes((mesh / "points.gz").read_bytes()[:-30])
    with pytest.raises(FileError, match=r"points.gz: is a damaged gzip file"):
        io.read(tmp_path / "cube")


def test_huge_numbers_take_no_memory(tmp_path):
    mesh = write_cube(tmp_path / "cube")
    for text in (b"99999999999{0}", b"99999999999999999999{0}", b"99999999999(0)", b"9999999999999(" + b"(" * 9 + b")"):
        (mesh / "owner").write_bytes(header("labelList", "owner") + text)
        with pytest.raises(FileError, match="owner"):
            io.read(tmp_path / "cube")
    spoil(mesh, "boundary", (b"ends", b"{" * 5000))
    with pytest.raises(FileError):
        io.read(tmp_path / "cube")


@pytest.fixture(scope="module")
def cases(tmp_path_factory):
    """A case with zones as text, binary and gzip."""
    folder, mesh = tmp_path_factory.mktemp("cases"), grid(2)
    sides = {"wall": np.array([[0, 0], [2, 0]]), "lid": np.array([[1, 1]])}
    mesh = mesh.replace(side_sets=sides, hex_sets={"half": np.arange(4)}, node_sets={"some": np.array([1, 5])})
    for encoding in ("ascii", "binary"):
        io.write(folder / encoding / "case.foam", mesh, encoding=encoding)
    shutil.copytree(folder / "binary", folder / "gzip")
    for path in (folder / "gzip/constant/polyMesh").iterdir():
        if path.name != "boundary":
            path.with_name(f"{path.name}.gz").write_bytes(gzip.compress(path.read_bytes()))
            path.unlink()
    return folder
