"""Terms that are added to the energy of the hexes."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.norm import ObjectiveNorm


class Term(Protocol):
    """Function of the positions of all nodes, which is added to an energy."""

    @property
    def limits_moves(self) -> bool:
        """True if `beyond` may find some nodes."""

    @property
    def total_weight(self) -> float:
        """Value, in hexes, that it may have where all of them are perfect."""

    def value(self, x: np.ndarray, norm: ObjectiveNorm) -> float:
        """Compute the term at positions x (n, 3) in the energy's unit; +inf where they are not allowed."""

    def gradient(self, x: np.ndarray, norm: ObjectiveNorm) -> np.ndarray:
        """Compute its gradient by all nodes, (n, 3)."""

    def assemble(self, x: np.ndarray, norm: ObjectiveNorm, matrix: AssembledHessian) -> None:
        """Add its second derivatives, or a semidefinite part of them, to a matrix."""

    def beyond(self, x: np.ndarray, there: np.ndarray) -> np.ndarray | None:
        """Mark nodes, (n,) bool, that may not move from x (n, 3) to `there` (n, 3); None if all may."""

    def on_part(self, nodes: np.ndarray, moves: np.ndarray, x: np.ndarray) -> Term:
        """Return the term of a part, by the positions of its nodes (j,); `moves` (j,) bool, x (n, 3) those of all."""


class Terms:
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
