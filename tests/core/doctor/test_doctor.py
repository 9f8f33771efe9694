"""The doctor finds planted problems, and none in a valid mesh."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Cells, LinearMotion, Mesh, io, measure
from hexmend.cli.main import main
from hexmend.doctor import PROBLEMS, Finding, examine, repair
from hexmend.doctor.nodes import extract_hexes, renumber_nodes
from hexmend.mesh.collapsed_hexes import with_collapsed_converted
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE, VOXEL_ORDER
from hexmend.mesh.materials import CONTACT_CARDS
from hexmend.mesh.orientation import mirror_hexes, with_consistent_orientation
from tests.core.doctor.faulty_meshes import (
    SOUND,
    bent,
    blocks,
    collapsed,
    flipped,
    found_in,
    hanging,
    second_order_grid,
    with_hexes,
)
from tests.core.grids import grid
from tests.core.solid_lattices import mixed

TROUBLES = [
    (Mesh(np.vstack([SOUND.points, [[9, 9, 9]]]), SOUND.hexes), "unused-nodes", 1, True),
    (with_hexes(np.vstack([SOUND.hexes, SOUND.hexes[:2]])), "duplicate-hexes", 2, True),
    (collapsed(), "degenerate-hexes", 1, True),
    (with_hexes(SOUND.hexes[[0, 26]]), "parts", 2, False),
    (mirror_hexes(SOUND, np.ones(27, dtype=bool)), "left-handed-hexes", 27, True),
    (flipped(13), "left-handed-hexes", 1, True),
    (with_hexes(SOUND.hexes[:, VOXEL_ORDER]), "voxel-order", 27, True),
    (blocks(), "coincident-nodes", 16, True),
    (blocks(1e-8), "coincident-nodes", 16, True),
    (hanging(), "hanging-nodes", 5, False),
    (with_hexes(np.vstack([SOUND.hexes, SOUND.hexes[:1], SOUND.hexes[:1]])), "crowded-faces", None, False),
    (bent(inside=True), "mid-nodes", 4, True),
    (bent(inside=False), "mid-nodes", 1, False),
]


@pytest.mark.parametrize(("mesh", "kind", "count", "mendable"), TROUBLES, ids=[case[1] for case in TROUBLES])
def test_problems_are_found_and_counted_with_their_hexes_or_nodes(mesh, kind, count, mendable):
    found = found_in(mesh)
    assert kind in found
    finding = found[kind]
    assert count is None or finding.count == count
    assert f"{finding.count:,}" in finding.message or "All hexes" in finding.message
    assert finding.remedy
    assert finding.mendable is mendable
    assert len(finding.hexes) + len(finding.nodes) > 0
    assert finding.location_text()


def test_a_sound_mesh_has_no_findings():
    assert examine(SOUND) == ()


@pytest.mark.parametrize(
    ("mesh", "kind"), [case[:2] for case in TROUBLES if case[3]], ids=[case[1] for case in TROUBLES if case[3]]
)
def test_what_is_mended_is_found_no_more_and_every_hex_is_sound(mesh, kind):
    after, mended = repair(mesh, [kind])
    assert [finding.kind for finding in mended] == [kind]
    assert kind not in found_in(after)
    assert measure(after.points, after.hexes).n_inverted <= measure(mesh.points, mesh.hexes).n_inverted


def test_parts_that_other_cells_connect_are_not_disconnected():
    apart = with_hexes(SOUND.hexes[[0, 26]])
    bridge = Cells("tetra", np.array([[*apart.hexes[0][:2], *apart.hexes[1][:2]]], np.int32))
    assert "hexmend repair" in found_in(apart)["parts"].remedy
    assert "parts" not in found_in(apart.replace(cells=(bridge,)))


def test_only_mid_nodes_inside_the_mesh_are_moved_and_to_halfway_where_that_is_valid():
    mesh, sound = bent(inside=True), second_order_grid()
    after, _ = repair(mesh)
    np.testing.assert_array_equal(after.points, sound.points)
    both = bent(inside=False, start=mesh)  # also with a mid-node on the boundary, which keeps its bend
    after, _ = repair(both)
    inner = np.flatnonzero(np.bincount(both.mid_nodes[:, :12].ravel(), minlength=both.n_nodes) == 4)
    assert set(np.flatnonzero((after.points != both.points).any(axis=1))) <= set(inner)
    assert found_in(after)["mid-nodes"].count == 1
    pinned = np.zeros(mesh.n_nodes, bool)
    pinned[inner] = True
    assert not found_in(mesh.replace(pinned=pinned))["mid-nodes"].mendable


def test_nodes_of_second_order_are_no_unused_ones_and_turn_with_their_hex():
    mids = np.full((1, 19), -1)
    mids[0, :12] = np.arange(8, 20)
    ends = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]])
    points = np.vstack([UNIT_CUBE, UNIT_CUBE[ends].mean(axis=1)])
    mesh = Mesh(points, [range(8)], mid_nodes=mids)
    assert examine(mesh) == ()
    wrong = mirror_hexes(mesh, np.array([True]))
    again = with_consistent_orientation(wrong)
    np.testing.assert_array_equal(again.hexes, mesh.hexes)
    np.testing.assert_array_equal(again.mid_nodes, mesh.mid_nodes)
    assert "renumbered" in again.notes[-1]
    for hexes, middles in ((wrong.hexes[0], wrong.mid_nodes[0]),):
        np.testing.assert_allclose(points[hexes[ends]].mean(axis=1), points[middles[:12]])


@given(st.integers(0, 2**32 - 1), st.integers(1, 26))
def test_flipped_hexes_are_those_that_were_flipped(seed, count):
    random = np.random.default_rng(seed)
    which = random.choice(27, count, replace=False)
    mesh = flipped(*which)
    found = found_in(mesh)
    assert found["left-handed-hexes"].hexes.tolist() == sorted(which)
    np.testing.assert_array_equal(repair(mesh)[0].hexes, SOUND.hexes)


def test_a_tangled_mesh_is_not_taken_for_a_flipped_one():
    points = SOUND.points.copy()
    inner = np.flatnonzero(SOUND.free)
    points[inner] = points[inner][::-1]
    mesh = SOUND.with_points(points)
    assert measure(points, mesh.hexes).n_inverted > 0
    assert "left-handed-hexes" not in found_in(mesh)


@pytest.mark.parametrize("degrees", [0, 27])
def test_flat_hexes_do_not_keep_a_part_from_being_turned(degrees):
    points = SOUND.points.copy()
    high = points[:, 2].max()
    points[points[:, 2] > high - 0.01, 2] = np.unique(points[:, 2])[-2]  # a layer of no height
    angle = np.deg2rad(degrees)  # which makes volumes of nearly zero, of either sign
    spin = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
    flat = Mesh(points @ spin.T + degrees, SOUND.hexes)
    mirrored = mirror_hexes(flat, np.ones(27, dtype=bool))
    assert found_in(mirrored)["left-handed-hexes"].count == 27
    np.testing.assert_array_equal(with_consistent_orientation(mirrored).hexes, flat.hexes)
    assert "renumbered on reading" in with_consistent_orientation(mirrored).notes[-1]
    assert with_consistent_orientation(flat) is flat
    nothing = Mesh(points * [1, 1, 0] @ spin.T, SOUND.hexes)  # flat all over
    assert with_consistent_orientation(nothing) is nothing


def test_names_and_titles_are_of_their_own():
    assert len({one.title for one in PROBLEMS.values()}) == len(PROBLEMS)
    assert len({one.rank for one in PROBLEMS.values()}) == len(PROBLEMS)


def test_a_node_of_a_named_set_is_used():
    mesh = Mesh(np.vstack([SOUND.points, [[9, 9, 9]]]), SOUND.hexes, node_sets={"reference point": np.array([64])})
    assert examine(mesh) == ()


# The commands of the doctor report problems and repair files.


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


# Repairs keep data, sets and pins, and leave a valid mesh.


def test_merged_blocks_are_one_grid():
    after, _ = repair(blocks())
    assert examine(after) == ()
    assert after.n_nodes == 2 * 64 - 16
    assert after.topology.boundary_faces.shape == (9 * 10 - 9 * 2 + 0 + 36 - 0 - 18, 4) or after.topology.parts == 1
    assert measure(after.points, after.hexes).n_inverted == 0


def test_data_sets_and_pins_follow():
    mesh = blocks()
    n, m = mesh.n_nodes, mesh.n_hexes
    rich = mesh.rebuilt(
        node_data={"id": np.arange(n) + 100},
        hex_data={"id": np.arange(m) + 500},
        node_sets={"last": np.array([n - 1])},
        hex_sets={"right": np.arange(27, 54)},
        side_sets={"end": np.array([[53, 1]])},
        pinned=np.arange(n) == n - 1,
        cells=(Cells("quad", mesh.hexes[53][FACES[1]][None]),),
    )
    after, _ = repair(rich)
    (last,) = after.node_sets["last"]
    np.testing.assert_array_equal(after.points[last], mesh.points[-1])
    assert after.node_data["id"][last] == 100 + n - 1
    assert after.pinned[last]
    np.testing.assert_array_equal(after.hex_sets["right"], np.arange(27, 54))
    np.testing.assert_array_equal(after.cells[0].nodes[0], after.hexes[53][FACES[1]])
    fewer, _ = repair(rich.rebuilt(hexes=np.vstack([mesh.hexes[:-1], mesh.hexes[:1]])), ["duplicate-hexes"])
    np.testing.assert_array_equal(fewer.hex_sets["right"], [0, *range(27, 53)])
    assert fewer.side_sets["end"].tolist() == [[0, 1]]


@pytest.mark.parametrize("face", range(6))
@pytest.mark.parametrize("turned", [False, True])
def test_a_face_collapsed_to_an_edge_leaves_a_wedge(face, turned):
    nodes, (a, b, c, d) = np.arange(8), FACES[face]
    nodes[[b, c] if turned else [b, d]] = nodes[[a, d] if turned else [a, c]]
    mesh, _ = with_collapsed_converted(Mesh(UNIT_CUBE, [nodes.tolist()]))
    assert (mesh.n_hexes, [cells.kind for cells in mesh.cells]) == (0, ["wedge"])
    assert mesh.quality("scaled-jacobian").min() > 0.5
    assert mesh.quality("volume").sum() == pytest.approx(0.5)


@pytest.mark.parametrize("turns", range(4))
@pytest.mark.parametrize("tips", range(4))
def test_a_hex_with_a_face_in_one_node_is_a_pyramid_or_a_tetrahedron(turns, tips):
    order = np.arange(8)
    for turn in [[1, 2, 3, 0, 5, 6, 7, 4]] * turns + [[4, 5, 1, 0, 7, 6, 2, 3]] * tips:
        order = order[turn]
    for kind, places, volume in (
        ("pyramid", [0, 1, 2, 3, 4, 4, 4, 4], 1 / 3),
        ("tetra", [0, 1, 2, 2, 4, 4, 4, 4], 1 / 6),
    ):
        nodes = np.array(places)[order]  # the same hex, numbered from another corner
        mesh, text = with_collapsed_converted(Mesh(UNIT_CUBE, [nodes.tolist()]))
        assert [cells.kind for cells in mesh.cells] == [kind]
        assert mesh.quality("volume").sum() == pytest.approx(volume)
        assert text.startswith("1 hex is collapsed")


def test_a_collapsed_hex_is_kept_as_a_wedge():
    after, _ = repair(collapsed())
    assert after.n_hexes == 26
    assert [cells.kind for cells in after.cells] == ["wedge"]
    assert after.n_elements == 27


def test_a_duplicate_leaves_its_sets_and_sides_to_the_hex_that_is_kept():
    hexes = np.vstack([SOUND.hexes, SOUND.hexes[:1]])
    sets, sides = {"a": np.array([0]), "b": np.array([27])}, {"s": np.array([[27, 2]])}
    after, _ = repair(Mesh(SOUND.points, hexes, hex_sets=sets, side_sets=sides))
    assert {name: rows.tolist() for name, rows in after.hex_sets.items()} == {"a": [0], "b": [0]}
    assert after.side_sets["s"].tolist() == [[0, 2]]


def test_a_wedge_keeps_what_the_hex_had():
    mesh = collapsed().replace(hex_data={"id": np.arange(27) + 7}, hex_sets={"a": np.array([0, 1])})
    after, _ = repair(mesh, ["degenerate-hexes"])
    (wedges,) = after.cells
    assert wedges.data["id"].tolist() == [7]
    assert wedges.sets["a"].tolist() == [0]
    assert after.hex_sets["a"].tolist() == [0]


def test_what_cannot_be_mended_is_not_said_to_be():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1.0]])
    mesh = Mesh(points, [[0, 1, 2, 2, 0, 1, 2, 2]])  # flat, and the only one
    assert not found_in(mesh)["degenerate-hexes"].mendable
    after, mended = repair(mesh, ["degenerate-hexes"])
    assert mended == ()
    assert after is mesh


def test_a_mesh_written_twice_is_one_mesh_again():
    mesh = Mesh(np.vstack([SOUND.points] * 2), np.vstack([SOUND.hexes, SOUND.hexes + SOUND.n_nodes]))
    after, mended = repair(mesh)
    assert {finding.kind for finding in mended} == {"coincident-nodes", "duplicate-hexes"}
    assert examine(after) == ()
    assert after.n_hexes == SOUND.n_hexes


def test_bodies_of_different_materials_or_in_contact_are_not_glued():
    touching = blocks()
    halves = {"left": np.arange(27), "right": np.arange(27, 54)}
    for mesh in (touching.replace(hex_sets=halves), touching.replace(field_data={CONTACT_CARDS: ["TIE"]})):
        assert "coincident-nodes" not in found_in(mesh)
        assert repair(mesh) == (mesh, ())


def test_nodes_inside_a_material_are_merged_up_to_its_interface():
    mesh = blocks()
    material = (mesh.points[mesh.hexes].mean(axis=1)[:, 1] > np.median(mesh.points[:, 1])).astype(int)
    after, _ = repair(mesh.replace(hex_data={"material": material}))
    assert after.n_nodes == repair(mesh)[0].n_nodes == mesh.n_nodes - 16


def test_nodes_of_faces_are_merged_with_those_of_hexes_but_join_no_materials():
    touching = blocks().replace(hex_sets={"left": np.arange(27), "right": np.arange(27, 54)})
    for side, merged in (0, 16), (3, 0):  # faces at x = 0 of the left block, and at x = 3, where the blocks touch
        faces = SOUND.topology.boundary_faces
        nodes, quads = np.unique(faces[(SOUND.points[faces, 0] == side).all(axis=1)], return_inverse=True)
        points = np.vstack([touching.points, SOUND.points[nodes]])
        quads = Cells("quad", touching.n_nodes + quads.reshape(-1, 4))
        mesh = Mesh(points, touching.hexes, cells=(quads,), hex_sets=touching.hex_sets)
        assert ("coincident-nodes" in found_in(mesh)) is (merged > 0)
        assert repair(mesh)[0].n_nodes == mesh.n_nodes - merged


def test_a_linear_motion_follows_the_numbers_of_its_nodes():
    mesh = grid(2)
    bottom, top = (np.flatnonzero(mesh.points[:, 2] == z) for z in (0, 2))
    motion = LinearMotion.tying(top, bottom).merge(LinearMotion.in_planes(bottom, [0.0, 0, 1]))
    mesh = mesh.with_linear_motion(motion)
    order = np.random.default_rng(0).permutation(mesh.n_nodes)
    other = renumber_nodes(mesh, order)
    np.testing.assert_array_equal(other.fixed[order], mesh.fixed)
    shift = np.random.default_rng(1).normal(0, 0.1, mesh.points.shape)
    moved = np.empty(shift.shape)
    moved[order] = mesh.constrained(mesh.points + shift)
    back = np.argsort(order)
    np.testing.assert_allclose(other.constrained(moved), moved, atol=1e-15)
    assert (other.constrained(other.points + shift[back])[order[top], 2] == 2).all()


# Some hexes of a mesh, as a mesh with what belongs to them.


GRID = grid(3, 2, 2)
M, N = GRID.n_hexes, GRID.n_nodes
LOW_X = int(np.flatnonzero((UNIT_CUBE[np.array(FACES), 0] == 0).all(axis=1))[0])
BOUNDARY = GRID.topology.boundary_faces
MESH = GRID.rebuilt(
    hex_data={"id": np.arange(100, 100 + M)},
    node_data={"id": np.arange(1000, 1000 + N)},
    hex_sets={"even": np.arange(0, M, 2), "first": np.array([0])},
    node_sets={"odd": np.arange(1, N, 2)},
    side_sets={"low x": np.array([[h, LOW_X] for h in range(0, M, 3)])},
    cells=(
        Cells("quad", BOUNDARY.astype(np.int32), {"ref": np.arange(len(BOUNDARY))}, {"some": np.arange(0, len(BOUNDARY), 3)}),
        Cells("tetra", GRID.hexes[:2, [0, 1, 3, 4]]),
    ),
    pinned=np.arange(N) % 5 == 0,
)  # fmt: skip


def places(mesh, nodes):
    return {tuple(point) for point in mesh.points[nodes].tolist()}


@given(st.lists(st.booleans(), min_size=M, max_size=M).map(np.array).filter(np.any))
def test_hexes_keep_their_places_ids_sets_and_faces(kept):
    part, rows = extract_hexes(MESH, np.append(kept, [False, False])), np.flatnonzero(kept)
    np.testing.assert_array_equal(part.points[part.hexes], MESH.points[MESH.hexes[rows]])
    assert part.topology.used.all()
    np.testing.assert_array_equal(part.hex_data["id"], MESH.hex_data["id"][rows])
    ids = part.node_data["id"] - 1000
    np.testing.assert_array_equal(part.points, MESH.points[ids])
    for name, members in MESH.hex_sets.items():
        assert part.hex_data["id"][part.hex_sets.get(name, [])].tolist() == [100 + h for h in members if kept[h]]
    assert set(ids[part.node_sets.get("odd", [])]) == set(MESH.node_sets["odd"]) & set(ids)
    np.testing.assert_array_equal(part.pinned, MESH.pinned[ids])
    sides = part.side_sets.get("low x", np.empty((0, 2), int))
    assert places(part, part.hexes[sides[:, 0, None], np.array(FACES)[sides[:, 1]]].ravel()) == {
        (0.0, *yz)
        for h in MESH.side_sets["low x"][:, 0]
        if kept[h]
        for yz in MESH.points[MESH.hexes[h]][MESH.points[MESH.hexes[h]][:, 0] == 0][:, 1:].tolist()
    }


@given(st.lists(st.booleans(), min_size=M, max_size=M).map(np.array).filter(np.any))
def test_quads_on_the_hexes_stay_and_other_solid_cells_do_not(kept):
    part = extract_hexes(MESH, np.append(kept, [False, False]))
    assert all(cells.kind == "quad" for cells in part.cells)
    there = set(map(tuple, part.points.tolist()))
    expected = [q for q, quad in enumerate(BOUNDARY) if places(MESH, quad) <= there]
    for cells in part.cells:
        assert cells.data["ref"].tolist() == expected
        assert cells.data["ref"][cells.sets.get("some", [])].tolist() == [q for q in expected if q % 3 == 0]
        np.testing.assert_array_equal(part.points[cells.nodes], MESH.points[BOUNDARY[expected]])
    assert bool(part.cells) == bool(expected)


def test_mid_nodes_stay_with_their_hexes():
    middle = np.arange(M * 19).reshape(M, 19) + N
    points = np.concatenate([GRID.points, np.random.default_rng(1).random((M * 19, 3))])
    mesh = Mesh(points, GRID.hexes, mid_nodes=middle.astype(np.int32))
    part = extract_hexes(mesh, np.arange(M) == 5)
    assert part.n_nodes == 27
    np.testing.assert_array_equal(part.points[part.mid_nodes[0]], mesh.points[middle[5]])


@pytest.mark.parametrize("last", [12, 72])
def test_some_cells_of_all_kinds_are_extracted(last):
    mesh = mixed(3)
    kept = np.arange(72) % 3 == 0
    kept[:last] &= last == 72  # without a hex too
    part = extract_hexes(mesh, kept)
    assert part.n_elements == kept.sum()
    assert part.topology.used.all()
    np.testing.assert_allclose(part.quality("volume"), mesh.quality("volume")[kept])
