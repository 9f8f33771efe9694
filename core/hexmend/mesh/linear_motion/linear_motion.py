"""Linear constraints on the displacements of nodes."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from functools import cached_property

import numpy as np

from hexmend.arrays import as_immutable, mask
from hexmend.errors import MeshError
from hexmend.mesh.linear_motion import subspaces
from hexmend.mesh.linear_motion.hanging_nodes import (
    resolved_anchors,
    restrictions_of_anchors,
    rows_without_hanging,
)
from hexmend.mesh.linear_motion.subspaces import TOLERANCE, fixed_spaces, rounded
from hexmend.mesh.topology.components import components
from hexmend.mesh.validation import as_array, as_integers, as_reals

#: Largest error of a projector or rotation that is given.
_MATRIX_ERROR = 1e-6


@dataclass(frozen=True, eq=False)
class LinearMotion:
    """Linear constraints on the displacements of nodes: they move in planes, along lines, or as others do.

    The arrays are brought to a standard form: each node is there once, nodes ascend, the restrictions of a tied or
    hanging node become restrictions of its masters, and chains end at masters that are neither tied nor hanging. Where
    constraints of a node meet, its displacements are those that all of them admit. A hanging node that is tied to one
    that does not hang stays.

    Parameters
    ----------
    nodes : (k,) int32
        Nodes whose directions are restricted.
    projectors : (k, 3, 3) float64
        Orthogonal projectors onto their admissible displacements. Nodes with projector 0 stay.
    tied : (t,) int32
        Nodes that follow another.
    master : (t,) int32
        Node that each of them follows.
    rotations : (t, 3, 3) float64
        The displacement of tied[i] is rotations[i] times that of master[i].
    hanging, anchors : (w,) int32
        Nodes that hang between others, and these: a row for each of them.
    weights : (w,) float64
        The displacement of a hanging node is the sum of those of its anchors times their weights.

    Raises
    ------
    MeshError
        For arrays of other shapes and types, and for matrices that are no projectors or no rotations.

    Examples
    --------
    >>> motion = LinearMotion.in_planes([3, 4], [[0, 0, 1], [1, 1, 0]]).merge(LinearMotion.in_planes([4], [0, 0, 2]))
    >>> motion.nodes.tolist(), motion.ranks.tolist()
    ([3, 4], [2, 1])
    """

    nodes: np.ndarray = field(default_factory=lambda: np.empty(0, np.int32))
    projectors: np.ndarray = field(default_factory=lambda: np.empty((0, 3, 3)))
    tied: np.ndarray = field(default_factory=lambda: np.empty(0, np.int32))
    master: np.ndarray = field(default_factory=lambda: np.empty(0, np.int32))
    rotations: np.ndarray = field(default_factory=lambda: np.empty((0, 3, 3)))
    hanging: np.ndarray = field(default_factory=lambda: np.empty(0, np.int32))
    anchors: np.ndarray = field(default_factory=lambda: np.empty(0, np.int32))
    weights: np.ndarray = field(default_factory=lambda: np.empty(0))

    def __post_init__(self) -> None:
        names = ("nodes", "tied", "master", "hanging", "anchors")
        nodes, tied, master, hanging, anchors = (_as_numbers(getattr(self, name), name) for name in names)
        projectors = _as_matrices(self.projectors, "projectors", nodes.size)
        rotations = _as_matrices(self.rotations, "rotations", tied.size)
        if master.size != tied.size:
            raise MeshError(f"{tied.size} tied nodes have {master.size} masters: expected one for each")
        _check(nodes, "projector", "symmetric with P P = P", projectors @ projectors.transpose(0, 2, 1) - projectors)
        _check(tied, "rotation", "R R^T = 1", rotations @ rotations.transpose(0, 2, 1) - np.eye(3))
        if hanging.size:
            hanging, anchors, weights = resolved_anchors(hanging, anchors, self._weights(hanging.size, anchors.size))
            self._set(hanging=hanging.astype(np.int32), anchors=anchors.astype(np.int32), weights=weights)
            one, other = np.isin(tied, hanging), np.isin(master, hanging)
            stays, alone = np.concatenate([tied[one ^ other], master[one ^ other]]), ~(one | other)
            tied, master, rotations = tied[alone], master[alone], rotations[alone]
            nodes, projectors = np.append(nodes, stays), np.concatenate([projectors, np.zeros((stays.size, 3, 3))])
            nodes, projectors = restrictions_of_anchors(nodes, projectors, hanging, anchors)
        tied, master, rotations, axis_nodes, axes = resolved(tied, master, subspaces.rounded(rotations))
        nodes, projectors = np.concatenate([nodes, axis_nodes]), np.concatenate([projectors, axes])
        row = np.searchsorted(tied, nodes)
        own = np.flatnonzero(tied[np.minimum(row, tied.size - 1)] == nodes) if tied.size else row[:0]
        nodes[own] = master[row[own]]
        projectors[own] = subspaces.rotated(projectors[own], rotations[row[own]].transpose(0, 2, 1))
        nodes, projectors = subspaces.combined(nodes, subspaces.rounded(projectors))
        restricted = subspaces.ranks(projectors) < 3
        self._set(nodes=nodes[restricted].astype(np.int32), projectors=projectors[restricted])
        self._set(tied=tied, master=master, rotations=rotations)

    def _weights(self, *sizes: int) -> np.ndarray:
        """Check the weights of hanging nodes, of as many rows as there are hanging nodes and anchors."""
        weights = as_reals(self.weights, "weights")
        if {*sizes} != {weights.size} or weights.ndim != 1:
            raise MeshError(
                f"weights have shape {weights.shape}: expected ({sizes[0]},), one for each hanging node and anchor"
            )
        return weights

    def _set(self, **values: np.ndarray) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, as_immutable(value))

    def __reduce__(self) -> tuple[object, ...]:
        return LinearMotion, tuple(getattr(self, one.name) for one in fields(self))

    @classmethod
    def in_planes(cls, nodes: np.ndarray, normals: np.ndarray) -> LinearMotion:
        """Restrict nodes to planes through their positions.

        Parameters
        ----------
        nodes : (k,) int
            A node of several planes is there once for each: it moves along a line, or stays.
        normals : (k, 3) or (3,) float
            Normal of the plane of each node, or of all, of any length but 0.

        Returns
        -------
        LinearMotion

        Raises
        ------
        MeshError
            For arrays of another shape or type, and for a normal of length 0.
        """
        nodes = _as_numbers(nodes, "nodes")
        return cls(nodes, subspaces.plane_projectors(_as_vectors(normals, "normals", nodes)))

    @classmethod
    def along_lines(cls, nodes: np.ndarray, directions: np.ndarray) -> LinearMotion:
        """Restrict nodes (k,) to lines through their positions with directions (k, 3) or (3,); see `in_planes`."""
        nodes = _as_numbers(nodes, "nodes")
        return cls(nodes, subspaces.line_projectors(_as_vectors(directions, "directions", nodes)))

    @classmethod
    def keeping(cls, nodes: np.ndarray) -> LinearMotion:
        """Keep nodes (k,) where they are, and with them the nodes that are tied to them."""
        nodes = _as_numbers(nodes, "nodes")
        return cls(nodes, np.zeros((nodes.size, 3, 3)))

    @classmethod
    def tying(cls, tied: np.ndarray, master: np.ndarray, rotation: np.ndarray | None = None) -> LinearMotion:
        """Tie nodes to others, all by one rotation.

        Parameters
        ----------
        tied, master : (t,) int
            A node can be tied to several, to nodes that are tied themselves, and to itself: on the axis of a rotation
            it moves along the axis.
        rotation : (3, 3) float, optional
            Takes the displacement of a master to that of its tied node; none by default, as for translated copies.

        Returns
        -------
        LinearMotion

        Raises
        ------
        MeshError
            For arrays of another shape or type, and for a matrix that is no rotation.
        """
        tied = _as_numbers(tied, "tied")
        matrix = np.eye(3) if rotation is None else _as_matrices([rotation], "rotation", 1)[0]
        return cls(tied=tied, master=master, rotations=np.tile(matrix, (tied.size, 1, 1)))

    @classmethod
    def between(cls, rows: np.ndarray) -> LinearMotion:
        """Let nodes hang at the mean of four others: rows (h, 5) int of a node and of these, as `Topology.hanging`."""
        rows = as_integers(rows, "rows", ("row", "node")).reshape(-1, 5)
        return cls(hanging=rows[:, 0].repeat(4), anchors=rows[:, 1:].ravel(), weights=np.full(4 * len(rows), 0.25))

    def merge(self, other: LinearMotion) -> LinearMotion:
        """Combine the constraints of both; a displacement is admissible if it is so for both.

        A node that hangs in both hangs on its anchors in the first.
        """
        if not other:
            return self
        new = ~np.isin(other.hanging, self.hanging)
        values = {one.name: (getattr(self, one.name), getattr(other, one.name)) for one in fields(self)}
        for name in ("hanging", "anchors", "weights"):
            values[name] = values[name][0], values[name][1][new]
        return LinearMotion(**{name: np.concatenate(both) for name, both in values.items()})

    def without_hanging(self) -> LinearMotion:
        """Return the constraints of the nodes that do not hang."""
        if not self.hanging.size:
            return self
        return LinearMotion(self.nodes, self.projectors, self.tied, self.master, self.rotations)

    def renumbered(self, number: np.ndarray) -> LinearMotion:
        """Return the constraints in other node numbers.

        Parameters
        ----------
        number : (n,) int
            New number of each node, -1 if it is removed. Nodes that followed a removed one follow one of them; for
            those that hang on it, it stays.

        Returns
        -------
        LinearMotion
        """
        stay = number[self.tied] >= 0
        tied, master, rotations = self.tied[stay], self.master[stay], self.rotations[stay]
        # The first node tied to a removed master takes its place; it is then tied to itself.
        orphans, heir = np.unique(master[number[master] < 0], return_inverse=True)
        rows = np.flatnonzero(number[master] < 0)
        first = rows[np.unique(heir, return_index=True)[1]]
        nodes, projectors = self.nodes.copy(), self.projectors.copy()
        for node, row in zip(orphans, first, strict=True):
            own = nodes == node
            nodes[own] = tied[row]
            projectors[own] = subspaces.rotated(projectors[own], rotations[[row]])
        turns, names = rotations[first][heir], tied[first][heir]
        master, rotations = master.copy(), rotations.copy()
        rotations[rows] = rotations[rows] @ turns.transpose(0, 2, 1)
        master[rows] = names
        kept, hangs = number[nodes] >= 0, (number[self.hanging] >= 0) & (number[self.anchors] >= 0)
        hanging, anchors = number[self.hanging[hangs]], number[self.anchors[hangs]]
        ties = number[tied], number[master], rotations
        return LinearMotion(number[nodes[kept]], projectors[kept], *ties, hanging, anchors, self.weights[hangs])

    @cached_property
    def ranks(self) -> np.ndarray:
        """Number of directions in which each of `nodes` may move, (k,) int64: 0 to 2."""
        return subspaces.ranks(self.projectors)

    @cached_property
    def largest_node(self) -> int:
        """The largest node number, -1 if there is none."""
        parts = self.nodes, self.tied, self.master, self.hanging, self.anchors
        return int(max(part.max(initial=-1) for part in parts))

    def roots(self, n: int) -> np.ndarray:
        """Node that each of n nodes moves with: the master of a tied node, else itself; (n,) int64."""
        roots = np.arange(n)
        roots[self.tied] = self.master
        return roots

    def marks(self, n: int) -> np.ndarray:
        """Mark the nodes, of n, that are restricted, tied, followed by others, or hang, (n,) bool."""
        return mask(np.concatenate([self.nodes, self.tied, self.master, self.hanging]), n)

    def leads(self, n: int) -> np.ndarray:
        """Mark the nodes, of n, that neither follow others nor hang, (n,) bool."""
        return ~mask(np.concatenate([self.tied, self.hanging]), n)

    def with_coupled(self, marks: np.ndarray) -> np.ndarray:
        """Return marks of nodes, (n,) bool, to which the nodes are added that move with them, or on which they hang."""
        marks, roots = marks.copy(), self.roots(marks.size)
        marks[self.anchors[marks[self.hanging]]] = True
        marks = mask(roots[marks], marks.size)[roots]
        marks[self.hanging[marks[self.anchors]]] = True
        return marks

    def sums_of_anchors(self, vectors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Hanging nodes, each once, (h,), and the weighted sums of vectors (n, 3) of their anchors, (h, 3)."""
        first = np.flatnonzero(np.diff(self.hanging, prepend=-1))
        return self.hanging[first], np.add.reduceat(self.weights[:, None] * vectors[self.anchors], first, axis=0)

    def independent_rows(self, elements: np.ndarray, n: int) -> np.ndarray:
        """Rows (j, 8) of nodes, of n, that lead: two are together if they move the same cell of `elements` (m, 8)."""
        if self.hanging.size:
            elements = rows_without_hanging(elements, self.hanging, self.anchors)
        return self.roots(n)[elements]

    def __bool__(self) -> bool:
        return self.largest_node >= 0


def _as_numbers(values: object, label: str) -> np.ndarray:
    """Convert node numbers to (k,) int64."""
    array = as_integers(np.atleast_1d(as_array(values, label)), label, ("row",))
    if array.ndim != 1:
        raise MeshError(f"{label} have shape {array.shape}: expected one node number a row")
    if array.size and not 0 <= int(array.min()) <= int(array.max()) < 2**31:
        raise MeshError(f"{label} hold a number outside 0 to 2^31 - 1: expected numbers of nodes")
    return array.astype(np.int64)


def _as_matrices(values: object, label: str, count: int) -> np.ndarray:
    array = as_reals(values, label)
    if array.shape != (count, 3, 3) and array.size + count:
        raise MeshError(f"{label} have shape {array.shape}: expected ({count}, 3, 3), one for each node")
    return array.reshape(count, 3, 3)


def _as_vectors(values: object, label: str, nodes: np.ndarray) -> np.ndarray:
    """Convert vectors, one for each node or one for all, to (k, 3)."""
    array = as_reals(values, label)
    if array.shape not in ((3,), (nodes.size, 3)):
        raise MeshError(f"{label} have shape {array.shape}: expected (3,) or ({nodes.size}, 3)")
    array = np.broadcast_to(array, (nodes.size, 3))
    wrong = np.flatnonzero(~(np.isfinite(array).all(axis=1) & (array != 0).any(axis=1)))
    if wrong.size:
        row = wrong[0]
        raise MeshError(
            f"{label} of node {nodes[row]} are {array[row].tolist()}: expected a finite vector other than 0"
        )
    return array


def _check(nodes: np.ndarray, kind: str, expected: str, error: np.ndarray) -> None:
    """Raise `MeshError` for a matrix with an error (k, 3, 3) beyond rounding, or that is not finite."""
    wrong = np.flatnonzero(~(np.abs(error) < _MATRIX_ERROR).all(axis=(1, 2)))
    if wrong.size:
        raise MeshError(f"the {kind} of node {nodes[wrong[0]]} is none: expected a matrix with {expected}")


def resolved(tied: np.ndarray, master: np.ndarray, rotations: np.ndarray) -> tuple[np.ndarray, ...]:
    """Resolve chains and cycles of ties, as at an edge of a box that is periodic in two directions.

    A node that is tied to itself by a rotation, as on the axis of a wedge, may move along the axis.

    Parameters
    ----------
    tied, master : (t,) int
        A node can be tied several times, to nodes that are tied themselves, and to itself.
    rotations : (t, 3, 3) float64

    Returns
    -------
    tied, master : (t,) int32
        Each tied node once, ascending, and the node that it follows, which is not tied itself: of connected nodes the
        lowest that is not tied, or else the lowest.
    rotations : (t, 3, 3) float64
        The displacement of tied[i] is rotations[i] times that of master[i].
    nodes : (k,) int32
        Masters whose displacement a cycle of ties restricts; one can be there several times.
    projectors : (k, 3, 3) float64
        Projectors onto their admissible displacements.
    """
    nodes, ends = np.unique(np.concatenate([tied, master]), return_inverse=True)
    tied, master = ends[: tied.size], ends[tied.size :]
    # The root of a node is the lowest of its component that is not tied, or else the lowest.
    component = components(nodes.size, np.column_stack([tied, master]))
    order = np.lexsort((np.arange(nodes.size), mask(tied, nodes.size), component))
    _, first = np.unique(component[order], return_index=True)
    root = order[first][component]
    turn = np.tile(np.eye(3), (nodes.size, 1, 1))  # the displacement of a node is `turn` times that of its root
    known = root == np.arange(nodes.size)
    while not known.all():
        down, up = known[master] & ~known[tied], known[tied] & ~known[master]
        turn[tied[down]] = rotations[down] @ turn[master[down]]
        turn[master[up]] = rotations[up].transpose(0, 2, 1) @ turn[tied[up]]
        known[tied[down]] = known[master[up]] = True
    cycle = turn[tied].transpose(0, 2, 1) @ rotations @ turn[master]
    bent = np.flatnonzero((np.abs(cycle - np.eye(3)) > TOLERANCE).any(axis=(1, 2)))
    follows = np.flatnonzero(root != np.arange(nodes.size))
    return (
        nodes[follows].astype(np.int32),
        nodes[root[follows]].astype(np.int32),
        rounded(turn[follows]),
        nodes[root[tied[bent]]].astype(np.int32),
        fixed_spaces(cycle[bent]),
    )
