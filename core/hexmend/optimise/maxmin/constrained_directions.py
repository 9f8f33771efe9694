"""Step directions of nodes with a linear motion: in their planes, along their lines, and with their masters."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import index_of
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.optimise.maxmin.directions import AROUND, StepDirections

#: Directions in the basis of a subspace of 0, 1, 2 or 3 dimensions.
_BY_RANK = (np.empty((0, 3)), AROUND[[0, 4]], AROUND, np.concatenate([np.eye(3), -np.eye(3)]))


def constrained_directions(
    directions: StepDirections, nodes: np.ndarray, size: np.ndarray, motion: LinearMotion
) -> StepDirections:
    """Replace the directions of nodes with a linear motion by those that it admits.

    Parameters
    ----------
    directions : StepDirections
        Of nodes without constraints.
    nodes : (k,) int
        The nodes of the step, ascending, with all nodes that move with them.
    size : (k,) float64
        Length of the shortest edge at each; see `least_of_tied`.
    motion : LinearMotion

    Returns
    -------
    StepDirections
    """
    n = max(int(nodes.max(initial=-1)), motion.largest_node) + 1
    marks, roots, row = motion.marks(n)[nodes], motion.roots(n)[nodes], index_of(nodes, n)
    projectors = np.tile(np.eye(3), (n, 1, 1))
    projectors[motion.nodes] = motion.projectors
    others = ~marks[directions.node_index]
    index, steps = [directions.node_index[others]], [directions.displacements[others]]
    projected = [directions.projected[others]]
    own = np.flatnonzero(marks & (roots == nodes))
    values, vectors = np.linalg.eigh(projectors[nodes[own]])
    rank, bases = np.rint(values.sum(axis=1)).astype(int), vectors[:, :, ::-1]  # admissible directions first
    for dimensions, unit in enumerate(_BY_RANK):
        of = np.flatnonzero(rank == dimensions)
        along = np.einsum("kij,wj->kwi", bases[of], unit) if dimensions < 3 else np.tile(unit, (of.size, 1, 1))
        index.append(np.repeat(own[of], len(unit)))
        steps.append((size[own[of], None, None] * along).reshape(-1, 3))
        projected.append(steps[-1])
    independent = _sorted(np.concatenate(index), np.concatenate(steps), np.concatenate(projected))
    return _with_tied(independent, nodes, row, motion)


def least_of_tied(size: np.ndarray, motion: LinearMotion) -> np.ndarray:
    """Replace a length at each node, (n,), by the least of the nodes that move as one."""
    size = size.copy()
    np.minimum.at(size, motion.master, size[motion.tied])
    size[motion.tied] = size[motion.master]
    return size


def _with_tied(directions: StepDirections, nodes: np.ndarray, row: np.ndarray, motion: LinearMotion) -> StepDirections:
    """Append the directions of tied nodes, with the unknowns of their masters."""
    tied = np.flatnonzero((row[motion.tied] >= 0) & (row[motion.master] >= 0))
    master = row[motion.master[tied]]
    first = np.searchsorted(directions.node_index, np.arange(nodes.size + 1))
    count = first[master + 1] - first[master]
    unknown = np.arange(count.sum()) + np.repeat(first[master] - np.cumsum(count) + count, count)
    turned = np.einsum(
        "kij,kj->ki", np.repeat(motion.rotations[tied], count, axis=0), directions.displacements[unknown]
    )
    return _sorted(
        np.concatenate([directions.node_index, np.repeat(row[motion.tied[tied]], count)]),
        np.concatenate([directions.displacements, turned]),
        np.concatenate([directions.projected, turned]),
        np.concatenate([np.arange(directions.node_index.size), unknown]),
    )


def _sorted(
    index: np.ndarray, displacements: np.ndarray, projected: np.ndarray, unknown: np.ndarray | None = None
) -> StepDirections:
    order = np.argsort(index, kind="stable")
    unknown = None if unknown is None else unknown[order]
    return StepDirections(index[order], displacements[order], projected[order], unknown)
