"""Part of a mesh that one rank holds: the nodes that it owns, all hexes at them, and the other nodes of these hexes.

Boundary nodes of a divided mesh that slide: every rank knows the positions of the whole boundary.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import pymetis

from hexmend.arrays import index_of, mask
from hexmend.boundary.sliding import SlidingBoundary, SlidingNodes
from hexmend.energy import Motion
from hexmend.errors import ParameterError
from hexmend.mesh.element_target import Target
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.components import any_of_rows
from hexmend.ranks.mpi_ranks import MPIRanks

if TYPE_CHECKING:
    from mpi4py import MPI


@dataclass(frozen=True, eq=False)
class RankPart:
    """Part of a mesh.

    Hexes and nodes keep the order that they have in the whole mesh, so that sums at a node have the same order too.

    Parameters
    ----------
    mesh : Mesh
        Hexes at nodes that this rank owns, with the free nodes and the mean edge length of the whole mesh.
    ranks : MPIRanks
    nodes : (n,) int32
        Numbers of its nodes in the whole mesh.
    owned : (n,) bool
        Nodes that this rank moves.
    counted : (m,) bool
        Hexes that this rank counts; each is counted by one.
    n_hexes : int
        Number of hexes of the whole mesh.
    """

    mesh: Mesh
    ranks: MPIRanks
    nodes: np.ndarray
    owned: np.ndarray
    counted: np.ndarray
    n_hexes: int

    @cached_property
    def motion(self) -> Motion:
        """Motion of the free nodes that this rank owns."""
        return Motion(self.mesh, owned=self.owned, ranks=self.ranks)


def divide(mesh: Mesh, count: int) -> np.ndarray:
    """Divide hexes among ranks so that few faces lie between them; returns the rank of each, (m,) int32."""
    if count == 1:
        return np.zeros(mesh.n_elements, np.int32)
    neighbours = mesh.topology.face_neighbours
    others = (neighbours >= 0) & (neighbours != np.arange(len(neighbours))[:, None])
    start = np.concatenate([[0], np.cumsum(others.sum(axis=1))]).astype(np.int32)
    _, ranks = pymetis.part_graph(count, adjacency=pymetis.CSRAdjacency(start, neighbours[others]))
    return np.asarray(ranks, dtype=np.int32)


def owners_of_nodes(mesh: Mesh, rank_of_hex: np.ndarray) -> np.ndarray:
    """Return the rank that owns each node, (n,) int32: the lowest rank of its hexes (m,), or 0 without hexes."""
    owner = np.zeros(mesh.n_nodes, np.int32)
    for rank in range(int(rank_of_hex.max(initial=0)), -1, -1):
        owner[mesh.elements[rank_of_hex == rank].ravel()] = rank
    return owner


def arrays_of_parts(mesh: Mesh, owner: np.ndarray, count: int) -> Iterator[dict[str, np.ndarray | float]]:
    """Yield the arrays from which each rank makes its part; `owner` (n,) int32 is the rank of each node."""
    lists = [_nodes_of(mesh, owner == rank) for rank in range(count)]
    for rank, (hexes, nodes) in enumerate(lists):
        of = owner[nodes]
        rows: dict[str, np.ndarray | float] = {
            "points": mesh.points[nodes],
            "hexes": index_of(nodes, mesh.n_nodes)[mesh.elements[hexes]],
            "nodes": nodes,
            "fixed": mesh.fixed[nodes],
            "owned": of == rank,
            "counted": owner[mesh.elements[hexes, 0]] == rank,
            "sizes": np.array([mesh.mean_edge_length, mesh.n_elements]),
        }
        for other, (_, theirs) in enumerate(lists):
            if other == rank:
                continue
            rows[f"received {other}"] = np.flatnonzero(of == other)
            wanted = theirs[owner[theirs] == rank]
            rows[f"sent {other}"] = np.searchsorted(nodes, wanted)
        if mesh.element_target is not None:
            rows["lengths"] = mesh.element_target.lengths[hexes]
            rows["size_weight"] = np.array([mesh.element_target.size_weight])
        yield rows


def _nodes_of(mesh: Mesh, owned: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the hexes at some nodes (n,) bool, and all nodes of these hexes."""
    hexes = np.flatnonzero(any_of_rows(owned, mesh.elements))
    return hexes, np.flatnonzero(mask(mesh.elements[hexes], mesh.n_nodes)).astype(np.int32)


def make_part(comm: MPI.Comm, rows: dict[str, np.ndarray]) -> RankPart:
    """Make the part of this rank from the arrays of `arrays_of_parts`."""

    def lists(word: str) -> dict[int, np.ndarray]:
        found = {int(name.split()[1]): at for name, at in rows.items() if name.split()[0] == word}
        return {rank: at for rank, at in found.items() if at.size}

    length, n_hexes = rows["sizes"]
    mesh = Mesh.of_cells(rows["points"], rows["hexes"], rows["fixed"])
    if "lengths" in rows:
        mesh = mesh.with_element_target(Target(rows["lengths"], float(rows["size_weight"][0])))
    mesh._set(mean_edge_length=float(length))
    ranks = MPIRanks(comm, lists("sent"), lists("received"))
    return RankPart(mesh, ranks, rows["nodes"], rows["owned"], rows["counted"], int(n_hexes))


def distribute(comm: MPI.Comm, mesh: Mesh | None) -> RankPart:
    """Divide the mesh of rank 0 among all ranks; the others give None."""
    if mesh is None:
        return make_part(comm, _receive(comm))
    owner, own = owners_of_nodes(mesh, divide(mesh, comm.size)), None
    idle = comm.size - np.unique(owner[mesh.elements]).size
    if idle:
        raise ParameterError(too_many_ranks(comm.size, mesh.n_elements, idle))
    for rank, rows in enumerate(arrays_of_parts(mesh, owner, comm.size)):
        if rank == 0:
            own = rows
        else:
            _send(comm, rows, rank)
    return make_part(comm, own)


def too_many_ranks(count: int, n_hexes: int, idle: int) -> str:
    """Return the message for more ranks than have work."""
    return f"{count} ranks are too many for {n_hexes:,} hexes: {idle} of them would own no node. Use fewer."


def _send(comm: MPI.Comm, rows: dict[str, np.ndarray], rank: int) -> None:
    comm.send([(name, array.shape, array.dtype.str) for name, array in rows.items()], dest=rank)
    for array in rows.values():
        comm.Send(np.ascontiguousarray(array), dest=rank)


def _receive(comm: MPI.Comm) -> dict[str, np.ndarray]:
    rows = {}
    for name, shape, kind in comm.recv(source=0):
        rows[name] = np.empty(shape, kind)
        comm.Recv(rows[name], source=0)
    return rows


class RankSliding:
    """Sliding nodes of a part; whether a move harms the boundary is judged for the whole boundary by each rank.

    All ranks call `rejected` together. The boundary is small: a mesh of ten million hexes has 280,000 faces there.

    Parameters
    ----------
    whole : SlidingNodes
        Of the nodes of the whole boundary alone; see `SlidingNodes.on_boundary`.
    numbers : (b,) int64
        Numbers of these nodes in the whole mesh, ascending.
    part : RankPart
        Part of the mesh with the boundary fixed.

    Attributes
    ----------
    mesh : Mesh
        The mesh of the part with the sliding nodes free.
    nodes : (k,) int64
        Sliding nodes of the part that this rank owns, ascending.
    motion : Motion
        Of the part; nodes on flat patches and straight curves are projected as others are.
    """

    def __init__(self, whole: SlidingNodes, numbers: np.ndarray, part: RankPart):
        self.whole, mesh, ranks = whole, part.mesh, part.ranks
        place = np.minimum(np.searchsorted(part.nodes, numbers), part.nodes.size - 1)
        self._in_part = np.where(part.nodes[place] == numbers, place, -1)  # of each node of the boundary
        here = np.flatnonzero(self._in_part >= 0)
        self._on_boundary = np.full(mesh.n_nodes, -1, dtype=np.int64)
        self._on_boundary[self._in_part[here]] = here
        slides = np.zeros(mesh.n_nodes, dtype=bool)
        moving = self._in_part[whole.nodes]
        slides[moving[moving >= 0]] = True
        self.nodes = np.flatnonzero(slides & part.owned)
        free = mesh.with_free(slides)
        free._set(mean_edge_length=mesh.mean_edge_length)
        self.mesh = free
        self._ranks = ranks
        self._own = here[part.owned[self._in_part[here]]]
        self._all = ranks.gather(self._own)
        sliding = np.concatenate([self.nodes, np.flatnonzero(slides & ~part.owned)])
        self.motion = Motion(free, self, sliding, part.owned, ranks)

    def with_points(self, points: np.ndarray) -> Mesh:
        """Return `mesh` with other points (n, 3) and the mean edge length of the whole mesh."""
        moved = self.mesh.with_points(points)
        moved._set(mean_edge_length=self.mesh.mean_edge_length)
        return moved

    def project(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """See `SlidingNodes.project`."""
        return self.whole.project(x, self._on_boundary[nodes])

    def tangent_bases(self, x: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """See `SlidingNodes.tangent_bases`."""
        return self.whole.tangent_bases(x, self._on_boundary[nodes])

    def rejected(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray | None:
        """Mark nodes of the part whose moves harm the boundary, (n,) bool; None if no rank has any.

        Parameters
        ----------
        before, after : (n, 3) float64
            Positions of the nodes of the part, in the mesh's unit.
        changed : (n,) bool, optional
            See `SlidingNodes.rejected_nodes`.
        """
        before, after = self._of_boundary(before), self._of_boundary(after)
        changed = None if changed is None else self._of_boundary(changed)
        marks = self.whole.rejected(before, after, changed)
        return None if marks is None else (self._on_boundary >= 0) & marks[self._on_boundary]

    def _of_boundary(self, rows: np.ndarray) -> np.ndarray:
        """Gather an array with a row for each node of the part, as one with a row for each node of the boundary."""
        gathered = np.empty((self._in_part.size, *rows.shape[1:]), rows.dtype)
        gathered[self._all] = self._ranks.gather(rows[self._in_part[self._own]])
        return gathered


def distribute_sliding(part: RankPart, sliding: SlidingBoundary | None) -> RankSliding:
    """Give all ranks the sliding nodes of the whole mesh that rank 0 has; the others give None."""
    whole, numbers = part.ranks.comm.bcast(None if sliding is None else sliding.on_boundary())
    return RankSliding(whole, numbers, part)
