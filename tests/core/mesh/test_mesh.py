"""Mesh: validation, immutability and sharing."""

import json
import pickle
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import hexmend as hx
from hexmend import (
    Cells,
    Mesh,
    MeshError,
    ParameterError,
    add_set,
    fix,
    fix_outside,
    io,
    iterate,
    remove_set,
    smooth,
    unfix,
)
from hexmend.arrays import as_immutable, is_immutable
from hexmend.cli.main import main
from hexmend.doctor import repair
from hexmend.gallery import make
from hexmend.io import read
from hexmend.mesh import orientation
from hexmend.mesh.edge_length import OUTLIER_FACTOR, mean_edge_length
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from hexmend.mesh.materials import STRUCTURED_BLOCKS
from hexmend.mesh.orientation import MIRRORED_CORNERS, left_handed_hexes, mirror_hexes, with_consistent_orientation
from hexmend.mesh.rules.named_sets import nodes_in_set, set_names
from hexmend.mesh.topology import Topology
from hexmend.quality import corner_determinants
from hexmend.terminal_text import count_phrase
from tests.core.grids import grid, scrambled, with_edge_midpoints


def test_with_points_shares_topology_and_leaves_the_original():
    mesh = grid(3)
    _ = mesh.topology.face_neighbours, mesh.free
    moved = mesh.with_points(mesh.points + 1)
    assert moved.topology is mesh.topology
    assert moved.hexes is mesh.hexes
    assert moved.free is mesh.free
    assert mesh.points[0, 0] == 0
    assert moved.points[0, 0] == 1


NO_MESHES = [
    (UNIT_CUBE[:, :2], [range(8)], r"points have shape \(8, 2\): expected"),
    (UNIT_CUBE, [range(7)], r"hexes have shape \(1, 7\): expected"),
    (UNIT_CUBE, np.empty((0, 8), int), "at least one hex"),
    (UNIT_CUBE, [[0, 1, 2, 3, 4, 5, 6, 8]], "hex 0 .* expected numbers from 0 to 7"),
    (UNIT_CUBE, [[0, 1, 2, 3, 4, 5, 6, -1]], "hex 0 .* expected numbers from 0 to 7"),
    (np.where(UNIT_CUBE > 0, np.nan, 0), [range(8)], "node 1 .* expected finite"),
]


@pytest.mark.parametrize(("points", "hexes", "words"), NO_MESHES)
def test_what_is_no_mesh_is_said(points, hexes, words):
    with pytest.raises(MeshError, match=words):
        Mesh(points, hexes)


def test_fixed_are_boundary_pinned_and_unused():
    mesh = grid(4)
    inner = int(np.flatnonzero(mesh.free)[0])
    pinned = np.zeros(mesh.n_nodes + 1, dtype=bool)
    pinned[inner] = True
    more = Mesh(np.vstack([mesh.points, [[9, 9, 9]]]), mesh.hexes, pinned=pinned)
    assert mesh.free.sum() == 27
    assert more.free.sum() == 26
    assert more.fixed[inner]
    assert more.fixed[-1]


def test_a_replaced_mesh_shares_what_is_not_replaced_and_checks_what_is():
    mesh = grid(2)
    tagged = mesh.replace(hex_sets={"some": np.array([1, 2])})
    assert tagged.points is mesh.points
    assert tagged.hexes is mesh.hexes
    assert mesh.hex_sets == {}
    with pytest.raises(MeshError, match="pinned has shape"):
        mesh.replace(pinned=[True])
    with pytest.raises(TypeError, match="has no colour"):
        mesh.replace(colour="red")


# Nodes fixed by named sets, numbers and marks, and regions outside which all nodes are fixed.


MESH = scrambled(grid(5), 0.4).replace(
    node_sets={"some": np.array([100, 101])}, hex_sets={"part": np.array([62])}, side_sets={"side": np.array([[64, 1]])}
)


def test_sets_of_nodes_hexes_and_sides_are_fixed():
    assert set(nodes_in_set(MESH, "part")) == set(MESH.hexes[62])
    assert set(nodes_in_set(MESH, "side")) == set(MESH.hexes[64][FACES[1]])
    fixed = fix(MESH, "some", "side").immovable
    assert fixed[[100, 101]].all()
    assert fixed[nodes_in_set(MESH, "side")].all()
    with pytest.raises(MeshError, match=r"there is no set 'sme': did you mean some\? there are 'some', 'part', 'side'"):
        fix(MESH, "sme")


def test_nodes_are_fixed_by_number_and_by_marks_and_released_again():
    inner = np.flatnonzero(MESH.free)[:3]
    marks = np.zeros(MESH.n_nodes, dtype=bool)
    marks[inner] = True
    for fixed in (fix(MESH, inner), fix(MESH, inner.tolist()), fix(MESH, marks), fix(MESH, *map(int, inner))):
        np.testing.assert_array_equal(np.flatnonzero(MESH.free & ~fixed.free), inner)
        np.testing.assert_array_equal(fixed.immovable, marks)
    np.testing.assert_array_equal(np.flatnonzero(unfix(fixed, inner[1:]).immovable), inner[:1])
    assert not unfix(fixed).immovable.any()
    assert MESH.pinned is None
    with pytest.raises(MeshError, match="nodes"):
        fix(MESH, [MESH.n_nodes])


def test_fixed_sets_are_those_of_which_no_node_moves():
    assert MESH.fixed_sets == ()
    assert fix(MESH, "some").fixed_sets == ("some",)
    assert fix(MESH, nodes_in_set(MESH, "side")[1:]).fixed_sets == ()
    assert fix(MESH, "part").fixed_sets == ("part",)
    assert fix(MESH, MESH.hexes[64]).fixed_sets == ("side",)  # one of its faces
    assert MESH.with_rules(fix="side").fixed_sets == ("side",)
    assert unfix(fix(MESH, "some"), "some").fixed_sets == ()


def test_nodes_of_faces_edges_and_points_inside_stay_unless_interfaces_are_free():
    mesh, (a, b, c, d) = scrambled(grid(5), 0.4), MESH.hexes[62][FACES[3]]
    outer = Cells("quad", mesh.topology.boundary_faces)
    for change, kept in (
        ({"side_sets": {"baffle": np.array([[62, 3]])}}, [a, b, c, d]),
        ({"cells": (outer, Cells("quad", np.array([[a, b, c, d]], np.int32)))}, [a, b, c, d]),
        (
            {"cells": (Cells("line", np.array([[a, b]], np.int32)), Cells("vertex", np.array([[d]], np.int32)))},
            [a, b, d],
        ),
        ({"hex_sets": {"low": np.arange(50), "high": np.arange(50, 125)}, "side_sets": {"z": np.array([[45, 5]])}}, []),
    ):
        changed = mesh.replace(**change)
        np.testing.assert_array_equal(np.flatnonzero(changed.immovable), np.sort(kept))
        assert not changed.free[kept].any()
        assert changed.with_rules(interfaces="free").free.sum() == mesh.free.sum()


@pytest.mark.parametrize("rings", [0, 1, 2])
def test_of_a_region_and_its_rings_alone_nodes_are_free(rings):
    free = fix_outside(MESH, np.array([62]), rings).free
    expected = np.zeros(MESH.n_nodes, dtype=bool)
    expected[MESH.hexes[MESH.topology.hexes_around([62], rings)]] = True
    np.testing.assert_array_equal(free, expected & MESH.free)


def test_the_command_keeps_sets_and_moves_regions(tmp_path, capsys, run_command):
    path, out, report = tmp_path / "a.vtu", tmp_path / "b.vtu", tmp_path / "c.json"
    io.write(path, MESH)
    words = ["smooth", str(path), "-o", str(out), "--method", "laplacian", "--json", str(report)]
    main([*words, "--only", "part", "--rings", "0", "--fix", "some"])
    moved = np.flatnonzero((io.read(out).points != MESH.points).any(axis=1))
    assert len(moved) > 0
    assert set(moved) <= set(MESH.hexes[62])
    assert json.loads(report.read_text())["before"]["free_nodes"] == 8
    capsys.readouterr()
    printed = run_command(*words, "--only", "parts", status=3).err
    assert "there is no element set 'parts': did you mean part? there are 'part', 'inverted'" in printed


# Mean edge length: every edge counts once a hex, and a distant node does not distort it.


def test_each_edge_counts_once_a_hex():
    mesh = grid(3)
    assert mesh.mean_edge_length == mean_edge_length(mesh.points, mesh.hexes) == pytest.approx(1)
    assert mesh.with_points(mesh.points * [1, 2, 3]).mean_edge_length == pytest.approx(2)


@pytest.mark.parametrize("far", [1e6, 1e150])
def test_one_node_far_away_spoils_nothing(far):
    mesh = grid(4)
    points = mesh.points.copy()
    points[np.flatnonzero(mesh.free)[0]] = far
    assert 0.9 < mean_edge_length(points, mesh.hexes) < OUTLIER_FACTOR


# Immutable arrays of a mesh: they cannot be written to, and meshes share them.


TWO = grid(2, 1, 1)


def writable_alias(hexes):
    """Make read-only hexes that own their memory, with an older view that is still writable."""
    mine = np.array(hexes)
    alias = mine[:]
    mine.flags.writeable = False
    return mine, lambda: alias.__setitem__((0, 0), 10**9)


def thawed(hexes):
    """Make read-only hexes that own their memory: NumPy can make them writable again."""
    mine = np.array(hexes)
    mine.flags.writeable = False

    def write():
        mine.flags.writeable = True
        mine[0, 0] = 10**9

    return mine, write


def unpickled(hexes):
    """Make hexes from a pickle: their memory belongs to `bytes`, but is writable."""
    mine = pickle.loads(pickle.dumps(np.array(hexes), protocol=4))
    alias = mine[:]
    mine.flags.writeable = False
    return mine, lambda: alias.__setitem__((0, 0), 10**9)


def buffered(hexes):
    """Make hexes from a read-only memoryview of a writable array."""
    mine = np.array(hexes)
    return np.asarray(memoryview(mine).toreadonly()), lambda: mine.__setitem__((0, 0), 10**9)


@pytest.mark.parametrize("make", [writable_alias, thawed, unpickled, buffered])
def test_a_read_only_array_that_can_still_be_written_to_does_not_change_a_mesh(make):
    hexes, write = make(TWO.hexes)
    mesh, topology = Mesh(TWO.points, hexes), Topology(hexes, TWO.n_nodes)
    write()
    for kept in (mesh.hexes, topology.hexes, mesh.topology.hexes):
        np.testing.assert_array_equal(kept, TWO.hexes)
    np.testing.assert_array_equal(mesh.quality("q"), TWO.quality("q"))


@pytest.mark.parametrize("name", ["points", "hexes", "fixed", "free"])
def test_nobody_can_make_the_arrays_of_a_mesh_writable(name):
    array = getattr(Mesh(TWO.points.copy(), TWO.hexes.copy()), name)
    for view in (array, array[:]):
        with pytest.raises(ValueError, match="cannot set WRITEABLE"):
            view.flags.writeable = True


@pytest.mark.parametrize(
    "values",
    [np.zeros((2, 3)), np.zeros((0, 3)), np.zeros((2, 3), order="F"), np.array(["a", "bc"]), np.array([b"a"]),
     np.array([1 + 2j]), np.array([True]), np.array(["2020-01-01"], "M8[D]"), np.zeros(2, [("a", "i4"), ("b", "f8")])],
    ids=lambda values: f"{values.dtype}-{values.shape}",
)  # fmt: skip
def test_an_immutable_copy_has_the_values_and_is_copied_no_more(values):
    kept = as_immutable(values)
    np.testing.assert_array_equal(kept, values)
    assert kept.dtype == values.dtype
    assert kept.flags.c_contiguous
    assert not np.shares_memory(kept, values)
    assert values.flags.writeable
    assert [is_immutable(values), is_immutable(kept), is_immutable(kept[1:])] == [False, True, True]
    assert as_immutable(kept) is kept


def test_cells_have_arrays_of_their_own():
    nodes, data, chosen = np.array([[0, 1, 2, 3]]), np.zeros(1), np.zeros(1, int)
    mesh = TWO.replace(cells=[hx.Cells("quad", nodes, {"a": data}, {"b": chosen})])
    nodes[...], data[...], chosen[...] = 7, 7, 7
    (cells,) = mesh.cells
    assert cells.nodes.dtype == np.int32
    assert [cells.nodes.tolist(), cells.data["a"].tolist(), cells.sets["b"].tolist()] == [[[0, 1, 2, 3]], [0.0], [0]]
    assert all(is_immutable(array) for array in (cells.nodes, cells.data["a"], cells.sets["b"]))
    assert mesh.rebuilt(name="other").cells[0].nodes is cells.nodes
    assert TWO.replace(cells=(hx.Cells("quad", [[0.0, 1.0, 2.0, 3.0]]),)).cells[0].nodes.dtype == np.int32


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_meshes_come_out_of_a_pickle_immutable_and_of_one_lineage(protocol):
    mesh = TWO.replace(pinned=np.ones(12, bool), node_sets={"a": [1]}, cells=(hx.Cells("line", [[0, 1]]),))
    moved = mesh.with_points(mesh.points + 1)
    assert moved.fixed.all()
    first, second = pickle.loads(pickle.dumps((mesh, moved), protocol=protocol))
    assert first.hexes is second.hexes is first.topology.hexes
    np.testing.assert_array_equal(second.points, moved.points)
    arrays = [second.points, second.hexes, second.pinned, second.fixed, second.node_sets["a"], second.cells[0].nodes]
    assert all(is_immutable(array) for array in arrays)


@dataclass(frozen=True)
class Reuses(hx.Smoother):
    """Method that overwrites the array that it has yielded."""

    name = title = "reuses"
    help = source = "Moves its own array."

    def steps(self, mesh):
        points = mesh.points.copy()
        yield hx.Step(points)
        while True:
            points[mesh.free] += 0.01
            yield hx.Step(points)


def test_a_method_may_go_on_writing_to_the_array_that_it_yields():
    mesh = grid(2)
    seen = [iteration.points for iteration in hx.iterate(mesh, Reuses(), max_iterations=3)]
    for number, points in enumerate(seen, 1):
        np.testing.assert_allclose(points[mesh.free], mesh.points[mesh.free] + 0.01 * number)


# Named sets of hexes, nodes and sides are added to a mesh and removed.


TAGGED = grid(3)


def test_a_set_of_each_kind_is_added_and_removed():
    mesh = add_set(add_set(add_set(TAGGED, "a", hexes=[5, 2]), "b", nodes=[1]), "c", sides=[[0, 4]])
    assert (mesh.hex_sets["a"].tolist(), mesh.node_sets["b"].tolist(), mesh.side_sets["c"].tolist()) == (
        [5, 2],
        [1],
        [[0, 4]],
    )
    assert not TAGGED.hex_sets
    assert add_set(mesh, "a", hexes=[7]).hex_sets["a"].tolist() == [7]
    left = remove_set(mesh, "b")
    assert not left.node_sets
    assert list(left.hex_sets) == ["a"]
    both = add_set(mesh, "a", nodes=[3])
    assert not {"a"} & {*remove_set(both, "a").hex_sets, *remove_set(both, "a").node_sets}


def test_what_is_no_set_is_refused():
    for members in ({}, {"hexes": [0], "nodes": [0]}):
        with pytest.raises(ParameterError, match="set 'a': expected its members by one of hexes=, nodes= and sides="):
            add_set(TAGGED, "a", **members)
    with pytest.raises(MeshError, match="hex set 'a' has 27"):
        add_set(TAGGED, "a", hexes=[27])
    with pytest.raises(MeshError, match=r"there is no set 'inlt': did you mean inlet\? there are 'inlet'"):
        remove_set(add_set(TAGGED, "inlet", nodes=np.arange(4)), "inlt")


def test_a_set_of_other_cells_is_removed_too():
    quads = TAGGED.topology.boundary_faces[:4]
    mesh = TAGGED.replace(cells=(Cells("quad", quads, sets={"wall": [0, 1], "inlet": [2]}),))
    assert set_names(mesh) == ["wall", "inlet"]
    assert set_names(remove_set(mesh, "wall")) == ["inlet"]
    with pytest.raises(MeshError, match=r"no set 'wal': did you mean wall\? there are 'wall', 'inlet'"):
        remove_set(mesh, "wal")


# Materials by sets and data, and the interfaces between them.


HALVES = grid(4)
LOW = np.flatnonzero(HALVES.points[HALVES.hexes].mean(axis=1)[:, 0] < 2)
HIGH = np.setdiff1d(np.arange(HALVES.n_hexes), LOW)
TWO_MATERIALS = {"low": LOW, "high": HIGH}


def of(**fields):
    return HALVES.replace(**fields).materials


DIVIDING_SETS = [
    TWO_MATERIALS,
    {"all": np.arange(64), **TWO_MATERIALS},
    {"some": LOW[:5], **TWO_MATERIALS, "empty": np.empty(0, int)},
    {"across": np.array([0, 63]), "all": np.arange(64), "a few": HIGH[:2], **TWO_MATERIALS},
    {"low": np.concatenate([LOW, LOW[:3]]), "high": HIGH},
]


@pytest.mark.parametrize("sets", DIVIDING_SETS)
def test_sets_that_divide_the_mesh_are_materials_whatever_others_there_are(sets):
    found = of(hex_sets=sets)
    assert set(found.names) == {"low", "high"}
    for k, name in enumerate(found.names):
        np.testing.assert_array_equal(np.flatnonzero(found.of_hex == k), TWO_MATERIALS[name])


WITHOUT_A_DIVISION = [
    {},
    {"hex_sets": {"low": LOW}},
    {"hex_sets": {"all": np.arange(64)}},
    {"hex_sets": {"low": LOW, "more": np.append(HIGH, LOW[0])}},
    {"hex_data": {"pressure": np.arange(64) // 32, "id": np.arange(64)}},
    {"hex_data": {"MaterialIds": np.ones(64)}},
    {"hex_data": {"MaterialIds": np.linspace(0, 1, 64)}},
    {"hex_data": {"region": np.arange(64)}},
    {"hex_sets": TWO_MATERIALS, "field_data": {STRUCTURED_BLOCKS: ["low", "high"]}},
]


@pytest.mark.parametrize("fields", WITHOUT_A_DIVISION)
def test_a_mesh_without_a_division_has_one_material_and_keeps_its_free_nodes(fields):
    mesh = HALVES.replace(**fields)
    assert mesh.materials is None
    np.testing.assert_array_equal(mesh.free, HALVES.free)


@pytest.mark.parametrize("name", ["MaterialIds", "material", "medit:ref", "Region Id", "block", "nastran:pid"])
def test_numbers_under_a_usual_name_are_materials(name):
    for as_type in (np.int8, np.float64):
        numbers = np.full(64, 7, as_type)
        numbers[HIGH] = 12
        found = of(hex_data={name: numbers})
        assert found.names == ("7", "12")
        np.testing.assert_array_equal(np.flatnonzero(found.of_hex), HIGH)


@given(st.integers(2, 5), st.integers(0, 10**6))
def test_interfaces_are_the_nodes_and_faces_of_hexes_of_different_material(count, seed):
    numbers = np.random.default_rng(seed).integers(0, count, HALVES.n_hexes)
    numbers[:count] = np.arange(count)
    found = of(hex_data={"material": numbers})
    sets = [set(numbers[(HALVES.hexes == node).any(axis=1)]) for node in range(HALVES.n_nodes)]
    np.testing.assert_array_equal(found.interface_nodes, [len(one) > 1 for one in sets])
    across = HALVES.topology.face_neighbours
    expected = sum(numbers[h] != numbers[o] for h in range(64) for o in across[h] if o > h)
    assert len(found.interface_sides) == expected
    for one, face, other, back in found.interface_sides:
        assert numbers[one] < numbers[other]
        assert across[one, face] == other
        assert set(HALVES.hexes[one, FACES[face]]) == set(HALVES.hexes[other, FACES[back]])


def test_the_ball_in_a_box_has_a_sphere_as_interface():
    mesh = make("materials", size=300, scramble=0.4)
    on = mesh.materials.interface_nodes
    assert mesh.materials.names == ("ball", "box")
    assert not mesh.free[on].any()
    np.testing.assert_allclose(np.linalg.norm(mesh.points[on], axis=1), 0.6)


def test_the_ten_grains(real_mesh):
    mesh = read(real_mesh("n10-id2_hex.msh"))
    inside = mesh.materials.interface_nodes & ~mesh.topology.boundary
    assert len(mesh.materials) == 10
    assert np.count_nonzero(inside) == 701
    assert not mesh.free[inside].any()


# Left-handed hexes are renumbered with their side sets; hexes that their nodes invert are not.


def mirrored(mesh, which):
    """Number some hexes of a mesh left-handed, with the side sets on the same faces."""
    hexes = mesh.hexes.copy()
    hexes[which] = hexes[which][:, MIRRORED_CORNERS]
    return mesh.rebuilt(hexes=hexes, side_sets={})


def two_grids():
    """Make two disconnected grids, of 8 hexes and of 1."""
    one, other = grid(2), grid(1)
    points = np.concatenate([one.points, other.points + 5])
    return Mesh(points, np.concatenate([one.hexes, other.hexes + one.n_nodes]))


def nodes_of(mesh, name):
    """Return the nodes of each face of a side set, as sets."""
    return [frozenset(mesh.hexes[hexa, FACES[face]].tolist()) for hexa, face in mesh.side_sets[name]]


@pytest.mark.parametrize("chunk", [1, 2, 100])
def test_hexes_that_are_flat_up_to_rounding_do_not_count_wherever_a_chunk_ends(chunk, monkeypatch):
    monkeypatch.setattr(orientation, "_CHUNK", chunk)
    mesh = grid(2, 1, 1)
    points = mesh.points.copy()
    flat = points[:, 0] == 2
    points[flat] = points[flat] * [0, 1, 1] + [1 - 1e-15, 0, 0]
    mesh = mirrored(mesh.with_points(points), [True, True])
    volumes = corner_determinants(points, mesh.hexes, np.arange(2)).sum(axis=1)
    assert volumes[0] < 0 < volumes[1] < 1e-13
    assert left_handed_hexes(mesh).all()


def test_faces_of_side_sets_stay_where_they_are():
    mesh = grid(2)
    rows = np.array([(hexa, face) for hexa in range(8) for face in range(6)])
    mesh = mesh.replace(side_sets={"all": rows})
    which = np.arange(8) % 3 == 0
    back = mirror_hexes(mesh, which)
    assert nodes_of(back, "all") == nodes_of(mesh, "all")
    np.testing.assert_array_equal(back.side_sets["all"][:, 0], rows[:, 0])
    assert (back.side_sets["all"][~which[rows[:, 0]]] == rows[~which[rows[:, 0]]]).all()
    np.testing.assert_array_equal(mirror_hexes(back, which).side_sets["all"], rows)
    np.testing.assert_array_equal(mesh.side_sets["all"], rows)  # the given mesh is as it was


@pytest.mark.parametrize("which", [[0, 1, 2, 3, 4, 5, 6, 7], [8], list(range(9))])
def test_whole_parts_are_turned_and_a_note_counts_them(which):
    mesh = two_grids()
    wrong = mirrored(mesh, np.isin(np.arange(9), which))
    np.testing.assert_array_equal(np.flatnonzero(left_handed_hexes(wrong)), which)
    back = with_consistent_orientation(wrong)
    assert (corner_determinants(back.points, back.hexes) > 0).all()
    assert back.renumbered == "parts"
    assert len(back.notes) == 1
    assert back.notes[0].startswith(
        "All hexes" if len(which) == 9 else f"{count_phrase(len(which), 'hex', 'hexes')}, which make"
    )


def lattice_pattern(name):
    """Mark hexes of a lattice of 4 x 3 x 3, (36,) bool."""
    x, y, z = np.arange(36) % 4, np.arange(36) // 4 % 3, np.arange(36) // 12
    return {
        "checkerboard": (x + y + z) % 2 == 0,
        "layer": z == 1,
        "one hex": np.arange(36) == 17,
        "all but one": np.arange(36) != 17,
        "block": (x < 2) & (y < 2),
        "most": x > 0,
    }[name]


@pytest.mark.parametrize("name", ["checkerboard", "layer", "one hex", "all but one", "block", "most"])
def test_left_handed_hexes_of_a_lattice_are_renumbered_exactly_and_a_note_counts_them(name):
    mesh, which = grid(4, 3, 3), lattice_pattern(name)
    wrong = mirrored(scrambled(mesh, 0.1), which)
    np.testing.assert_array_equal(left_handed_hexes(wrong), which)
    back = with_consistent_orientation(wrong)
    np.testing.assert_array_equal(back.hexes, mesh.hexes)
    (note,) = back.notes
    assert note.startswith(f"{count_phrase(which.sum(), 'hex', 'hexes')}, unlike")
    assert back.renumbered == "hexes"


@pytest.mark.parametrize("flat", [[0, 1, 2, 3], [4, 5, 6, 7]])
def test_flat_hexes_follow_their_neighbours(flat):
    mesh = grid(2, 2, 3)
    points = mesh.points.copy()
    points[points[:, 2] == (0 if flat[0] == 0 else 2), 2] = 1  # the lowest layer, or that above it, has no height
    mesh = mesh.with_points(points)
    assert (corner_determinants(mesh.points, mesh.hexes)[flat] == 0).all()
    which = np.arange(12) % 3 == 0
    np.testing.assert_array_equal(with_consistent_orientation(mirrored(mesh, which)).hexes, mesh.hexes)
    assert with_consistent_orientation(mesh) is mesh


@pytest.mark.parametrize("amplitude", [1.3, 1.5])
def test_hexes_that_their_nodes_invert_are_left_as_they_are_and_others_renumbered_among_them(amplitude):
    mesh = scrambled(grid(4, 3, 3), amplitude)
    inverted = corner_determinants(mesh.points, mesh.hexes).sum(axis=1) < 0
    assert inverted.any()
    assert with_consistent_orientation(mesh) is mesh
    for which in (lattice_pattern("layer"), np.ones(36, dtype=bool)):
        np.testing.assert_array_equal(with_consistent_orientation(mirrored(mesh, which)).hexes, mesh.hexes)


def test_a_node_far_outside_does_not_turn_the_whole_mesh():
    mesh = grid(4, 3, 3)
    points = mesh.points.copy()
    points[0] = 1e6
    assert corner_determinants(points, mesh.hexes[:1]).sum() < 0
    mesh = mesh.with_points(points)
    assert with_consistent_orientation(mesh) is mesh


def test_mid_nodes_and_side_sets_follow_their_hexes():
    mesh, which = grid(4, 3, 3), lattice_pattern("checkerboard")
    rows = np.array([(hexa, face) for hexa in range(36) for face in range(6)])
    mesh = with_edge_midpoints(mesh).replace(side_sets={"all": rows})
    back = with_consistent_orientation(mirror_hexes(mesh, which))
    np.testing.assert_array_equal(back.hexes, mesh.hexes)
    np.testing.assert_array_equal(back.mid_nodes, mesh.mid_nodes)
    np.testing.assert_array_equal(back.side_sets["all"], rows)


def test_a_run_refuses_left_handed_hexes_and_names_the_remedy():
    wrong = mirrored(scrambled(grid(3), 0.1), np.arange(27) == 13)
    with pytest.raises(MeshError, match=r"1 hex, unlike its neighbours, is numbered inside out .* hexmend repair"):
        iterate(wrong)
    assert smooth(repair(wrong)[0]).after.inverted == 0


def test_volumes_far_from_the_origin_are_those_of_the_hexes():
    mesh = grid(2)
    np.testing.assert_allclose(orientation.signed_volumes(mesh.points + 1e5, mesh.hexes), 1, rtol=1e-6)
