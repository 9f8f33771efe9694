"""When the raising of the minimum scaled Jacobian ends: where steps gain little, and how little depends on the least."""

import itertools

import numpy as np
import pytest

from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.optimise.maxmin import slp
from hexmend.optimise.maxmin.corner_values import scaled_jacobians
from hexmend.optimise.maxmin.slp_config import SLPConfig
from tests.core.grids import grid, scrambled


def steps_of(patient_below=-np.inf, **settings):
    mesh = scrambled(grid(3), 0.4, 1)
    optimiser = slp.MaxMinOptimiser(mesh, mesh.points, config=SLPConfig(**settings))
    *steps, limit = optimiser.steps(patient_below=patient_below)
    assert isinstance(limit, slp.ActiveCorners)
    return steps


@pytest.mark.parametrize("window", [1, 3])
@pytest.mark.parametrize("sound", [-2.0, 2.0])
def test_it_ends_after_some_steps_that_together_gain_less_than_a_little(window, sound):
    """Below `sound` what counts is `min_gain`, above it `min_gain_acceptable`."""
    much, nothing = ("min_gain", "min_gain_acceptable") if sound == 2.0 else ("min_gain_acceptable", "min_gain")
    settings = {"window": window, "acceptable": sound, "promise": 0.0}
    assert len(steps_of(**settings, **{much: 10.0, nothing: 0.0})) == window
    assert len(steps_of(**settings, **{much: 0.0, nothing: 10.0})) > window


def test_it_ends_where_a_program_promises_less_than_a_share_of_that_per_step():
    every = [step.least for step in steps_of(promise=0.0)]
    fewer = [step.least for step in steps_of(promise=100.0)]
    assert fewer == every[: len(fewer)]
    assert 1 < len(fewer) < len(every)
    assert len(steps_of(promise=1e4, patient_below=1.0)) == len(every)


@pytest.mark.parametrize(("radius", "band"), [(0.3, 0.1), (0.01, 0.04), (0.001, 0.01)])
def test_the_corners_of_a_program_are_those_within_a_band_that_narrows_with_the_radius(radius, band):
    config = SLPConfig(initial_corners=10**6, initial_radius=radius, max_radius=radius, shrink=1.0)
    mesh = scrambled(grid(4), 0.2, 3)
    before, counts = mesh.points, []
    for step in itertools.islice(slp.MaxMinOptimiser(mesh, mesh.points, config=config).steps(), 30):
        if isinstance(step, slp.MaxMinStep):
            values = scaled_jacobians(before, mesh.hexes)[movable(mesh)]
            assert step.corners == np.count_nonzero(values < values.min() + band)
            counts.append(step.corners)
            before = step.points
    assert counts


def movable(mesh):
    return mesh.free[mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2)
