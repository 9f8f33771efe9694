"""Which nodes mend's local sweeps move: around what is inverted or poor, but never where corners are left out."""

import itertools

import numpy as np
import pytest

from hexmend.energy import MeshEnergy
from hexmend.kernels import local
from hexmend.quality import measure
from hexmend.smoothers import METHODS
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.local_sweeps import local_sweeps
from hexmend.smoothers.mend.untangling import UntanglingConfig, untangle
from tests.core.boundary.solids import wavy
from tests.core.grids import grid, scrambled
from tests.core.smoothers.mend.walks import walked

DEFAULT = UntanglingConfig()


@pytest.fixture
def swept(monkeypatch):
    """Sweeps as mend makes them around a hex of a grid of 7 x 7 x 7; the nodes that move."""
    mesh = scrambled(grid(7), 0.2, 1)
    energy = MeshEnergy(mesh)
    asked = []
    sweep = local.sweep
    monkeypatch.setattr(local, "sweep", lambda *given: asked.append(given) or sweep(*given))

    def around(which, left_out=(), sweeps=2):
        hexes, omitted = np.zeros(mesh.n_hexes, bool), np.zeros(mesh.n_hexes, np.uint8)
        hexes[list(which)], omitted[list(left_out)] = True, 1
        x = energy.to_edge_units(mesh.points)
        there = local_sweeps(energy, x, hexes, omitted, 0.0, sweeps)
        assert len(asked) == sweeps
        np.testing.assert_array_equal(x, energy.to_edge_units(mesh.points))
        asked.clear()
        return set(np.flatnonzero((there != x).any(axis=1)).tolist())

    return mesh, around


def untangled(mesh, energy, config=DEFAULT):
    """Untangle a mesh: the steps, and the result."""
    locked = locked_corners(mesh, measure(mesh.points, mesh.hexes))
    return walked(untangle(mesh, energy, locked, config))


def nodes_of(mesh, hexes):
    return set(np.unique(mesh.hexes[list(hexes)]).tolist())


def neighbours(mesh, which):
    """Hexes that have a node in common with some."""
    return np.flatnonzero(np.isin(mesh.hexes, mesh.hexes[list(which)]).any(axis=1))


@pytest.mark.parametrize("hexa", [171, 0, 24])  # in the middle, at a corner, in between
def test_nodes_of_a_hex_and_of_its_neighbours_move_and_no_others(swept, hexa):
    mesh, around = swept
    assert around([hexa]) == nodes_of(mesh, neighbours(mesh, [hexa])) & set(np.flatnonzero(mesh.free).tolist())


def test_nodes_at_hexes_of_which_corners_are_left_out_stay(swept):
    mesh, around = swept
    moved, all_of_them = around([171], left_out=[172]), around([171])
    assert moved == all_of_them - nodes_of(mesh, [172])
    assert moved < all_of_them


def test_corners_that_resist_are_left_out_as_those_that_are_locked():
    """Half of a cube is folded back over the other: wherever the node in the middle goes, hexes are inverted."""
    mesh = grid(2)
    points = mesh.points.copy()
    points[points[:, 0] == 2, 0] = -1.0
    mesh = mesh.with_points(points)
    locked = locked_corners(mesh, measure(mesh.points, mesh.hexes))
    _, result = untangled(mesh, MeshEnergy(mesh, omitted=locked))
    quality = measure(result.points, mesh.hexes)
    np.testing.assert_array_equal(result.quality.q, quality.q)
    inverted = inverted_corners(result.points, mesh.hexes, quality)
    np.testing.assert_array_equal(result.omitted, inverted | locked)
    assert (inverted & ~locked).any()


def test_a_run_at_its_optimum_has_no_iteration_that_only_repeats_the_last():
    steps = list(itertools.islice(METHODS["mend"](goal="shape").steps(wavy(grid(3), 0.2)), 300))
    assert 2 < len(steps) < 300
    assert all((one.points != other.points).any() for one, other in itertools.pairwise(steps))
