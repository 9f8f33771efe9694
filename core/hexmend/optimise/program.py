"""The linear program of a step: nodes that go certain ways, and what depends on their places by linear models."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any

import numpy as np

#: Share of the gain that may be given away so that nodes stay which need not move.
IDLE = 0.05


@dataclass(frozen=True, eq=False)
class Ways:
    """Ways that nodes may go, in the length of the shortest edge at each.

    Parameters
    ----------
    of : (w,)
        Whose, ascending.
    aims : (w, 3)
        The displacement that is asked for: along a tangent where the node slides.
    leads : (w, 3)
        What it comes to once the node is put back: of a faceted surface that is another plane at every side.
    """

    of: np.ndarray
    aims: np.ndarray
    leads: np.ndarray


@dataclass(frozen=True, eq=False)
class Models:
    """Linear models of what depends on the places of four nodes each.

    Parameters
    ----------
    ends : (r, 4)
        The nodes.
    above : (r,)
        How far the value is above its bound.
    slopes : (r, 4, 3)
        Its derivatives by their places.
    rises : (r,)
        1 where the bound is to rise, as the least of the corners is; 0 where it stands.
    """

    ends: np.ndarray
    above: np.ndarray
    slopes: np.ndarray
    rises: np.ndarray

    def and_those(self, other: Models) -> Models:
        """These, and others behind them."""
        pairs = ((getattr(one, field.name) for one in (self, other)) for field in dataclasses.fields(self))
        return Models(*(np.concatenate(list(pair)) for pair in pairs))


def bounds_of(ends: np.ndarray, above: np.ndarray, slopes: np.ndarray) -> Models:
    """Models of what is not to fall below its bound."""
    return Models(ends, above, slopes, np.zeros(len(above)))


def program(nodes: np.ndarray, ways: Ways, models: Models, radius: float, falls: bool) -> tuple[Any, ...]:
    """The linear program of a step, as `scipy.optimize.linprog` takes it: costs, matrix, limits, bounds.

    Unknowns are how far nodes (k,) go each of their ways, up to a radius, and what the least rises by. Those nodes stay
    that need not move: a small price is on each way.
    """
    from scipy.sparse import coo_array

    ends = models.ends
    slot = np.full(int(ends.max(initial=0)) + 1, -1)
    slot[nodes] = np.arange(nodes.size)
    slots = slot[ends]
    row, end = np.nonzero(slots >= 0)
    own = slots[row, end]
    start = np.searchsorted(ways.of, np.arange(nodes.size + 1))
    count = start[own + 1] - start[own]
    pair = np.repeat(np.arange(own.size), count)
    column = np.arange(pair.size) + np.repeat(start[own] - np.cumsum(count) + count, count)
    slopes = np.einsum("ki,ki->k", models.slopes[row[pair], end[pair]], ways.leads[column])
    unknowns, rows = ways.of.size + 1, len(ends)
    entries = np.concatenate([-slopes, models.rises])
    at = np.concatenate([row[pair], np.arange(rows)]), np.concatenate([column, np.full(rows, unknowns - 1)])
    cost = np.full(unknowns, IDLE / max(nodes.size, 1))
    cost[-1] = -1.0
    bounds = np.zeros((unknowns, 2))
    bounds[:, 1] = radius
    bounds[-1] = -2.0 if falls else 0.0, 2.0
    return cost, coo_array((entries, at), shape=(rows, unknowns)).tocsr(), models.above, None, None, bounds
