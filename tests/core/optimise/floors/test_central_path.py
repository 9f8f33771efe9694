"""The central path: it raises the least values as far as linear programs do, and lets the energy fall above floors."""

import numpy as np
import pytest

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from hexmend.optimise.floors.central_path import CentralPath, Least
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from hexmend.run import smooth
from hexmend.smoothers import METHODS
from hexmend.smoothers.mend.balance import raise_jacobian

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
