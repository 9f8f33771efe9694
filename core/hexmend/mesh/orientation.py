"""Orientation of hexes: those whose corners are numbered left-handed, which are inside out wherever their nodes are."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend.arrays import bounds
from hexmend.errors import MeshError
from hexmend.kernels import elements, faces
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MIRRORED_MID_NODES
from hexmend.mesh.second_order.mid_node_order import in_order
from hexmend.mesh.topology.components import components_of_cells
from hexmend.mesh.topology.face_parity import face_parity
from hexmend.terminal_text import count_phrase

#: Corners, and faces, of a hex whose lower and upper face are exchanged.
MIRRORED_CORNERS = np.array([4, 5, 6, 7, 0, 1, 2, 3])
MIRRORED_FACES = np.array([0, 1, 2, 3, 5, 4])

#: Hexes whose volumes are computed at a time.
_CHUNK = 1 << 16


def with_consistent_orientation(mesh: Mesh, report: Callable[[float], object] = lambda share: None) -> Mesh:
    """Return the mesh with all left-handed hexes renumbered right-handed; a note and `Mesh.renumbered` say so.

    Hexes that the positions of their nodes invert are left as they are: smoothing has to repair them. Mid-nodes that
    are in the order of another program are put in order, which a note says too.

    Parameters
    ----------
    mesh : Mesh
    report : callable
        Called with the share of the hexes that have been looked at, 0 to 1.

    Returns
    -------
    Mesh
    """
    which = left_handed_hexes(mesh, report)
    if which.any():
        mesh = _right_handed(mesh, which)
    mids = None if mesh.mid_nodes is None else in_order(mesh.points, mesh.hexes, mesh.mid_nodes)
    if mids is None:
        return mesh
    note = (
        "Mid-nodes are in the order of another program in the file, in which nearly all hexes of second order are "
        "invalid: those of the vertical edges and of the upper edges were exchanged on reading."
    )
    return mesh.replace(mid_nodes=mids, notes=(*mesh.notes, note))


def _right_handed(mesh: Mesh, which: np.ndarray) -> Mesh:
    """Return the mesh with left-handed hexes (m,) bool renumbered, with a note and `Mesh.renumbered`."""
    are = left_handed_are(mesh, which)
    note = f"{are} numbered inside out in the file (left-handed), and renumbered on reading."
    renumbered = "hexes" if _differ_from_neighbours(mesh, which) else "parts"
    return mirror_hexes(mesh, which).replace(notes=(*mesh.notes, note), renumbered=renumbered)


def check_orientation(mesh: Mesh) -> None:
    """Check that no hex is numbered left-handed: no position of its nodes makes it valid.

    Raises
    ------
    MeshError
        Where hexes are; the message names the ways to renumber them.
    """
    which = left_handed_hexes(mesh)
    if which.any():
        raise left_handed_error(left_handed_are(mesh, which))


def left_handed_error(hexes_are: str) -> MeshError:
    """Return the error of left-handed hexes, whose sentence begins with this subject and verb."""
    return MeshError(
        f"{hexes_are} numbered inside out (left-handed), which moving nodes does not mend. "
        "Renumber first: hexmend repair MESH -o OUT, hexmend.doctor.repair(mesh), or Edit > Doctor in the window."
    )


def left_handed_are(mesh: Mesh, which: np.ndarray) -> str:
    """Return the subject and verb of a sentence about left-handed hexes (m,) bool; at least one is marked."""
    count = int(which.sum())
    if count == mesh.n_hexes:
        return "The only hex is" if count == 1 else "All hexes are"
    if _differ_from_neighbours(mesh, which):
        return count_phrase(count, "hex, unlike its neighbours, is", "hexes, unlike their neighbours, are")
    return count_phrase(count, "hex, which makes a whole part, is", "hexes, which make whole parts, are")


def _differ_from_neighbours(mesh: Mesh, which: np.ndarray) -> bool:
    """Return True if a hex among `which` (m,) bool has a neighbour that is not."""
    neighbours = mesh.topology.neighbours_in_any_order[which]
    return bool(((neighbours >= 0) & ~which[neighbours]).any())


def left_handed_hexes(mesh: Mesh, report: Callable[[float], object] = lambda share: None) -> np.ndarray:
    """Find the hexes whose corners are numbered left-handed.

    Which hexes of a face-connected component are numbered alike follows from the faces that they share
    (`face_parity`); which of both ways is right-handed follows from volumes (`are_left_handed`). A hex that is
    inverted, and numbered as its neighbours are, is therefore not left-handed. None is where the faces contradict each
    other.

    Parameters
    ----------
    mesh : Mesh
    report : callable
        As of `with_consistent_orientation`.

    Returns
    -------
    (m,) bool
    """
    volume = signed_volumes(mesh.points, mesh.hexes, report) if mesh.n_hexes else np.empty(0)
    if not (volume < 0).any():
        return np.zeros(mesh.n_hexes, dtype=bool)
    component, sign = face_parity(mesh.hexes, mesh.topology.neighbours_in_any_order)
    return are_left_handed(
        component, sign, volume, np.sign(volume), all_corners_negative(mesh.points, mesh.hexes, volume)
    )


def are_left_handed(
    component: np.ndarray, sign: np.ndarray, volume: np.ndarray, votes: np.ndarray, valid: np.ndarray
) -> np.ndarray:
    """Decide which of both numberings in a component is left-handed: that in which its volume is negative.

    The volume inside the boundary does not depend on the nodes inside, however tangled they are. A component is left
    as it is if renumbering would not leave fewer hexes of negative volume, as where an outlier turns the boundary, or
    would make no hex valid, as for a tangled hex that shares no face.

    Parameters
    ----------
    component, sign : (k,) int
        Of hexes, or of groups of hexes that are numbered alike; see `face_parity`.
    volume : (k,) float64
        Their volume.
    votes : (k,) float64
        Number of their hexes of positive volume less that of negative ones.
    valid : (k,) float64 or bool
        Number of their hexes that are valid after renumbering; see `all_corners_negative`.

    Returns
    -------
    (k,) bool
    """
    with np.errstate(all="ignore"):  # volumes may overflow
        right = np.sign(np.bincount(component, sign * volume))[component]
        wrong = sign * right < 0
    lost, gained = (np.bincount(component, np.where(wrong, values, 0)) for values in (votes, valid))
    return wrong & ((lost < 0) & (gained > 0))[component]


def all_corners_negative(points: np.ndarray, hexes: np.ndarray, volume: np.ndarray) -> np.ndarray:
    """Mark the hexes (m, 8) of these volumes (m,) whose corner determinants are all negative, (m,) bool."""
    negative = np.flatnonzero(volume < 0)
    determinants, marks = np.empty((negative.size, 8)), np.zeros(len(hexes), dtype=bool)
    elements.corner_determinants(points, np.ascontiguousarray(hexes[negative]), determinants)
    marks[negative] = (determinants < 0).all(axis=1)
    return marks


def signed_volumes(
    points: np.ndarray, hexes: np.ndarray, report: Callable[[float], object] = lambda share: None
) -> np.ndarray:
    """Compute the volumes of hexes (m, 8); 0 for flat hexes, whose volume is zero up to rounding, (m,) float64.

    Those of very large coordinates, whose products overflow, count as flat.
    """
    volume = np.empty(len(hexes))
    faces.volume(points, hexes, volume)
    bound = _rounding_bound(points)
    for begin in range(0, len(hexes), _CHUNK):
        some = volume[begin : begin + _CHUNK]
        small = begin + np.flatnonzero(~(np.abs(some) > bound))  # larger volumes need no bound of their own
        with np.errstate(all="ignore"):
            volume[small[~(np.abs(volume[small]) > _rounding(points, hexes[small]))]] = 0.0
        report(min(begin + _CHUNK, len(hexes)) / len(hexes))
    return volume


def _rounding_bound(points: np.ndarray) -> float:
    """Bound of the rounding errors of all hexes with these corners (n, 3)."""
    low, high = bounds(points)
    with np.errstate(all="ignore"):
        largest = np.maximum(np.abs(low), np.abs(high)).max()
        return float(65 * np.finfo(np.float64).eps * largest * np.square(high - low).sum())


def _rounding(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Bound of the rounding error in the volume of a hex, (k,) float64."""
    corners = points[hexes]
    size = np.linalg.norm(corners.max(axis=1) - corners.min(axis=1), axis=1)
    return 64 * np.finfo(np.float64).eps * np.abs(corners).max(axis=(1, 2)) * size**2


def mirror_hexes(mesh: Mesh, which: np.ndarray) -> Mesh:
    """Return the mesh with the lower and upper face of some hexes (m,) bool exchanged, which reverses the hexes."""
    hexes = mesh.hexes.copy()
    hexes[which] = hexes[which][:, MIRRORED_CORNERS]
    mids = None
    if mesh.mid_nodes is not None:
        mids = mesh.mid_nodes.copy()
        mids[which] = mids[which][:, MIRRORED_MID_NODES]
    sides = {}
    for name, rows in mesh.side_sets.items():
        sides[name] = rows = np.array(rows)
        there = which[rows[:, 0]]
        rows[there, 1] = MIRRORED_FACES[rows[there, 1]]
    return mesh.rebuilt(hexes=hexes, mid_nodes=mids, side_sets=sides)


def parts_of(mesh: Mesh, others: bool = False) -> np.ndarray:
    """The part that each solid cell belongs to, parts hanging together by nodes; (m,) int from 0.

    Parameters
    ----------
    mesh : Mesh
    others : bool
        Shells, beams and other cells of lower dimension join parts too.
    """
    return components_of_cells(mesh.n_nodes, mesh.elements, *(cells.nodes for cells in mesh.cells if others))
