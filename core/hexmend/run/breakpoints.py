"""Break-points: events at which a run pauses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.iteration import Iteration


@dataclass(frozen=True)
class Hit:
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
    cuts : int or None
        Pause when the line search shortens the step more often than this. Methods with a line search for each node do
        not report it.
    """

    inverts: bool = False
    q_min_falls: bool = False
    node: int | None = None
    move: float = 0.1
    hex: int | None = None
    change: float = 0.1
    cuts: int | None = None

    @property
    def any(self) -> bool:
        """True if any event is set."""
        watched = (self.node, self.hex, self.cuts)
        return self.inverts or self.q_min_falls or any(one is not None for one in watched)

    def hit(self, before: Iteration, now: Iteration, unit: float) -> Hit | None:
        """Return the first break-point that an iteration reaches, in the order of the fields, or None.

        Parameters
        ----------
        before, now : Iteration
            Two consecutive iterations of a run.
        unit : float
            Mean edge length of the mesh.
        """
        hits = (
            self._inverted(before, now),
            self._fell(before, now),
            self._moved(before, now, unit),
            self._changed(before, now),
            self._cut(now),
        )
        return next((hit for hit in hits if hit is not None), None)

    def _inverted(self, before: Iteration, now: Iteration) -> Hit | None:
        if not self.inverts:
            return None
        hexes = np.flatnonzero(now.quality.inverted & ~before.quality.inverted)
        if not hexes.size:
            return None
        more = f" and {hexes.size - 1:,} more" if hexes.size > 1 else ""
        return Hit(f"Hex {hexes[0]}{more} inverted", tuple(int(h) for h in hexes))

    def _fell(self, before: Iteration, now: Iteration) -> Hit | None:
        least, worst = before.quality.q.min(), int(now.quality.q.argmin())
        if not (self.q_min_falls and now.quality.q[worst] < least):
            return None
        return Hit(f"q min fell from {least:.4f} to {now.quality.q[worst]:.4f}, at hex {worst}", (worst,))

    def _moved(self, before: Iteration, now: Iteration, unit: float) -> Hit | None:
        if self.node is None:
            return None
        move = float(np.linalg.norm(now.points[self.node] - before.points[self.node])) / unit
        if not move > self.move:
            return None
        return Hit(f"Node {self.node} moved by {move:.3g} mean edge lengths", nodes=(self.node,))

    def _changed(self, before: Iteration, now: Iteration) -> Hit | None:
        if self.hex is None:
            return None
        was, is_now = float(before.quality.q[self.hex]), float(now.quality.q[self.hex])
        if not abs(is_now - was) > self.change:
            return None
        return Hit(f"q of hex {self.hex} went from {was:.4f} to {is_now:.4f}", (self.hex,))

    def _cut(self, now: Iteration) -> Hit | None:
        cuts = now.diagnostics.get("cuts", 0)
        if self.cuts is None or not cuts > self.cuts:
            return None
        return Hit(f"The line search shortened the step {cuts} times, to {now.diagnostics.get('step_length', 0.0):.3g}")
