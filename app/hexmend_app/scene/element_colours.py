"""What the colours of one view stand for: a value and a kind for each element, and the range that they span."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.scene.colours import Colouring, fitted, resolve
from hexmend_app.scene.frame import Frame
from hexmend_app.state.measured import values


class ElementColours:
    """Measures the elements of a frame, and colours them.

    Attributes
    ----------
    values : (m,) float64
        What the colours show of each element.
    kinds : (m,) bool or uint8
        As in `Colouring.colours`.
    colouring : Colouring or None
        None before a frame has been measured.
    """

    def __init__(self) -> None:
        self.values, self.kinds = np.empty(0), np.empty(0, dtype=bool)
        self.colouring: Colouring | None = None
        self._beside: tuple[float, float] | None = None

    def measure(self, frame: Frame) -> None:
        """Take another frame."""
        self._frame = frame
        mesh, figures, scale, movement = frame.mesh, frame.figures, frame.look.scale, frame.movement
        self.kinds, title = figures.inverted, ""
        if scale.metric not in DISPLACEMENT_QUANTITIES:
            self.values = values(scale.metric, mesh.points, mesh.hexes, figures)
        elif movement is None:
            self.values = np.zeros(mesh.n_hexes)
        else:
            self.values = movement.values(scale.metric)
            self.kinds = movement.inversion_changes if scale.metric == "q-change" else figures.inverted
            title = movement.title(scale.metric)
        self.colouring = resolve(scale, self.values, figures.inverted, self._beside, title)

    def span(self, beside: tuple[float, float] | None) -> bool:
        """Let a range that is fitted span these values too, of views beside this; whether it becomes another."""
        if beside == self._beside:
            return False
        before, self._beside = self.colouring, beside
        self.measure(self._frame)
        return (before.low, before.high) != (self.colouring.low, self.colouring.high)

    def of(self, hexes: np.ndarray | slice, opened: np.ndarray | None = None) -> np.ndarray:
        """The colours of faces of some hexes, (k, 3) uint8.

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
        """The least and the greatest value here, as `fitted` has them."""
        return fitted(self.values, self._frame.figures.inverted)

    @property
    def apart(self) -> list[tuple[str, int, tuple[int, int, int]]]:
        """What has a colour of its own whatever its value: name, number of elements, colour."""
        counts = np.bincount(self.kinds, minlength=len(self.colouring.apart) + 1)
        return [(one.name, int(counts[k]), one.colour) for k, one in enumerate(self.colouring.apart, start=1)]
