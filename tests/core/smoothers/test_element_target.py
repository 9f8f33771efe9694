"""Optimisers with a target of the elements: layers stay, scrambled ones return, and the target decides what is kept."""

import numpy as np
import pytest

from hexmend import METHODS, StoppingCriteria, Target, iterate, smooth
from hexmend.mesh.hexahedron import EDGES
from hexmend.quality import measure, measure_against_target, target_quality
from tests.core.grids import grid, placed

OPTIMISERS = sorted(name for name, method in METHODS.items() if method.optimises)
#: Each optimiser with and without the weight of the size in turn.
WEIGHTED = [(name, 0.5 * (number % 2)) for number, name in enumerate(OPTIMISERS)]


def edge_lengths(mesh):
    """Means of the four parallel edges of each hex, (m, 3)."""
    ends = mesh.points[mesh.hexes[:, EDGES]]
    return np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2).reshape(-1, 3, 4).mean(axis=2)


def as_given(mesh, weight=0.0):
    return mesh.with_element_target(Target(edge_lengths(mesh), weight))


def stretched(n=4, height=0.1):
    lattice = grid(n)
    return lattice.with_points(lattice.points * [1, 1, height])


def shaken(mesh, amplitude, seed=0):
    """Nodes displaced by a share of the lengths of a stretched lattice; the target stays."""
    shift = np.random.default_rng(seed).uniform(-1, 1, mesh.points.shape) * np.ptp(mesh.points, axis=0) * amplitude
    return mesh.with_points(mesh.points + shift * mesh.free[:, None])


def layered(layers=10, first=1e-3, growth=1.3, bump=0.02):
    """Layers over a bump, whose heights grow from its surface; returns the mesh and the height of each node's layer."""
    lattice = grid(8, 4, layers)
    level = lattice.points[:, 2].astype(int)
    heights = np.concatenate([[0], np.cumsum(first * growth ** np.arange(layers))])
    x, y = lattice.points[:, 0] / 8, lattice.points[:, 1] / 8
    z = heights[level] + bump * np.sin(np.pi * x) ** 2 * (1 - heights[level] / heights[-1])
    gaps = np.diff(heights)[np.minimum(level, layers - 1)]
    return lattice.with_points(np.column_stack([x, y, z])), gaps


@pytest.mark.parametrize(("name", "weight"), WEIGHTED)
def test_a_mesh_like_its_target_stays(name, weight):
    mesh = as_given(stretched(), weight)
    result = smooth(mesh, METHODS[name](), StoppingCriteria(max_iterations=5))
    np.testing.assert_allclose(result.mesh.points, mesh.points, atol=1e-9)


@pytest.mark.parametrize(("name", "weight"), WEIGHTED)
def test_a_scrambled_lattice_returns_to_its_lengths(name, weight):
    lattice = as_given(stretched(3), weight)
    result = smooth(shaken(lattice, 0.08), METHODS[name](), StoppingCriteria(max_iterations=400))
    assert result.after.inverted == 0
    assert target_quality(result.mesh).min() > 0.999
    np.testing.assert_allclose(result.mesh.points, lattice.points, atol=5e-3)


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
def test_mend_untangles_layers_and_keeps_their_heights(boundary):
    made, gaps = layered()
    shift = np.random.default_rng(1).uniform(-1, 1, made.points.shape) * np.column_stack(
        [0 * gaps + 0.05, 0 * gaps, gaps]
    )
    mesh = as_given(made).with_points(made.points + shift * made.free[:, None])
    before = measure(mesh.points, mesh.hexes)
    result = smooth(mesh, METHODS["mend"](boundary=boundary), StoppingCriteria(max_iterations=100))
    after = measure(result.mesh.points, mesh.hexes)
    assert before.n_inverted > 0 == after.n_inverted
    assert after.scaled_jacobian.min() > 0.95 * measure(made.points, made.hexes).scaled_jacobian.min()
    ratios = edge_lengths(result.mesh)[:, 2] / edge_lengths(made)[:, 2]
    assert np.abs(ratios - 1).max() < 0.1


def test_mend_untangles_thin_layers_whose_size_counts():
    """Nodes are displaced by ten thousand times the height of the layers, along them: sigma is as much too large."""
    lattice = grid(4, 4, 6)
    thin = lattice.with_points(lattice.points * [1, 1, 1e-4])
    shift = np.random.default_rng(3).uniform(-1, 1, thin.points.shape) * [0.3, 0.3, 5e-5]
    mesh = as_given(thin, 0.5).with_points(thin.points + shift * thin.free[:, None])
    result = smooth(mesh, METHODS["mend"]())
    assert result.before.inverted > 0 == result.after.inverted
    np.testing.assert_allclose(result.mesh.points, thin.points, rtol=1e-3, atol=5e-6)


def test_the_ideal_target_loses_the_layers():
    made, _ = layered()
    result = smooth(made, METHODS["mend"](goal="shape", target="ideal"))
    assert edge_lengths(result.mesh)[:32, 2].min() > 2 * edge_lengths(made)[:32, 2].max()


def test_the_size_brings_back_sizes_that_the_shape_does_not():
    """Cubes of two sizes in a row of fixed length: the shape alone is content with any scale."""
    lattice = grid(4, 2, 2)
    planes = np.array([0, 0.5, 1, 2.5, 4.0])  # lengths along x: 0.5, 0.5, 1.5, 1.5
    made = placed(lattice, np.s_[:, 0], planes[lattice.points[:, 0].astype(int)])
    lengths = np.repeat(edge_lengths(made)[:, :1], 3, axis=1)  # cubes of these sizes
    moved = made.with_points(np.where(made.free[:, None], made.points + [0.3, 0, 0], made.points))
    errors = []
    for weight in (0.0, 5.0):
        result = smooth(moved.with_element_target(Target(lengths, weight)), METHODS["mend"]())
        volume = edge_lengths(result.mesh).prod(axis=1) / lengths.prod(axis=1)
        errors.append(np.abs(np.log(volume)).mean())
    assert errors[1] < errors[0]


def test_the_kept_iterate_is_the_best_against_the_target():
    """From unit cubes to a target of flat hexes the ideal q falls all the way."""
    lattice = grid(4)
    lengths = np.ones((64, 3))
    lengths[:16, 2] = 0.5
    mesh = lattice.with_element_target(Target(lengths))
    result = smooth(mesh, METHODS["global-nr"]())
    assert result.kept > 0
    assert result.after.q_mean < result.before.q_mean
    assert target_quality(result.mesh).mean() > target_quality(mesh).mean()
    objectives = [row["objective"] for row in result.history]
    assert objectives == sorted(objectives, reverse=True)


def test_the_recorded_objective_is_that_against_the_target():
    mesh = shaken(as_given(stretched(3)), 0.05)
    first = next(iter(iterate(mesh, METHODS["mend"](goal="shape"), StoppingCriteria(max_iterations=3))))
    against = measure_against_target(mesh, first.points, first.quality)
    assert first.objective == pytest.approx(np.square(against.eta).sum())
    assert first.quality.q == pytest.approx(measure(first.points, mesh.hexes).q)


def test_methods_without_an_energy_say_that_they_ignore_the_target():
    mesh = as_given(stretched(3))
    result = smooth(mesh, METHODS["laplacian"](), StoppingCriteria(max_iterations=2))
    assert "Laplacian takes no account of the target" in result.message
    assert "target" not in smooth(stretched(3), METHODS["laplacian"](), StoppingCriteria(max_iterations=2)).message
