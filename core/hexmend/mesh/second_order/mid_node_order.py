"""Order of mid-nodes in a file that is that of another program.

VTK and Abaqus list the edges of the lower face, of the upper face, then the vertical ones; ExodusII, CGNS and Nastran
list the vertical ones second. A file in the other order has mid-nodes far from their edges in every hex.
"""

from __future__ import annotations

import numpy as np

from hexmend.mesh.second_order.bernstein import least_coefficients

#: Columns of `mid_nodes` with those of vertical edges and of the edges of the upper face exchanged.
_EXCHANGED = np.array([0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7, *range(12, 19)])

#: Hexes that are looked at, evenly over the mesh, and the share of them that has to become valid: some may be bent.
_SAMPLE, _MOST = 1000, 0.9


def in_order(points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray) -> np.ndarray | None:
    """Exchange two groups of mid-nodes where nearly all hexes are invalid as given, and valid then.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    mid_nodes : (m, 19) int32

    Returns
    -------
    (m, 19) int32 or None
        Mid-nodes in the right order; None where they are as given.
    """
    curved = np.flatnonzero((mid_nodes[:, :12] >= 0).all(axis=1))
    if not curved.size:
        return None
    some = curved[:: -(-curved.size // _SAMPLE)]
    exchanged = mid_nodes.copy()
    exchanged[curved] = mid_nodes[curved][:, _EXCHANGED]
    as_given, as_exchanged = (
        np.mean(least_coefficients(points, hexes[some], each[some]) > 0) for each in (mid_nodes, exchanged)
    )
    return exchanged if as_given <= 1 - _MOST and as_exchanged >= _MOST else None
