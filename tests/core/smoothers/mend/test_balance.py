"""Goal balanced: of a sound mesh no figure falls, tangled ones are untangled, and a boundary that slides ends no lower."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from hexmend.io import read
from hexmend.iteration import Outcome, StoppingCriteria
from hexmend.quality import measure, summarise
from hexmend.quality.regressions import WORSE_BY
from hexmend.run import smooth
from hexmend.smoothers import METHODS
from hexmend.smoothers.mend.floors import Floors
from hexmend.smoothers.mend.inversion import inverted_corners
from tests.core.boundary.solids import ball, cylinder, slid, wavy
from tests.core.grids import grid, scrambled
from tests.core.smoothers.mend.test_mend import with_locked_corner

Mend = METHODS["mend"]
FIGURES = "q_min", "q_mean", "scaled_jacobian_min"

#: Small meshes, cheap to draw many of.
MESHES = {
    "grid": lambda: grid(3),
    "wavy": lambda: wavy(grid(3), 0.3),
    "five-side": lambda: make("five-side", size=60),
    "bridge-sharp": lambda: make("bridge-sharp", size=60),
    "plane": lambda: make("plane", size=100),
    "cylinder": lambda: cylinder(16, 2),
    "ball": lambda: ball(3),
}


def changes(before, after):
    """By how much each figure is higher."""
    return {name: getattr(after, name) - getattr(before, name) for name in FIGURES}


def movable_least(mesh, points):
    """The least values of what can be moved, without the corners that are inverted."""
    inverted = inverted_corners(points, mesh.hexes, measure(points, mesh.hexes))
    return Floors(MeshEnergy(mesh, ObjectiveNorm(1.0), inverted), points).values


def check_nothing_falls(result):
    assert result.before.inverted == result.after.inverted == 0
    fallen = {name: change for name, change in changes(result.before, result.after).items() if change < -WORSE_BY}
    assert not fallen, f"{result.before} became {result.after}"


def test_it_is_the_default_and_p_follows_the_goal():
    assert Mend().goal == "balanced"
    assert [Mend(goal=goal).norm.p for goal in ("balanced", "shape", "scaled-jacobian")] == [1, 2, 2]
    assert [Mend(goal=goal, p=4.0).norm.p for goal in ("balanced", "shape")] == [4, 4]


@given(
    name=st.sampled_from(sorted(MESHES)),
    amplitude=st.sampled_from([0.0, 0.05, 0.15, 0.25]),
    iterations=st.sampled_from([3, 10, 300]),
    seed=st.integers(0, 2**32 - 1),
)
def test_of_a_sound_mesh_nothing_falls_wherever_it_is_stopped(name, amplitude, iterations, seed):
    mesh = MESHES[name]()
    mesh = scrambled(mesh, amplitude * mesh.mean_edge_length, seed)
    result = smooth(mesh, Mend(), StoppingCriteria(max_iterations=iterations))
    assert result.after.inverted <= result.before.inverted
    if result.before.inverted == 0:
        check_nothing_falls(result)


@pytest.mark.parametrize(
    ("name", "first"), [("five-side", "laplacian"), ("bridge-sharp", "getme"), ("plane", "local-sd")]
)
def test_nothing_falls_after_another_method_and_something_rises(name, first):
    mesh = smooth(make(name, size=300), first).mesh
    result = smooth(mesh, Mend())
    if result.before.inverted:
        assert result.after.inverted == 0
        return
    check_nothing_falls(result)
    assert max(changes(result.before, result.after).values()) > 1e-3


def test_a_mean_that_would_fall_is_kept():
    """Each face of a cube has a node so deep inside that hexes are nearly flat: the best shape has a lower mean."""
    cube = make("cube", size=27)
    points, size = cube.points.copy(), np.ptp(cube.points)
    first = cube.points.min(axis=0) + size / 3
    for axis in range(3):
        inner = np.isclose(np.delete(cube.points, axis, axis=1), np.delete(first, axis)).all(axis=1)
        for side, inwards in ((cube.points.min(), 0.33), (cube.points.max(), -0.33)):
            points[inner & np.isclose(cube.points[:, axis], side), axis] += inwards * size
    mesh = cube.with_points(points)
    shape = smooth(mesh, Mend(goal="shape", p=1.0)).after
    result = smooth(mesh, Mend())
    assert shape.q_mean < result.before.q_mean - 0.01
    check_nothing_falls(result)


@pytest.mark.parametrize("name", ["five-side", pytest.param("plane", marks=pytest.mark.slow)])
def test_a_tangled_mesh_ends_as_good_as_by_the_goals_it_balances(name):
    mesh = make(name, size=150, scramble=0.8, seed=3)
    assert summarise(mesh).inverted > 10
    balanced, raised = (smooth(mesh, Mend(goal=goal)).after for goal in ("balanced", "scaled-jacobian"))
    shape = smooth(mesh, Mend(goal="shape", p=1.0)).after
    assert balanced.inverted == 0
    assert balanced.scaled_jacobian_min >= 0.94 * raised.scaled_jacobian_min
    assert balanced.scaled_jacobian_min >= shape.scaled_jacobian_min - 1e-9
    assert balanced.q_min >= min(shape.q_min, raised.q_min) - 1e-9
    assert balanced.q_mean >= raised.q_mean - 1e-9


def test_beside_a_locked_hex_no_figure_of_the_others_falls():
    mesh = with_locked_corner(make("five-side", size=300))
    result = smooth(mesh, Mend())
    locked = measure(mesh.points, mesh.hexes).inverted
    assert (result.before.inverted, result.after.inverted, result.after.locked_inverted) == (1, 1, 1)
    before, after = (measure(points, mesh.hexes) for points in (mesh.points, result.mesh.points))
    for name in ("q", "scaled_jacobian"):
        old, new = (getattr(one, name)[~locked].min() for one in (before, after))
        assert new >= old
    start, end = movable_least(mesh, mesh.points), movable_least(mesh, result.mesh.points)
    assert end.jacobian > start.jacobian + 0.01
    assert end.quality > start.quality + 0.01
    assert "The minimum scaled Jacobian of the corners that can be moved reached" in result.message


def test_the_result_is_said_with_what_was_possible():
    mesh = make("five-side", size=100)
    result = smooth(mesh, Mend())
    least = movable_least(mesh, result.mesh.points)
    assert "The minimum scaled Jacobian of the corners that can be moved reached " in result.message
    assert (
        f"the result has at least {least.jacobian:.4f}, and a q(H) of at least {least.quality:.4f}." in result.message
    )


SLIDING = {
    "cylinder": lambda: slid(cylinder(16, 2), 0.4, 3),
    "five-side": lambda: make("five-side", size=60),
}


def check_freedom(mesh):
    """Check that neither least is lower with the boundary sliding than fixed."""
    fixed, slides = (smooth(mesh, Mend(boundary=boundary)) for boundary in ("fixed", "slide"))
    assert slides.after.inverted <= fixed.after.inverted
    if fixed.after.inverted:
        return
    for name in ("scaled_jacobian_min", "q_min"):
        assert getattr(slides.after, name) >= getattr(fixed.after, name) - 1e-9, (fixed.after, slides.after)
    if not slides.before.inverted:
        check_nothing_falls(slides)


@pytest.mark.parametrize("name", ["cylinder", pytest.param("five-side", marks=pytest.mark.slow)])
def test_a_boundary_that_slides_ends_no_lower_than_a_fixed_one(name):
    check_freedom(SLIDING[name]())


def test_a_run_that_is_cut_while_the_boundary_slides_keeps_the_result_with_the_boundary_fixed():
    mesh = slid(cylinder(16, 2), 0.2, 3)
    fixed, slides = (smooth(mesh, Mend(boundary=boundary)) for boundary in ("fixed", "slide"))
    assert fixed.after.inverted == 0
    for limit in range(fixed.iterations, slides.iterations):
        cut = smooth(mesh, Mend(boundary="slide"), max_iterations=limit)
        assert cut.outcome is Outcome.MAX_ITERATIONS
        for name in ("scaled_jacobian_min", "q_min"):
            assert getattr(cut.after, name) >= getattr(fixed.after, name) - 1e-9, (limit, fixed.after, cut.after)


SLOW = [pytest.param(name, marks=pytest.mark.slow) for name in ("bridge-sharp", "CAD4.vtk")]


@pytest.mark.parametrize("name", ["five-side", "pave3.e.vtk", "hex_5_tangled.vtk", *SLOW])
def test_nothing_falls_in_meshes_of_others_and_of_the_gallery(sample_mesh, name):
    result = smooth(sample_mesh(name), Mend())
    assert result.after.inverted == result.after.locked_inverted
    if result.before.inverted == 0:
        check_nothing_falls(result)
        assert result.after.scaled_jacobian_min > result.before.scaled_jacobian_min


@pytest.mark.slow
def test_of_a_larger_real_mesh_nothing_falls(real_mesh):
    check_nothing_falls(smooth(read(real_mesh("swivel2_7494.mesh")), Mend()))


@pytest.mark.slow
def test_where_much_is_gained_the_least_comes_near_that_of_its_own_goal(real_mesh):
    mesh = read(real_mesh("rockerarm_2.mesh"))
    balanced, highest = (smooth(mesh, Mend(goal=goal)).after for goal in ("balanced", "scaled-jacobian"))
    assert balanced.scaled_jacobian_min >= 0.95 * highest.scaled_jacobian_min


def test_the_least_of_the_table_is_explained_where_it_is_at_a_fixed_corner():
    tangled = smooth(make("bridge-sharp", size=864, scramble=0.4, seed=1), Mend())
    least = tangled.after.scaled_jacobian_min
    movable = movable_least(tangled.mesh, tangled.mesh.points).jacobian
    assert 0 < least < movable - 1e-3
    assert f" A corner that cannot be moved has {least:.4f}." in tangled.message
    assert "cannot be moved" not in smooth(make("cube", size=64, scramble=0.4), Mend()).message
