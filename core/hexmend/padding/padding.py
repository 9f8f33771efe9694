"""Padding: a layer of hexes under the boundary of a mesh, then mended with the boundary as it is.

Mesh with a layer of hexes: points, hexes, sets and data.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from hexmend.boundary.normals import unit_vectors
from hexmend.errors import MeshError, ParameterError
from hexmend.io import read
from hexmend.iteration import Iteration, Result
from hexmend.locking.locked_corners import nodes_without_space
from hexmend.mesh.mesh import Mesh
from hexmend.padding.inserted_layer import Sheet
from hexmend.padding.mid_nodes import padded_mid_nodes
from hexmend.padding.padded_data import Numbering, extended_data, extended_node_data, extended_set, padded_node_set
from hexmend.padding.placement import displacements, neighbours_behind
from hexmend.padding.regions import around_sheet, set_sheet, whole_sheet
from hexmend.padding.sides import padded_cells, padded_side_set
from hexmend.quality import Summary, locked_hexes, measure, summarise
from hexmend.run import smooth
from hexmend.terminal_text import count_phrase

#: Hexes around which `pad` can lay a layer.
AROUND = ("locked", "inverted")
#: Nodes that a message names.
_MAX_NAMED = 5


@dataclass(frozen=True, eq=False)
class Padding:
    """Mesh with a layer of hexes.

    Parameters
    ----------
    mesh : Mesh
        Nodes and hexes of the given mesh keep their numbers; those that are added follow them.
    layer : (k,) int64
        Numbers of the hexes of the layer.
    before, after : Summary
        Quality and counts of the mesh as given, and of this one.
    run : Result or None
        The run that mended the mesh; None if it was not mended.
    settings : mapping of str to str
        Settings of the run that mends the mesh.
    """

    mesh: Mesh
    layer: np.ndarray
    before: Summary
    after: Summary
    run: Result | None = None
    settings: Mapping[str, str] = field(default_factory=dict)

    def mended(self, run: Result) -> Padding:
        """Return the padding with the mesh that a run has mended."""
        return replace(self, mesh=run.mesh.with_element_target(None), after=run.after, run=run)

    @cached_property
    def thickness(self) -> np.ndarray:
        """Distance of the centre of each inner face below the plane of the outer one, (k,) float64."""
        corners = self.mesh.points[self.mesh.hexes[self.layer]]
        outer, inner = corners[:, 4:], corners[:, :4]
        normals = unit_vectors(np.cross(outer[:, 2] - outer[:, 0], outer[:, 3] - outer[:, 1]))
        return np.einsum("ki,ki->k", outer.mean(axis=1) - inner.mean(axis=1), normals)

    @cached_property
    def nodes_without_space(self) -> np.ndarray:
        """Boundary nodes of inverted hexes at which the boundary leaves no space for sound ones."""
        inverted = self.layer[measure(self.mesh.points, self.mesh.hexes[self.layer]).inverted]
        return nodes_without_space(self.mesh, inverted)

    @property
    def message(self) -> str:
        """The layer and what is left inverted, as sentences."""
        left, mean = self.after.inverted, self.thickness.mean()
        layer = f"The layer has {count_phrase(len(self.layer), 'hex', 'hexes')}, of mean thickness {mean:.3g}"
        words = [f"{layer}." if left else f"{layer} and least thickness {self.thickness.min():.3g}."]
        if left:
            words.append(f"{count_phrase(left, 'hex is', 'hexes are')} inverted.")
            if self.run is None:
                words.append("Mend the mesh.")
        nodes = self.nodes_without_space if left and self.run is not None else ()
        if len(nodes):
            named = ", ".join(map(str, nodes[:_MAX_NAMED])) + (", ..." if len(nodes) > _MAX_NAMED else "")
            words.append(
                f"At {count_phrase(len(nodes), 'node')} ({named}) the faces of the boundary leave no space for a sound "
                "hex under each: let the boundary slide there."
            )
        return " ".join(words)


def pad(
    mesh: Mesh | str | os.PathLike[str],
    name: str | None = None,
    around: str | None = None,
    rings: int = 1,
    thickness: float | None = None,
    *,
    mend: bool = True,
    progress: bool | None = None,
    watch: Callable[[Iteration], Any] | None = None,
) -> Padding:
    """Lay a layer of hexes under the boundary of a mesh, and mend it with the boundary fixed.

    Under the layer each hex has at most one face on the boundary: hexes that fixed nodes keep inverted can be mended.
    The faces of the boundary stay exactly as they are; copies of their nodes move into the mesh.

    Parameters
    ----------
    mesh : Mesh or path
        A mesh, which is not changed, or the path of a file.
    name : str, optional
        Set of boundary faces (sides, quads or nodes) or of hexes: only under its faces a layer is laid.
    around : {"locked", "inverted"}, optional
        Lay the layer around hexes that fixed nodes keep inverted, or that are inverted, and not under the whole
        boundary.
    rings : int
        Rings of hexes around these that the layer encloses.
    thickness : float, optional
        Thickness of the layer in the mesh's unit of length, which is kept as far as the shape of the mesh allows. By
        default the layer begins with a third of the edges behind it and takes the shape that is best for the hexes.
    mend : bool
        Mend the mesh by the default method; else hexes may be inverted.
    progress, watch
        As for `hexmend.smooth`.

    Returns
    -------
    Padding

    Raises
    ------
    MeshError, FileError
        For a mesh that cannot be padded or read, a set that does not exist, and a layer that cannot be closed.
    ParameterError
        For a thickness that is not positive, and where both a set and hexes to be enclosed are named.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> padded = pad(make("cube", size=27))
    >>> padded.mesh.n_hexes, len(padded.layer), padded.after.inverted
    (81, 54, 0)
    """
    _check_choices(name, around, rings, thickness)
    mesh = mesh if isinstance(mesh, Mesh) else read(mesh)
    before, padded = summarise(mesh), padded_mesh(_sheet(mesh, name, around, rings), thickness)
    settings: dict[str, Any] = {} if thickness is None else {"target": "given-shape"}
    layer = np.arange(mesh.n_hexes, padded.n_hexes)
    padding = Padding(padded, layer, before, summarise(padded), settings=settings)
    return padding.mended(smooth(padded, progress=progress, watch=watch, **settings)) if mend else padding


def _check_choices(name: str | None, around: str | None, rings: int, thickness: float | None) -> None:
    if thickness is not None and not 0 < thickness < np.inf:
        raise ParameterError(f"thickness is {thickness:g}: expected a positive length in the unit of the mesh")
    if around is not None and around not in AROUND:
        raise ParameterError(f"around is {around!r}: expected {' or '.join(AROUND)}")
    if around is not None and name is not None:
        raise ParameterError(f"a layer is laid under the set {name!r} or around {around} hexes: choose one of them")
    if rings < 0:
        raise ParameterError(f"rings is {rings}: expected 0 or more")


def _sheet(mesh: Mesh, name: str | None, around: str | None, rings: int) -> Sheet:
    """Return the sheet under a set, around hexes, or under the whole boundary."""
    if name is not None:
        return set_sheet(mesh, name)
    if around is None:
        return whole_sheet(mesh)
    quality = measure(mesh.points, mesh.hexes, mesh.mid_nodes)
    chosen = quality.inverted
    if around == "locked":
        chosen = locked_hexes(mesh.points, mesh.hexes, mesh.fixed, chosen)
    if not chosen.any():
        raise MeshError(f"no hex of the mesh is {around}: there are no hexes to pad around")
    return around_sheet(mesh, np.flatnonzero(chosen), rings)


def padded_mesh(sheet: Sheet, thickness: float | None = None) -> Mesh:
    """Return the mesh of a sheet with its new hexes.

    Nodes and hexes keep their numbers; the copies of nodes, further mid-nodes, and the new hexes follow them. A new hex
    has the sets, the material and the data of the hex behind it, and on its outer face the side sets that were there.

    Parameters
    ----------
    sheet : Sheet
    thickness : float, optional
        See `displacements`.

    Returns
    -------
    Mesh
        Without rules of motion; hexes may be inverted.
    """
    mesh, behind = sheet.mesh, sheet.faces[:, 0]
    moves = displacements(sheet, thickness)
    sources, mid_nodes = sheet.originals, None
    if mesh.mid_nodes is not None:
        mid_nodes, more = padded_mid_nodes(sheet)
        sources = np.concatenate([sources, more])
    nodes, share = neighbours_behind(sheet, moves)
    nodes = np.concatenate([nodes, sources[nodes.size :]])
    share = np.concatenate([share, np.zeros(sources.size - share.size)])
    ids = Numbering(mesh.hex_data, *(cells.data for cells in mesh.cells))
    flat = Mesh(
        points=np.concatenate([mesh.points, mesh.points[sources]]),
        hexes=np.concatenate([sheet.inner_hexes, sheet.new_hexes]),
        pinned=None if mesh.pinned is None else np.concatenate([mesh.pinned, np.zeros(sources.size, dtype=bool)]),
        node_data=extended_node_data(mesh.node_data, sources, nodes, share),
        hex_data=extended_data(mesh.hex_data, behind, ids),
        node_sets={name: padded_node_set(sheet, members) for name, members in mesh.node_sets.items()},
        hex_sets={name: extended_set(members, behind, mesh.n_hexes) for name, members in mesh.hex_sets.items()},
        cells=tuple(padded_cells(sheet, cells, mid_nodes, ids) for cells in mesh.cells),
        name=mesh.name,
        side_sets={name: padded_side_set(sheet, sides) for name, sides in mesh.side_sets.items()},
        mid_nodes=mid_nodes,
        field_data=mesh.field_data,
        notes=mesh.notes,
        side_set_types=mesh.side_set_types,
        periodic_pairs=mesh.periodic_pairs,
    )
    points = flat.points.copy()
    points[mesh.n_nodes : mesh.n_nodes + len(moves)] += moves
    return flat.with_points(points)
