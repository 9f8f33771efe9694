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
    number = np.arange((nx + 1) * (ny + 1) * (nz + 1)).reshape(nz + 1, ny + 1, nx + 1)
    low, high = slice(None, -1), slice(1, None)
    square = [(low, low), (low, high), (high, high), (high, low)]  # corners 0 to 3 by y and x
    places = [(z, *yx) for z in (low, high) for yx in square]
    return np.column_stack([number[place].ravel() for place in places])


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
