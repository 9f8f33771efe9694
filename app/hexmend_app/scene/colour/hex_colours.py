"""Values and colours of the hexes of a view."""

from __future__ import annotations

import numpy as np

from hexmend_app.picture.colours import MATERIAL
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.scene.colour.colouring import Colouring, fitted, invalid_kinds, resolve
from hexmend_app.scene.colour.material_colours import material_names, material_values
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.state.mesh.metric_cache import metric_values


class HexColours:
    """Computes the values and the colours of the hexes of a frame.

    Attributes
    ----------
    values : (m,) float64
        Coloured value of each hex.
    kinds : (m,) bool or uint8
        Number of the special colour of each hex, see `Colouring.colours`.
    colouring : Colouring or None
        None before `measure` is called.
    """

    def __init__(self) -> None:
        self.values, self.kinds = np.empty(0), np.empty(0, dtype=np.uint8)
        self.colouring: Colouring | None = None
        self._ends_of_views: tuple[float, float] | None = None
        self._counts: tuple[np.ndarray, np.ndarray] | None = None  # kinds, and the number of hexes of each

    def measure(self, frame: Frame) -> None:
        """Compute the values and the colouring of a frame."""
        self._frame = frame
        mesh, quality, colours, movement = frame.mesh, frame.quality, frame.look.colours, frame.movement
        self.kinds, title, names = invalid_kinds(quality), "", tuple[str, ...]()
        if colours.metric == MATERIAL.name:
            self.values, names = material_values(mesh), material_names(mesh)
        elif colours.metric not in DISPLACEMENT_QUANTITIES:
            self.values = metric_values(colours.metric, mesh, quality)
        elif movement is None:
            self.values = np.zeros(mesh.n_elements)
        else:
            self.values = movement.values(colours.metric)
            if colours.metric == "q-change":
                self.kinds = movement.validity_changes
            title = movement.title(colours.metric)
        self.colouring = resolve(colours, self.values, quality.invalid, self._ends_of_views, title, names)

    def extend_range(self, ends: tuple[float, float] | None) -> bool:
        """Extend a fitted range to that of all views; return True if it changes."""
        if ends == self._ends_of_views:
            return False
        before, self._ends_of_views = self.colouring, ends
        self.measure(self._frame)
        return (before.low, before.high) != (self.colouring.low, self.colouring.high)

    def of(self, hexes: np.ndarray | slice, opened: np.ndarray | None = None) -> np.ndarray:
        """Return the colours of faces of some hexes, (k, 3) uint8.

        Parameters
        ----------
        hexes : (k,) int32 or slice
        opened : (k,) bool, optional
            True for faces inside the mesh, for neutral looks; None for all.
        """
        kinds = self.kinds[hexes]
        if not self._frame.look.colours.neutral:
            return self.colouring.colours(self.values[hexes], kinds)
        return self.colouring.neutral(np.ones(len(kinds), bool) if opened is None else opened, kinds)

    @property
    def ends(self) -> tuple[float, float]:
        """Fitted range of the values of this view."""
        return fitted(self.values, self._frame.quality.invalid)

    @property
    def special_counts(self) -> list[tuple[str, int, tuple[int, int, int]]]:
        """Name, number of hexes and colour of each special colour."""
        colours = self.colouring.special_colours
        if self._counts is None or self._counts[0] is not self.kinds:
            self._counts = self.kinds, np.bincount(self.kinds)
        counts = [*self._counts[1].tolist(), *(0 for _ in colours)]
        pairs = zip(colours, counts[1:], strict=False)
        return [(special.name, count, special.colour) for special, count in pairs]
