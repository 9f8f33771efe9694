"""Terms that are added to the energy of the hexes.

Addition of second derivatives of some elements, quads or hexes, to assembled Hessians.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from hexmend.arrays import index_of
from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.norm import ObjectiveNorm
from hexmend.energy.sparsity import BlockSparsity

#: Places of xx xy xz yy yz zz in a matrix of 3 rows.
UPPER = [0, 1, 2, 4, 5, 8]


class ElementBlocks:
    """Places of pairs of an element's nodes in assembled Hessians; they are found once for each sparsity pattern.

    Parameters
    ----------
    elements : (f, w) int32
        Nodes of each element.
    """

    def __init__(self, elements: np.ndarray):
        self._elements, self._known = elements, None

    def add(self, pairs: np.ndarray, matrix: AssembledHessian) -> None:
        """Add second derivatives by pairs of nodes of each element, (f, w, w, 3, 3), to a matrix."""
        own, corner, slot, element, row, column, block = self._of(matrix.sparsity)
        diagonal = pairs[own, corner, corner].reshape(-1, 9)[:, UPPER]
        np.add.at(matrix.diagonal, slot, diagonal.astype(matrix.diagonal.dtype))
        above = pairs[element, row, column].reshape(-1, 9)
        np.add.at(matrix.off_diagonal, block, above.astype(matrix.dtype))

    def _of(self, sparsity: BlockSparsity) -> tuple[np.ndarray, ...]:
        """Find the places in matrices of a sparsity pattern.

        Returns
        -------
        element, corner, slot : (d,) int
            Corners with a free node, and its slot.
        element, row, column, block : (b,) int
            Pairs of corners with free nodes, and the block above the diagonal to which their second derivatives belong:
            that of the corner `row` comes first.
        """
        known = self._known
        if known is not None and known[0] is sparsity:
            return known[1]
        width = self._elements.shape[1]
        slots = index_of(sparsity.nodes, int(max(sparsity.nodes.max(initial=-1), self._elements.max(initial=-1))) + 1)
        slots = slots[self._elements].astype(np.int64)
        count = sparsity.nodes.size
        rows = np.repeat(np.arange(len(sparsity.row_start) - 1, dtype=np.int64), np.diff(sparsity.row_start))
        keys = rows * count + sparsity.columns  # ascending
        row, column = (corner.ravel() for corner in np.indices((width, width)))
        first, second = slots[:, row], slots[:, column]
        element, pair = np.nonzero((first >= 0) & (first < second))
        block = np.searchsorted(keys, first[element, pair] * count + second[element, pair])
        free = np.nonzero(slots >= 0)
        places = (*free, slots[free], element, row[pair], column[pair], block)
        self._known = sparsity, places
        return places


class Term(ABC):
    """Function of the positions of all nodes, which is added to an energy."""

    @property
    def limits_moves(self) -> bool:
        """True if `beyond` may find some nodes."""
        return False

    @property
    def total_weight(self) -> float:
        """Value, in hexes, that it may have where all of them are perfect."""
        return 0.0

    @abstractmethod
    def value(self, x: np.ndarray, norm: ObjectiveNorm) -> float:
        """Compute the term at positions x (n, 3) in the energy's unit; +inf where they are not allowed."""

    @abstractmethod
    def gradient(self, x: np.ndarray, norm: ObjectiveNorm) -> np.ndarray:
        """Compute its gradient by all nodes, (n, 3)."""

    @abstractmethod
    def assemble(self, x: np.ndarray, norm: ObjectiveNorm, matrix: AssembledHessian) -> None:
        """Add its second derivatives, or a semidefinite part of them, to a matrix."""

    def beyond(self, x: np.ndarray, there: np.ndarray) -> np.ndarray | None:
        """Mark nodes, (n,) bool, that may not move from x (n, 3) to `there` (n, 3); None if all may."""
        return None

    def on_part(self, nodes: np.ndarray, moves: np.ndarray, x: np.ndarray) -> Term:
        """Return the term of a part, by the positions of its nodes (j,); `moves` (j,) bool, x (n, 3) those of all.

        Raises
        ------
        NotImplementedError
            For a term that is made for what moves.
        """
        raise NotImplementedError


class Terms(Term):
    """Sum of terms."""

    def __init__(self, *terms: Term):
        self._terms = terms

    @property
    def limits_moves(self) -> bool:
        """See `Term`."""
        return any(term.limits_moves for term in self._terms)

    @property
    def total_weight(self) -> float:
        """See `Term`."""
        return sum(term.total_weight for term in self._terms)

    def value(self, x: np.ndarray, norm: ObjectiveNorm) -> float:
        """See `Term`."""
        return sum(term.value(x, norm) for term in self._terms)

    def gradient(self, x: np.ndarray, norm: ObjectiveNorm) -> np.ndarray:
        """See `Term`."""
        return np.sum([term.gradient(x, norm) for term in self._terms], axis=0)

    def assemble(self, x: np.ndarray, norm: ObjectiveNorm, matrix: AssembledHessian) -> None:
        """See `Term`."""
        for term in self._terms:
            term.assemble(x, norm, matrix)

    def beyond(self, x: np.ndarray, there: np.ndarray) -> np.ndarray | None:
        """See `Term`."""
        marks = [found for term in self._terms if (found := term.beyond(x, there)) is not None]
        return np.logical_or.reduce(marks) if marks else None

    def on_part(self, nodes: np.ndarray, moves: np.ndarray, x: np.ndarray) -> Terms:
        """See `Term`."""
        return Terms(*(term.on_part(nodes, moves, x) for term in self._terms))
