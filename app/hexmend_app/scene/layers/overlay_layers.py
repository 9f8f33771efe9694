"""Layers of a view besides the hexes; a layer that fails is hidden, and the others are drawn."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.picture.layer_switch import ordered_layers
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.geometry.skin import Faces, Skin
from hexmend_app.scene.layers.arrows import ArrowLayer
from hexmend_app.scene.layers.measurement_layer import MeasurementLayer
from hexmend_app.scene.layers.mesh import MeshLayer
from hexmend_app.scene.layers.optional.structure import StructureLayers
from hexmend_app.scene.layers.optional_layer import OptionalLayer
from hexmend_app.scene.layers.selection.selection_layer import SelectionLayer
from hexmend_app.scene.layers.silhouette import Silhouette
from hexmend_app.scene.layers.translucent_surface import TranslucentSurface
from hexmend_app.theme.palette import GHOST


def raise_error(error: Exception) -> None:
    """Raise the error of a layer; used for pictures that are written to files."""
    raise error


class OverlayLayers:
    """Draws ghosts, the outline, the structure, arrows, the selection, a measurement and the optional layers.

    A layer that raises is reported and hidden until another mesh is drawn; the other layers are not affected.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    on_failure : callable
        Called with the exception of a layer that failed.

    Attributes
    ----------
    ghosts : Ghosts
    outline : Silhouette
        Outline of the whole mesh while part of it is hidden.
    structure : StructureLayers
    arrows : ArrowLayer
    selection : SelectionLayer
        Marks of the selected hex and node.
    measurement : MeasurementLayer
    optional : dict of OptionalLayer
        Layers that are switched on and off, by their names in `LAYERS`.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0, on_failure: Callable[[Exception], object] = raise_error):
        self._on_failure = on_failure
        self._frame: Frame | None = None
        self._failed: set[str] = set()
        self.optional: dict[str, OptionalLayer] = {
            switch.name: switch.drawn_by(pane, pixel_ratio) for switch in ordered_layers() if switch.drawn_by
        }
        self.ghosts = Ghosts(pane, pixel_ratio)  # translucent actors are drawn in the order of their creation
        self.outline = Silhouette(pane, pixel_ratio)
        self.structure = StructureLayers(pane, pixel_ratio)
        self.arrows = ArrowLayer(pane, pixel_ratio)
        self.selection = SelectionLayer(pane, pixel_ratio)
        self.measurement = MeasurementLayer(pane, pixel_ratio)

    @property
    def renderers(self) -> tuple[vtkRenderer, ...]:
        """Renderers in front of the renderer of the hexes, from back to front."""
        optional = [renderer for layer in self.optional.values() for renderer in layer.renderers]
        own = self.structure.renderer, self.arrows.renderer, *self.selection.layers
        return *own, *optional, *self.measurement.layers

    @property
    def places(self) -> np.ndarray:
        """Points of ghosts and optional layers that a fitted camera includes, (k, 3)."""
        return np.concatenate([self.ghosts.places, *(layer.places for layer in self.optional.values())])

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        for layer in (self.selection, self.ghosts, self.outline, *self.optional.values()):
            layer.set_dark(dark)  # type: ignore[attr-defined]

    def draw(self, frame: Frame, keep: np.ndarray | None, mesh_layer: MeshLayer, ghosts: np.ndarray | None) -> None:
        """Draw all layers.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            True for hexes shown whole or in part; None for all.
        mesh_layer : MeshLayer
            Layer of the drawn hexes.
        ghosts : (m,) bool, optional
            True for hexes that are drawn as ghosts; None for none.
        """
        if not frame.is_of(self._frame):
            self.hide()
        self._frame = frame
        for name, layer in self.optional.items():
            if frame.look.structure.is_on(name):
                self._attempt(name, layer.draw, frame, keep)
            else:
                layer.hide()
        self._attempt("selection", self.selection.draw, frame)
        self._attempt("ghosts", self.ghosts.draw, frame, ghosts, keep)
        self._attempt("arrows", self.arrows.draw, frame, keep, mesh_layer)
        self._attempt("outline", self.outline.draw, frame, keep)
        self._attempt("measurement", self.measurement.draw, frame.look.measurement)
        self._attempt("structure", self.structure.draw, frame, keep, mesh_layer.faces)

    def hide(self) -> None:
        """Hide all layers, also those that failed."""
        self._frame = None
        self._failed.clear()
        own = self.ghosts, self.outline, self.structure, self.arrows, self.selection, self.measurement
        for layer in (*own, *self.optional.values()):
            layer.hide()  # type: ignore[attr-defined]

    def _attempt(self, name: str, draw: Callable[..., object], *values: object) -> None:
        """Draw a layer unless it has failed before; hide and report a layer that fails."""
        if name in self._failed:
            return
        try:
            draw(*values)
        except Exception as error:  # the other layers are drawn after any error
            self._failed.add(name)
            layer = self.optional[name] if name in self.optional else getattr(self, name)
            layer.hide()
            self._on_failure(error)


class Ghosts(TranslucentSurface):
    """Draws the outer faces of the rings of hexes around isolated hexes, in one pale colour."""

    colour, face_opacity, edge_opacity = GHOST, 0.14, 0.4

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        super().__init__(pane, pixel_ratio)
        self.actors[0].GetProperty().BackfaceCullingOn()

    def draw(self, frame: Frame, ghosts: np.ndarray | None, keep: np.ndarray | None) -> None:
        """Replace the ghosts.

        Parameters
        ----------
        frame : Frame
        ghosts : (m,) bool, optional
            True for ghosts; None if there are none.
        keep : (m,) bool
            True for hexes that are shown opaque.
        """
        if ghosts is None or not ghosts.any():
            self.hide()
            return
        faces = Skin(frame.mesh).visible(ghosts | keep)
        outer = ghosts[faces.hexes]
        self.set_faces(frame, frame.mesh.points, Faces(faces.nodes, faces.quads[outer], faces.hexes[outer]))
        self.show()
