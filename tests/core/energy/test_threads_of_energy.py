"""Energies of one mesh used by several threads at once."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest

from hexmend.boundary import SlidingBoundary
from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery import make
from tests.core.energy.projected import projected_energy

POWERS = ObjectiveNorm(2.0, 1.0), ObjectiveNorm(4.0, 0.0)


def energies_of(kind):
    """Make two energies of one mesh that share the data that depend on the mesh alone."""
    mesh = make("bridge-sharp", size=2000)
    first = MeshEnergy(mesh, POWERS[0]) if kind == "fixed" else projected_energy(SlidingBoundary(mesh), POWERS[0])
    return first, first.with_objective(POWERS[1], first.omitted)


def answers(energy, x, steps=10):
    """Compute gradients and Hessian products at different points."""
    found = []
    for k in range(steps):
        there = x * (1 + 1e-3 * k)
        gradient = energy.gradient(there, 0.1)
        found += [gradient, energy.hessian(there, 0.1).matvec(gradient.ravel())]
    return found


@pytest.mark.parametrize("kind", ["fixed", "slide"])
@pytest.mark.parametrize("copies", [True, False])
def test_two_threads_get_what_each_gets_alone(kind, copies):
    first, second = energies_of(kind)
    both = (first, second if copies else first)
    x = first.to_edge_units(first.mesh.points)
    places = (x, 1.7 * x)
    alone = [answers(energy, place) for energy, place in zip(both, places, strict=True)]
    together = Barrier(2)

    def run(energy, place):
        together.wait()
        return answers(energy, place)

    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(run, both, places))
    for mine, expected in zip(found, alone, strict=True):
        for one, other in zip(mine, expected, strict=True):
            np.testing.assert_array_equal(one, other)
