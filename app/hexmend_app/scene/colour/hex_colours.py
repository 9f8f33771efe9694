"""Values, kinds and colours of the hexes of one view."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.scene.colour.colouring import Colouring, fitted, resolve
from hexmend_app.scene.views.frame import Frame
from hexmend_app.state.mesh.metric_cache import metric_values


class ElementColours:
    """Measures the hexes of a frame, and colours them.

    Attributes
    ----------
    values : (m,) float64
        Coloured value of each hex.
    kinds : (m,) bool or uint8
        As in `Colouring.colours`.
    colouring : Colouring or None
        None before a frame has been measured.
    """

    def __init__(self) -> None:
        self.values, self.kinds = np.empty(0), np.empty(0, dtype=bool)
        self.colouring: Colouring | None = None
        self._neighbour: tuple[float, float] | None = None

    def measure(self, frame: Frame) -> None:
        """Measure another frame."""
        self._frame = frame
        mesh, figures, scale, movement = frame.mesh, frame.figures, frame.look.scale, frame.movement
        self.kinds, title = figures.inverted, ""
        if scale.metric not in DISPLACEMENT_QUANTITIES:
            self.values = metric_values(scale.metric, mesh.points, mesh.hexes, figures)
        elif movement is None:
            self.values = np.zeros(mesh.n_hexes)
        else:
            self.values = movement.values(scale.metric)
            self.kinds = movement.inversion_changes if scale.metric == "q-change" else figures.inverted
            title = movement.title(scale.metric)
        self.colouring = resolve(scale, self.values, figures.inverted, self._neighbour, title)

    def span(self, neighbour: tuple[float, float] | None) -> bool:
        """Extend a fitted range to values of other views; return True if it changes."""
        if neighbour == self._neighbour:
            return False
        before, self._neighbour = self.colouring, neighbour
        self.measure(self._frame)
        return (before.low, before.high) != (self.colouring.low, self.colouring.high)

    def of(self, hexes: np.ndarray | slice, opened: np.ndarray | None = None) -> np.ndarray:
        """Return the colours of faces of some hexes, (k, 3) uint8.

        Parameters
        ----------
        hexes : (k,) int32 or slice
        opened : (k,) bool, optional
            Of a neutral look, which faces lie inside the mesh; None for all.
        """
        kinds = self.kinds[hexes]
        if not self._frame.look.neutral:
            return self.colouring.colours(self.values[hexes], kinds)
        return self.colouring.neutral(np.ones(len(kinds), bool) if opened is None else opened, kinds)

    @property
    def ends(self) -> tuple[float, float]:
        """Range of the values of this view, as `fitted` returns it."""
        return fitted(self.values, self._frame.figures.inverted)

    @property
    def special_counts(self) -> list[tuple[str, int, tuple[int, int, int]]]:
        """Special colours: name, number of hexes, colour."""
        counts = np.bincount(self.kinds, minlength=len(self.colouring.special_colours) + 1)
        return [(one.name, int(counts[k]), one.colour) for k, one in enumerate(self.colouring.special_colours, start=1)]
