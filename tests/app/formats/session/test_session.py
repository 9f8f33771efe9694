"""Sessions as the core sees them: meshes with all that they carry, of which one was shown."""

import dataclasses

import numpy as np
import pytest

from hexmend import Cells, FileError, Mesh, io
from hexmend.boundary import SkinSurface
from hexmend.gallery import make
from hexmend.mesh.fixing import fix
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.second_order import MID_EDGES
from hexmend_app.formats.session import SUFFIX
from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.formats.session.session_file import VERSION, read_session, write_session
from tests.core.solid_lattices import mixed, prisms

KIND = "Hexmend session"


def rich() -> Mesh:
    """A hex of second order, with something in every field of a mesh."""
    mids = np.full((1, 19), -1)
    mids[0, :12] = np.arange(8, 20)
    return Mesh(
        np.vstack([UNIT_CUBE, UNIT_CUBE[MID_EDGES].mean(axis=1)]) / 3,
        [range(8)],
        pinned=np.arange(20) == 4,
        node_data={"id": np.arange(20) + 2**40, "speed": np.random.default_rng(0).normal(size=(20, 3))},
        hex_data={"id": np.array([7]), "name": np.array(["steel"])},
        node_sets={"inlet": np.array([1, 2])},
        hex_sets={"$array": np.array([0])},
        cells=(Cells("quad", np.array([[0, 1, 2, 3]]), {"ref": np.array([5])}, {"wall": np.array([0])}),),
        name="one",
        side_sets={"top": np.array([[0, 5]])},
        mid_nodes=mids,
        field_data={"time": np.array([0.5]), "authors": ["a", "ö"]},
        notes=("It was read.",),
        renumbered="parts",
    )


def assert_same(a, b):
    """Two values hold the same, whatever they are made of."""
    if isinstance(a, np.ndarray):
        np.testing.assert_array_equal(a, b)
    elif dataclasses.is_dataclass(a):
        for one in dataclasses.fields(a):
            if one.name != "topology":
                assert_same(getattr(a, one.name), getattr(b, one.name))
    elif isinstance(a, dict):
        assert a.keys() == b.keys()
        for name in a:
            assert_same(a[name], b[name])
    elif isinstance(a, tuple | list):
        assert len(a) == len(b)
        for one, other in zip(a, b, strict=True):
            assert_same(one, other)
    else:
        assert a == b


def test_everything_that_a_mesh_carries_is_there_again(tmp_path):
    opened = rich().keeping_surface()
    moved = opened.with_points(opened.points * [1, 1, 2] + 1 / 7)
    tagged = moved.replace(hex_sets={"bad": np.array([0])})
    window = {"look": None}
    write_session(tmp_path / "a.hexmend", [opened, moved, tagged], 1, window)
    back = read_session(tmp_path / "a.hexmend")
    for mesh, other in zip((opened, moved, tagged), back.meshes, strict=True):
        assert_same(mesh, other)
        np.testing.assert_array_equal(mesh.surface_points, other.surface_points)
    assert (back.now, back.window) == (1, window)


def test_meshes_that_shared_arrays_share_them_again(tmp_path):
    opened = rich().replace(mid_nodes=None).keeping_surface()
    moved = opened.with_points(opened.points + 1)
    write_session(tmp_path / "a.hexmend", [opened, moved], 0, None)
    one, other = read_session(tmp_path / "a.hexmend").meshes
    for field in ("hexes", "topology", "pinned", "hex_sets", "node_data"):
        assert getattr(one, field) is getattr(other, field)
    assert other.surface_points is one.points


def test_states_of_a_mixed_mesh_share_their_cells_again(tmp_path):
    for opened in (mixed(2), prisms(2)):
        fixed = fix(opened.with_points(opened.points + 1), [0])
        write_session(tmp_path / "a.hexmend", [opened, fixed], 0, None)
        one, other = read_session(tmp_path / "a.hexmend").meshes
        assert one.elements is other.elements
        np.testing.assert_array_equal(one.elements, opened.elements)
        np.testing.assert_array_equal(other.fixed, fixed.fixed)


def test_the_surface_that_a_boundary_slides_on_is_there_again(tmp_path):
    mesh = make("cube", size=27)
    skin = SkinSurface(mesh.points + 0.01, mesh.topology.boundary_faces, "body.stl")
    opened = mesh.sliding_on(skin)
    moved = opened.with_points(opened.points + 5)  # far from it: what a session had, it has again
    write_session(tmp_path / "a.hexmend", [mesh, opened, moved], 1, None)
    bare, one, other = read_session(tmp_path / "a.hexmend").meshes
    assert bare.target is None
    assert one.target is other.target
    assert one.target.name == "body.stl"
    np.testing.assert_array_equal(one.target.points, skin.points)
    np.testing.assert_array_equal(one.target.faces, skin.faces)
    assert one.topology is bare.topology
    np.testing.assert_array_equal(io.read(tmp_path / "a.hexmend").target.points, skin.points)


@pytest.mark.parametrize(("change", "said"), [
    ({"faces": np.array([[0, 1, 2, 8]])}, "node 8: expected numbers from 0 to 7"),
    ({"faces": np.array([[0, 1]])}, "faces have shape"),
    ({"faces": np.zeros((0, 3), int)}, "has no faces"),
    ({"faces": np.array([[0.5, 1, 2]])}, "expected a whole number"),
    ({"faces": 7}, "faces have shape"),
    ({"points": np.full((8, 3), np.inf)}, "expected finite numbers"),
    ({"name": 7}, "or no name"),
    ({"colour": 7}, "the surface that the boundary slides on has an unknown field 'colour'"),
])  # fmt: skip
def test_what_cannot_be_a_surface_is_refused(change, said, tmp_path):
    path = tmp_path / "a.hexmend"
    write_session(path, [rich()], 0, None)
    data = read_archive(path, KIND, VERSION)
    data["meshes"][0]["target"] = {"points": UNIT_CUBE, "faces": np.array([[0, 1, 2, 3]]), "name": "a"} | change
    write_archive(path, KIND, VERSION, data)
    with pytest.raises(FileError, match=said):
        io.read(path)


def test_a_session_is_read_as_the_mesh_that_was_shown(tmp_path):
    opened = rich()
    moved = opened.with_points(opened.points * 2)
    write_session(tmp_path / "work.hexmend", [opened, moved], 1, None)
    (tmp_path / "work.hexmend").rename(tmp_path / "other.dat")  # its content tells
    mesh = io.read(tmp_path / "other.dat")
    assert mesh.name == "other"
    assert_same(mesh.replace(name="one"), moved)
    assert SUFFIX in io.readable_suffixes()
    assert SUFFIX not in io.writable_suffixes()  # a mesh alone is no session


@pytest.mark.parametrize(("change", "said"), [
    (lambda data: data.update(more=1), "the session has an unknown field 'more'"),
    (lambda data: data.pop("window"), "the session has no field 'window'"),
    (lambda data: data.update(now=1), "which of its meshes"),
    (lambda data: data["meshes"][0].update(colour=1), "a mesh has an unknown field 'colour'"),
    (lambda data: data["meshes"][0].update(hexes=np.full((1, 8), 20)), "uses the nodes"),
    (lambda data: data["meshes"][0].update(points=np.full((20, 3), np.nan)), "expected finite numbers"),
    (lambda data: data["meshes"][0].update(points=7), "points have shape"),
    (lambda data: data["meshes"][0].update(surface=None), "points have shape"),
    (lambda data: data["meshes"][0].update(hexes="none"), "hexes"),
    (lambda data: data["meshes"][0].update(node_sets=7), "node set: found int"),
    (lambda data: data["meshes"][0].update(points=[1]), "points have shape"),
    (lambda data: data["meshes"][0].update(pinned=np.ones(3, bool)), "pinned has shape"),
    (lambda data: data["meshes"][0]["hex_sets"].update(bad=np.array([1])), "hex set 'bad' has 1 at"),
    (lambda data: data["meshes"][0]["side_sets"].update(bad=np.array([[0, 6]])), "side set 'bad' has 6 at"),
    (lambda data: data["meshes"][0]["node_data"].update(bad=np.ones(3)), "node data 'bad' has 3 rows: expected 20"),
    (lambda data: data["meshes"][0]["cells"][0].update(kind="hept"), "no kind of cells 'hept'"),
    (lambda data: data["meshes"][0]["cells"][0].update(nodes=np.array([[0, 1, 2, 30]])), "uses the nodes"),
    (lambda data: data["meshes"][0].update(renumbered="some"), "renumbered is 'some': expected"),
    (lambda data: data["meshes"][0].update(mid_nodes=np.full((1, 19), 99)), "nodes"),
])  # fmt: skip
def test_what_cannot_be_a_mesh_is_refused(change, said, tmp_path):
    path = tmp_path / "a.hexmend"
    write_session(path, [rich()], 0, None)
    data = read_archive(path, KIND, VERSION)
    change(data)
    write_archive(path, KIND, VERSION, data)
    for read in (io.read, read_session):
        with pytest.raises(FileError, match=said) as error:
            read(path)
        assert str(error.value).startswith("a.hexmend: ")


def test_a_session_of_another_version_says_what_to_do(tmp_path):
    write_archive(tmp_path / "a.hexmend", KIND, VERSION + 1, {})
    said = rf"a\.hexmend: is of version {VERSION + 1}: expected {VERSION}\. Use the Hexmend that wrote it\."
    with pytest.raises(FileError, match=said):
        io.read(tmp_path / "a.hexmend")


@pytest.mark.parametrize("content", [b"# vtk DataFile Version 2.0\n", b"PK\x03\x04 and no more"])
def test_another_file_of_that_name_is_no_session(content, tmp_path):
    (tmp_path / "a.hexmend").write_bytes(content)
    with pytest.raises(FileError):
        io.read(tmp_path / "a.hexmend")
