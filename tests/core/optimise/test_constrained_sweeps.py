"""Sweeps over nodes with a linear motion: each independent node lowers the energy of the hexes at it and its copies."""

import numpy as np
import pytest

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.element_target import Target
from hexmend.optimise.constrained_sweeps import ConstrainedSweeps, newton_steps, steepest_descents
from tests.core.linear_motions import CASES, scrambled_within

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
