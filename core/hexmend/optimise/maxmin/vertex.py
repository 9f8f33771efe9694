"""Vertex at which a linear program ended: the next one begins there, as the two share most unknowns and models.

A step later the same corners are low and the same nodes move, so that few steps of the simplex lead from one vertex to
the next.
"""

from __future__ import annotations

import numpy as np

from hexmend.optimise.maxmin.directions import StepDirections

#: Most directions of a node.
_DIRECTIONS = 16
#: Weights by which the four nodes of a model are added up to its name.
_NODE_WEIGHTS = np.array([1_000_003, 10_007, 101, 1])
_NONE = np.empty(0, dtype=np.int64)


class Vertex:
    """Unknowns and models that were at their bounds when the last program was solved, by names that programs share.

    Where two models have one name, the program only takes more steps.
    """

    def __init__(self) -> None:
        self._unknowns, self._rows = _Table(), _Table()

    @property
    def is_known(self) -> bool:
        """A program was solved."""
        return self._unknowns.names.size > 0

    def unknowns(self, names: np.ndarray) -> np.ndarray:
        """Return for unknowns with names (u,) 0 at the lower bound, 1 at none, 2 at the upper one; 0 for new ones."""
        return self._unknowns.values_of(names)

    def rows(self, names: np.ndarray) -> np.ndarray:
        """Mark the models with names (r,) that were at their limits, (r,) bool; new ones are not."""
        return self._rows.values_of(names) > 0

    def remember(self, names: np.ndarray, at: np.ndarray, row_names: np.ndarray, at_limit: np.ndarray) -> None:
        """Replace what is known by unknowns (u,) and models (r,), with values as `unknowns` and `rows` return them."""
        self._unknowns, self._rows = _Table(names, at), _Table(row_names, at_limit.astype(np.int64))


class _Table:
    """Values (k,) int by names (k,) int64; 0 for all other names."""

    def __init__(self, names: np.ndarray = _NONE, values: np.ndarray = _NONE):
        order = np.argsort(names, kind="stable")
        self.names, self._values = names[order], values[order]

    def values_of(self, names: np.ndarray) -> np.ndarray:
        if not self.names.size:
            return np.zeros(names.size, dtype=np.int64)
        at = np.searchsorted(self.names, names)
        at[at == self.names.size] = 0
        return np.where(self.names[at] == names, self._values[at], 0)


def names_of_unknowns(nodes: np.ndarray, directions: StepDirections) -> np.ndarray:
    """Names of the unknowns of a step of nodes (k,), (u,) int64: lengths in directions, and the gain, which is last."""
    first = np.searchsorted(directions.node_index, np.arange(nodes.size + 1))
    number = np.arange(directions.node_index.size) - first[directions.node_index]
    names = np.full(directions.n_unknowns + 1, -1, dtype=np.int64)
    names[directions.columns] = nodes[directions.node_index].astype(np.int64) * _DIRECTIONS + number
    return names


def names_of_models(nodes: np.ndarray, has_gain: np.ndarray) -> np.ndarray:
    """Names of models of four nodes each, (r, 4), of which some have a gain, (r,): (r,) int64."""
    return 2 * (nodes.astype(np.int64) @ _NODE_WEIGHTS) + has_gain.astype(np.int64)
