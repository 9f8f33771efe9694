"""Orientation of hexes of a divided mesh: left-handed parts are renumbered, as in one process."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.orientation import MIRRORED_CORNERS, handedness
from hexmend.mesh.topology.components import components_of_cells
from hexmend.ranks.mpi_ranks import MPIRanks


def mirror_parts(ranks: MPIRanks, points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Return the hexes of a rank's part, those of left-handed parts of the whole mesh renumbered.

    Parameters
    ----------
    ranks : MPIRanks
    points : (n, 3) float64
    hexes : (m, 8) int32
        All hexes at the nodes that the rank owns.

    Returns
    -------
    (m, 8) int32
    """
    wrong, right = handedness(points, hexes)
    if not ranks.any(wrong):
        return hexes
    part = components_of_cells(len(points), hexes)
    left, proper = (np.bincount(part, marks) > 0 for marks in (wrong, right))
    marks = np.stack([left, proper], axis=1)
    while True:  # marks spread through nodes from rank to rank
        of_node = np.zeros((len(points), 2), np.uint8)
        of_node[hexes] = marks[part][:, None]
        ranks.complete(of_node)
        spread = marks.copy()
        for corner in hexes.T:
            np.logical_or.at(spread, part, of_node[corner].astype(bool))
        changed = (spread != marks).any()
        marks = spread
        if not ranks.any(changed):
            break
    mirrored = (marks[:, 0] & ~marks[:, 1])[part]
    turned = hexes.copy()
    turned[mirrored] = hexes[mirrored][:, MIRRORED_CORNERS]
    return turned
