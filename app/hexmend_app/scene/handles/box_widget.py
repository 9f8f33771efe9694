"""Cut box whose sides are dragged in the view."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkInteractionWidgets import vtkBoxRepresentation, vtkBoxWidget2

from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.handles.handles import Handles
from hexmend_app.theme.palette import PLANE_ACTIVE, PLANE_EDGE, rgb


class BoxWidget(Handles):
    """VTK's box widget without rotation.

    Parameters
    ----------
    pane : Pane
    moved : callable
        Called with (low, high) while the user drags; not called by `set`.
    """

    def __init__(self, pane: Pane, moved: Callable[[tuple, tuple], None]):
        self._moved = moved
        shape = vtkBoxRepresentation()
        shape.SetPlaceFactor(1.0)
        shape.GetFaceProperty().SetOpacity(0)
        shape.GetSelectedFaceProperty().SetOpacity(0.12)
        shape.GetSelectedHandleProperty().SetColor(0.84, 0.37, 0.0)
        shape.SetOutlineCursorWires(False)
        self._shape = shape
        self.set_dark(False)
        widget = vtkBoxWidget2()
        widget.SetRepresentation(shape)
        widget.RotationEnabledOff()
        widget.ScalingEnabledOff()
        super().__init__(pane, widget)

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        self._shape.GetOutlineProperty().SetColor(rgb(PLANE_EDGE.of(dark)))
        for part in ("SelectedFace", "SelectedOutline", "Handle"):
            getattr(self._shape, f"Get{part}Property")().SetColor(rgb(PLANE_ACTIVE.of(dark)))

    def set_bounds(self, bounds: tuple[float, float, float, float, float, float]) -> None:
        """Set the bounds of the mesh, which limit the box."""
        self._bounds = np.array(bounds).reshape(3, 2)
        super().set_bounds(bounds)

    def _place(self) -> None:
        ends = zip(self._wanted.low, self._wanted.high, strict=True)
        self._shape.PlaceWidget([end for pair in ends for end in pair])

    @property
    def corners(self) -> np.ndarray:
        """Lowest and highest corner of the box, (2, 3) float64."""
        data = vtkPolyData()
        self._shape.GetPolyData(data)
        return np.array(data.GetBounds()).reshape(3, 2).T

    def _announce(self) -> None:
        low, high = self.corners.clip(self._bounds[:, 0], self._bounds[:, 1])
        self._moved(tuple(low.tolist()), tuple(high.tolist()))
