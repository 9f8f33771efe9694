"""Cut plane that is dragged and rotated in the view."""

from __future__ import annotations

from collections.abc import Callable

from vtkmodules.vtkInteractionWidgets import vtkImplicitPlaneRepresentation, vtkImplicitPlaneWidget2

from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.handles.handles import Handles
from hexmend_app.theme.palette import PLANE, PLANE_ACTIVE, PLANE_EDGE, rgb


class PlaneWidget(Handles):
    """VTK's implicit plane widget without its box.

    Parameters
    ----------
    pane : Pane
    moved : callable
        Called with the Plane while the user drags; not called by `set`.
    """

    def __init__(self, pane: Pane, moved: Callable[[Plane], None]):
        self._moved = moved
        shape = vtkImplicitPlaneRepresentation()
        shape.SetPlaceFactor(1.08)
        shape.OutlineTranslationOff()
        shape.ScaleEnabledOff()
        shape.SetDrawOutline(False)
        shape.SetTubing(False)
        shape.GetPlaneProperty().SetOpacity(0.04)
        shape.GetSelectedPlaneProperty().SetOpacity(0.12)
        shape.GetSelectedNormalProperty().SetColor(0.84, 0.37, 0.0)
        shape.GetOutlineProperty().SetOpacity(0)
        self._shape = shape
        self.set_dark(False)
        widget = vtkImplicitPlaneWidget2()
        widget.SetRepresentation(shape)
        super().__init__(pane, widget)

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        edge, plane, selected = (rgb(role.of(dark)) for role in (PLANE_EDGE, PLANE, PLANE_ACTIVE))
        self._shape.SetEdgeColor(edge)
        self._shape.GetPlaneProperty().SetColor(plane)
        self._shape.GetSelectedPlaneProperty().SetColor(selected)
        self._shape.GetNormalProperty().SetColor(selected)

    def _place(self) -> None:
        self._shape.SetNormal(self._wanted.normal)
        self._shape.SetOrigin(self._wanted.point)

    def _announce(self) -> None:
        self._moved(Plane(self._shape.GetNormal(), point=self._shape.GetOrigin()))
