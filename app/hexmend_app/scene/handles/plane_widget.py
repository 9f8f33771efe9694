"""Cut plane that is dragged and rotated in the view."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from vtkmodules.vtkInteractionWidgets import (
    vtkDisplaySizedImplicitPlaneRepresentation,
    vtkDisplaySizedImplicitPlaneWidget,
)
from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor

from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.handles.handles import Handles
from hexmend_app.theme.palette import PLANE, PLANE_ACTIVE, PLANE_EDGE, rgb

_State = vtkDisplaySizedImplicitPlaneRepresentation
#: What VTK would do where a drag begins, and what it does here.
_DRAGS = {_State.Rotating: _State.Pushing, _State.ResizeDiskRadius: _State.Rotating}  # arrow, ring
_BEFORE_ZOOMING = 1.0  # priority of the observers of the wheel


class PlaneWidget(Handles):
    """Disc whose arrow or face is dragged to push the plane, and whose ring is dragged to rotate it.

    The wheel over the arrow, the ring or the centre pushes the plane too.

    Parameters
    ----------
    pane : Pane
    moved : callable
        Called with the Plane while the user drags; not called by `set`.
    """

    def __init__(self, pane: Pane, moved: Callable[[Plane], None]):
        self._moved = moved
        shape = vtkDisplaySizedImplicitPlaneRepresentation()
        shape.SetPlaceFactor(1.08)
        shape.OutlineTranslationOff()
        shape.ScaleEnabledOff()
        shape.DrawOutlineOff()
        shape.DrawIntersectionEdgesOn()
        shape.GetPlaneProperty().SetOpacity(0.04)
        shape.GetSelectedPlaneProperty().SetOpacity(0.12)
        shape.SetInteractionColor(0.84, 0.37, 0.0)
        shape.GetEdgesProperty().SetOpacity(0.5)
        self._shape = shape
        self.set_dark(False)
        widget = vtkDisplaySizedImplicitPlaneWidget()
        widget.SetRepresentation(shape)
        super().__init__(pane, widget)
        self._wheel = [
            widget.GetInteractor().AddObserver(f"MouseWheel{direction}Event", partial(self._bump, by), _BEFORE_ZOOMING)
            for direction, by in (("Forward", 1), ("Backward", -1))
        ]

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        edge, plane, selected = (rgb(role.of(dark)) for role in (PLANE_EDGE, PLANE, PLANE_ACTIVE))
        self._shape.SetHandleColor(selected)
        self._shape.SetForegroundColor(edge)
        self._shape.GetPlaneProperty().SetColor(plane)
        self._shape.GetSelectedPlaneProperty().SetColor(selected)

    def close(self) -> None:
        """Detach the widget and the wheel from the interactor."""
        for observer in self._wheel:
            self.widget.GetInteractor().RemoveObserver(observer)
        super().close()

    def _place(self) -> None:
        self._shape.SetNormal(self._wanted.normal)
        self._shape.SetOrigin(self._wanted.point)

    def _drag(self, on: bool) -> None:
        state = self._shape.GetInteractionState()
        if on and state in _DRAGS:
            self._shape.SetInteractionState(_DRAGS[state])
        super()._drag(on)

    def _bump(self, by: int, interactor: vtkRenderWindowInteractor, event: str) -> None:
        """Push the plane by a turn of the wheel over the arrow, the ring or the centre, in place of zooming."""
        if self.widget.GetEnabled() and self._shape.GetRepresentationState() in (*_DRAGS, _State.MovingOrigin):
            self._shape.BumpPlane(by, 1.0)
            self._announce()
            interactor.GetCommand(self._wheel[by < 0]).SetAbortFlag(True)

    def _announce(self) -> None:
        self._moved(Plane(self._shape.GetNormal(), point=self._shape.GetOrigin()))
