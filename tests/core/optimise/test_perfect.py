"""Optimisers end at cubes, however high p is: what is small is not taken for nothing.

Sweeps over nodes with a linear motion: each independent node lowers the energy of the hexes at it and its copies.
"""

import numpy as np
import pytest

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from hexmend.iteration import Outcome
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.element_target import Target
from hexmend.optimise.constrained_sweeps import ConstrainedSweeps, newton_steps, steepest_descents
from hexmend.optimise.descent import is_perfect
from hexmend.run import smooth
from hexmend.smoothers import METHODS
from tests.core.grids import grid, scrambled
from tests.core.linear_motions import CASES, scrambled_within

EXPONENTS = [1.0, 2.0, 4.0, 8.0, 16.0]


@pytest.mark.parametrize(
    ("name", "p"),
    [
        ("global-nr", 16.0),
        ("global-mnr", 8.0),
        ("local-sd", 2.0),
        ("local-nr", 4.0),
        ("local-mnr", 16.0),
        ("mend", 16.0),
    ],
)
def test_optimisers_reach_the_cubes_of_a_scrambled_grid_whatever_p(name, p):
    result = smooth(make("cube", size=64, scramble=0.4), METHODS[name](p=p), max_iterations=1000)
    assert result.outcome is Outcome.CONVERGED
    assert result.after.q_min == pytest.approx(1.0, abs=2e-5)


@pytest.mark.parametrize("offset", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("p", [*EXPONENTS, 32.0])
def test_a_mesh_of_cubes_is_perfect_and_one_a_little_away_is_not(p, offset):
    cubes, other = grid(4), scrambled(grid(4), 0.01)
    for mesh, answer in ((cubes, True), (other, False)):
        energy = MeshEnergy(mesh, ObjectiveNorm(p, offset))
        assert is_perfect(energy, energy.value(energy.to_edge_units(mesh.points)), 0.0) == answer


@pytest.mark.parametrize("p", [8.0, 16.0, 32.0])
def test_a_hessian_below_the_range_of_single_precision_keeps_its_digits(p):
    mesh = scrambled(grid(4), 0.005)
    energy = MeshEnergy(mesh, ObjectiveNorm(p))
    hessian = energy.hessian(energy.to_edge_units(mesh.points))
    v = np.random.default_rng(0).normal(size=hessian.shape[0])
    product = hessian @ v
    size = np.abs(product).max()
    np.testing.assert_allclose((hessian.assembled() @ v) / size, product / size, atol=1e-5)
    matrix = hessian.assembled()
    np.testing.assert_allclose((matrix.matrix() @ v) / size, product / size, atol=1e-5)
    solved = matrix.solve(product, 1e-6, 500, damping=0.0)
    if not solved.negative_curvature:
        np.testing.assert_allclose((hessian @ solved.x) / size, product / size, atol=1e-3)


SEARCH = LineSearch(max_backtracks=60)


def with_target(mesh, size_weight):
    lengths = np.random.default_rng(2).uniform(0.5, 1.5, (mesh.n_hexes, 3))
    return mesh.with_element_target(Target(lengths, size_weight))


@pytest.mark.parametrize(
    ("case", "size_weight", "directions"),
    [
        ("planes", None, steepest_descents),
        ("periodic", 0.0, newton_steps),
        ("layer", 1.0, steepest_descents),
        ("wedge", None, newton_steps),
        ("wedge", 1.0, steepest_descents),
    ],
)
def test_sweeps_lower_the_energy_and_move_only_what_is_chosen(case, size_weight, directions):
    mesh = scrambled_within(CASES[case](4), 0.2)
    if size_weight is not None:
        mesh = with_target(mesh, size_weight)
    energy = MeshEnergy(mesh, ObjectiveNorm(1.5))
    motion, x = mesh.linear_motion, energy.to_edge_units(mesh.points)
    chosen = mesh.free & motion.marks(mesh.n_nodes) & (np.arange(mesh.n_nodes) % 3 > 0)
    sweeps, values, start = ConstrainedSweeps(energy, chosen), [energy.value(x, 0.01)], x.copy()
    for _ in range(4):
        sweeps(x, 0.01, directions, SEARCH)
        values.append(energy.value(x, 0.01))
    assert (np.diff(values) < 0).all()
    moved, roots = (x != start).any(axis=1), motion.roots(mesh.n_nodes)
    assert not moved[~np.isin(roots, roots[chosen])].any()
    np.testing.assert_allclose(mesh.constrained(x * energy.unit), x * energy.unit, atol=1e-13)
