"""The optimum of shape of large meshes: long steps, accurate ones, and an end as soon as nothing is to be gained."""

import numpy as np
import pytest

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from hexmend.iteration import Outcome
from hexmend.smoothers.mend.shape_optimum import ShapeOptimumConfig, optimise_shape
from tests.core.smoothers.mend.walks import walked

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


@pytest.mark.parametrize(
    ("name", "size", "saves_steps"),
    [("five-side", 920, False), ("bridge-sharp", 500, False), ("kershaw", 1_728, True)],
)
def test_the_optimum_is_the_same_in_no_more_steps(name, size, saves_steps):
    energy = MeshEnergy(make(name, size=size), MEAN)
    (points, steps, outcome), (large_points, large_steps, large_outcome) = optimum(energy, False), optimum(energy, True)
    assert outcome is large_outcome is Outcome.CONVERGED
    value, large_value = (energy.value(energy.to_edge_units(at)) for at in (points, large_points))
    assert large_value == pytest.approx(value, rel=1e-8)
    np.testing.assert_allclose(large_points, points, atol=2e-3 * energy.unit)
    assert len(large_steps) < len(steps) + (not saves_steps)


def test_p_rises_and_the_last_stage_ends_as_it_does_for_small_meshes():
    energy = MeshEnergy(make("five-side", size=920), MEAN)
    _, steps, _ = optimum(energy, True, intermediate=True, max_p=4.0)
    assert [p for p in (1.0, 2.0, 4.0) if p in {step.diagnostics["p"] for step in steps}] == [1.0, 2.0, 4.0]
    points, _, outcome = optimum(energy, True, intermediate=False)
    assert outcome is Outcome.CONVERGED
    x = energy.to_edge_units(points)
    assert np.abs(energy.gradient(x)).max() < 1e-4


def test_successive_short_steps_end_the_stage():
    energy = MeshEnergy(make("bridge-sharp", size=500), MEAN)
    every = ShapeOptimumConfig(short=2.0, short_steps=3)  # all steps are short
    steps, end = walked(optimise_shape(energy, energy.mesh.points, 1.0, False, every))
    assert len(steps) == 3
    assert end.outcome is Outcome.NO_IMPROVEMENT
    assert end.points is steps[-1].points
    steps, end = walked(optimise_shape(energy, energy.mesh.points, 2.0, False, every))
    assert len(steps) == 6
    assert [step.diagnostics["p"] for step in steps] == [1.0] * 3 + [2.0] * 3
