"""The doctor finds planted problems, none in a valid mesh, and repairs leave a valid mesh."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend import io
from hexmend.cli.main import main
from hexmend.doctor import PROBLEMS, examine, repair
from hexmend.doctor.cells import _WEDGES
from hexmend.mesh.cells import Cells
from hexmend.mesh.hexahedron import EDGES, FACES, UNIT_CUBE, VOXEL_ORDER
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import mirror_hexes, with_consistent_orientation
from hexmend.quality import measure
from tests.core.grids import grid

SOUND = grid(3)


def found_in(mesh):
    return {finding.kind: finding for finding in examine(mesh)}


def with_hexes(hexes):
    return Mesh(SOUND.points, hexes)


def blocks(gap=0.0):
    """Make two adjacent blocks whose nodes are not merged."""
    other = SOUND.points + [SOUND.points[:, 0].max() + gap, 0, 0]
    return Mesh(np.vstack([SOUND.points, other]), np.vstack([SOUND.hexes, SOUND.hexes + SOUND.n_nodes]))


def flipped(*which):
    marks = np.zeros(SOUND.n_hexes, dtype=bool)
    marks[list(which)] = True
    return mirror_hexes(SOUND, marks)


def collapsed():
    """Make a mesh whose corner hex has edges 01 and 45 collapsed, a wedge."""
    hexes = SOUND.hexes.copy()
    hexes[0, 1], hexes[0, 5] = hexes[0, 0], hexes[0, 4]
    return with_hexes(hexes)


def hanging():
    """Make a hex with four hexes of half its size on one of its faces."""
    fine = grid(2)
    fine = Mesh(fine.points * 0.5, fine.hexes)
    coarse = UNIT_CUBE * np.ptp(fine.points[:, 0]) + [fine.points[:, 0].max(), 0, 0]
    mesh = Mesh(np.vstack([fine.points, coarse]), np.vstack([fine.hexes, [np.arange(8) + fine.n_nodes]]))
    return repair(mesh, ["coincident-nodes"])[0]


TROUBLES = [
    (Mesh(np.vstack([SOUND.points, [[9, 9, 9]]]), SOUND.hexes), "unused-nodes", 1, True),
    (with_hexes(np.vstack([SOUND.hexes, SOUND.hexes[:2]])), "duplicate-hexes", 2, True),
    (collapsed(), "degenerate-hexes", 1, True),
    (with_hexes(SOUND.hexes[[0, 26]]), "parts", 1, False),
    (mirror_hexes(SOUND, np.ones(27, dtype=bool)), "mirrored-parts", 27, True),
    (flipped(13), "flipped-hexes", 1, True),
    (with_hexes(SOUND.hexes[:, VOXEL_ORDER]), "voxel-order", 27, True),
    (blocks(), "coincident-nodes", 16, True),
    (blocks(1e-8), "coincident-nodes", 16, True),
    (hanging(), "hanging-nodes", 5, False),
    (with_hexes(np.vstack([SOUND.hexes, SOUND.hexes[:1], SOUND.hexes[:1]])), "crowded-faces", None, False),
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
    assert "turned" in again.notes[-1]
    for hexes, middles in ((wrong.hexes[0], wrong.mid_nodes[0]),):
        np.testing.assert_allclose(points[hexes[ends]].mean(axis=1), points[middles[:12]])


def test_every_collapsed_pair_of_edges_makes_a_wedge_that_stands_upright():
    assert len(_WEDGES) == 12
    edges = {tuple(sorted(edge)) for edge in EDGES.tolist()}
    for pair, corners in _WEDGES.items():
        assert {tuple(sorted(edge)) for edge in pair} <= edges
        x = UNIT_CUBE.copy()
        for a, b in pair:
            x[[a, b]] = x[[a, b]].mean(axis=0)
        a, b, c, d = x[list(corners[:4])]
        assert np.linalg.det([b - a, c - a, d - a]) > 0
        assert len({tuple(place) for place in x[list(corners)]}) == 6


def test_a_collapsed_hex_is_kept_as_a_wedge_whose_nodes_stay():
    mesh = collapsed()
    after, _ = repair(mesh)
    assert after.n_hexes == 26
    assert [cells.kind for cells in after.cells] == ["wedge"]
    assert after.fixed[after.cells[0].nodes].all()


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1), st.integers(1, 5))
def test_flipped_hexes_are_those_that_were_flipped(seed, count):
    random = np.random.default_rng(seed)
    which = random.choice(27, count, replace=False)
    mesh = flipped(*which)
    found = found_in(mesh)
    if "flipped-hexes" in found:  # a neighbourhood of nothing but flipped hexes is left to the eye
        assert set(found["flipped-hexes"].hexes.tolist()) <= set(which.tolist())
    if count == 1:
        np.testing.assert_array_equal(repair(mesh)[0].hexes, SOUND.hexes)


def test_a_tangled_mesh_is_not_taken_for_a_flipped_one():
    points = SOUND.points.copy()
    inner = np.flatnonzero(SOUND.free)
    points[inner] = points[inner][::-1]
    mesh = SOUND.with_points(points)
    assert measure(points, mesh.hexes).n_inverted > 0
    assert "flipped-hexes" not in found_in(mesh)
    assert "mirrored-parts" not in found_in(mesh)


@pytest.mark.parametrize("degrees", [0, 27])
def test_flat_hexes_do_not_keep_a_part_from_being_turned(degrees):
    points = SOUND.points.copy()
    high = points[:, 2].max()
    points[points[:, 2] > high - 0.01, 2] = np.unique(points[:, 2])[-2]  # a layer of no height
    angle = np.deg2rad(degrees)  # which makes volumes of nearly zero, of either sign
    spin = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
    flat = Mesh(points @ spin.T + degrees, SOUND.hexes)
    mirrored = mirror_hexes(flat, np.ones(27, dtype=bool))
    assert found_in(mirrored)["mirrored-parts"].count == 27
    np.testing.assert_array_equal(with_consistent_orientation(mirrored).hexes, flat.hexes)
    assert "have been turned" in with_consistent_orientation(mirrored).notes[-1]
    assert with_consistent_orientation(flat) is flat
    nothing = Mesh(points * [1, 1, 0] @ spin.T, SOUND.hexes)  # flat all over
    assert with_consistent_orientation(nothing) is nothing


def test_names_and_titles_are_of_their_own():
    assert len({one.title for one in PROBLEMS.values()}) == len(PROBLEMS)
    assert len({one.rank for one in PROBLEMS.values()}) == len(PROBLEMS)


def test_info_says_where_and_by_which_command(tmp_path, capsys):
    io.write(tmp_path / "blocks.vtu", blocks())
    assert main(["info", str(tmp_path / "blocks.vtu"), "--doctor"]) == 0
    said = capsys.readouterr().out
    assert "9 pairs of boundary faces lie on each other" in said
    assert "--only coincident-nodes" in said
    assert "nodes 64, " in said
    assert "finds nothing" not in said


def test_info_says_that_the_doctor_found_nothing(tmp_path, capsys):
    io.write(tmp_path / "sound.vtu", SOUND)
    assert main(["info", str(tmp_path / "sound.vtu")]) == 0
    assert "The doctor finds" not in capsys.readouterr().out
    assert main(["info", str(tmp_path / "sound.vtu"), "--doctor"]) == 0
    assert "The doctor finds no problems" in capsys.readouterr().out


def test_repair_writes_the_mended_mesh_and_says_what_was_done(tmp_path, capsys):
    io.write(tmp_path / "blocks.vtu", blocks())
    assert main(["repair", str(tmp_path / "blocks.vtu"), "-o", str(tmp_path / "whole.vtu")]) == 0
    assert "Done: merge them" in capsys.readouterr().out
    assert io.read(tmp_path / "whole.vtu").n_nodes == 112
    assert main(["repair", str(tmp_path / "whole.vtu"), "-o", str(tmp_path / "again.vtu")]) == 0
    assert "No problems were found." in capsys.readouterr().out
    assert main(["repair", str(tmp_path / "whole.vtu"), "-o", str(tmp_path / "x.vtu"), "--only", "fleas"]) == 2


def test_nodes_without_a_place_are_put_between_their_neighbours(tmp_path, capsys):
    path = tmp_path / "nan.vtk"
    io.write(path, SOUND, encoding="ascii")
    lines = path.read_text().splitlines()
    row = next(k for k, line in enumerate(lines) if line.startswith("POINTS")) + 1
    numbers = " ".join(lines[row:]).split()
    inner = int(np.flatnonzero(SOUND.free)[0])
    numbers[3 * inner] = "nan"
    path.write_text("\n".join([*lines[:row], " ".join(numbers[: 3 * 64]), *_rest(lines, row)]) + "\n")
    assert main(["info", str(path)]) == 3
    assert "hexmend repair" in capsys.readouterr().err
    assert main(["repair", str(path), "-o", str(tmp_path / "whole.vtk")]) == 0
    np.testing.assert_allclose(io.read(tmp_path / "whole.vtk").points[inner], SOUND.points[inner])


def _rest(lines, row):
    """What comes after the coordinates."""
    return lines[next(k for k, line in enumerate(lines[row:], row) if line[:1].isalpha()) :]


@pytest.mark.parametrize("mesh", [flipped(13), with_hexes(SOUND.hexes[:, VOXEL_ORDER])], ids=["flipped", "voxels"])
def test_smooth_gives_the_diagnosis_and_the_command(mesh, tmp_path, capsys):
    io.write(tmp_path / "bad.vtu", mesh)
    main(["smooth", str(tmp_path / "bad.vtu"), "-o", str(tmp_path / "out.vtu"), "--max-iterations", "1"])
    assert f"Run: hexmend repair {tmp_path / 'bad.vtu'} -o OUT --only" in capsys.readouterr().err


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


def test_a_node_of_a_named_set_is_used():
    mesh = Mesh(np.vstack([SOUND.points, [[9, 9, 9]]]), SOUND.hexes, node_sets={"reference point": np.array([64])})
    assert examine(mesh) == ()


def test_what_cannot_be_mended_is_not_said_to_be():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1.0]])
    mesh = Mesh(points, [[0, 1, 2, 2, 3, 4, 5, 5]])
    assert not found_in(mesh)["degenerate-hexes"].mendable
    after, mended = repair(mesh)
    assert mended == ()
    assert after is mesh


def test_a_mesh_written_twice_is_one_mesh_again():
    mesh = Mesh(np.vstack([SOUND.points] * 2), np.vstack([SOUND.hexes, SOUND.hexes + SOUND.n_nodes]))
    after, mended = repair(mesh)
    assert {finding.kind for finding in mended} == {"coincident-nodes", "duplicate-hexes"}
    assert examine(after) == ()
    assert after.n_hexes == SOUND.n_hexes


def test_a_report_does_not_replace_the_result(tmp_path, capsys):
    io.write(tmp_path / "in.vtk", SOUND)
    out = str(tmp_path / "out.vtk")
    assert main(["smooth", str(tmp_path / "in.vtk"), "-o", out, "--json", out]) == 3
    assert "another file to be written" in capsys.readouterr().err
