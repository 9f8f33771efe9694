"""Break-points: events at which a run pauses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from hexmend.iteration import Iteration
from hexmend.parameters import Parameter, Parametrised, declared, parameter
from hexmend.terminal_text import count_phrase

#: Value of a breakpoint that is not set.
NONE = "none"


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
class Breakpoints(Parametrised):
    """Events at which a run pauses; none by default."""

    inverts: bool = parameter(
        False, label="A hex inverts", help="Pause after an iteration that inverts a valid hex, and select that hex."
    )
    q_min_falls: bool = parameter(
        False,
        label="Minimum q drops",
        help="Pause after an iteration that lowers the minimum quality, and select the worst hex.",
    )
    node: int = parameter(
        NONE,
        low=0,
        label="Node no.",
        help="Pause when the node with this number moves further than the limit below in one iteration.",
        automatic=NONE,
    )
    move: float = parameter(
        0.1, low=0, high=9.999, label="Move above", unit="edges", help="Limit of the move, in mean edge lengths."
    )
    hex: int = parameter(
        NONE,
        low=0,
        label="Hex no.",
        help="Pause when q(H) of the hex with this number changes by more than the limit below in one iteration.",
        automatic=NONE,
    )
    change: float = parameter(0.1, low=0, high=9.999, label="Change of q above", help="Limit of the change of q(H).")
    backtracks: int = parameter(
        NONE,
        low=0,
        high=99,
        label="Backtracks above",
        help="Pause when the line search (Algorithm A.5) shortens the step more often than this. Not available for "
        "methods that search node by node.",
        automatic=NONE,
    )

    @classmethod
    def numbered(cls, hexes: int, nodes: int) -> list[Parameter]:
        """Return the declarations for a mesh of this many hexes and nodes."""
        highest = {"hex": hexes - 1, "node": nodes - 1}
        return [replace(one, high=highest.get(one.name, one.high)) for one in declared(cls)]

    @property
    def any(self) -> bool:
        """True if any event is set."""
        return self.inverts or self.q_min_falls or {self.node, self.hex, self.backtracks} != {NONE}

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
        if self.node != NONE:
            move = float(np.linalg.norm(now.points[self.node] - before.points[self.node])) / unit
            if move > self.move:
                yield BreakpointHit(f"Node {self.node} moved by {move:.3g} mean edge lengths", nodes=(self.node,))
        if self.hex != NONE and abs(float(q[self.hex]) - float(was[self.hex])) > self.change:
            yield BreakpointHit(f"q of hex {self.hex} went from {was[self.hex]:.4f} to {q[self.hex]:.4f}", (self.hex,))
        count = now.diagnostics.get("backtracks", 0)
        if self.backtracks != NONE and count > self.backtracks:
            length = now.diagnostics.get("step_length", 0.0)
            yield BreakpointHit(f"The line search shortened the step {count_phrase(count, 'time')}, to {length:.3g}")
