"""Limits of a mesh: range of its coordinates, and numbers of nodes and hexes that 32 bits can hold."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from hexmend.arrays import bounds
from hexmend.errors import MeshError

#: Largest coordinate and smallest extent of a mesh: beyond them fourth powers of lengths overflow or vanish.
MAX_COORDINATE, MIN_EXTENT = 1e75, 1e-75

#: Node numbers have 32 bits, and so have corner numbers, 8 * hex + corner.
MAX_NODES = 2**31 - 1
MAX_HEXES = MAX_NODES // 8

#: Items of compressed rows, such as the neighbours of all nodes, are counted with 32 bits too.
MAX_ITEMS = MAX_NODES


@contextmanager
def overflow_as_mesh_error(label: str) -> Iterator[None]:
    """Turn a kernel's `OverflowError` about too many items into a `MeshError` that names them."""
    try:
        yield
    except OverflowError as error:
        raise MeshError(
            f"the mesh has too many {label}, whose numbers have 32 bits: {error}; divide the mesh"
        ) from None


def check_size(points: np.ndarray) -> None:
    """Raise `MeshError` if points (n, 3) are so far apart, or so close, that volumes overflow or vanish."""
    if not len(points):
        return
    low, high = bounds(points)
    far, size = max(-low.min(), high.max()), float((high - low).max())
    if far > MAX_COORDINATE:
        raise MeshError(
            f"coordinates go up to {far:.3g}: expected {MAX_COORDINATE:g} at most; choose a larger unit of length"
        )
    if 0 < size < MIN_EXTENT:
        raise MeshError(
            f"the mesh is {size:.3g} wide: expected {MIN_EXTENT:g} at least; choose a smaller unit of length"
        )
