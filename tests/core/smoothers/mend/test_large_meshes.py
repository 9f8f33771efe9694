"""The optimum of shape of large meshes: long steps, accurate ones, and an end as soon as nothing is to be gained."""

import numpy as np
import pytest

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from hexmend.iteration import Outcome
from hexmend.smoothers.mend.shape_optimum import ShapeOptimumConfig, optimise_shape

MEAN = ObjectiveNorm(1.0)


def optimum(energy, large, intermediate=True, max_p=1.0):
    """Go to the optimum, as a large mesh does or not; returns its points, the steps, and the outcome."""
    config = ShapeOptimumConfig(large=1 if large else 10**9)
    run, steps = optimise_shape(energy, energy.mesh.points, max_p, intermediate, config), []
    while True:
        try:
            steps.append(next(run))
        except StopIteration as end:
            return end.value.points, steps, end.value.outcome


@pytest.mark.parametrize(("name", "size"), [("five-side", 920), ("bridge-sharp", 500), ("kershaw", 1_728)])
def test_the_optimum_is_the_same_in_no_more_steps(name, size):
    energy = MeshEnergy(make(name, size=size), MEAN)
    (points, steps, outcome), (large_points, large_steps, large_outcome) = optimum(energy, False), optimum(energy, True)
    assert outcome is large_outcome is Outcome.CONVERGED
    value, large_value = (energy.value(energy.to_edge_units(at)) for at in (points, large_points))
    assert large_value == pytest.approx(value, rel=1e-8)
    np.testing.assert_allclose(large_points, points, atol=2e-3 * energy.unit)
    assert len(large_steps) <= len(steps)
