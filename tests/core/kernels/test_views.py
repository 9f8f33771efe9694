"""Objects that kernels take view arrays: they keep them alive, and refuse arrays that do not fit."""

import gc
import sys

import numpy as np
import pytest

from hexmend.boundary import SlidingBoundary
from hexmend.kernels import laplacian, local
from hexmend.kernels.hex_mesh import HexMesh
from hexmend.kernels.line_search import LineSearch
from tests.core.grids import grid, scrambled


def arrays(mesh):
    """Copies of the connectivity that nothing else holds."""
    corners = mesh.topology.node_corners
    return mesh.hexes.copy(), corners.start.copy(), corners.items.copy()


def test_an_object_keeps_its_arrays_alive_and_lets_them_go():
    given = arrays(grid(3))
    before = [sys.getrefcount(array) for array in given]
    view = HexMesh(*given)
    assert [sys.getrefcount(array) for array in given] == [count + 1 for count in before]
    del view
    gc.collect()
    assert [sys.getrefcount(array) for array in given] == before


def test_a_sliding_surface_keeps_the_arrays_of_its_parts():
    mesh = scrambled(grid(3), 0.1)
    sliding = SlidingBoundary(mesh)
    expected, moved = mesh.points.copy(), mesh.points.copy()
    ring, nodes, surface = sliding.rings, sliding.nodes.astype(np.int32), sliding.sliding_surface
    laplacian.in_place(expected, ring.start, ring.items, nodes, surface)
    del sliding
    gc.collect()
    laplacian.in_place(moved, ring.start, ring.items, nodes, surface)
    np.testing.assert_array_equal(moved, expected)


def test_a_surface_wants_tangents_and_tangents_a_surface():
    mesh = grid(3)
    sliding, colours = SlidingBoundary(mesh), mesh.topology.colouring(mesh.free)
    settings = local.NodeStepSettings(local.Direction.NEWTON, 0.1, (2.0, 1.0), LineSearch())
    given = mesh.points.copy(), mesh.topology.hex_mesh, colours.start, colours.items, settings
    with pytest.raises(ValueError, match="surface and tangents"):
        local.sweep(*given, sliding.sliding_surface)
    with pytest.raises(ValueError, match="surface and tangents"):
        local.sweep(*given, tangents=sliding.tangents(mesh.points))
    with pytest.raises(ValueError, match=r"^tangents: "):
        local.sweep(*given, sliding.sliding_surface, sliding.tangents(mesh.points)[1:])


def test_a_line_search_passes_on_the_exceptions_of_the_energy():
    def fails(alpha):
        raise ZeroDivisionError("no energy")

    with pytest.raises(ZeroDivisionError, match="no energy"):
        LineSearch()(fails, 1.0, -1.0)


def test_the_rounding_of_a_negative_energy_ends_a_line_search():
    assert LineSearch()(lambda alpha: 0.0, -1.0, -1e-16) == (0.0, 0)
