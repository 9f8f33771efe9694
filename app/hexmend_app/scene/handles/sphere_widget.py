"""Cut sphere that is dragged in the view."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pyvista as pv
from vtkmodules.vtkInteractionWidgets import vtkLineRepresentation, vtkLineWidget2
from vtkmodules.vtkRenderingCore import vtkPropCollection

from hexmend_app.picture.cut_shapes import Sphere
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.handles.handles import Handles
from hexmend_app.scene.layers.flat_actor import flat_actor, offset_depth
from hexmend_app.theme.palette import PLANE_ACTIVE, PLANE_EDGE, rgb

_CORNERS = 96  # of a circle
_IN_FRONT = -66_000  # depth offset that is larger than the depth of the view


class SphereWidget(Handles):
    """Three circles of a sphere, and a radius between two handles: the centre moves the sphere, the rim its size.

    Parameters
    ----------
    pane : Pane
    moved : callable
        Called with (centre, radius) while the user drags; not called by `set`.
    """

    def __init__(self, pane: Pane, moved: Callable[[tuple, float], None]):
        self._moved = moved
        self._direction = np.array([1.0, 0.0, 0.0])  # of the handle on the rim
        shape = vtkLineRepresentation()
        shape.SetPlaceFactor(1.0)
        for part in (shape.GetSelectedEndPointProperty(), shape.GetSelectedEndPoint2Property()):
            part.SetColor(0.84, 0.37, 0.0)
        shape.GetSelectedLineProperty().SetColor(0.84, 0.37, 0.0)
        _draw_on_top(shape)
        self._shape = shape
        self._circles = flat_actor(pane.renderer)
        self._circles.SetUseBounds(False)
        self._circles.GetMapper().SetInputData(_unit_circles())
        self.set_dark(False)
        widget = vtkLineWidget2()
        widget.SetRepresentation(shape)
        super().__init__(pane, widget)

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        active = rgb(PLANE_ACTIVE.of(dark))
        self._circles.GetProperty().SetColor(rgb(PLANE_EDGE.of(dark)))
        for part in (self._shape.GetEndPointProperty(), self._shape.GetEndPoint2Property()):
            part.SetColor(active)
        self._shape.GetLineProperty().SetColor(active)

    def set(self, shape: Sphere | None, shown: bool = True) -> None:
        """Show a sphere, or hide it if it is None or not `shown`; the circles move during a drag too."""
        super().set(shape, shown)
        self._circles.SetVisibility(self.widget.GetEnabled())
        if shape is not None:
            self._circles.SetPosition(shape.centre)
            self._circles.SetScale(max(shape.radius, 1e-300))

    def close(self) -> None:
        """Detach the widget from the interactor, and remove the circles."""
        self._renderer.RemoveActor(self._circles)
        super().close()

    def _place(self) -> None:
        centre = np.array(self._wanted.centre)
        self._shape.SetPoint1WorldPosition(centre)
        self._shape.SetPoint2WorldPosition(centre + self._wanted.radius * self._direction)

    def _announce(self) -> None:
        centre, rim = (np.array(place()) for place in (self._shape.GetPoint1WorldPosition,
                                                       self._shape.GetPoint2WorldPosition))  # fmt: skip
        before, radius = np.array(self._wanted.centre), self._wanted.radius
        if np.allclose(centre, before, rtol=0, atol=1e-9 * (radius + np.abs(before).max())):
            radius = float(np.linalg.norm(rim - centre))
            if radius:
                self._direction = (rim - centre) / radius
        else:
            self._shape.SetPoint2WorldPosition(centre + radius * self._direction)
        self._moved(tuple(centre.tolist()), radius)


def _draw_on_top(shape: vtkLineRepresentation) -> None:
    """Draw a line and its handles in front of the mesh, in which the centre of a sphere often lies."""
    for part in (shape.GetEndPointProperty(), shape.GetEndPoint2Property(), shape.GetLineProperty()):
        part.SetLighting(False)
        part.SetAmbient(0)  # without lighting, it would be added
    actors = vtkPropCollection()
    for source in (shape, shape.GetPoint1Representation(), shape.GetPoint2Representation()):
        source.GetActors(actors)
    for at in range(actors.GetNumberOfItems()):
        mapper = actors.GetItemAsObject(at).GetMapper()
        offset_depth(mapper, lines=_IN_FRONT, polygons=_IN_FRONT)


def _unit_circles() -> pv.PolyData:
    """Return circles of radius 1 around the origin, across the three axes."""
    angle = np.linspace(0, 2 * np.pi, _CORNERS, endpoint=False)
    circle = np.stack([np.cos(angle), np.sin(angle), np.zeros(_CORNERS)], axis=1)
    points = np.concatenate([np.roll(circle, axis, axis=1) for axis in range(3)])
    circles = np.append(np.arange(_CORNERS), 0) + _CORNERS * np.arange(3)[:, None]
    return pv.PolyData(points, lines=pv.CellArray.from_regular_cells(circles))  # type: ignore[arg-type]
