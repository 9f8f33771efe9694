"""Side sets of a padded mesh: outer faces pass to the new hexes, faces inside go on to the faces of the layer."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hexmend.mesh.hexahedron import FACES
from hexmend.padding.inserted_layer import LATERAL, OUTER, Sheet

#: Largest number of hexes around an edge that are passed.
_MAX_AROUND = 256


class Extension(NamedTuple):
    """Faces between new hexes in which sides of the mesh go on through the layer.

    Parameters
    ----------
    rows : (j,) int64
        Row of the side that each continues.
    hexes : (j,) int64
        New hex, counted from 0.
    sides : (j,) int64
        Side of its outer face, from corner i to corner i + 1.
    """

    rows: np.ndarray
    hexes: np.ndarray
    sides: np.ndarray


def extensions(sheet: Sheet, sides: np.ndarray) -> Extension:
    """Find the faces in which sides inside the mesh, or beside the sheet, go on through the layer.

    At an edge of the sheet the hexes around it are passed, from the side's own hex on, up to a face of the sheet: the
    new hex there has the face that goes on.

    Parameters
    ----------
    sheet : Sheet
    sides : (j, 2) int
        A hex and its face, in each row; none is a face of the sheet.

    Returns
    -------
    Extension
    """
    mesh = sheet.mesh
    near = np.flatnonzero((sheet.copy_of_corner[sides[:, :1], FACES[sides[:, 1]]] >= 0).sum(axis=1) >= 2)
    rows = np.repeat(near, 4)
    hexes, faces = sides[rows].T.astype(np.int64)
    side = np.tile(np.arange(4), near.size)
    corners = FACES[faces[:, None], np.stack([side, (side + 1) % 4], axis=1)]
    ends = mesh.hexes[hexes[:, None], corners]
    whole = (sheet.copy_of_corner[hexes[:, None], corners] >= 0).all(axis=1)
    rows, hexes, faces, ends = rows[whole], hexes[whole], faces[whole], ends[whole]
    found: list[tuple[np.ndarray, ...]] = []
    for _ in range(_MAX_AROUND):
        if not rows.size:
            break
        faces = _other_face(mesh.hexes[hexes], faces, ends)
        number = sheet.face_number[hexes, faces]
        at = np.flatnonzero(number >= 0)
        at_corner = sheet.quads[number[at]]
        first = (at_corner[:, :, None] == ends[at][:, None, :]).any(axis=2)
        follows = first & np.roll(first, -1, axis=1)
        found.append((rows[at], number[at], follows.argmax(axis=1)))
        across = mesh.topology.face_neighbours[hexes, faces].astype(np.int64)
        on = np.flatnonzero((number < 0) & (across >= 0) & sheet.region[across])
        back = (mesh.topology.face_neighbours[across[on]] == hexes[on][:, None]).argmax(axis=1)
        rows, hexes, faces, ends = rows[on], across[on], back, ends[on]
    if not found:
        found = [(np.empty(0, np.int64),) * 3]
    return Extension(*(np.concatenate(parts) for parts in zip(*found, strict=True)))


def _other_face(hexes: np.ndarray, faces: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Face of each hex (j, 8) at the edge between two nodes (j, 2) that is not a given one (j,), (j,) int64."""
    at = (hexes[:, FACES][..., None] == ends[:, None, None, :]).any(axis=2).all(axis=2)
    at[np.arange(len(faces)), faces] = False
    return at.argmax(axis=1)


def padded_side_set(sheet: Sheet, sides: np.ndarray) -> np.ndarray:
    """Return a side set of the padded mesh.

    Parameters
    ----------
    sheet : Sheet
    sides : (j, 2) int
        The set in the mesh: a hex and its face in each row.

    Returns
    -------
    (i, 2) int64
        Sides on the sheet are those of the new hexes; the others have those added in which they go on.
    """
    number, m = sheet.face_number[sides[:, 0], sides[:, 1]], sheet.mesh.n_hexes
    answer = np.where((number >= 0)[:, None], np.stack([m + number, np.full_like(number, OUTER)], axis=1), sides)
    more = extensions(sheet, sides[number < 0])
    _, first = np.unique(sheet.lateral_of_side[more.hexes, more.sides], return_index=True)
    first.sort()
    added = np.stack([m + more.hexes[first], LATERAL[more.sides[first]]], axis=1)
    return np.concatenate([answer, added])
