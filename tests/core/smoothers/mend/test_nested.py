"""The optimum of shape begins at that of the coarse mesh where the mesh is a refinement."""

import numpy as np
import pytest

import hexmend as hx
from hexmend.boundary import SlidingBoundary
from hexmend.energy import energy_of
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.smoothers.mend import shape_stages, stages
from hexmend.smoothers.mend.mend import Mend
from hexmend.smoothers.mend.nested.coarse_problem import coarse_problem
from hexmend.smoothers.mend.nested.nested_start import NestedConfig, nested_start
from tests.core.curved_shell import curved_shell
from tests.core.grids import grid
from tests.core.linear_motions import periodic, planes
from tests.core.refined_meshes import refined, renumbered
from tests.core.smoothers.mend.walks import walked

FORCED = NestedConfig(free_nodes=1, coarsest=1)
NEVER = NestedConfig(free_nodes=10**9)
SHAPE = Mend(goal="shape", p=1.0)


@pytest.fixture
def forced(monkeypatch):
    """All meshes that are refinements begin at coarse ones."""

    class Forced(stages.Stages):
        def __init__(self, settings):
            super().__init__(settings, FORCED)

    monkeypatch.setattr("hexmend.smoothers.mend.mend.Stages", Forced)


def scrambled(mesh, amplitude, seed=0):
    """Free nodes moved at random, by a share of the mean edge length at most along each axis."""
    shift = np.random.default_rng(seed).uniform(-1, 1, mesh.points.shape) * amplitude * mesh.mean_edge_length
    return mesh.with_points(mesh.points + shift * mesh.free[:, None])


def coarse_optimum(settings=SHAPE):
    return shape_stages.ShapeStages(settings, FORCED).coarse_shape


def start(mesh, energy, config=FORCED):
    return walked(nested_start(mesh, energy, coarse_optimum(), lambda given, begun: True, config))


def value(energy, points):
    return measure(points, energy.mesh.hexes).n_inverted, energy.value(energy.to_edge_units(points))


FIXED = {
    "lattice": lambda: grid(4),
    "five-side": lambda: refined(make("five-side", size=40)),
    "bridge-sharp": lambda: renumbered(refined(make("bridge-sharp", size=200)), 0)[0],
    "twice": lambda: refined(refined(make("five-side", size=20))),
    "pins": lambda: pinned(refined(make("five-side", size=40))),
    "planes": lambda: refined(grid(3)).with_linear_motion(planes(refined(grid(3)))),
}


def pinned(mesh):
    return mesh.replace(pinned=np.random.default_rng(3).random(mesh.n_nodes) < 0.2)


@pytest.mark.parametrize(("name", "amplitude"), list(zip(FIXED, 2 * [0.0, 0.2, 0.7], strict=True)))
def test_the_start_is_no_worse_than_the_given_points_and_keeps_fixed_nodes_and_planes(name, amplitude):
    whole = FIXED[name]()
    mesh = whole.with_points(whole.constrained(scrambled(whole, amplitude).points))
    energy = energy_of(mesh, SHAPE.norm)
    steps, points = start(mesh, energy)
    assert value(energy, points) <= value(energy, mesh.points)
    assert steps
    for found in [points, *(step.points for step in steps)]:
        assert np.array_equal(found[mesh.fixed], mesh.points[mesh.fixed])
        assert np.array_equal(whole.constrained(found), found)
    assert all(step.intermediate for step in steps)
    assert all("coarse_hexes" in step.diagnostics for step in steps if step.diagnostics)


def test_a_scrambled_lattice_begins_at_the_lattice():
    mesh = scrambled(grid(8), 0.3)
    assert measure(mesh.points, mesh.hexes).q.min() < 0.7
    _, points = start(mesh, energy_of(mesh, SHAPE.norm))
    np.testing.assert_allclose(points, grid(8).points, atol=1e-6)


def test_displacements_keep_what_positions_would_lose():
    """Hexes that are thin in turn: between the nodes of the coarse mesh positions would make them equal."""
    whole = grid(8)
    lines = np.array([0, 0.2, 2, 2.2, 4, 4.2, 6, 6.2, 8])
    mesh = Mesh(np.column_stack([lines[whole.points[:, 0].astype(int)], whole.points[:, 1:]]), whole.hexes)
    problem = coarse_problem(mesh, energy_of(mesh, SHAPE.norm), 1)
    by_positions, by_displacements = (
        interpolated(problem.mesh.points) for interpolated in (problem.by_positions, problem.by_displacements)
    )
    assert np.array_equal(by_displacements, mesh.points)
    inner = ~mesh.topology.boundary
    assert np.abs(by_positions - mesh.points)[inner].max() > 0.5


@pytest.mark.parametrize("turned", [False, True])
def test_curved_boundaries_slide_on_the_surface_of_the_fine_mesh(turned):
    shell = curved_shell(through=2, around=4, along=2)
    whole = refined(Mesh(shell.points, shell.hexes)) if turned else fine_shell()
    sliding = SlidingBoundary(whole)
    shift = np.random.default_rng(1).uniform(-0.3, 0.3, whole.points.shape) * whole.mean_edge_length
    moved = sliding.linear_mesh.constrained(whole.points + shift * sliding.mesh.free[:, None])
    mesh = sliding.mesh.with_points(sliding.projected(moved))
    energy = energy_of(mesh, SHAPE.norm, sliding)
    _, points = start(mesh, energy)
    assert sliding.curved_nodes.size
    assert value(energy, points) <= value(energy, mesh.points)
    assert np.array_equal(points[sliding.mesh.fixed], mesh.points[sliding.mesh.fixed])
    off = sliding.project(points[sliding.nodes]) - points[sliding.nodes]
    assert np.abs(off).max() < 1e-9


def fine_shell():
    shell = curved_shell(through=4, around=8, along=4)
    return Mesh(shell.points, shell.hexes)


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
def test_the_optimum_is_that_without_the_start_or_better(boundary):
    whole = refined(make("five-side", size=100))
    mesh, smoother = scrambled(whole, 0.3), Mend(goal="shape", p=1.0, boundary=boundary)
    ends = []
    for config in (NEVER, FORCED):
        steps, _ = walked(stages.Stages(smoother, config).steps(mesh))
        ends.append(measure(steps[-1].points, mesh.hexes).eta.sum())
    if boundary == "fixed":
        assert ends[1] == pytest.approx(ends[0], rel=1e-8)
    else:  # on facets steps end at several points
        assert ends[1] < ends[0] * (1 + 1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("goal", ["shape", "balanced"])
def test_kershaws_mesh_ends_at_the_lattice_in_fewer_steps_of_all_its_nodes(goal):
    mesh, smoother = make("kershaw", size=24**3), Mend(goal=goal, boundary="slide", p=1.0)
    counts = []
    for config in (NEVER, FORCED):
        steps, _ = walked(stages.Stages(smoother, config).steps(mesh))
        places = steps[-1].points * 24
        assert np.abs(places - np.rint(places)).max() < 1e-6
        assert np.array_equal(steps[-1].points[mesh.immovable], mesh.points[mesh.immovable])
        counts.append(sum("coarse_hexes" not in step.diagnostics for step in steps))
    assert counts[1] < 0.6 * counts[0]


@pytest.mark.usefixtures("forced")
def test_runs_keep_interfaces_and_lower_no_figure():
    coarse = make("materials", size=200)
    fine, _ = renumbered(refined(Mesh(coarse.points, coarse.hexes)), 0)
    material = (fine.points[fine.hexes].mean(axis=1)[:, 0] > np.median(fine.points[:, 0])).astype(np.int32)
    mesh = fine.rebuilt(hex_data={"material": material})
    assert mesh.interfaces is not None
    result = hx.smooth(scrambled(mesh, 0.1), "mend", layers="free")
    assert np.array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])
    assert result.after.q_min >= result.before.q_min - 1e-9
    assert result.after.q_mean >= result.before.q_mean - 1e-9


def with_target(mesh):
    return Mend(target="given-shape").with_target(mesh, hx.layers.Layers())


@pytest.mark.parametrize(
    "mesh", [grid(3), with_target(grid(4)), periodic(4), grid(2)], ids=["odd", "target", "periodic", "too small"]
)
def test_other_meshes_begin_where_they_are(mesh):
    energy = energy_of(mesh, SHAPE.norm)
    steps, points = start(mesh, energy, NestedConfig(free_nodes=1, coarsest=2))
    assert steps == []
    assert points is mesh.points
