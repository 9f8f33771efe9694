"""Newton's directions: how good the solution of the linear system is to be, and what damps it."""

from types import SimpleNamespace

import numpy as np
import pytest
import scipy.sparse.linalg
from scipy.sparse.linalg import ArpackNoConvergence

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.ranks import ONE_RANK
from hexmend.optimise import search_direction
from hexmend.optimise.search_direction import ModifiedNewton, TruncatedNewton, TruncatedNewtonConfig
from tests.core.grids import grid, scrambled

CONFIG = TruncatedNewtonConfig()
FIRST, SECOND, THIRD = (CONFIG.damping_factor**k * CONFIG.tightest for k in range(3))


class Matrix:
    """Records what it is asked to solve; says that the curvature is negative while the damping is below `needed`."""

    def __init__(self, needed=0.0):
        self.needed, self.asked, self.assemblies, self.has_lent_memory = needed, [], 0, False
        self.energy = SimpleNamespace(ranks=ONE_RANK)

    def assembled(self, reuse=None):
        self.assemblies, self.has_lent_memory = self.assemblies + 1, False
        return self

    def solve(self, right, tolerance, iterations, damping, deflated):
        self.deflated = deflated
        self.asked.append((right.copy(), tolerance, iterations, damping))
        return SimpleNamespace(x=right / 2, iterations=3, negative_curvature=damping < self.needed)

    def lend_memory(self):
        pass


def tolerances(lengths, unit=1.0, **options):
    find, matrix = TruncatedNewton(TruncatedNewtonConfig(**options)), Matrix()
    for length in lengths:
        find(1.0, np.array([[unit * length, 0.0, 0.0]]), matrix)
    return [tolerance for _, tolerance, _, _ in matrix.asked]


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
def test_the_tolerance_follows_the_square_of_what_is_left_of_the_gradient_in_any_unit(unit):
    lengths = [8.0, 4.0, 0.4, 0.08]
    found = tolerances(lengths, unit, loosest=0.5, tightest=1e-4)
    assert found == pytest.approx([0.5, 0.9 / 4, 0.9 / 100, 0.9 / 25])


def test_damping_rises_until_the_curvature_is_positive_and_falls_again_twice_as_fast():
    find, matrix = TruncatedNewton(), Matrix(needed=THIRD)
    found = find(1.0, np.ones((1, 3)), matrix)
    assert [damping for *_, damping in matrix.asked] == [0.0, FIRST, SECOND, THIRD]
    assert (found.shift, found.solver_iterations) == (THIRD, 12)
    matrix.needed, matrix.asked = 0.0, []
    for _ in range(3):
        find(1.0, np.ones((1, 3)), matrix)
    assert [damping for *_, damping in matrix.asked] == [THIRD, FIRST, 0.0]


@pytest.mark.parametrize("value", [-5.0, 0.0])
def test_steepest_descent_of_a_value_without_a_root_follows_the_gradient(value):
    hessian = SimpleNamespace(energy=SimpleNamespace(norm=ObjectiveNorm(2.0), node_lengths=None))
    found = search_direction.steepest_descent(value, np.array([[1.0, -2.0, 0.5]]), hessian)
    assert found.vector.tolist() == [[-1.0, 2.0, -0.5]]


class Shifted:
    """A Hessian that records by how much it is shifted."""

    def __init__(self, shift=0.0):
        self.shift = shift

    def shifted(self, shift):
        return Shifted(shift)


@pytest.mark.parametrize(
    ("least", "greatest", "shift"),
    [(-1.0, 100.0, 1.1), (0.05, 100.0, 0.05), (0.2, 100.0, 0.0), (-1.0, 0.01, 1.00001), (0.5, 0.01, 0.0)],
)
def test_the_least_eigenvalue_is_raised_to_a_thousandth_of_the_greatest(monkeypatch, least, greatest, shift):
    monkeypatch.setattr(search_direction, "extreme_eigenvalues", lambda hessian: (least, greatest))
    found = ModifiedNewton(lambda hessian, right: (right / 2, 5))(1.0, np.array([[2.0, 4.0, 6.0]]), Shifted())
    assert found.shift == pytest.approx(shift)
    assert (found.vector.tolist(), found.solver_iterations) == ([[-1.0, -2.0, -3.0]], 5)


def test_where_eigenvalues_are_not_found_the_least_counts_as_0_and_the_greatest_is_computed(monkeypatch):
    def fails(*args, **options):
        raise ArpackNoConvergence("none", np.empty(0), np.empty((0, 0)))

    monkeypatch.setattr(scipy.sparse.linalg, "eigsh", fails)
    mesh = scrambled(grid(3), 0.2, 1)
    energy = MeshEnergy(mesh)
    hessian = energy.hessian(energy.to_edge_units(mesh.points), 0.0)
    least, greatest = search_direction.extreme_eigenvalues(hessian)
    assert least == 0.0
    matrix = np.column_stack([hessian.assembled() @ row for row in np.eye(hessian.shape[0])])
    assert greatest == pytest.approx(
        max(np.linalg.eigvalsh(matrix[at : at + 3, at : at + 3]).max() for at in range(0, len(matrix), 3))
    )
