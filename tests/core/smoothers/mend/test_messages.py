"""What mend's steps say while another stage is to come.

Messages of mend about hexes that fixed nodes lock.

Mend makes hexes valid that are invalid between positive corners.

The optimum of shape begins at that of the coarse mesh where the mesh is a refinement.
"""

import numpy as np
import pytest

import hexmend as hx
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.smoothers.mend import stages
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.mend import Mend
from hexmend.smoothers.mend.messages import freed_message
from hexmend.smoothers.mend.nested.nested_start import NestedConfig
from tests.core.grids import grid, invalid_inside
from tests.core.refined_meshes import refined, renumbered


def with_two_locked_corners():
    """A grid of which two corners are inverted, and as it would be sound."""
    sound = grid(3)
    points, ends = sound.points.copy(), (0, len(sound.points) - 1)
    middle = points.mean(axis=0)
    for node in ends:
        points[node] += 0.5 * (middle - points[node])
    return sound.with_points(points), sound.points, ends


def message_after(mesh, points):
    """The message where the boundary has slid from where a mesh has it to other points."""
    inverted = inverted_corners(points, mesh.hexes, measure(points, mesh.hexes))
    return freed_message(locked_corners(mesh, measure(mesh.points, mesh.hexes)), inverted)


def test_what_sliding_has_freed_and_what_is_left_is_said():
    mesh, sound, (one, _) = with_two_locked_corners()
    assert np.count_nonzero(locked_corners(mesh, measure(mesh.points, mesh.hexes))) == 2
    had = "2 hexes had corners that fixed nodes keep inverted: sliding freed "
    assert message_after(mesh, sound) == had + "2, none is left."
    assert message_after(mesh, mesh.points) == had + "0, 2 are left."
    half = mesh.points.copy()
    half[one] = sound[one]
    assert message_after(mesh, half) == had + "1, 1 is left."
    assert message_after(mesh.with_points(sound), mesh.points) == ""


def distorted(amplitude, seed):
    """Make a grid of 27 hexes with nodes moved at random, those of the boundary too."""
    mesh = grid(3)
    return mesh.with_points(mesh.points + np.random.default_rng(seed).uniform(-amplitude, amplitude, mesh.points.shape))


def pinned(mesh):
    """Pin two of the free nodes of the invalid hex."""
    nodes = mesh.hexes[measure(mesh.points, mesh.hexes).invalid].ravel()
    marks = np.zeros(mesh.n_nodes, dtype=bool)
    marks[nodes[mesh.free[nodes]][:2]] = True
    return mesh.replace(pinned=marks)


def resisting():
    """Make a grid of 12 hexes, one of which is invalid between positive corners where the energy is least."""
    mesh, random = grid(2, 2, 3), np.random.default_rng(6323)
    return mesh.with_points(mesh.points + random.uniform(-0.4, 0.4, mesh.points.shape))


MESHES = {
    "interior": invalid_inside,
    "boundary": lambda: distorted(0.45, 4936),
    "pinned nodes": lambda: pinned(invalid_inside()),
    "at the optimum of shape": resisting,
}


@pytest.mark.parametrize("name", MESHES)
@pytest.mark.parametrize("goal", ["shape", "balanced"])
def test_a_run_ends_without_invalid_hexes_and_fixed_nodes_stay(name, goal):
    mesh = MESHES[name]()
    result = hx.smooth(mesh, goal=goal)
    assert result.after.invalid == 0
    np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])


@pytest.mark.parametrize("seed", [1, 6])
def test_no_more_hexes_are_invalid_afterwards_where_some_are_inverted(seed):
    result = hx.smooth(distorted(0.5, seed), goal="shape")
    assert result.before.inverted > 0
    assert result.after.invalid <= result.before.invalid


FORCED = NestedConfig(free_nodes=1)
NEVER = NestedConfig(free_nodes=10**9)


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


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
def test_the_optimum_is_that_without_the_start_or_better(boundary):
    whole = refined(make("five-side", size=100))
    mesh, smoother = scrambled(whole, 0.3), Mend(goal="shape", p=1.0, boundary=boundary)
    ends = []
    for config in (NEVER, FORCED):
        steps = list(stages.Stages(smoother, config).steps(mesh))
        ends.append(measure(steps[-1].points, mesh.hexes).eta.sum())
    if boundary == "fixed":
        assert ends[1] == pytest.approx(ends[0], rel=1e-8)
    else:  # on facets steps end at several points
        assert ends[1] < ends[0] * (1 + 1e-6)


@pytest.mark.slow
def test_kershaws_mesh_ends_at_the_lattice_in_fewer_steps_of_all_its_nodes():
    mesh, smoother = make("kershaw", size=24**3), Mend(goal="shape", boundary="slide", p=1.0)
    counts = []
    for config in (NEVER, FORCED):
        steps = list(stages.Stages(smoother, config).steps(mesh))
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
