"""The doctor finds planted problems, and none in a valid mesh."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Cells, Mesh, io, measure
from hexmend.cli.main import main
from hexmend.doctor import PROBLEMS, Finding, examine, repair
from hexmend.mesh.hexahedron import UNIT_CUBE, VOXEL_ORDER
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


def test_only_mid_nodes_inside_the_mesh_are_put_halfway_and_corners_stay():
    mesh, sound = bent(inside=True), second_order_grid()
    after, _ = repair(mesh)
    np.testing.assert_array_equal(after.points, sound.points)
    both = bent(inside=False, start=mesh)  # also with a mid-node on the boundary, which keeps its bend
    after, _ = repair(both)
    moved = np.flatnonzero((after.points != both.points).any(axis=1))
    assert moved.tolist() == np.flatnonzero((mesh.points != sound.points).any(axis=1)).tolist()
    assert found_in(after)["mid-nodes"].count == 1
    pinned = np.zeros(mesh.n_nodes, bool)
    pinned[moved] = True
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
