"""Interfaces between materials, which every registered method keeps, or lets slide on themselves.

Methods whose objective counts the quads of a sliding boundary too: over the registry.
"""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend import METHODS, Mesh, Outcome, StoppingCriteria, Target, iterate, smooth
from hexmend.boundary import NodeClass, SlidingBoundary
from hexmend.energy import ObjectiveNorm
from hexmend.energy.quads import SurfaceQuads
from hexmend.gallery import make
from hexmend.quality import measure, objective
from hexmend.quality.material_volumes import material_volumes
from tests.core.boundary.solids import ball, cylinder, slid
from tests.core.grids import displaced, grid, scrambled
from tests.core.linear_motions import planes
from tests.core.threads import by_threads

SLIDING = [
    name for name, cls in METHODS.items() if cls().slides_on(make("materials", size=56).with_rules(interfaces="slide"))
]


def bumpy(n: int = 6) -> Mesh:
    """Two materials with a wave as their interface, scrambled between it and the boundary."""
    mesh = grid(n)
    x = mesh.points / n
    low = mesh.points[mesh.hexes].mean(axis=1)[:, 0] < n / 2
    wave = 0.06 * np.sin(np.pi * x[:, 0]) * np.sin(2 * np.pi * x[:, 1]) * np.sin(2 * np.pi * x[:, 2])
    sets = {"low": np.flatnonzero(low), "high": np.flatnonzero(~low)}
    return scrambled(mesh.with_points(x + wave[:, None] * [1, 0, 0]).replace(hex_sets=sets), 0.25 / n)


@settings(max_examples=4)
@given(seed=st.integers(0, 10**6), parts=st.integers(2, 4))
@pytest.mark.parametrize("name", METHODS)
def test_nodes_between_materials_stay_to_the_last_bit(name, seed, parts):
    mesh = make("five-side", size=60)
    mesh = scrambled(mesh.replace(hex_data={"material": np.random.default_rng(seed).integers(0, parts, 60)}), 0.05)
    if mesh.materials is None:
        return
    on = mesh.materials.interface_nodes
    for step in itertools.islice(METHODS[name]().steps(mesh), 4):
        np.testing.assert_array_equal(step.points[on], mesh.points[on])


@pytest.mark.parametrize("name", SLIDING)
def test_an_interface_that_slides_stays_on_itself_and_leaves_the_boundary(name):
    mesh = bumpy().with_rules(interfaces="slide")
    after = smooth(mesh, name, max_iterations=60).mesh
    boundary = mesh.topology.boundary
    np.testing.assert_array_equal(after.points[boundary], mesh.points[boundary])
    on = mesh.materials.interface_nodes & ~boundary
    assert np.linalg.norm(after.points - mesh.points, axis=1)[on].max() > 1e-3 * mesh.mean_edge_length
    y, z = after.points[on, 1], after.points[on, 2]
    wave = 0.5 + 0.06 * np.sin(2 * np.pi * y) * np.sin(2 * np.pi * z)
    assert np.abs(after.points[on, 0] - wave).max() < 0.1 * mesh.mean_edge_length
    volumes = material_volumes(mesh), material_volumes(after)
    assert all(volumes[1][key] == pytest.approx(volume, rel=0.01) for key, volume in volumes[0].items())


def test_an_interface_is_a_patch_of_its_own_that_ends_in_a_curve_on_the_boundary():
    mesh = bumpy()
    between, outer = mesh.materials.interface_nodes, mesh.topology.boundary
    sliding = SlidingBoundary(mesh)
    assert (sliding.node_class[between & ~outer] == NodeClass.PATCH).all()
    assert (sliding.node_class[between & outer] != NodeClass.PATCH).all()
    patches = set(sliding.boundary.component[between & ~outer])
    others = outer & (sliding.node_class == NodeClass.PATCH)
    assert len(patches) == 1
    assert not patches & set(sliding.boundary.component[others])


def test_corners_are_where_the_interfaces_of_four_materials_meet():
    mesh = grid(4)
    quarter = (mesh.points[mesh.hexes].mean(axis=1) > 2) @ [1, 2, 4]
    mesh = mesh.replace(hex_data={"material": quarter})
    classes = SlidingBoundary(mesh).node_class
    at = {tuple(x): classes[k] for k, x in enumerate(mesh.points)}
    assert at[2, 2, 2] == NodeClass.CORNER
    assert at[2, 2, 1] == NodeClass.CURVE
    assert at[2, 1, 1] == NodeClass.PATCH
    assert at[1, 1, 1] == NodeClass.INSIDE


def test_interfaces_slide_with_the_boundary_and_fixed_sets_stay():
    mesh = bumpy()
    inner = mesh.materials.interface_nodes & ~mesh.topology.boundary
    middle = np.flatnonzero(inner)[:3]
    mesh = mesh.replace(node_sets={"middle": middle})
    after = smooth(mesh, boundary="slide", fix="middle", max_iterations=60).mesh.points
    np.testing.assert_array_equal(after[middle], mesh.points[middle])
    others = np.setdiff1d(np.flatnonzero(inner), middle)
    assert (after[others] != mesh.points[others]).any(axis=1).mean() > 0.5


def test_free_interfaces_move_as_in_a_mesh_of_one_material():
    mesh = bumpy()
    one = smooth(mesh.replace(hex_sets={})).mesh.points
    np.testing.assert_array_equal(smooth(mesh, interfaces="free").mesh.points, one)


def test_a_mesh_whose_nodes_are_all_between_materials_has_nothing_free_unless_they_slide():
    mesh = grid(2).replace(hex_data={"material": np.arange(8) % 2})
    mesh = mesh.with_points(mesh.points + 0.2 * (np.arange(27) == 13)[:, None])
    assert smooth(mesh).outcome is Outcome.NOTHING_FREE
    assert smooth(mesh, interfaces="free").outcome is Outcome.CONVERGED


def test_hexes_between_the_boundary_and_an_interface_are_locked_and_sliding_frees_them():
    mesh = grid(3)
    numbers = mesh.points[mesh.hexes].mean(axis=1)[:, 0] > 1
    node = int(np.flatnonzero((mesh.points == [1, 1, 1]).all(axis=1))[0])
    moved = mesh.points + [0, 1.1, 0] * (np.arange(mesh.n_nodes) == node)[:, None]
    mesh = mesh.replace(hex_data={"material": numbers.astype(int)})
    folded = mesh.with_points(moved)
    kept = smooth(folded)
    assert kept.after.inverted
    assert kept.after.locked_inverted
    assert not smooth(folded, interfaces="free").after.inverted
    assert not smooth(mesh.keeping_surface().with_points(moved), interfaces="slide").after.inverted


@pytest.mark.parametrize("name", ["laplacian", "local-nr", "mend"])
def test_a_node_freed_from_an_interface_leaves_its_neighbours_sliding_on_it(name):
    mesh = bumpy()
    between, outer = mesh.materials.interface_nodes, mesh.topology.boundary
    inner = np.flatnonzero(between & ~outer)
    middle = inner[np.linalg.norm(mesh.points[inner] - 0.5, axis=1).argmin()]
    mesh = mesh.replace(node_sets={"middle": [middle]}).with_rules(interfaces="slide", free="middle")
    sliding = SlidingBoundary(mesh, outer=False)
    assert sliding.node_class[middle] == NodeClass.INSIDE
    assert (sliding.node_class[np.setdiff1d(inner, middle)] == NodeClass.PATCH).all()
    after = smooth(mesh, name, max_iterations=60).mesh.points
    ring = np.intersect1d(mesh.topology.rings.of(np.array([middle])), inner)
    assert ring.size == 4
    assert (after[[middle, *ring]] != mesh.points[[middle, *ring]]).any(axis=1).all()
    wave = 0.5 + 0.06 * np.sin(2 * np.pi * after[ring, 1]) * np.sin(2 * np.pi * after[ring, 2])
    assert np.abs(after[ring, 0] - wave).max() < 0.1 * mesh.mean_edge_length


WEIGHTED = sorted(name for name, method in METHODS.items() if hasattr(method, "surface_weight"))
DESCENTS = [name for name in WEIGHTED if name != "local-patch"]
SOLIDS = {"block": lambda: grid(3, 2, 4), "cylinder": lambda: cylinder(16, 3), "ball": lambda: ball(3)}
FEW = StoppingCriteria(max_iterations=20)


def sliding(name, weight, **values):
    return METHODS[name](boundary="slide", surface_weight=weight, **values)


def quads_of(mesh, points=None):
    """The corners of the quads of the boundary at some points, on the surface of a mesh."""
    return SurfaceQuads(SlidingBoundary(mesh), ObjectiveNorm(), 1.0).corners(mesh.points if points is None else points)


@pytest.mark.parametrize("name", WEIGHTED)
def test_a_weight_that_counts_nothing_gives_the_same_points(name):
    """The quads are in the sums, with a share that no sum feels: what is summed besides is as without them."""
    mesh = slid(cylinder(16, 3), 0.3)
    without, with_quads = (
        [step.points for step in itertools.islice(sliding(name, weight).steps(mesh), 3)] for weight in (0, 1e-300)
    )
    for one, other in zip(without, with_quads, strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", ["local-nr", "global-nr"])
def test_a_fixed_boundary_ignores_it_and_says_so(name):
    mesh = slid(grid(3), 0.3)
    one, other = (smooth(mesh, METHODS[name](surface_weight=weight), FEW) for weight in (0, 5))
    np.testing.assert_array_equal(one.mesh.points, other.mesh.points)
    assert "surface_weight has no effect with boundary = fixed." in other.message
    assert "surface_weight" not in one.message
    assert "surface_weight" not in smooth(mesh, sliding(name, 5), FEW).message


@pytest.mark.parametrize(("name", "solid"), list(zip(DESCENTS, 2 * sorted(SOLIDS), strict=True)))
def test_the_recorded_objective_is_the_one_that_is_minimised(name, solid):
    mesh, weight = slid(SOLIDS[solid](), 0.25, 1), 2.0
    run = iterate(mesh, sliding(name, weight, p=3.0), StoppingCriteria(max_iterations=6))
    points = [mesh.points, *(iteration.points for iteration in run)]
    quads = SurfaceQuads(SlidingBoundary(mesh), ObjectiveNorm(3.0), weight)
    for row, x in zip(run.history, points, strict=True):
        expected = objective(measure(x, mesh.hexes), 3.0) + quads.objective(x).value
        assert row["objective"] == pytest.approx(expected, rel=1e-12)
        assert row["objective_formula"] == "Σ η³ + 2 Σ η³ of quads"
    for before, after in itertools.pairwise(points):
        term = quads.at(before, 0.0, 0.01)  # with the normals that are held in the step
        assert term.delta == 0
        then, now = (
            objective(measure(x, mesh.hexes), 3.0) + term.value(x / quads.unit, quads.norm) for x in (before, after)
        )
        assert now <= then * (1 + 1e-12)
    values = [row["objective"] for row in run.history]
    assert values[-1] < 0.8 * values[0]


@pytest.mark.parametrize("name", ["local-mnr", "global-nr"])
def test_a_skewed_surface_gets_better_quads_than_without(name):
    mesh = cylinder(16, 3)
    twist = 0.5 * mesh.points[:, 2:] ** 2 * np.array([-mesh.points[:, 1], mesh.points[:, 0]]).T
    mesh = mesh.with_points(mesh.points + np.column_stack([twist, np.zeros(mesh.n_nodes)]))
    mesh = slid(mesh.keeping_surface(), 0.2, 3)
    stop = StoppingCriteria(max_iterations=60, keep_last=True)
    without, with_quads = (
        quads_of(mesh, smooth(mesh, sliding(name, weight), stop).mesh.points).qualities for weight in (0, 10)
    )
    assert with_quads.mean() > without.mean() + 1e-4
    assert with_quads.mean() > quads_of(mesh).qualities.mean() + 0.01


def with_a_flipped_quad():
    """A cube in which a node of a face is beyond a diagonal of its quads, but so little inside that no hex is inverted."""
    cube = grid(4)
    node = int(np.flatnonzero((cube.points == [2, 2, 0]).all(axis=1))[0])
    return displaced(cube, node, [0.8, 0.8, 0]), node


@pytest.mark.parametrize("name", WEIGHTED[::3])
def test_a_flipped_quad_is_untangled(name):
    mesh, node = with_a_flipped_quad()
    assert (quads_of(mesh).sigma <= 0).any()
    result = smooth(mesh, sliding(name, 1.0), StoppingCriteria(max_iterations=60))
    assert result.after.inverted == 0
    assert quads_of(mesh, result.mesh.points).sigma.min() > 0.5
    assert np.abs(result.mesh.points[node] - [2, 2, 0]).max() < 0.2


@given(
    name=st.sampled_from(WEIGHTED),
    solid=st.sampled_from(sorted(SOLIDS)),
    amplitude=st.sampled_from([0.1, 0.3, 0.6]),
    weight=st.sampled_from([0.1, 1.0, 100.0]),
    seed=st.integers(0, 2**32 - 1),
)
def test_nodes_stay_on_their_surface_and_the_objective_ends_no_higher(name, solid, amplitude, weight, seed):
    mesh = slid(SOLIDS[solid](), amplitude, seed)
    boundary = SlidingBoundary(mesh)
    run = iterate(mesh, sliding(name, weight), StoppingCriteria(max_iterations=5))
    for iteration in run:
        np.testing.assert_array_equal(iteration.points[boundary.mesh.fixed], mesh.points[boundary.mesh.fixed])
        x = iteration.points[boundary.nodes]
        assert np.linalg.norm(boundary.project(x) - x, axis=1).max() < 1e-9
    values = [row["objective"] for row in run.history]
    if values[0] is not None and values[-1] is not None and solid == "block" and name != "local-patch":
        assert values[-1] <= values[0] * (1 + 1e-9)


def test_local_and_global_steps_reach_the_same_optimum():
    mesh = slid(grid(4, 3, 2).with_points(grid(4, 3, 2).points * [1, 1.4, 1]), 0.2, 2)
    stop = StoppingCriteria(tolerance=1e-9, max_iterations=600)
    ends = [smooth(mesh, sliding(name, 3.0), stop).mesh.points for name in ("local-nr", "global-nr")]
    np.testing.assert_allclose(*ends, atol=1e-5)


@pytest.mark.parametrize("name", ["local-nr", "global-nr"])
def test_the_number_of_threads_does_not_matter(name):
    mesh, method = slid(cylinder(32, 3), 0.3), sliding(name, 1.0)
    np.testing.assert_array_equal(*by_threads(lambda: next(itertools.islice(method.steps(mesh), 3, None)).points))


@pytest.mark.parametrize("name", ["local-nr", "global-nr"])
def test_with_a_target_the_quads_are_to_have_its_lengths(name):
    block = grid(4).with_points(grid(4).points * [1, 1, 0.1])
    mesh = block.with_element_target(Target(np.tile([1.0, 1.0, 0.1], (block.n_hexes, 1))))
    for step in itertools.islice(sliding(name, 1.0).steps(mesh), 3):
        assert step.surface.value == pytest.approx(0, abs=1e-12)
    moved = slid(block, 0.02, 1)
    steps = sliding(name, 1.0).steps(moved.with_element_target(mesh.element_target))
    values = [step.surface.value for step in itertools.islice(steps, 12)]
    assert values[-1] < 0.01 * values[0]


@pytest.mark.parametrize("name", ["local-nr", "local-patch", "global-nr"])
def test_nodes_with_a_linear_motion_keep_it(name):
    cube = grid(4)
    mesh = cube.with_linear_motion(planes(cube, axes=(0,)))
    shift = np.random.default_rng(0).uniform(-0.2, 0.2, mesh.points.shape) * mesh.free[:, None]
    mesh = mesh.with_points(mesh.constrained(mesh.points + shift))
    run = iterate(mesh, sliding(name, 1.0), StoppingCriteria(max_iterations=8))
    formulas = [run.history[0]["objective_formula"], *(it.row()["objective_formula"] for it in run)]
    assert set(formulas) == {"Σ η² + 1 Σ η² of quads"}
    ends = np.isin(cube.points[:, 0], (0, 4))
    np.testing.assert_array_equal(run.last.points[ends, 0], cube.points[ends, 0])
    assert run.history[-1]["objective"] < 0.5 * run.history[0]["objective"]
