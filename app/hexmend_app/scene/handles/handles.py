"""Base class of the VTK widgets that are dragged in the view."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np
from vtkmodules.vtkInteractionWidgets import vtkAbstractWidget

from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.frame import Frame

#: Extent of isolated hexes, as a fraction of that of the mesh, below which handles would fill the view.
_DETAIL = 0.25


def isolates_detail(frame: Frame) -> bool:
    """Return True if the hexes shown are isolated and small compared with the mesh, in whose size handles are drawn."""
    mesh, isolate = frame.mesh, frame.look.show.isolate
    if isolate is None:
        return False
    hexes = np.array(isolate.hexes, dtype=np.int64)
    places = mesh.points[mesh.elements[hexes[hexes < mesh.n_elements]]].reshape(-1, 3)
    whole = np.ptp(mesh.points[mesh.topology.used], axis=0)
    return len(places) > 0 and bool(np.linalg.norm(np.ptp(places, axis=0)) < _DETAIL * np.linalg.norm(whole))


class Handles(ABC):
    """Widget that sets a shape of a cut. Its drag ends where the pointer leaves the view.

    Attributes
    ----------
    widget : vtkAbstractWidget

    Parameters
    ----------
    pane : Pane
    widget : vtkAbstractWidget
        Widget with its representation.
    """

    def __init__(self, pane: Pane, widget: vtkAbstractWidget):
        self.widget = widget
        self._renderer = pane.renderer
        self._dragging = self._placed = False
        self._wanted: Any = None
        widget.SetInteractor(pane.window.GetInteractor())
        widget.AddObserver("StartInteractionEvent", lambda *_: self._drag(True))
        widget.AddObserver("EndInteractionEvent", lambda *_: self._drag(False))
        widget.AddObserver("InteractionEvent", self._on_dragged)

    def set_bounds(self, bounds: tuple[float, float, float, float, float, float]) -> None:
        """Set the bounds of the mesh, which scale the widget."""
        self.widget.GetRepresentation().PlaceWidget(bounds)
        self._placed = True

    def set(self, shape: Any, shown: bool = True) -> None:
        """Show a shape, or hide the widget if the shape is None or not `shown`.

        The widget is not moved during a drag; otherwise a plane that snaps to an axis could not be rotated away from
        it.
        """
        self._wanted = shape
        on = shape is not None and shown and self._placed
        if on and not self._dragging:
            self._place()
        self._switch(on)

    def close(self) -> None:
        """Detach the widget from the interactor."""
        self.widget.Off()
        self.widget.SetInteractor(None)

    @abstractmethod
    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""

    @abstractmethod
    def _place(self) -> None:
        """Move the widget to the wanted shape."""

    @abstractmethod
    def _announce(self) -> None:
        """Report the dragged shape."""

    def _switch(self, on: bool) -> None:
        if not on and self._dragging:
            # VTK does not end an interrupted drag; switched on again, the widget would continue it without a button.
            self._let_go()
            self._dragging = False
        if bool(self.widget.GetEnabled()) != on:
            if on:  # otherwise VTK moves the widget into the view that the mouse was over last
                self.widget.SetCurrentRenderer(self._renderer)
            self.widget.SetEnabled(on)

    def _drag(self, on: bool) -> None:
        self._dragging = on
        if not on and self._wanted is not None:
            self._place()

    def _on_dragged(self, *_: object) -> None:
        self._announce()
        interactor = self.widget.GetInteractor()
        (x, y), (width, height) = interactor.GetEventPosition(), interactor.GetSize()
        if self._dragging and not (0 <= x < width and 0 <= y < height):
            self._let_go()

    def _let_go(self) -> None:
        """End the drag; VTK ends it only at a release of the button."""
        self.widget.GetInteractor().InvokeEvent("LeftButtonReleaseEvent")
