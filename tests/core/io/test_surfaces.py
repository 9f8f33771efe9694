"""Surfaces from files that other programs write, and what is said of those that hold none."""

import re

import numpy as np
import pytest

from hexmend import FileError, read_surface
from hexmend.boundary.closest_point import triangulate
from hexmend.io.surfaces import SURFACE_FORMATS
from hexmend.io.surfaces.read import merge_points
from hexmend.mesh.topology.close_pairs import LATTICE_FREE_DIRECTION
from tests.core.io.vtk_writers import by_vtk

pv = pytest.importorskip("pyvista")


def sphere():
    return pv.Sphere(radius=2, center=(1, 2, 3), theta_resolution=12, phi_resolution=9)


def xml(mode, *, compressed, encoded=True):
    def write(path, data):
        from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

        kind = "SetCompressorTypeToZLib" if compressed else "SetCompressorTypeToNone"
        by_vtk(
            vtkXMLPolyDataWriter(),
            path,
            data,
            {f"SetDataModeTo{mode}": None, kind: None, "SetEncodeAppendedData": encoded},
        )

    return write


def legacy(version, kind):
    def write(path, data):
        from vtkmodules.vtkIOLegacy import vtkPolyDataWriter

        by_vtk(vtkPolyDataWriter(), path, data, {"SetFileVersion": version, f"SetFileTypeTo{kind}": None})

    return write


def obj(path, data):
    from vtkmodules.vtkIOGeometry import vtkOBJWriter

    by_vtk(vtkOBJWriter(), path, data)


def edited(write, edit):
    """What a writer writes, changed as another program has it."""

    def write_and_edit(path, data):
        write(path, data)
        path.write_text(edit(path.read_text()))

    return write_and_edit


def in_text(path, data):
    data.save(path, binary=False)


def turned_numbers(text):
    """Faces that count their nodes from the last."""
    count = text.count("\nv ")
    lines = [
        " ".join(["f", *(str(int(word.split("/")[0]) - count - 1) for word in line.split()[1:])])
        if line.startswith("f ")
        else line
        for line in text.splitlines()
    ]
    return "\n".join(lines)


WRITERS = {
    "binary.stl": lambda path, data: data.save(path),
    "text.stl": in_text,
    "blank-lines.stl": edited(in_text, lambda text: text.replace("facet n", "\n  facet n") + "\n\n"),
    "capitals.stl": edited(in_text, str.upper),
    "no-normals.stl": edited(in_text, lambda text: re.sub("facet normal.*", "facet", text)),
    "returns.stl": edited(in_text, lambda text: text.replace("\n", "\r")),
    "notes.stl": edited(in_text, lambda text: text.replace("\n", " note\n")),
    "tabs.stl": edited(in_text, lambda text: text.replace("vertex ", "\tvertex\t ")),
    "two-solids.stl": edited(in_text, lambda text: text.replace("  facet", "endsolid a\nsolid b\n facet", 1)),
    "binary.ply": lambda path, data: data.save(path),
    "text.ply": in_text,
    "index.ply": edited(in_text, lambda text: text.replace("vertex_indices", "vertex_index")),
    "plain.obj": obj,
    "negative.obj": edited(obj, turned_numbers),
    "text.vtp": xml("Ascii", compressed=False),
    "binary.vtp": xml("Binary", compressed=False),
    "zlib.vtp": xml("Binary", compressed=True),
    "appended.vtp": xml("Appended", compressed=True),
    "raw.vtp": xml("Appended", compressed=False, encoded=False),
    "raw-zlib.vtp": xml("Appended", compressed=True, encoded=False),
    "text-42.vtk": legacy(42, "ASCII"),
    "binary-42.vtk": legacy(42, "Binary"),
    "text-51.vtk": legacy(51, "ASCII"),
    "binary-51.vtk": legacy(51, "Binary"),
}


@pytest.mark.parametrize("name", WRITERS)
def test_what_other_programs_write_is_read(name, tmp_path):
    path, data = tmp_path / name, sphere()
    WRITERS[name](path, data)
    skin = read_surface(path)
    assert skin.name == name
    assert len(skin.faces) == data.n_cells
    assert len(skin.nodes) == len(skin.points) == data.n_points  # corners at one place are one
    assert (skin.edges.count == 2).all()
    assert skin.volume() == pytest.approx(data.volume, rel=1e-5)
    np.testing.assert_allclose(np.ptp(skin.points, axis=0), np.ptp(data.points, axis=0), rtol=1e-5)


@pytest.mark.parametrize("suffix", [".vtp", ".vtk", ".ply"])
def test_quads_are_quads(suffix, tmp_path):
    path = tmp_path / f"cube{suffix}"
    cube = pv.Cube(clean=True)
    pv.PolyData(cube.points, faces=cube.faces).save(path)
    skin = read_surface(path)
    assert skin.faces.shape == (6, 4)
    assert skin.volume() == pytest.approx(1)


def test_polygons_and_triangles_beside_quads_keep_their_places(tmp_path):
    path = tmp_path / "prism.obj"
    angle = np.arange(5) * 2 * np.pi / 5
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    lines = [f"v {x} {y} {z}" for z in (0, 1) for x, y in ring]
    lines += [
        "f 5 4 3 2 1",
        "f 6 7 8 9 10",
        *(f"f {k + 1} {(k + 1) % 5 + 1} {(k + 1) % 5 + 6} {k + 6}" for k in range(5)),
    ]
    path.write_text("\n".join(lines))
    skin = read_surface(path)
    assert skin.volume() == pytest.approx(2.5 * np.sin(2 * np.pi / 5))
    assert (skin.edges.count == 2).all()
    _, triangles, _ = triangulate(skin.points, skin.faces)
    assert triangles.max() < len(skin.points) + len(skin.faces)


TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
EMPTY_PLY = (
    "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 0\nproperty list uchar int vertex_indices\nend_header\n"
)
STL = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
PLY, NO_VERTEX = "cannot be read as PLY", "expected vertices and faces, its header declares no vertex"
NO_STL, NO_SURFACE, NO_AREA = "cannot be read as STL", "holds no surface", "no triangle or quad with an area"
BAD = {
    "empty.stl": ("", "is empty"),
    "no-facets.stl": ("solid a\nendsolid a\n", NO_SURFACE),
    "junk.stl": ("\0" * 200, "is not an STL file"),
    "cut-short.stl": (STL[: STL.index("vertex 0 1 0")], NO_STL),
    "uneven.stl": (STL.replace("vertex 0 0 0", "vertex 0 0").replace("vertex 1 0 0", "vertex 1 0 0 0"), NO_STL),
    "bare.stl": (STL.replace("endloop", "vertex\nendloop"), NO_STL),
    "word-behind.stl": (STL.replace("vertex 0 0 0", "vertex 0 0 0vertex"), NO_STL),
    "run-on.stl": (STL.replace("facet normal", "facetnormal"), NO_STL),
    "run-together.stl": (STL.replace("vertex 0 0 0", "vertex0 0 0"), NO_STL),
    "points.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", NO_SURFACE),
    "flat.obj": ("v 0 0 0\nv 1 0 0\nv 0 0 0\nf 1 2 3\n", NO_SURFACE),
    "collinear.obj": ("v 0.1 0.1 5\nv 0.2 0.2 5\nv 0.7 0.7 5\nf 1 2 3\n", NO_AREA),
    "collinear-quad.obj": ("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\n", NO_AREA),
    "far.obj": (
        TETRAHEDRON.replace("v 1 0 0", "v 1e38 0 0"),
        r"area beside point 1 \(counted from 0\), which is far from the others at \[1e\+38, 0.0, 0.0\]",
    ),
    "nan.obj": (TETRAHEDRON.replace("v 1 0 0", "v nan 0 0"), "point 1 .counted from 0. is at .nan"),
    "range.obj": (TETRAHEDRON.replace("f 1 3 2", "f 1 3 9"), "uses the point 8: expected numbers from 0 to 3"),
    "junk.ply": ("nothing", "no head"),
    "text-empty.ply": (EMPTY_PLY, NO_VERTEX),
    "binary-empty.ply": (EMPTY_PLY.replace("ascii", "binary_little_endian"), NO_VERTEX),
    "short.ply": ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header\n", PLY),
    "junk.vtp": ("nothing", "does not begin with <VTKFile"),
    "grid.vtp": ('<VTKFile type="UnstructuredGrid">', "expected PolyData"),
    "cut.vtp": ('<VTKFile type="PolyData"><PolyData><Piece', "its XML is broken"),
    "grid.vtk": ("# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\n", "expected POLYDATA"),
    "part.step": ("ISO-10303-21;", "the suffix '.step' is none of a surface"),
}


def test_tabs_and_notes_between_the_words_of_an_obj_file_are_passed_over(tmp_path):
    path = tmp_path / "notes.obj"
    text = (
        TETRAHEDRON.replace("v ", "v\t").replace("f 1 3 2", "\tf  1\t-2 2 # note").replace("0 0 1\n", "0\t0 1# far\n")
    )
    path.write_text(f"# a\n\n{text}")
    skin = read_surface(path)
    assert len(skin.faces) == 4
    assert skin.volume() == pytest.approx(1 / 6)


@pytest.mark.parametrize("name", BAD)
def test_what_is_no_surface_is_said(name, tmp_path):
    content, words = BAD[name]
    path = tmp_path / name
    path.write_text(content)
    with pytest.raises(FileError, match=words) as error:
        read_surface(path)
    assert str(error.value).startswith(f"{name}: ")
    assert error.value.remedy


def test_points_lines_and_strips(tmp_path):
    cloud = pv.PolyData(np.random.default_rng(0).random((5, 3)))
    for suffix in (".vtp", ".vtk", ".ply"):
        path = tmp_path / f"cloud{suffix}"
        cloud.save(path)
        with pytest.raises(FileError, match="holds no surface"):
            read_surface(path)
    for suffix in (".vtp", ".vtk"):
        path = tmp_path / f"strips{suffix}"
        sphere().strip().save(path)
        with pytest.raises(FileError, match="triangle strips"):
            read_surface(path)


def test_every_format_is_tried():
    assert set(SURFACE_FORMATS) == {"." + name.rpartition(".")[2] for name in WRITERS}


@pytest.mark.parametrize("flat", [False, True], ids=["sphere", "plane across the direction of sorting"])
def test_corners_are_merged_where_they_coincide_up_to_rounding(flat):
    random = np.random.default_rng(3)
    points, triangles = sphere().points.astype(np.float64), sphere().regular_faces.astype(np.int64)
    if flat:
        points -= (points @ LATTICE_FREE_DIRECTION)[:, None] * LATTICE_FREE_DIRECTION
    corners = points[triangles].reshape(-1, 3)
    corners = corners + 1e-12 * random.normal(size=corners.shape) * (random.random(len(corners)) < 0.5)[:, None]
    merged, faces = merge_points(corners, np.arange(len(corners)).reshape(-1, 3))
    assert len(merged) == len(points)
    np.testing.assert_allclose(merged[faces], points[triangles], atol=1e-11)
    exactly, again = merge_points(points[triangles].reshape(-1, 3), np.arange(len(corners)).reshape(-1, 3))
    assert len(exactly) == len(points)
    np.testing.assert_array_equal(exactly[again], points[triangles])
