"""Orientation of hexes of a divided mesh: left-handed ones are found, renumbered and refused as in one process."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.orientation import all_corners_negative, are_left_handed, left_handed_error, signed_volumes
from hexmend.mesh.topology import Topology
from hexmend.mesh.topology.face_parity import face_parity, signed_components
from hexmend.ranks.divided.divided_mesh import DividedMesh
from hexmend.ranks.mpi_ranks import MPIRanks
from hexmend.terminal_text import count_phrase


def check_orientation(mesh: DividedMesh) -> None:
    """Check that no hex is numbered left-handed; all ranks call it together.

    Raises
    ------
    MeshError
        On all ranks, where hexes are.
    """
    part = mesh.part
    which = left_handed_hexes(part.ranks, part.mesh.points, part.mesh.hexes, mesh.hex_ids, part.owned)
    count = part.ranks.sum(int(np.count_nonzero(which & part.counted)))
    if count:
        raise left_handed_error(count_phrase(count, "hex is", "hexes are"))


def left_handed_hexes(
    ranks: MPIRanks, points: np.ndarray, hexes: np.ndarray, ids: np.ndarray, owned: np.ndarray
) -> np.ndarray:
    """Find the hexes of a rank's part that are numbered left-handed in the whole mesh; all ranks call it together.

    Each rank solves the parity of its own hexes (`face_parity`); hexes that several ranks have connect their
    components.

    Parameters
    ----------
    ranks : MPIRanks
    points : (n, 3) float64
    hexes : (m, 8) int32
        All hexes at the nodes that the rank owns.
    ids : (m,) int
        Their numbers in the whole mesh.
    owned : (n,) bool

    Returns
    -------
    (m,) bool
    """
    volume = signed_volumes(points, hexes)
    if not ranks.any(volume < 0):
        return np.zeros(len(hexes), dtype=bool)
    of_own = owned[hexes[:, FACES]].any(axis=2)  # all hexes at such a face are here
    component, sign = face_parity(hexes, np.where(of_own, Topology(hexes, len(points)).neighbours_in_any_order, -1))
    component, sign = _in_whole_mesh(ranks, component, sign, ids, ~owned[hexes].all(axis=1))
    group, of_hex = np.unique(3 * component + sign + 1, return_inverse=True)  # alike in the whole mesh
    counted = owned[hexes[:, 0]]
    values = volume, np.sign(volume), all_corners_negative(points, hexes, volume)
    sums = [np.bincount(of_hex[counted], one[counted], len(group)) for one in values]
    rows = ranks.gather(np.stack([group, *sums], axis=1))
    components, signs = np.divmod(rows[:, 0].astype(np.int64), 3)
    return np.isin(group, rows[are_left_handed(components, signs - 1, *rows[:, 1:].T), 0])[of_hex]


def _in_whole_mesh(
    ranks: MPIRanks, component: np.ndarray, sign: np.ndarray, ids: np.ndarray, shared: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Convert components and signs of hexes from a rank's part to the whole mesh; `shared` has the other parts'."""
    first, component = np.unique(component, return_inverse=True)
    counts = ranks.gather(np.array([first.size]))
    component = component + counts[: ranks.number].sum()
    rows = ranks.gather(np.stack([ids, component, sign], axis=1)[shared | (sign == 0)])
    rows = rows[np.argsort(rows[:, 0], kind="stable")]
    same = rows[1:, 0] == rows[:-1, 0]
    none = rows[rows[:, 2] == 0, 1]
    pairs = np.concatenate([np.stack([rows[:-1, 1], rows[1:, 1]], axis=1)[same], np.stack([none, none], axis=1)])
    unlike = np.concatenate([(rows[:-1, 2] != rows[1:, 2])[same], np.ones(none.size, dtype=bool)])
    whole, sign_of = signed_components(int(counts.sum()), pairs, unlike)
    return whole[component], sign * sign_of[component]
