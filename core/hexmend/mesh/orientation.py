"""Orientation of hexes: parts whose corners are numbered left-handed, so that each hex is inside out."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend.arrays import bounds
from hexmend.kernels import elements
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MIRRORED_MID_NODES
from hexmend.mesh.topology.components import components_of_cells
from hexmend.terminal_text import count_phrase

#: Corners, and faces, of a hex whose lower and upper face are exchanged.
MIRRORED_CORNERS = np.array([4, 5, 6, 7, 0, 1, 2, 3])
MIRRORED_FACES = np.array([0, 1, 2, 3, 5, 4])

#: Hexes whose volumes are computed at a time.
_CHUNK = 1 << 16
#: End of the note on hexes that were renumbered, and that of version 0.1.
_RENUMBERED = "numbered inside out in the file (left-handed), and renumbered on reading."
_RENUMBERED_BEFORE = "were numbered inside out in the file, and were renumbered on reading."


def was_turned(mesh: Mesh) -> bool:
    """Return True if parts of the mesh were renumbered on reading."""
    return any(note.endswith((_RENUMBERED, _RENUMBERED_BEFORE)) for note in mesh.notes)


def with_consistent_orientation(mesh: Mesh, report: Callable[[float], object] = lambda share: None) -> Mesh:
    """Return the mesh with all left-handed parts renumbered right-handed, and a note that says so.

    Single inverted hexes are left as they are: smoothing has to repair them.

    Parameters
    ----------
    mesh : Mesh
    report : callable
        Called with the share of the hexes that have been looked at, 0 to 1.

    Returns
    -------
    Mesh
    """
    which = mirrored_parts(mesh, report)
    count = int(which.sum())
    if not count:
        return mesh
    note = f"{whole_parts_are(count, mesh.n_hexes)} {_RENUMBERED}"
    return mirror_hexes(mesh, which).replace(notes=(*mesh.notes, note))


def whole_parts_are(count: int, n_hexes: int) -> str:
    """Return the subject and verb of a sentence about hexes that make whole parts of a mesh.

    >>> whole_parts_are(8, 8), whole_parts_are(1, 8), whole_parts_are(1, 1)
    ('All hexes are', '1 hex, which makes a whole part, is', 'The only hex is')
    """
    if count == n_hexes:
        return "The only hex is" if count == 1 else "All hexes are"
    return count_phrase(count, "hex, which makes a whole part, is", "hexes, which make whole parts, are")


def mirrored_parts(mesh: Mesh, report: Callable[[float], object] = lambda share: None) -> np.ndarray:
    """Find the hexes of left-handed parts.

    Parts are connected by nodes. A part is left-handed if some of its hexes have a negative volume and none a positive
    one; flat hexes, whose volume is zero up to rounding, do not count.

    Parameters
    ----------
    mesh : Mesh
    report : callable
        As of `with_consistent_orientation`.

    Returns
    -------
    (m,) bool
    """
    wrong, right = np.zeros(mesh.n_hexes, dtype=bool), np.zeros(mesh.n_hexes, dtype=bool)
    if not mesh.n_hexes:
        return wrong
    bound = _rounding_bound(mesh.points)
    for begin in range(0, mesh.n_hexes, _CHUNK):
        some = slice(begin, begin + _CHUNK)
        wrong[some], right[some] = _handedness(mesh.points, mesh.hexes[some], bound)
        report(min(begin + _CHUNK, mesh.n_hexes) / mesh.n_hexes)
    if not wrong.any():
        return wrong
    part = parts_of(mesh)
    of_part = (np.bincount(part, wrong) > 0) & (np.bincount(part, right) == 0)
    return of_part[part]


def handedness(points: np.ndarray, hexes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mark hexes (m, 8) of negative and of positive volume, both (m,) bool; flat ones are neither."""
    bound, chunks = _rounding_bound(points), range(0, len(hexes), _CHUNK)
    marks = [_handedness(points, hexes[begin : begin + _CHUNK], bound) for begin in chunks]
    wrong, right = (np.concatenate([np.empty(0, bool), *(pair[side] for pair in marks)]) for side in (0, 1))
    return wrong, right


def _handedness(points: np.ndarray, hexes: np.ndarray, bound: float) -> tuple[np.ndarray, np.ndarray]:
    """Mark hexes (k, 8) of negative and of positive volume, both (k,) bool; flat ones are neither.

    `bound` is that of the rounding error of any hex: those of larger volumes need none of their own.
    """
    volumes = _volumes(points, hexes)
    with np.errstate(all="ignore"):
        wrong, right = volumes < -bound, volumes > bound
        small = np.flatnonzero(~(wrong | right))
        rounding = _rounding(points, hexes[small])
        wrong[small], right[small] = volumes[small] < -rounding, volumes[small] > rounding
    return wrong, right


def _rounding_bound(points: np.ndarray) -> float:
    """Bound of the rounding errors of all hexes with these corners (n, 3)."""
    low, high = bounds(points)
    with np.errstate(all="ignore"):
        largest = np.maximum(np.abs(low), np.abs(high)).max()
        return float(65 * np.finfo(np.float64).eps * largest * np.square(high - low).sum())


def _volumes(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Sums of the corner determinants of hexes (k, 8), (k,); very large coordinates overflow."""
    determinants = np.empty((len(hexes), 8))
    elements.corner_determinants(points, hexes, determinants)
    with np.errstate(all="ignore"):
        return determinants.sum(axis=1)


def _rounding(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Bound of the rounding error in the sum of a hex's corner determinants, (k,) float64."""
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
    """The part that each hex belongs to, parts hanging together by nodes; (m,) int from 0.

    Parameters
    ----------
    mesh : Mesh
    others : bool
        Cells of other kinds join parts too.
    """
    return components_of_cells(mesh.n_nodes, mesh.hexes, *(cells.nodes for cells in mesh.cells if others))
