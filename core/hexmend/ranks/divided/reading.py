"""Reading of a mesh by all ranks: each reads a slice of the file, and gets its part from the others.

Division of places among ranks by recursive bisection of coordinates (Berger and Bokhari 1987).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from hexmend.arrays import as_immutable_owned
from hexmend.energy.ranks import Ranks
from hexmend.errors import ParameterError
from hexmend.io.base.fixed_marks import find_marks
from hexmend.io.formats.vtk.grid import HEXAHEDRON
from hexmend.io.slices import GridSlice
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import MIRRORED_CORNERS
from hexmend.ranks.divided.checks import (
    NotDivisibleError,
    check_divisible,
    check_nodes,
    left_handed_hexes,
    mean_edge_length,
)
from hexmend.ranks.divided.divided_mesh import Directory, DividedMesh, PieceCells, send_rows
from hexmend.ranks.mpi_ranks import MPIRanks
from hexmend.ranks.rank_part import RankPart, too_many_ranks

if TYPE_CHECKING:
    from mpi4py import MPI


def divide_slices(
    comm: MPI.Comm, piece: GridSlice, field_data: Mapping[str, object], as_is: bool = False
) -> DividedMesh:
    """Make a divided mesh of the slices that all ranks have read; they call it together.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
    piece : GridSlice
        Of this rank.
    field_data : mapping of str to object
        Of the file.
    as_is : bool
        See `hexmend.io.read`.

    Raises
    ------
    NotDivisibleError
        On all ranks, if only the whole mesh tells which nodes stay.
    ParameterError
        On all ranks, if there are more ranks than the mesh can be divided among.
    """
    ranks = MPIRanks(comm, {}, {})
    n_nodes = ranks.greatest(int(piece.node_ids.max(initial=-1))) + 1
    check_divisible(ranks, piece, n_nodes)
    if n_nodes <= np.iinfo(np.int32).max:
        piece = replace(piece, nodes=piece.nodes.astype(np.int32))
    directory = Directory(comm, n_nodes)
    at, (places, *data) = directory.put(piece.node_ids, piece.points, *piece.node_data.values())
    points, *kept = (_by_node(directory, at, rows) for rows in (places, *data))
    check_nodes(ranks, at, places, points)
    node_data = dict(zip(piece.node_data, kept, strict=True))
    del places, data
    first = piece.start[:-1][piece.types == HEXAHEDRON]
    hexes = piece.nodes[first[:, None] + np.arange(8)]
    owner, owners = _owners(ranks, directory, points, hexes)
    unused = owner == comm.size
    owner[unused] = comm.rank
    ids, rows = _hexes_at_owned(comm, piece.cell_ids[piece.types == HEXAHEDRON], hexes, owners)
    idle = ranks.sum(int(not len(ids)))
    if idle:
        n_hexes = ranks.sum(len(hexes))
        raise ParameterError(too_many_ranks(comm.size, n_hexes, idle))
    cells = _piece_cells(comm, directory, piece, owner)
    marks = find_marks(node_data)[1]
    pinned = np.zeros(len(points), bool) if marks is None else marks
    part = _part(directory, ids, rows, points, owner, pinned, as_is)
    return DividedMesh(part, ids, directory, points, node_data, unused, cells, field_data)


def _by_node(directory: Directory, at: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Order rows of nodes that have come to this rank, (k, ...)."""
    ordered = np.zeros((directory.end - directory.begin, *rows.shape[1:]), rows.dtype)
    ordered[at] = rows
    return ordered


def _owners(
    ranks: MPIRanks, directory: Directory, points: np.ndarray, hexes: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Find the owner of each node that this rank keeps, (k,), and of each node of its hexes, (h, 8); int32.

    Hexes are divided by their centroids; the owner of a node is the lowest rank of its hexes, or the number of ranks
    where it has none.
    """
    nodes, which = np.unique(hexes, return_inverse=True)
    which = which.reshape(hexes.shape)
    centroids = np.zeros((len(hexes), 3))
    (places,) = directory.get(nodes, points)
    for corner in which.T:
        centroids += places[corner] / 8
    rank_of_hex = bisect(ranks, centroids, ranks.count)
    lowest = np.full(len(nodes), ranks.count, np.int32)
    for corner in which.T:
        np.minimum.at(lowest, corner, rank_of_hex)
    at, (found,) = directory.put(nodes, lowest)
    owner = np.full(len(points), ranks.count, np.int32)
    np.minimum.at(owner, at, found)
    return owner, directory.get(nodes, owner)[0][which]


def _hexes_at_owned(
    comm: MPI.Comm, ids: np.ndarray, hexes: np.ndarray, owners: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Get all hexes with a node that this rank owns, ascending; returns their numbers and nodes (m, 8)."""
    ordered = np.sort(owners, axis=1)
    other = np.ones(ordered.shape, dtype=bool)
    other[:, 1:] = ordered[:, 1:] != ordered[:, :-1]
    which, column = np.nonzero(other)
    _, (numbers, rows) = send_rows(comm, ordered[which, column], ids[which], hexes[which])
    order = np.argsort(numbers)
    return numbers[order], rows[order]


def _piece_cells(comm: MPI.Comm, directory: Directory, piece: GridSlice, owner: np.ndarray) -> PieceCells:
    """Send each cell to the owner of its first node, which writes it; the nodes of hexes go with the parts."""
    (to,) = directory.get(piece.nodes[piece.start[:-1]], owner)
    widths = np.where(piece.types == HEXAHEDRON, 0, np.diff(piece.start))
    rows = piece.cell_ids, piece.types, widths, *piece.cell_data.values()
    _, (ids, types, lengths, *data) = send_rows(comm, to, *rows)
    _, (nodes,) = send_rows(comm, np.repeat(to, widths), piece.nodes[np.repeat(widths > 0, np.diff(piece.start))])
    order = np.lexsort((ids, types != HEXAHEDRON))
    others = order[np.count_nonzero(types == HEXAHEDRON) :]
    begins, start = np.cumsum(lengths) - lengths, np.concatenate([[0], np.cumsum(lengths[others])])
    of_cells = np.arange(start[-1]) + np.repeat(begins[others] - start[:-1], lengths[others])
    named = {name: values[order] for name, values in zip(piece.cell_data, data, strict=True)}
    return PieceCells(ids[order], types[others], start, nodes[of_cells], named)


def _part(
    directory: Directory,
    ids: np.ndarray,
    rows: np.ndarray,
    points: np.ndarray,
    owner: np.ndarray,
    pinned: np.ndarray,
    as_is: bool,
) -> RankPart:
    """Make the part of this rank: hexes (m,) with nodes (m, 8); the directory keeps points and owners of nodes."""
    comm, numbers = directory.comm, np.unique(rows)
    hexes = np.searchsorted(numbers, rows).astype(np.int32)
    x, of, pins = directory.get(numbers, points, owner, pinned)
    owned = of == comm.rank
    counts, (asked,) = send_rows(comm, of[~owned], numbers[~owned])
    sent = np.split(np.searchsorted(numbers, asked), np.cumsum(counts)[:-1])
    ranks = MPIRanks(
        comm,
        {rank: at for rank, at in enumerate(sent) if at.size},
        {rank: np.flatnonzero(of == rank) for rank in set(of.tolist()) - {comm.rank}},
    )
    counted = owned[hexes[:, 0]]
    if not as_is:
        which = left_handed_hexes(ranks, x, hexes, ids, owned)
        hexes[which] = hexes[which][:, MIRRORED_CORNERS]
    whole = Mesh(as_immutable_owned(x), as_immutable_owned(hexes), pinned=pins)
    if ranks.any(whole.topology.hanging.size > 0):
        raise NotDivisibleError("it has hanging nodes, which move with nodes of several hexes")
    fixed = ranks.complete(whole.fixed.astype(np.uint8)).astype(bool)  # a node's owner has all its hexes
    mesh = Mesh.of_cells(whole.points, whole.hexes, fixed)
    part = RankPart(mesh, ranks, numbers.astype(np.int32), owned, counted, ranks.sum(int(counted.sum())))
    mesh._set(mean_edge_length=mean_edge_length(part, ids))
    return part


#: Halvings of an interval in which a cut is searched.
_HALVINGS = 60


def bisect(ranks: Ranks, places: np.ndarray, count: int) -> np.ndarray:
    """Divide places, distributed over the ranks, into parts of about the same size; all ranks call it together.

    A set of places is cut across its longest extent, into shares for half the parts each, and so is each share.

    Parameters
    ----------
    ranks : Ranks
    places : (k, 3) float64
    count : int
        Number of parts.

    Returns
    -------
    (k,) int32
        Part of each place, from 0.

    Examples
    --------
    >>> from hexmend.energy.ranks import ONE_RANK
    >>> bisect(ONE_RANK, np.array([[0.0, 0, 0], [9, 0, 0], [1, 0, 0], [8, 1, 0]]), 2).tolist()
    [0, 1, 0, 1]
    """
    part = np.zeros(len(places), np.int32)
    waiting = [(np.arange(len(places)), 0, count)]
    while waiting:
        rows, first, parts = waiting.pop()
        if parts == 1:
            part[rows] = first
            continue
        here = places[rows]
        low = [ranks.least(float(x.min(initial=np.inf))) for x in here.T]
        high = [ranks.greatest(float(x.max(initial=-np.inf))) for x in here.T]
        axis, lower = int(np.argmax(np.subtract(high, low))), parts // 2
        wanted = ranks.sum(len(rows)) * lower / parts
        below = here[:, axis] <= _cut(ranks, here[:, axis], low[axis], high[axis], wanted)
        waiting += [(rows[below], first, lower), (rows[~below], first + lower, parts - lower)]
    return part


def _cut(ranks: Ranks, values: np.ndarray, low: float, high: float, wanted: float) -> float:
    """Find a number that about as many values of all ranks as are wanted are not greater than."""
    for _ in range(_HALVINGS):
        middle = low + (high - low) / 2
        if ranks.sum(int(np.count_nonzero(values <= middle))) < wanted:
            low = middle
        else:
            high = middle
    return high
