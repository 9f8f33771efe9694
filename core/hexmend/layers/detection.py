"""Detection of boundary layers: stacks of thin hexes whose heights grow steadily from a wall."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend.layers.columns import Columns, Lengths, lateral_lengths, walk_columns
from hexmend.layers.walls import Layers, Wall
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.components import components_of_cells
from hexmend.quality import ElementQuality, measure
from hexmend.quality.measure import corner_determinants
from hexmend.target.edge_lengths import given_lengths
from hexmend.target.sheets import DISTORTED, recovered_lengths

#: Lateral length over height of a wall's first hex from which on it is thin, and for one beside thin ones.
THIN, RATHER_THIN = 3.0, 1.5
#: Longest side of a wall's face over the height that volumes tell, from which on its hex may be thin.
THIN_IN_VOLUME = 2.9
#: In a distorted mesh, walls with a smaller share of the boundary faces are not looked for: 1 over this.
MAX_WALLS_DISTORTED = 300
#: Least number of layers; that of very thin ones, and how thin these are.
MIN_LAYERS, MIN_VERY_THIN_LAYERS, VERY_THIN = 5, 3, 10.0
#: Least mean ratio of successive heights, and greatest mean change of its logarithm from layer to layer.
MIN_GROWTH, MAX_UNSTEADINESS = 1.02, 0.1
#: Least number of thin faces of a wall, and their least share of its faces.
MIN_FACES, MIN_SHARE = 9, 1 / 3
#: Share of a wall's faces that side sets have if the wall is divided and named by them.
_NAMED = 0.9


def find_layers(mesh: Mesh, quality: ElementQuality | None = None) -> Layers:
    """Find the boundary layers of a mesh by the heights of its hexes.

    A layer begins at a connected set of boundary faces on which thin hexes stand, with heights that grow inwards by a
    steady ratio. Where the mesh is noisy or tangled, lengths are recovered along dual sheets first. Without thin hexes
    on the boundary nothing else is looked at.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality, optional
        Of the mesh's hexes, if it is measured already.

    Returns
    -------
    Layers

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> bool(find_layers(make("cube", size=64))), [wall.depth for wall in find_layers(make("layered")).walls]
    (False, [20])
    """
    neighbours = mesh.topology.face_neighbours
    hexes, faces = np.nonzero(neighbours < 0)
    quality = quality or measure(mesh.points, mesh.hexes)
    distorted = bool((quality.scaled_jacobian < DISTORTED).any())
    thin = _may_be_thin(mesh, hexes, faces, distorted)
    if np.count_nonzero(thin) < MIN_FACES:
        return Layers()
    lengths = _lengths(mesh, quality, distorted)
    first = lengths(hexes)
    height = first[np.arange(len(hexes)), faces // 2]
    aspect = lateral_lengths(first, faces, neighbours[hexes]) / height
    candidates = np.flatnonzero(aspect >= RATHER_THIN)
    if np.count_nonzero(aspect >= THIN) < MIN_FACES:
        return Layers()
    columns = walk_columns(neighbours, lengths, hexes[candidates], faces[candidates])
    aspect, layers = aspect[candidates], columns.layers
    stacked = (layers >= MIN_LAYERS) | (aspect >= VERY_THIN) & (layers >= MIN_VERY_THIN_LAYERS)
    stacked &= (columns.growth >= MIN_GROWTH) & (columns.unsteadiness <= MAX_UNSTEADINESS)
    return _walls(mesh, columns.rows(stacked).separated(mesh.n_hexes), aspect[stacked] >= THIN)


def _may_be_thin(mesh: Mesh, hexes: np.ndarray, faces: np.ndarray, distorted: bool) -> np.ndarray:
    """Mark faces on which the shortest edge of the height is short against the longest beside it, (k,) bool."""
    thin = short_faces(mesh, hexes, faces)
    if np.count_nonzero(thin) < MIN_FACES:
        return thin
    thin &= thin_in_volume(mesh, hexes, faces)
    quads = mesh.hexes[hexes[:, None], FACES[faces]]
    return thin & _in_large_groups(quads, thin, mesh.n_nodes, least_faces(len(faces), distorted))


def least_faces(count: int, distorted: bool) -> int:
    """Return the least number of thin faces of a wall, of `count` faces of the boundary."""
    return max(MIN_FACES, count // MAX_WALLS_DISTORTED if distorted else 0)


def short_faces(mesh: Mesh, hexes: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Mark faces of hexes, both (k,) int, whose height has an edge that is short against the longest of the others."""
    ends = mesh.hexes[hexes][:, EDGES]
    along = mesh.points[ends[..., 1]] - mesh.points[ends[..., 0]]
    squares = np.einsum("kei,kei->ke", along, along).reshape(-1, 3, 4)
    rows = np.arange(len(hexes))
    height = squares.min(axis=2)[rows, faces // 2]
    longest = squares.max(axis=2)
    longest[rows, faces // 2] = 0
    return height * THIN**2 < longest.max(axis=1)


def _in_large_groups(quads: np.ndarray, marked: np.ndarray, n: int, least: int) -> np.ndarray:
    """Keep the marks of faces (k,) bool in connected groups of at least `least` marked faces, (k,) bool."""
    group = components_of_cells(n, quads[marked])
    large = np.zeros(len(quads), dtype=bool)
    large[marked] = np.bincount(group, minlength=1)[group] >= least
    return large


def thin_in_volume(
    mesh: Mesh,
    hexes: np.ndarray,
    faces: np.ndarray,
    complete: Callable[[np.ndarray], np.ndarray] = lambda rows: rows,
) -> np.ndarray:
    """Mark faces whose hexes, with those around them, have small volumes for the faces, (k,) bool.

    Single edges of a scrambled mesh may be short anywhere; the volume over several faces tells a layer from that.

    Parameters
    ----------
    mesh : Mesh
    hexes, faces : (k,) int
    complete : callable
        Completes sums at the nodes of a part of a mesh, (n,); see `hexmend.energy.ranks.Ranks`.
    """
    sigma = corner_determinants(mesh.points, mesh.hexes, hexes).mean(axis=1)
    quads = mesh.hexes[hexes[:, None], FACES[faces]]
    x = mesh.points[quads]
    area = np.linalg.norm(np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]), axis=1) / 2
    side = np.linalg.norm(x - np.roll(x, 1, axis=1), axis=2).max(axis=1)
    nodes = quads.ravel()
    volume, areas = (complete(np.bincount(nodes, np.repeat(of, 4), mesh.n_nodes)) for of in (sigma, area))
    return volume[quads].sum(axis=1) * THIN_IN_VOLUME < side * areas[quads].sum(axis=1)


def _lengths(mesh: Mesh, quality: ElementQuality, distorted: bool) -> Lengths:
    """Lengths of some hexes; of a distorted mesh they are recovered."""
    if not distorted:
        return lambda which: given_lengths(mesh, which)
    lengths = recovered_lengths(mesh, quality)
    return lambda which: lengths[which]


def _walls(mesh: Mesh, columns: Columns, thin: np.ndarray) -> Layers:
    """Group columns into walls by common nodes of their faces, and name them."""
    if not len(columns.hexes):
        return Layers()
    quads = mesh.hexes[columns.hexes[:, :1], FACES[columns.faces[:, 0]]]
    component = components_of_cells(mesh.n_nodes, quads)
    count, strong = np.bincount(component), np.bincount(component, thin)
    kept = np.flatnonzero((strong >= MIN_FACES) & (strong >= MIN_SHARE * count))
    parts: list[tuple[str, Columns]] = []
    for which in kept:
        rows = columns.rows(component == which)
        names = _names(mesh, rows)
        parts += [(name, rows.rows(names == name)) for name in dict.fromkeys(names.tolist())]
    parts.sort(key=lambda part: -len(part[1].hexes))
    walls = (Wall(name or f"wall {number}", part.hexes, part.faces) for number, (name, part) in enumerate(parts, 1))
    return Layers(tuple(walls))


def _names(mesh: Mesh, columns: Columns) -> np.ndarray:
    """Name of the side set that each face of a wall is in, the smallest of several, (w,) of str; "" for none.

    A wall of which side sets have only a small part is not divided.
    """
    keys = 6 * columns.hexes[:, 0].astype(np.int64) + columns.faces[:, 0]
    names = np.full(len(keys), "", dtype=object)
    for name, sides in sorted(mesh.side_sets.items(), key=lambda one: -len(one[1])):
        names[np.isin(keys, 6 * sides[:, 0].astype(np.int64) + sides[:, 1])] = name
    return names if np.mean(names != "") >= _NAMED else np.full(len(keys), "", dtype=object)
