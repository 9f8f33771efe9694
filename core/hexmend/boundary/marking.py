"""Marks of boundary edges as curves, which sliding keeps: line cells with the data "medit:ridge"."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from hexmend.boundary.edges import SurfaceEdges, edge_keys
from hexmend.errors import MeshError
from hexmend.mesh.cells import Cells
from hexmend.mesh.fields import as_set
from hexmend.mesh.mesh import Mesh

#: Data of line cells that mark edges, as files of Medit have them.
RIDGE, REQUIRED = "medit:ridge", "medit:required"


def marked_segments(mesh: Mesh) -> np.ndarray:
    """Return the edges that line cells mark as ridges or required, (e, 2) int, each once, the lower node first."""
    found = [np.empty((0, 2), np.int64)]
    for cells in mesh.cells:
        if cells.kind == "line":
            found.append(np.sort(cells.nodes[_marks_of(cells)], axis=1))
    return np.unique(np.concatenate(found), axis=0)


def with_curve(mesh: Mesh, nodes: Sequence[int] | np.ndarray) -> Mesh:
    """Return the mesh with the edges of a chain marked as a curve, which is kept when the boundary slides.

    Files of Medit, VTK and sessions store the marks.

    Parameters
    ----------
    mesh : Mesh
    nodes : (k,) int
        Nodes of the chain in order; successive ones are joined by an edge of the boundary.

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        For a node that does not exist, and for nodes that no edge of the boundary joins.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = with_curve(make("cube", size=27), (0, 1, 2))
    >>> marked_segments(mesh).tolist(), len(marked_segments(without_curves(mesh, (0, 1))))
    ([[0, 1], [1, 2]], 1)
    """
    edges = _edges_of(mesh, nodes)
    keys = edge_keys(edges, mesh.n_nodes)
    boundary = SurfaceEdges(mesh.topology.boundary_faces, mesh.n_nodes)
    outside = np.flatnonzero(~np.isin(keys, boundary.key))
    if len(outside):
        one, other = edges[outside[0]].tolist()
        raise MeshError(
            f"no edge of the boundary joins the nodes {one} and {other} (counted from 0): expected a chain of edges"
        )
    known = edge_keys(marked_segments(mesh), mesh.n_nodes)
    new = edges[np.unique(keys, return_index=True)[1]]
    new = new[~np.isin(edge_keys(new, mesh.n_nodes), known)]
    if not len(new):
        return mesh
    marks = Cells("line", new.astype(np.int32), {RIDGE: np.ones(len(new), dtype=np.int64)})
    return mesh.replace(cells=_joined(mesh.cells, marks))


def without_curves(mesh: Mesh, nodes: Sequence[int] | np.ndarray | None = None) -> Mesh:
    """Return the mesh without the marks of some edges.

    Parameters
    ----------
    mesh : Mesh
    nodes : (k,) int, optional
        Nodes of a chain, as of `with_curve`; all marks are removed by default.

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        For a node that does not exist.
    """
    keys = None if nodes is None else edge_keys(_edges_of(mesh, nodes), mesh.n_nodes)
    return mesh.replace(cells=tuple(_unmarked(mesh.cells, keys, mesh.n_nodes)))


def _edges_of(mesh: Mesh, nodes: Sequence[int] | np.ndarray) -> np.ndarray:
    """Return the edges between successive nodes of a chain, (k - 1, 2) int64."""
    nodes = as_set(nodes, "chain of nodes", mesh.n_nodes)
    return np.stack([nodes[:-1], nodes[1:]], axis=1)


def _marks_of(cells: Cells) -> np.ndarray:
    """Return True for cells that are marked, (k,) bool."""
    marks = np.zeros(len(cells.nodes), dtype=bool)
    for name in (RIDGE, REQUIRED):
        if name in cells.data:
            marks |= np.asarray(cells.data[name]) != 0
    return marks


def _joined(cells: Sequence[Cells], marks: Cells) -> tuple[Cells, ...]:
    """Return cells with new marks, in one block with the marks of earlier calls."""
    for at, one in enumerate(cells):
        if _only_marks(one):
            nodes = np.concatenate([one.nodes, marks.nodes])
            both = Cells("line", nodes, {RIDGE: np.concatenate([one.data[RIDGE], marks.data[RIDGE]])})
            return (*cells[:at], both, *cells[at + 1 :])
    return (*cells, marks)


def _only_marks(cells: Cells) -> bool:
    """Return True for lines that have marks and nothing else."""
    return cells.kind == "line" and set(cells.data) == {RIDGE} and not cells.sets


def _unmarked(cells: Iterable[Cells], keys: np.ndarray | None, n: int) -> Iterable[Cells]:
    """Yield cells without the marks of the edges with these keys, or of all; lines that are marks alone disappear."""
    for one in cells:
        removed = _marks_of(one) if one.kind == "line" else np.zeros(0, dtype=bool)
        if keys is not None and removed.any():
            removed &= np.isin(edge_keys(one.nodes, n), keys)
        if not removed.any():
            yield one
        elif _only_marks(one):
            if not removed.all():
                yield Cells("line", one.nodes[~removed], {RIDGE: np.asarray(one.data[RIDGE])[~removed]})
        else:
            names = one.data.keys() & {RIDGE, REQUIRED}
            changed = {name: np.where(removed, 0, np.asarray(one.data[name])) for name in names}
            yield Cells(one.kind, one.nodes, {**one.data, **changed}, one.sets)
