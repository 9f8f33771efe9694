"""Rules of motion by names of sets."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import hexmend as hx
from hexmend import LinearMotion, Mesh, MeshError, MotionRules, ParameterError, fix_outside, smooth
from hexmend.mesh.rules.periodic_sets import match_periodic
from hexmend.mesh.rules.resolution import normal_of_set
from hexmend.mesh.rules.two_dimensional import two_dimensional_motion, with_two_dimensional_motion
from tests.core.grids import displaced, grid, scrambled
from tests.core.linear_motions import scrambled_within

CUBE = grid(4)
SIDES = {
    f"{axis}{end}": np.flatnonzero(CUBE.points[:, k] == value)
    for k, axis in enumerate("xyz")
    for end, value in (("0", 0), ("1", 4))
}
LOW = CUBE.points[CUBE.hexes].mean(axis=1)[:, 0] < 2
TWO = {"low": np.flatnonzero(LOW), "high": np.flatnonzero(~LOW)}
MESH = CUBE.replace(node_sets=SIDES, hex_sets=TWO)
BETWEEN = MESH.materials.interface_nodes & ~MESH.topology.boundary


def test_rules_are_the_same_after_their_values():
    rules = MotionRules("slide", fix="a", slide=["b", "c"], periodic=[["d", "e"]])
    assert MotionRules.from_values(rules.values()) == rules
    assert rules.fix == ("a",)
    assert MotionRules().values() == {}
    assert not MotionRules()
    assert rules
    both = MotionRules(fix="z").merge(rules)
    assert both.fix == ("z", "a")
    assert both.interfaces == "slide"


@pytest.mark.parametrize("wrong", [{"interfaces": "glide"}, {"fix": 3}, {"periodic": ["a", "b", "c"]}, {"pin": "a"}])
def test_rules_that_do_not_exist_are_refused(wrong):
    with pytest.raises(ParameterError):
        MotionRules.from_values(wrong)


def test_interfaces_are_kept_unless_a_rule_says_otherwise():
    assert not MESH.free[BETWEEN].any()
    assert MESH.with_rules(interfaces="free").free[BETWEEN].all()
    mesh = MESH.with_rules(free="low")
    assert mesh.free[BETWEEN].all()
    assert not mesh.free[mesh.topology.boundary].any()
    assert not MESH.with_rules(free="low", fix="high").free[BETWEEN].any()


def test_rules_leave_the_pins_and_a_region_limits_them():
    pinned = np.zeros(MESH.n_nodes, dtype=bool)
    pinned[np.flatnonzero(CUBE.free & (CUBE.points[:, 0] < 2))] = True
    mesh = MESH.replace(pinned=pinned).with_rules(free="low", fix="x1")
    np.testing.assert_array_equal(mesh.pinned, pinned)
    assert mesh.free[pinned].all()
    part = fix_outside(mesh, TWO["high"][:1], 0)
    assert not part.free[np.setdiff1d(np.arange(part.n_nodes), part.hexes[TWO["high"][0]])].any()


RULES = st.fixed_dictionaries(
    {},
    optional={
        "interfaces": st.sampled_from(["keep", "slide", "free"]),
        "fix": st.sampled_from(["x0", "low"]),
        "slide": st.sampled_from(["y0", "z1"]),
        "free": st.just("low"),
        "plane": st.sampled_from(["z0", "x1", ("y0", "z0")]),
        "periodic": st.sampled_from([(("x0", "x1"),), (("y0", "y1"),)]),
    },
)


def assert_equal_motion(one, other):
    """Check that two meshes let the same nodes move in the same way."""
    np.testing.assert_array_equal(one.free, other.free)
    np.testing.assert_array_equal(one.immovable, other.immovable)
    assert (one.linear_motion is None) == (other.linear_motion is None)
    if one.linear_motion is None:
        return
    np.testing.assert_array_equal(one.motion_start, other.motion_start)
    for name in ("nodes", "projectors", "tied", "master", "rotations"):
        np.testing.assert_array_equal(getattr(one.linear_motion, name), getattr(other.linear_motion, name))


@given(st.lists(RULES, min_size=1, max_size=3), RULES, st.booleans())
def test_rules_replace_those_before_whatever_motion_these_gave(earlier, rules, has_own):
    mesh = MESH.with_linear_motion(LinearMotion.in_planes(SIDES["y1"], [0, 1, 0])) if has_own else MESH
    again = mesh
    for given_before in earlier:
        again = again.with_rules(**given_before)
    assert_equal_motion(again.with_rules(**rules), mesh.with_rules(**rules))


def test_a_linear_motion_given_after_rules_outlives_them():
    motion = LinearMotion.in_planes(SIDES["y1"], [0, 1, 0])
    mesh = MESH.with_rules(plane="z0").with_linear_motion(motion).with_rules()
    assert mesh.linear_motion is motion
    assert mesh.with_rules(plane="z0").with_linear_motion(None).with_rules().linear_motion is None


def test_a_set_that_does_not_exist_is_named_with_those_that_do():
    for rule in ("fix", "slide", "free", "plane"):
        with pytest.raises(MeshError, match=r"there is no set 'nowhere'.*'x0'.*'low'"):
            MESH.with_rules(**{rule: "nowhere"})


def test_a_set_of_the_boundary_cannot_be_free():
    with pytest.raises(MeshError, match="lies on the boundary"):
        MESH.with_rules(free="x0")


def test_a_flat_set_has_a_normal_and_another_tells_how_far_it_is_from_flat():
    assert normal_of_set(MESH, "z1").tolist() == [0, 0, 1]
    with pytest.raises(MeshError, match=r"not flat: node 112 .* is 0.2.* mean edge lengths"):
        normal_of_set(displaced(MESH, np.s_[SIDES["z1"][12], 2], 0.3), "z1")
    with pytest.raises(MeshError, match="on one line"):
        normal_of_set(MESH.replace(node_sets={"edge": np.arange(5)}), "edge")


def inner(name):
    """Nodes of a side that are not on its rim, (k,)."""
    x = CUBE.points[SIDES[name]]
    return SIDES[name][((x > 0) & (x < 4)).sum(axis=1) == 2]


def test_nodes_of_a_plane_move_in_it_and_those_of_its_rim_stay():
    mesh = CUBE.replace(node_sets=SIDES)
    moved = mesh.points.copy()
    moved[inner("z0"), :2] += np.random.default_rng(0).uniform(-0.3, 0.3, (len(inner("z0")), 2))
    mesh = scrambled(mesh.with_points(moved), 0.2)
    after = smooth(mesh, "mend", plane="z0", max_iterations=50).mesh.points
    assert (after[SIDES["z0"], 2] == 0).all()
    assert np.abs(after - CUBE.points)[inner("z0")].max() < 0.3 * np.abs(moved - CUBE.points).max()
    others = np.setdiff1d(np.flatnonzero(mesh.topology.boundary), inner("z0"))
    np.testing.assert_array_equal(after[others], mesh.points[others])


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
def test_nodes_of_periodic_sides_move_as_one(boundary):
    mesh = CUBE.replace(node_sets=SIDES)
    shift = np.random.default_rng(1).uniform(-0.25, 0.25, (len(inner("x0")), 3))
    moved = mesh.points.copy()
    for name in ("x0", "x1"):  # whose nodes are in one order
        moved[inner(name)] += shift
    mesh = scrambled(mesh.with_points(moved), 0.2)
    after = smooth(mesh, periodic=[("x0", "x1")], boundary=boundary).mesh.points
    np.testing.assert_array_equal(after[SIDES["x1"]] - after[SIDES["x0"]], moved[SIDES["x1"]] - moved[SIDES["x0"]])
    assert np.abs(after - moved)[inner("x0")].max() > 0.05


def test_cyclic_sides_of_a_file_move_as_one_where_the_boundary_slides_and_stay_where_it_does_not():
    hexes, sides = np.nonzero(CUBE.topology.face_neighbours < 0)
    middle = CUBE.points[CUBE.topology.boundary_faces].mean(axis=1)[:, 0]
    cyclic = {name: np.column_stack([hexes, sides])[middle == x] for name, x in (("in", 0), ("out", 4))}
    mesh = CUBE.replace(side_sets=cyclic, periodic_pairs=(("in", "out"),))
    mesh = scrambled(mesh, 0.4)
    np.testing.assert_array_equal(smooth(mesh).mesh.points[SIDES["x0"]], mesh.points[SIDES["x0"]])
    after = smooth(mesh, "laplacian", boundary="slide", max_iterations=3).mesh.points
    assert np.abs(after - mesh.points)[inner("x0")].max() > 1e-3
    np.testing.assert_array_equal(after[SIDES["x1"]] - after[SIDES["x0"]], np.tile([4.0, 0, 0], (25, 1)))


def test_a_rotated_side_is_matched_and_one_without_partners_tells_which_node():
    angle = np.pi / 6 * CUBE.points[:, 1] / 4
    radius = CUBE.points[:, 0] + 5
    bent = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), CUBE.points[:, 2]])
    sector = CUBE.replace(node_sets=SIDES).with_points(bent)
    pair = match_periodic(sector, "y0", "y1")
    np.testing.assert_allclose(bent[pair.nodes] @ pair.rotation.T, bent[pair.partners], atol=1e-12)
    wrong = bent.copy()
    wrong[SIDES["y1"][7]] += 0.1
    with pytest.raises(MeshError, match="no partner"):
        match_periodic(sector.with_points(wrong), "y0", "y1")
    with pytest.raises(MeshError, match="25 and 5 nodes"):
        match_periodic(MESH.replace(node_sets={"a": SIDES["x0"], "b": np.arange(5)}), "a", "b")


def test_periodic_pairs_of_a_file_leave_nodes_outside_a_region():
    mesh = scrambled(MESH, 0.2).replace(
        side_sets={}, periodic_pairs=(("y0", "y1"),), pinned=np.zeros(MESH.n_nodes, dtype=bool)
    )
    part = fix_outside(mesh.with_rules(free="high"), TWO["low"], 0)
    outside = np.setdiff1d(np.arange(mesh.n_nodes), mesh.hexes[TWO["low"]])
    after = smooth(part, boundary="slide").mesh
    np.testing.assert_array_equal(after.points[outside], mesh.points[outside])


# Meshes of one layer: nodes stay in their planes, and the two sides are copies of each other.


def layer(nx=6, ny=5, axis=2, kind="empty") -> Mesh:
    """One layer of hexes in any plane, with walls around."""
    counts = [nx, ny]
    counts.insert(axis, 1)
    mesh = grid(*counts)
    rows = np.array([(h, 2 * axis + side) for h in range(mesh.n_hexes) for side in (0, 1)])
    hexes, faces = np.nonzero(mesh.topology.face_neighbours < 0)
    others = np.column_stack([hexes, faces])[(faces // 2) != axis]
    return mesh.replace(side_sets={"front": rows, "walls": others}, side_set_types={"front": kind, "walls": "wall"})


def wedge(angle=5.0) -> Mesh:
    """A sector of a pipe wall: a layer between two planes through the x axis."""
    mesh = layer(6, 5, 2, "wedge")
    x, r, side = mesh.points.T
    turn = np.radians(angle) * (side - 0.5)
    points = np.column_stack([x, (r + 2) * np.cos(turn), (r + 2) * np.sin(turn)])
    rows = mesh.side_sets["front"]
    sides = {"back": rows[::2], "front": rows[1::2], "walls": mesh.side_sets["walls"]}
    types = {"back": "wedge", "front": "wedge", "walls": "wall"}
    return Mesh(points, mesh.hexes, side_sets=sides, side_set_types=types)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_inner_nodes_of_both_sides_move_in_their_plane_and_as_one(axis):
    mesh = with_two_dimensional_motion(layer(axis=axis))
    inner = (5 - 1 + 1) * (5 - 1) * 2
    assert mesh.free.sum() == inner
    moved = scrambled_within(mesh, 0.3, 3)
    across = [k for k in range(3) if k != axis]
    np.testing.assert_array_equal(moved.points[:, axis], mesh.points[:, axis])
    low, high = (moved.points[mesh.points[:, axis] == side][:, across] for side in (0, 1))
    np.testing.assert_array_equal(low, high)
    assert (moved.points != mesh.points).any(axis=1).sum() == inner


@pytest.mark.parametrize(("method", "boundary"), [("laplacian", "fixed"), ("mend", "slide")])
def test_methods_keep_the_two_sides_congruent_to_the_last_bit(method, boundary):
    mesh = scrambled_within(with_two_dimensional_motion(layer()), 0.6, 3)
    result = hx.smooth(mesh, method, boundary=boundary, max_iterations=20)
    low, high = (result.mesh.points[mesh.points[:, 2] == side] for side in (0, 1))
    np.testing.assert_array_equal(low[:, :2], high[:, :2])
    np.testing.assert_array_equal(result.mesh.points[:, 2], mesh.points[:, 2])
    assert result.after.q_mean > result.before.q_mean
    walls = (mesh.points[:, :2] == 0).any(axis=1) | (mesh.points[:, 0] == 6) | (mesh.points[:, 1] == 5)
    np.testing.assert_array_equal(result.mesh.points[walls], mesh.points[walls])


def test_the_sides_of_a_wedge_are_rotated_copies():
    mesh = with_two_dimensional_motion(wedge())
    start = scrambled_within(mesh, 0.3, 3)
    result = hx.smooth(start, max_iterations=20)
    assert result.after.q_mean > result.before.q_mean
    for points in (start.points, result.mesh.points):
        x, radius, turn = points[:, 0], np.hypot(points[:, 1], points[:, 2]), np.arctan2(points[:, 2], points[:, 1])
        side = layer().points[:, 2] == 0
        np.testing.assert_allclose(x[side], x[~side], atol=1e-13)
        np.testing.assert_allclose(radius[side], radius[~side], atol=1e-13)
        np.testing.assert_allclose(turn[side], -np.radians(2.5), atol=1e-13)
        np.testing.assert_allclose(turn[~side], np.radians(2.5), atol=1e-13)


def test_two_layers_are_refused_and_stay():
    mesh = grid(2).replace(side_sets={"low": np.array([(h, 4) for h in range(4)])}, side_set_types={"low": "empty"})
    with pytest.raises(MeshError, match="hex 0 has a face on 'low', of the type empty, and none opposite"):
        two_dimensional_motion(mesh)
    stays = with_two_dimensional_motion(mesh)
    assert "hex 0 has a face on 'low'" in stays.notes[-1]
    assert stays.linear_motion is None
    assert with_two_dimensional_motion(stays).notes == stays.notes


def test_a_face_of_a_flat_side_without_a_partner_stays_and_the_others_move():
    mesh = layer()
    axis = mesh.side_sets["walls"][:3]
    sides = {**mesh.side_sets, "walls": mesh.side_sets["walls"][3:], "axis": axis}
    alone = mesh.replace(side_sets=sides, side_set_types={**mesh.side_set_types, "axis": "empty"})
    np.testing.assert_array_equal(with_two_dimensional_motion(alone).free, with_two_dimensional_motion(mesh).free)


def test_sides_that_are_no_copies_are_refused():
    mesh = layer()
    points = mesh.points.copy()
    points[50] += [0.01, 0, 0]
    with pytest.raises(MeshError, match=r"not opposite each other: the line between them is inclined by 0\.57"):
        two_dimensional_motion(mesh.with_points(points))
    mesh = wedge()
    with pytest.raises(MeshError, match="from the image of node"):
        two_dimensional_motion(displaced(mesh, 50, [0.1, 0, 0]))
    with pytest.raises(MeshError, match="both sides of the wedge are in 'front'"):
        two_dimensional_motion(layer(kind="wedge"))
