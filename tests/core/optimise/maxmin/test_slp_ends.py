"""When the raising of the least scaled Jacobian ends: where steps gain little, and how little depends on the least."""

import itertools

import numpy as np
import pytest

from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.optimise.maxmin import slp
from hexmend.optimise.maxmin.corner_values import scaled_jacobians
from tests.core.grids import grid, scrambled


def steps_of(monkeypatch, **constants):
    for name, value in constants.items():
        monkeypatch.setattr(slp, name, value)
    mesh = scrambled(grid(3), 0.4, 1)
    *steps, limit = slp.MaxMinOptimiser(mesh, mesh.points).steps()
    assert isinstance(limit, slp.ActiveCorners)
    return steps


@pytest.mark.parametrize("lately", [1, 3])
@pytest.mark.parametrize("sound", [-2.0, 2.0])
def test_it_ends_after_some_steps_that_together_gain_less_than_a_little(monkeypatch, lately, sound):
    """Below `SOUND` what counts is `LITTLE`, above it `LITTLE_BEYOND`."""
    much, nothing = ("LITTLE", "LITTLE_BEYOND") if sound == 2.0 else ("LITTLE_BEYOND", "LITTLE")
    assert len(steps_of(monkeypatch, LATELY=lately, SOUND=sound, **{much: 10.0, nothing: 0.0})) == lately
    assert len(steps_of(monkeypatch, LATELY=lately, SOUND=sound, **{much: 0.0, nothing: 10.0})) > lately


@pytest.mark.parametrize("few", [1, 3])
def test_it_ends_as_high_however_few_corners_the_first_programs_have(monkeypatch, few):
    end = steps_of(monkeypatch)[-1].least
    steps = steps_of(monkeypatch, FEW=few)
    assert steps[-1].least == pytest.approx(end, abs=2e-3)
    assert steps[0].corners == few


def test_it_never_has_more_corners_than_the_most(monkeypatch):
    assert max(step.corners for step in steps_of(monkeypatch, FEW=3, MANY=6)) <= 6


def test_what_is_begun_again_begins_with_the_first_radius_and_few_corners():
    mesh = scrambled(grid(3), 0.6, 2)
    raise_ = slp.MaxMinOptimiser(mesh, mesh.points)
    first = [step.radius for step in raise_.steps(0.4) if isinstance(step, slp.MaxMinStep)]
    again = [step.radius for step in raise_.steps() if isinstance(step, slp.MaxMinStep)]
    assert first[0] == again[0] == slp.FIRST
    assert max(first[1:]) > slp.FIRST  # it had changed


@pytest.mark.parametrize(("radius", "band"), [(0.3, 0.1), (0.01, 0.04), (0.001, 0.01)])
def test_the_corners_of_a_program_are_those_within_a_band_that_narrows_with_the_radius(monkeypatch, radius, band):
    for name, value in {"FEW": 10**6, "FIRST": radius, "LARGEST": radius, "SHRINK": 1.0}.items():
        monkeypatch.setattr(slp, name, value)
    mesh = scrambled(grid(4), 0.2, 3)
    before, counts = mesh.points, []
    for step in itertools.islice(slp.MaxMinOptimiser(mesh, mesh.points).steps(), 30):
        if isinstance(step, slp.MaxMinStep):
            values = scaled_jacobians(before, mesh.hexes)[movable(mesh)]
            assert step.corners == np.count_nonzero(values < values.min() + band)
            counts.append(step.corners)
            before = step.points
    assert counts


def movable(mesh):
    return mesh.free[mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2)
