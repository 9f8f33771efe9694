"""Structured pieces that gallery meshes are put together from."""

from __future__ import annotations

import numpy as np


def box_hexes(nx: int, ny: int, nz: int) -> np.ndarray:
    """Hexes of a structured grid whose nodes are numbered x first, then y, then z; (nx ny nz, 8) int64."""
    number = np.arange((nx + 1) * (ny + 1) * (nz + 1)).reshape(nz + 1, ny + 1, nx + 1)
    low, high = slice(None, -1), slice(1, None)
    places = [
        (low, low, low), (low, low, high), (low, high, high), (low, high, low),
        (high, low, low), (high, low, high), (high, high, high), (high, high, low),
    ]  # fmt: skip
    return np.column_stack([number[place].ravel() for place in places])


def extrude(quads: np.ndarray, nodes: int, layers: int) -> np.ndarray:
    """Hexes above the quads of a plane, layer upon layer; (layers * quads, 8) int64.

    Parameters
    ----------
    quads : (k, 4) int
        Counter-clockwise seen from above.
    nodes : int
        Nodes of the plane; node i of layer j has the number j * nodes + i.
    layers : int
    """
    floor = np.concatenate([quads, quads + nodes], axis=1)
    return (floor[None] + nodes * np.arange(layers)[:, None, None]).reshape(-1, 8)
