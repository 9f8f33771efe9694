"""Base class of the VTK widgets that are dragged in the view."""

from __future__ import annotations

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
    places = mesh.points[mesh.hexes[hexes[hexes < mesh.n_hexes]]].reshape(-1, 3)
    whole = np.ptp(mesh.points[mesh.topology.used], axis=0)
    return len(places) > 0 and bool(np.linalg.norm(np.ptp(places, axis=0)) < _DETAIL * np.linalg.norm(whole))


class Handles:
    """Switches a widget on and off, and reports when it is dragged. Its drag ends where the pointer leaves the view.

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
        self._dragging = False
        widget.SetInteractor(pane.window.GetInteractor())
        widget.AddObserver("StartInteractionEvent", lambda *_: self._drag(True))
        widget.AddObserver("EndInteractionEvent", lambda *_: self._drag(False))
        widget.AddObserver("InteractionEvent", self._on_dragged)

    def close(self) -> None:
        """Detach the widget from the interactor."""
        self.widget.Off()
        self.widget.SetInteractor(None)

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

    def _on_dragged(self, *_: object) -> None:
        self._announce()
        interactor = self.widget.GetInteractor()
        (x, y), (width, height) = interactor.GetEventPosition(), interactor.GetSize()
        if self._dragging and not (0 <= x < width and 0 <= y < height):
            self._let_go()

    def _let_go(self) -> None:
        """End the drag; VTK ends it only at a release of the button."""
        self.widget.GetInteractor().InvokeEvent("LeftButtonReleaseEvent")

    def _announce(self, *_: object) -> None:
        """Report the dragged position."""
        raise NotImplementedError
