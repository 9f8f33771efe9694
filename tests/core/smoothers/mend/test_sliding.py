"""Mend whose boundary slides: how far it may leave the surface, and what flat solids keep."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.stats import special_ortho_group

from hexmend.boundary import SlidingBoundary, surface_change
from hexmend.gallery import make
from hexmend.io import read
from hexmend.quality import measure
from hexmend.run import StoppingCriteria, smooth
from hexmend.smoothers import METHODS
from hexmend.smoothers.mend.free_boundary import AUTO_FIT, RETURN
from tests.core.boundary.solids import ball, cylinder, slid, wavy
from tests.core.grids import grid

pytestmark = pytest.mark.slow

Mend = METHODS["mend"]
SHORT = StoppingCriteria(max_iterations=80)
seeds = st.integers(0, 2**32 - 1)
goals = st.sampled_from(["shape", "scaled-jacobian"])

FLAT = {
    "block": lambda: grid(3, 2, 4),
    "cube": lambda: grid(3),
    "bridge-sharp": lambda: make("bridge-sharp", size=60),
}
BENT = {"cylinder": lambda: cylinder(16, 2), "ball": lambda: ball(3), "wavy": lambda: wavy(grid(3), 0.25)}
SOLIDS = FLAT | BENT


def turned(mesh, seed):
    """The mesh, turned and shifted at random, so that no side is along an axis."""
    random = np.random.default_rng(seed)
    return mesh.with_points(mesh.points @ special_ortho_group.rvs(3, random_state=random).T + random.normal(size=3))


@pytest.mark.slow
@settings(max_examples=12)
@given(st.sampled_from(sorted(FLAT)), goals, st.floats(0, 0.3), st.sampled_from([0.0, 0.3, "unlimited"]), seeds)
def test_flat_solids_keep_surface_and_volume(solid, goal, amplitude, tolerance, seed):
    mesh = turned(slid(FLAT[solid](), amplitude, seed), seed)
    result = smooth(mesh, Mend(goal=goal, boundary="slide", surface_tolerance=tolerance), SHORT)
    if tolerance:
        assume(not result.departures.nodes.size)  # sliding was enough
    assert result.surface.max < 1e-12
    assert abs(result.surface.volume_change) < 1e-12
    assert result.surface.features_kept == result.surface.features


@settings(max_examples=12)
@given(st.sampled_from(sorted(SOLIDS)), goals, st.floats(0, 0.6), seeds)
def test_without_a_limit_nodes_stay_on_their_curves_and_patches(solid, goal, amplitude, seed):
    mesh = slid(SOLIDS[solid](), amplitude, seed)
    sliding = SlidingBoundary(mesh)
    result = smooth(mesh, Mend(goal=goal, boundary="slide", surface_tolerance="unlimited"), SHORT)
    assume(not result.departures.nodes.size)  # none had to leave
    on = result.mesh.points[sliding.nodes]
    away = np.linalg.norm(sliding.project(on) - on, axis=1)
    assert away.max() < 1e-9 * mesh.mean_edge_length
    kept = sliding.mesh.fixed
    np.testing.assert_array_equal(result.mesh.points[kept], mesh.points[kept])


@pytest.mark.parametrize("name", ["block_in.mesh"])
def test_a_real_mesh_is_freed_within_its_tolerance(name, real_mesh):
    mesh = read(real_mesh(name))
    assert measure(mesh.points, mesh.hexes).n_inverted > 0
    result = smooth(mesh, Mend(goal="scaled-jacobian", boundary="slide"))
    assert result.after.inverted == 0
    assert result.after.scaled_jacobian_min > 0.25
    assert result.surface.max <= 0.3 * (1 + 1e-4)


def rough(seed):
    """A cube whose boundary is crumpled, so that nodes have to leave it."""
    mesh = make("cube", size=27)
    points, crumpled = mesh.points.copy(), mesh.topology.boundary
    noise = np.random.default_rng(seed).normal(size=(int(crumpled.sum()), 3))
    points[crumpled] += 0.33 * mesh.mean_edge_length * noise
    return mesh.with_points(points)


@pytest.mark.parametrize("seed", range(2))
def test_to_its_end_it_turns_no_quad_over_and_speaks_of_what_it_keeps(seed):
    mesh = rough(seed)
    result = smooth(mesh, Mend(boundary="slide", goal="scaled-jacobian"), StoppingCriteria(max_iterations=600))
    assert result.after.inverted <= result.before.inverted
    assert not SlidingBoundary(mesh).flipped_quads(mesh.points, result.mesh.points).size
    assert surface_change(mesh, result.mesh).max <= RETURN.wider[-1] * AUTO_FIT
    assert result.active is None or result.kept == result.iterations
    assert ("hold each other" in result.message) <= (result.kept == result.iterations)
    assert not (result.after.inverted and "rises instead" in result.message)
