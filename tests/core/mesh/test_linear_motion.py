"""Linear constraints on the displacements of nodes: planes, lines, ties, and points that keep them exactly."""

import copy
import pickle

import numpy as np
import pytest

from hexmend import LinearMotion, MeshError, Target, gallery
from hexmend.mesh.linear_motion.constrained_points import admissible_displacements
from tests.core.grids import grid
from tests.core.linear_motions import planes, turn

MESH = grid(4)
FACES = {
    (axis, end): np.flatnonzero(MESH.points[:, axis] == end) for axis in range(3) for end in (0, MESH.points.max())
}


def test_nodes_of_two_planes_move_along_a_line_and_corners_stay():
    motion = planes(MESH)
    sides = sum(np.isin(np.arange(MESH.n_nodes), nodes).astype(int) for nodes in FACES.values())
    np.testing.assert_array_equal(3 - motion.ranks, sides[motion.nodes])
    np.testing.assert_array_equal(MESH.with_linear_motion(motion).fixed, sides == 3)
    assert set(np.unique(motion.projectors)) == {0.0, 1.0}


def test_skew_planes_meet_in_a_line():
    motion = LinearMotion.in_planes([7, 7], [[1.0, 2, 0], [0, 1, -1]])
    line = np.cross([1.0, 2, 0], [0, 1, -1])
    np.testing.assert_allclose(motion.projectors[0] @ line, line, atol=1e-12)
    assert motion.ranks.tolist() == [1]
    same = LinearMotion.in_planes([7, 7], [[1.0, 2, 0], [1 + 1e-7, 2, 0]])
    assert same.ranks.tolist() == [2]
    other = LinearMotion.along_lines([7], [3.0, 0, 0])
    assert motion.merge(other).ranks.tolist() == [0]


def test_a_restriction_of_a_tied_node_is_its_masters():
    quarter = turn(90)
    motion = LinearMotion.tying([5], [2], quarter).merge(LinearMotion.in_planes([5], [0.0, 0, 1]))
    assert motion.nodes.tolist() == [2]
    np.testing.assert_array_equal(motion.projectors[0], np.diag([1.0, 0, 1]))


def test_chains_and_cycles_of_ties_end_at_one_master():
    motion = LinearMotion.tying([1, 3], [0, 2]).merge(LinearMotion.tying([2, 3], [0, 1]))
    assert motion.tied.tolist() == [1, 2, 3]
    assert motion.master.tolist() == [0, 0, 0]
    chain = LinearMotion.tying([1], [0], turn(30)).merge(LinearMotion.tying([2], [1], turn(15)))
    np.testing.assert_allclose(chain.rotations[1], turn(45), atol=1e-12)
    cycle = chain.merge(LinearMotion.tying([2], [0], turn(20)))
    np.testing.assert_allclose(cycle.projectors, [np.diag([1.0, 0, 0])], atol=1e-9)


def test_nodes_are_renumbered_and_those_that_followed_a_removed_one_follow_one_of_them():
    motion = LinearMotion.tying([2, 3, 4], [1, 1, 1], turn(30)).merge(LinearMotion.in_planes([1, 0], [0.0, 1, 0]))
    number = np.array([5, -1, 4, 1, 0])
    other = motion.renumbered(number)
    assert (other.tied.tolist(), other.master.tolist(), other.nodes.tolist()) == ([1, 4], [0, 0], [0, 5])
    np.testing.assert_allclose(other.rotations, np.tile(np.eye(3), (2, 1, 1)), atol=1e-12)
    steps = np.random.default_rng(0).normal(size=(6, 3))
    nearest = admissible_displacements(other, steps)
    assert abs(nearest[0] @ turn(30) @ [0, 1, 0]) < 1e-12
    same = motion.renumbered(np.array([1, 0, 4, 3, 2]))
    assert (same.tied.tolist(), same.master.tolist()) == ([2, 3, 4], [0, 0, 0])


def test_a_node_tied_to_itself_by_a_rotation_moves_along_the_axis():
    motion = LinearMotion.tying([4], [4], turn(5))
    assert (motion.nodes.tolist(), motion.ranks.tolist(), motion.tied.size) == ([4], [1], 0)
    np.testing.assert_array_equal(motion.projectors[0], np.diag([1.0, 0, 0]))


def test_pinned_nodes_stay_and_what_is_tied_to_them():
    x0, x1 = FACES[0, 0], FACES[0, MESH.points.max()]
    mesh = MESH.with_linear_motion(LinearMotion.tying(x1, x0))
    assert mesh.free[x0].all()
    assert mesh.free[x1].all()
    mesh = mesh.replace(pinned=np.isin(np.arange(mesh.n_nodes), x1[:2]))
    np.testing.assert_array_equal(mesh.fixed[x0], mesh.fixed[x1])
    np.testing.assert_array_equal(np.flatnonzero(mesh.fixed[x1]), [0, 1])
    assert mesh.with_fixed(np.isin(np.arange(mesh.n_nodes), x1[3:])).fixed[x0[3:]].all()


def test_the_motion_stays_with_the_mesh_until_it_is_ended():
    mesh = MESH.with_linear_motion(planes(MESH))
    for other in (
        mesh.with_points(mesh.points + 0.0),
        mesh.with_fixed(mesh.fixed),
        mesh.replace(name="a"),
        mesh.keeping_surface(),
        mesh.rebuilt(hexes=mesh.hexes),
        copy.deepcopy(mesh),
        pickle.loads(pickle.dumps(mesh)),
    ):
        np.testing.assert_array_equal(other.linear_motion.projectors, mesh.linear_motion.projectors)
        np.testing.assert_array_equal(other.fixed, mesh.fixed)
    assert mesh.with_linear_motion(None).linear_motion is None
    np.testing.assert_array_equal(mesh.with_linear_motion(None).fixed, MESH.fixed)
    assert MESH.linear_motion is None
    assert MESH.constrained(MESH.points) is MESH.points


def test_constrained_points_keep_planes_and_translated_copies_to_the_last_bit():
    rng = np.random.default_rng(1)
    mesh = MESH.with_points(MESH.points * [1.0, 0.3, 7.1] + [0.1, 0.0, 3.3])
    x0, x1, z0, z1 = FACES[0, 0], FACES[0, MESH.points.max()], FACES[2, 0], FACES[2, MESH.points.max()]
    motion = LinearMotion.tying(x1, x0).merge(LinearMotion.tying(z1, z0))
    motion = motion.merge(LinearMotion.in_planes(np.concatenate([z0, FACES[1, 0]]), np.eye(3)[[2] * 25 + [1] * 25]))
    mesh = mesh.with_linear_motion(motion)
    points = mesh.constrained(mesh.points + rng.normal(0, 0.01, mesh.points.shape))
    points = mesh.constrained(points + rng.normal(0, 0.01, mesh.points.shape))
    np.testing.assert_array_equal(points[z0, 2], mesh.points[z0, 2])
    np.testing.assert_array_equal(points[z0, :2], points[z1, :2])
    np.testing.assert_array_equal(points[FACES[1, 0], 1], mesh.points[FACES[1, 0], 1])
    np.testing.assert_array_equal(points[x1] - points[x0], mesh.points[x1] - mesh.points[x0])
    np.testing.assert_array_equal(mesh.constrained(points), points)
    assert (points != mesh.points).any(axis=1).mean() > 0.9


def test_rotated_copies_do_not_drift():
    rng = np.random.default_rng(2)
    rotation = turn(5)
    points = MESH.points.copy()
    x0, x1 = FACES[0, 0], FACES[0, MESH.points.max()]
    points[x1] = points[x0] @ rotation.T
    mesh = MESH.with_points(points).with_linear_motion(LinearMotion.tying(x1, x0, rotation))
    for _ in range(100):
        points = mesh.constrained(points + rng.normal(0, 0.1, points.shape))
    np.testing.assert_allclose(points[x1], points[x0] @ rotation.T, atol=1e-14)
    np.testing.assert_array_equal(points[x1, 0], points[x0, 0])


def test_admissible_displacements_are_the_nearest():
    rng = np.random.default_rng(3)
    motion = LinearMotion.tying([5, 6], [2, 2], turn(40)).merge(LinearMotion.in_planes([2, 9], [1.0, 2, 3]))
    given = rng.normal(size=(12, 3))
    nearest = admissible_displacements(motion, given)
    np.testing.assert_allclose(admissible_displacements(motion, nearest), nearest, atol=1e-12)
    for _ in range(5):
        other = admissible_displacements(motion, rng.normal(size=(12, 3)))
        assert abs(np.sum((given - nearest) * other)) < 1e-12


ERRORS = [
    (lambda: LinearMotion(nodes=[3], projectors=[np.eye(3) * 0.5]), "projector of node 3 is none"),
    (lambda: LinearMotion.in_planes([3], [0.0, 0, 0]), "normals of node 3 are"),
    (lambda: LinearMotion.in_planes([3, 4], [[0.0, 0, 1]]), "expected .3,. or .2, 3."),
    (lambda: LinearMotion.in_planes([-3], [0.0, 0, 1]), "numbers of nodes"),
    (lambda: LinearMotion.tying([3], [4], np.ones((3, 3))), "rotation of node 3 is none"),
    (lambda: LinearMotion.tying([3], [4, 5]), "1 tied nodes have 2 masters"),
    (lambda: LinearMotion(nodes=[3]), "expected .1, 3, 3."),
    (lambda: MESH.with_linear_motion(LinearMotion.keeping([125])), "names node 125, but the mesh has 125"),
]


@pytest.mark.parametrize(("make", "message"), ERRORS)
def test_errors_name_the_node(make, message):
    with pytest.raises(MeshError, match=message):
        make()


# Targets of elements: their checks, and the meshes that carry them.


@pytest.fixture
def mesh():
    return gallery.make("cube", size=8)


IMPOSSIBLE_LENGTHS = [
    (np.ones(3), "shape"),
    (np.ones((2, 2)), "shape"),
    (np.zeros((2, 3)), "is 0 at hex 0"),
    ([[1, 1, 1], [1, np.nan, 1]], "is nan at hex 1, direction 1"),
    ([[1, 1, np.inf]], "positive finite"),
    ([[1, 1, -1]], "is -1 at hex 0, direction 2"),
    ([[1, 1e300, 1]], r"is 1e\+300 at hex 0, direction 1 .*: expected positive .* from 1e-100 to 1e\+100"),
    ([[1e-300, 1, 1]], "is 1e-300 at hex 0, direction 0"),
    (np.ones((2, 3), bool), "type bool"),
]


@pytest.mark.parametrize(("lengths", "message"), IMPOSSIBLE_LENGTHS)
def test_impossible_lengths_are_named(lengths, message):
    with pytest.raises(MeshError, match=message):
        Target(lengths)


@pytest.mark.parametrize("weight", [-1, np.nan, np.inf])
def test_impossible_weights_are_named(weight):
    with pytest.raises(MeshError, match="weight of the size"):
        Target(np.ones((1, 3)), weight)


def test_lengths_are_read_only_and_independent_of_the_callers():
    lengths = np.ones((2, 3))
    target = Target(lengths)
    lengths[:] = 2
    assert (target.lengths == 1).all()
    assert not target.lengths.flags.writeable


def test_derived_meshes_keep_the_target(mesh):
    target = Target(np.ones((mesh.n_hexes, 3)), 0.5, "given")
    aimed = mesh.with_element_target(target)
    derived = {
        "points": aimed.with_points(mesh.points + 1),
        "fixed": aimed.with_fixed(mesh.fixed),
        "surface": aimed.keeping_surface(),
        "field": aimed.replace(name="other"),
        "deep copy": copy.deepcopy(aimed),
    }
    assert {name for name, one in derived.items() if one.element_target is not target} == set()
    assert mesh.element_target is None
    assert aimed.topology is mesh.topology


def test_a_target_of_other_hexes_is_refused(mesh):
    with pytest.raises(MeshError, match="target is for 1 hex: the mesh has 8"):
        mesh.with_element_target(Target(np.ones((1, 3))))
