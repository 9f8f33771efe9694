"""Structured hexes from which gallery meshes are assembled."""

from __future__ import annotations

import numpy as np


def box_hexes(nx: int, ny: int, nz: int) -> np.ndarray:
    """Return the hexes of a structured grid.

    Parameters
    ----------
    nx, ny, nz : int
        Number of hexes in each direction; nodes are numbered x first, then y, then z.

    Returns
    -------
    (nx ny nz, 8) int64
    """
    floor = np.arange((nx + 1) * (ny + 1)).reshape(ny + 1, nx + 1)
    return extrude(grid_quads(floor), floor.size, nz)


def grid_quads(numbers: np.ndarray) -> np.ndarray:
    """Return the quads of grids of node numbers (..., ny + 1, nx + 1), counter-clockwise, (k, 4) int64."""
    low, high = slice(None, -1), slice(1, None)
    corners = [(low, low), (low, high), (high, high), (high, low)]  # by y and x
    return np.stack([numbers[..., y, x] for y, x in corners], axis=-1).reshape(-1, 4)


def tensor_product(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the nodes of a structured grid from its planes (nx,), (ny,), (nz,), numbered x first, (nx ny nz, 3)."""
    grids = np.meshgrid(z, y, x, indexing="ij")
    return np.column_stack([grid.ravel() for grid in grids[::-1]])


def extrude(quads: np.ndarray, nodes: int, layers: int) -> np.ndarray:
    """Return the hexes of quads extruded in layers.

    Parameters
    ----------
    quads : (k, 4) int
        Counter-clockwise seen from above.
    nodes : int
        Number of nodes of the plane; node i of layer j has the number j * nodes + i.
    layers : int

    Returns
    -------
    (layers * k, 8) int64
    """
    floor = np.concatenate([quads, quads + nodes], axis=1)
    return (floor[None] + nodes * np.arange(layers)[:, None, None]).reshape(-1, 8)
