"""The central path: it raises the least values as far as linear programs do, and lets the energy fall above floors."""

from dataclasses import replace

import numpy as np
import pytest

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from hexmend.optimise.floors.central_path import PATH, CentralPath, Least
from hexmend.optimise.floors.region import Region
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from hexmend.run import smooth
from hexmend.smoothers import METHODS
from hexmend.smoothers.mend.balance import raise_jacobian
from tests.core.grids import grid, scrambled

Mend = METHODS["mend"]
SHAPE = Mend(goal="shape", p=1.0)
MESHES = {
    "five-side": lambda: make("five-side", size=100),
    "plane": lambda: make("plane", size=150),
    "cube, tangled": lambda: make("cube", size=125, scramble=1.0),
}


@pytest.fixture(scope="module", params=MESHES)
def optimum(request):
    """Make a mesh at its optimum of shape, with its energy."""
    mesh = smooth(MESHES[request.param](), SHAPE).mesh
    return mesh, MeshEnergy(mesh, ObjectiveNorm(1.0))


def last(generator):
    """Run a generator to its end; return its result."""
    while True:
        try:
            next(generator)
        except StopIteration as end:
            return end.value


def test_it_reaches_what_linear_programs_reach(optimum):
    mesh, energy = optimum
    optimiser = MaxMinOptimiser(mesh, mesh.points)
    *_, active = optimiser.steps()
    assert isinstance(active, ActiveCorners)
    reached = CentralPath(energy, last(raise_jacobian(energy, mesh.points))).least.jacobian
    assert reached >= 0.99 * optimiser.corners.movable_minimum


def test_both_figures_rise_together_no_lower_than_at_the_start_and_no_further_than_asked(optimum):
    mesh, energy = optimum
    path = CentralPath(energy, mesh.points)
    start = path.least
    target = Least(start.jacobian + 0.5 * (1 - start.jacobian), 1.002 * start.quality)
    least = [start, *path.rise(target)]
    assert least[-1] == path.least
    best = max(one.jacobian for one in least)
    assert best >= start.jacobian
    assert all(one.jacobian > start.jacobian - PATH.jacobian_gap for one in least)
    assert all(one.quality > start.quality - PATH.quality_gap for one in least)
    assert len(least) <= PATH.max_floors + 1
    assert (path.x[mesh.fixed] == energy.to_edge_units(mesh.points)[mesh.fixed]).all()


def test_above_floors_the_energy_falls_and_the_floors_are_kept(optimum):
    mesh, energy = optimum
    path = CentralPath(energy, mesh.points)
    for _ in path.rise(Least(np.inf, -np.inf)):
        pass
    top, before = path.least, energy.value(path.x)
    floors = Least(0.9 * top.jacobian, 0.9 * top.quality)
    values = []
    for least in path.minimise_above(floors, (1.0, 0.1, 0.01)):
        assert least.jacobian > floors.jacobian
        assert least.quality > floors.quality
        values.append(energy.value(path.x))
    assert values[-1] <= before + 1e-9
    assert values[-1] <= values[0] + 1e-9
    assert values[-1] >= energy.value(energy.to_edge_units(mesh.points)) - 1e-6  # which is the optimum without floors


def with_bad_spot(n=7):
    """Make a grid in which a node within is displaced."""
    mesh = grid(n)
    (node,) = np.flatnonzero((mesh.points == n // 2).all(axis=1))
    points = mesh.points.copy()
    points[node] += [0.4, 0.3, 0.1]
    return mesh.with_points(points), node


def test_the_derivatives_of_a_region_are_those_of_the_mesh():
    mesh, node = with_bad_spot()
    energy = MeshEnergy(scrambled(mesh, 0.1, 1), ObjectiveNorm(1.0))
    x = energy.to_edge_units(energy.mesh.points)
    region = Region(energy, np.flatnonzero((mesh.hexes == node).any(axis=1)), x)
    part = region.energy
    nodes = np.flatnonzero((region.merged(np.zeros_like(x), np.ones_like(region.inside(x))) == 1).all(axis=1))
    moved = nodes[part.nodes]
    assert moved.size == 27
    np.testing.assert_allclose(part.gradient(region.inside(x)), energy.gradient(x)[np.isin(energy.nodes, moved)])
    change = part.value(region.inside(x)) - energy.hex_energies(x)[region.hexes].sum()
    assert change == pytest.approx(0, abs=1e-9)
    np.testing.assert_array_equal(region.merged(x, region.inside(x)), x)


def test_in_a_region_it_reaches_what_it_reaches_with_the_whole_mesh():
    mesh, node = with_bad_spot()
    energy = MeshEnergy(mesh, ObjectiveNorm(1.0))
    start, target = energy.to_edge_units(mesh.points), Least(0.9, 0.9)
    ends = []
    for whole in (0.0, 1.0):
        path = CentralPath(energy, mesh.points, replace(PATH, whole=whole))
        *_, least = path.rise(target)
        ends.append((path.x, least))
    (_, of_whole), (x, of_region) = ends
    assert of_region.jacobian == pytest.approx(of_whole.jacobian, abs=0.02)
    assert of_region.quality == pytest.approx(of_whole.quality, abs=0.02)
    assert of_region.jacobian >= 0.9
    far = np.abs(start - start[node]).max(axis=1) > 3.5 / energy.unit
    np.testing.assert_array_equal(x[far], start[far])
