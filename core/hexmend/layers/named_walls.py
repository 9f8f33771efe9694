"""Layers on walls that sets name, whether or not their heights grow."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import MeshError
from hexmend.layers.columns import walk_columns
from hexmend.layers.walls import Layers, layers_of_columns
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set
from hexmend.quality import ElementQuality
from hexmend.target.sheets import recovered_lengths


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
    neighbours = mesh.topology.face_neighbours
    hexes, faces = np.nonzero(neighbours < 0)
    wall = np.full(len(hexes), "", dtype=object)
    for name in names:
        marks = _faces_in_set(mesh, name, hexes, faces)
        if not marks.any():
            raise MeshError(
                f"the set {name!r} has no face on the boundary, on which layers could stand: name a set of boundary "
                "faces, or of all nodes of such faces"
            )
        wall[marks & (wall == "")] = name
    chosen = wall != ""
    columns = walk_columns(neighbours, recovered_lengths(mesh, quality), hexes[chosen], faces[chosen])
    return layers_of_columns(wall[chosen], *columns, mesh.n_hexes)


def _faces_in_set(mesh: Mesh, name: str, hexes: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Mark the faces of the boundary (k,), by hex and row of FACES, that are in a set, (k,) bool."""
    if name in mesh.side_sets:
        rows = np.asarray(mesh.side_sets[name], dtype=np.int64)
        return np.isin(6 * hexes + faces, 6 * rows[:, 0] + rows[:, 1])
    return mask(nodes_in_set(mesh, name), mesh.n_nodes)[mesh.topology.boundary_faces].all(axis=1)
