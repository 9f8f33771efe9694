"""Detection of boundary layers: stacks of thin hexes or wedges over whole patches of the boundary, whose heights grow.

Layers on walls that sets name, whether or not their heights grow.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary import boundary_of
from hexmend.errors import MeshError
from hexmend.layers.walls import WEDGES, Layers, lateral_lengths, layers_of_columns, nodes_of_faces, walk_columns
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set
from hexmend.mesh.solid_cells import kinds_of
from hexmend.quality import ElementQuality
from hexmend.quality.measure import corner_determinants
from hexmend.target.sheets import recovered_lengths

#: Lateral length over height from which on hexes at a wall are thin. Beside layers, and in graded blocks, it is less.
THIN = 3.0
#: Least ratio of successive heights that grow. That of equal heights is 1, but for noise.
LEAST_GROWTH = 1.02
#: Least product of the aspect ratio at the wall and the number of layers that confirm the growth of the two before:
#: three layers with an aspect ratio of 10, or five with 3.3.
LEAST_EVIDENCE = 10.0


def find_layers(mesh: Mesh, quality: ElementQuality | None = None) -> Layers:
    """Find the boundary layers of a mesh by the heights of its hexes.

    A layer is a stack over a whole patch of the boundary, between feature edges and the ends of named sets: most hexes
    on it are thin, and the heights of most columns grow inwards. Where the mesh is noisy or tangled, lengths are
    recovered along dual sheets.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality, optional
        Of the mesh's hexes, if it is measured already.

    Returns
    -------
    Layers
        Patches of one side set are one wall.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> bool(find_layers(make("cube", size=64))), [wall.depth for wall in find_layers(make("layered")).walls]
    (False, [20])
    """
    neighbours, at, hexes, faces = _faces_of_columns(mesh)
    volume, area, side = sizes_at_wall(mesh, hexes, faces)
    flat = volume * THIN <= side * area
    if not flat.any():
        return Layers()
    patch = boundary_of(mesh, corners=np.empty(0, np.int32)).patch_of_face[at]
    mostly_flat = np.bincount(patch, flat) * 2 >= np.bincount(patch)
    chosen = np.flatnonzero(mostly_flat[patch])
    if not chosen.size:
        return Layers()
    hexes, faces, patch = hexes[chosen], faces[chosen], patch[chosen]
    lengths = recovered_lengths(mesh, quality)
    columns, entries = walk_columns(neighbours, lengths, hexes, faces)
    heights = np.where(columns >= 0, lengths[columns, entries // 2], np.nan)
    growth = np.nan_to_num(heights[:, 1:] / heights[:, :-1])
    aspect = lateral_lengths(lengths[hexes], faces, neighbours[hexes]) / heights[:, 0]
    names, number = np.full(len(chosen), "", dtype=object), 0
    order = np.argsort(patch, kind="stable")
    for rows in sorted(np.split(order, np.flatnonzero(np.diff(patch[order])) + 1), key=len, reverse=True):
        depth = _depth(np.median(aspect[rows]), np.median(growth[rows], axis=0))
        columns[rows, depth:] = -1
        if depth:
            number += 1
            names[rows] = _side_set(mesh, hexes[rows[0]], faces[rows[0]]) or f"wall {number}"
    found = names != ""
    return layers_of_columns(names[found], columns[found], entries[found], mesh.n_elements)


def _faces_of_columns(mesh: Mesh) -> tuple[np.ndarray, ...]:
    """Neighbours across the faces through which columns go, and those of these faces that are boundary.

    Returns
    -------
    neighbours : (m, 6) int32
        -1 on the boundary; the cell itself where no column goes. Triangles of wedges are the faces 4 and 5, as those
        across the same direction of hexes.
    at : (k,) int64
        Of the faces on the boundary, the rows in `Topology.boundary_faces`.
    cells, faces : (k,) int64
    """
    given, kinds = mesh.topology.face_neighbours, kinds_of(mesh.elements)
    cells, faces = np.nonzero(given < 0)
    if not kinds.any():
        return given, np.arange(len(cells)), cells, faces
    wedges, own = kinds == WEDGES, np.arange(len(kinds), dtype=np.int32)[:, None]
    neighbours = np.where(kinds[:, None] == 0, given, own)
    neighbours[wedges, 4:] = given[wedges, :2]
    at = np.flatnonzero((kinds[cells] == 0) | wedges[cells] & (faces < 2))
    return neighbours, at, cells[at], faces[at] + 4 * wedges[cells[at]]


def _depth(aspect: float, growth: np.ndarray) -> int:
    """Number of layers on a patch with an aspect ratio at the wall and ratios of successive heights; 0 for none."""
    grows = int(np.logical_and.accumulate(growth >= LEAST_GROWTH).sum())
    return grows + 1 if aspect >= THIN and aspect * (grows - 1) >= LEAST_EVIDENCE else 0


def sizes_at_wall(mesh: Mesh, hexes: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Volumes of hexes (k,), areas of one face of each, (k,) int, and the longest sides of these faces; each (k,).

    Of wedges too; see `nodes_of_faces`.
    """
    x = mesh.points[nodes_of_faces(mesh.elements, hexes, faces)]
    area = np.linalg.norm(np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]), axis=1) / 2
    side = np.linalg.norm(x - np.roll(x, 1, axis=1), axis=2).max(axis=1)
    ideal = np.where(kinds_of(mesh.elements[hexes]) == WEDGES, np.sqrt(3) / 4, 1.0)  # volume
    return ideal * corner_determinants(mesh.points, mesh.elements, hexes).mean(axis=1), area, side


def _side_set(mesh: Mesh, hex: int, face: int) -> str:
    """Name of the smallest side set with a face; "" for none."""
    sizes = {name: len(rows) for name, rows in mesh.side_sets.items() if (rows == (hex, face)).all(axis=1).any()}
    return min(sizes, key=sizes.__getitem__, default="")


def layers_on_sets(mesh: Mesh, names: Sequence[str], quality: ElementQuality | None = None) -> Layers:
    """Find the layers on walls that are sets: the stack of hexes on each of their faces of the boundary.

    A stack goes on through opposite faces while its hexes are lower than wide, and while their heights change from one
    to the next by a factor of at most 2.5, up or down. Where stacks from several walls meet, each hex belongs to the
    nearer wall.

    Parameters
    ----------
    mesh : Mesh
    names : sequence of str
        Names of sets of sides, quads or nodes. A face that is in several belongs to the first.
    quality : ElementQuality, optional
        Of the mesh's hexes, if it is measured already.

    Returns
    -------
    Layers
        A wall for each set.

    Raises
    ------
    MeshError
        For a set that does not exist, and for one without a face on the boundary.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("layered", size=2000)
    >>> layers_on_sets(mesh, list(mesh.side_sets)[:1]).walls[0].depth
    20
    """
    neighbours, at, hexes, faces = _faces_of_columns(mesh)
    wall = np.full(len(hexes), "", dtype=object)
    for name in names:
        marks = _faces_in_set(mesh, name, at, hexes, faces)
        if not marks.any():
            raise MeshError(
                f"the set {name!r} has no face on the boundary, on which layers could stand: name a set of boundary "
                "faces, or of all nodes of such faces"
            )
        wall[marks & (wall == "")] = name
    chosen = wall != ""
    columns = walk_columns(neighbours, recovered_lengths(mesh, quality), hexes[chosen], faces[chosen])
    return layers_of_columns(wall[chosen], *columns, mesh.n_elements)


def _faces_in_set(mesh: Mesh, name: str, at: np.ndarray, hexes: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Mark the faces of the boundary (k,), by row in `boundary_faces`, cell and face, that are in a set, (k,) bool."""
    if name in mesh.side_sets:
        rows = np.asarray(mesh.side_sets[name], dtype=np.int64)
        return np.isin(6 * hexes + faces, 6 * rows[:, 0] + rows[:, 1])
    return mask(nodes_in_set(mesh, name), mesh.n_nodes)[mesh.topology.boundary_faces[at]].all(axis=1)
