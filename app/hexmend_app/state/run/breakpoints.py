"""Break-points: events at which a run pauses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hexmend.iteration import Iteration
from hexmend.terminal_text import count_phrase


@dataclass(frozen=True)
class BreakpointHit:
    """A break-point that was reached.

    Parameters
    ----------
    sentence : str
        Description of the event.
    hexes, nodes : tuple of int
        Hexes and nodes concerned; may be empty.
    """

    sentence: str
    hexes: tuple[int, ...] = ()
    nodes: tuple[int, ...] = ()


@dataclass(frozen=True)
class Breakpoints:
    """Events at which a run pauses; none by default.

    Parameters
    ----------
    inverts : bool
        Pause when a hex becomes inverted.
    q_min_falls : bool
        Pause when the least quality falls.
    node, move : int or None, float
        Pause when this node moves further than `move` mean edge lengths in an iteration.
    hex, change : int or None, float
        Pause when the quality of this hex changes by more than `change` in an iteration.
    backtracks : int or None
        Pause when the line search shortens the step more often than this. Methods with a line search for each node do
        not report it.
    """

    inverts: bool = False
    q_min_falls: bool = False
    node: int | None = None
    move: float = 0.1
    hex: int | None = None
    change: float = 0.1
    backtracks: int | None = None

    @property
    def any(self) -> bool:
        """True if any event is set."""
        return self.inverts or self.q_min_falls or {self.node, self.hex, self.backtracks} != {None}

    def hit(self, before: Iteration, now: Iteration, unit: float) -> BreakpointHit | None:
        """Return the first break-point that an iteration reaches, in the order of the fields, or None.

        Parameters
        ----------
        before, now : Iteration
            Two consecutive iterations of a run.
        unit : float
            Mean edge length of the mesh.
        """
        return next(self._hits(before, now, unit), None)

    def _hits(self, before: Iteration, now: Iteration, unit: float) -> Iterator[BreakpointHit]:
        was, q = before.quality.q, now.quality.q
        inverted = np.flatnonzero(now.quality.inverted & ~before.quality.inverted)
        if self.inverts and inverted.size:
            more = f" and {inverted.size - 1:,} more" if inverted.size > 1 else ""
            yield BreakpointHit(f"Hex {inverted[0]}{more} inverted", tuple(inverted.tolist()))
        if self.q_min_falls and q.min() < was.min():
            worst = int(q.argmin())
            yield BreakpointHit(f"q min fell from {was.min():.4f} to {q[worst]:.4f}, at hex {worst}", (worst,))
        if self.node is not None:
            move = float(np.linalg.norm(now.points[self.node] - before.points[self.node])) / unit
            if move > self.move:
                yield BreakpointHit(f"Node {self.node} moved by {move:.3g} mean edge lengths", nodes=(self.node,))
        if self.hex is not None and abs(float(q[self.hex]) - float(was[self.hex])) > self.change:
            yield BreakpointHit(f"q of hex {self.hex} went from {was[self.hex]:.4f} to {q[self.hex]:.4f}", (self.hex,))
        count = now.diagnostics.get("backtracks", 0)
        if self.backtracks is not None and count > self.backtracks:
            length = now.diagnostics.get("step_length", 0.0)
            yield BreakpointHit(f"The line search shortened the step {count_phrase(count, 'time')}, to {length:.3g}")
