"""Values of movable hexes: what fixed nodes lock, and what the energy leaves out, does not count."""

import numpy as np
import pytest

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.optimise.maxmin.corner_values import scaled_jacobians
from hexmend.quality import measure
from hexmend.smoothers.mend.inversion import inverted_corners
from tests.core.grids import grid
from tests.core.smoothers.mend.test_mend import with_locked_corner


def energy_of(mesh):
    """Make the energy of a mesh without its inverted corners."""
    return MeshEnergy(
        mesh, ObjectiveNorm(1.0), inverted_corners(mesh.points, mesh.hexes, measure(mesh.points, mesh.hexes))
    )


@pytest.mark.parametrize("lock", [False, True])
def test_scaled_jacobians_are_those_of_corners_with_a_free_node(lock):
    mesh = make("five-side", size=150)
    mesh = with_locked_corner(mesh) if lock else mesh
    energy = energy_of(mesh)
    hexes, x = MovableHexes(energy), energy.to_edge_units(mesh.points)
    movable = mesh.free[mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2)
    expected = np.where(movable, scaled_jacobians(mesh.points, mesh.hexes), np.inf).min(axis=1)
    np.testing.assert_allclose(hexes.jacobians(x), expected, rtol=1e-9)
    assert expected.min() > 0
    assert (np.unpackbits(hexes.ignored[:, None], axis=1, bitorder="little") == ~movable).all()
    assert (measure(mesh.points, mesh.hexes).scaled_jacobian.min() < 0) == lock


def test_qualities_are_those_of_hexes_that_move_and_have_no_omitted_corner():
    mesh = with_locked_corner(make("five-side", size=150))
    energy = energy_of(mesh)
    qualities = MovableHexes(energy).qualities(energy.to_edge_units(mesh.points))
    judged = mesh.free[mesh.hexes].any(axis=1) & (energy.omitted == 0)
    assert np.count_nonzero(energy.omitted) == 1
    np.testing.assert_allclose(qualities[judged], measure(mesh.points, mesh.hexes).q[judged], rtol=1e-9)
    assert np.isinf(qualities[~judged]).all()
    nothing_moves = grid(1)
    energy = energy_of(nothing_moves)
    assert np.isinf(MovableHexes(energy).qualities(nothing_moves.points)).all()
    assert np.isinf(MovableHexes(energy).jacobians(nothing_moves.points)).all()


def test_a_barrier_has_floors_where_hexes_have_values():
    mesh = with_locked_corner(make("five-side", size=150))
    energy = energy_of(mesh)
    hexes, x = MovableHexes(energy), energy.to_edge_units(mesh.points)
    least = hexes.jacobians(x).min(), hexes.qualities(x).min()
    held = energy.with_barrier(hexes.barrier(least[0] - 0.01, least[1] - 0.01, 0.5, 0.5, 2.0))
    assert 0 < held.value(x) < np.inf
    assert np.isfinite(held.gradient(x)).all()  # what is omitted has no derivatives
    assert np.isfinite(held.hessian(x).assembled(np.float64).diagonal).all()
    assert held.barriers(x).max() > 0
    for jacobian, quality in ((least[0] + 1e-9, -np.inf), (-np.inf, least[1] + 1e-9)):
        assert energy.with_barrier(hexes.barrier(jacobian, quality, 0.1, 0.1, 1.0)).value(x) == np.inf
