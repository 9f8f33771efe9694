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
    outline : Silhouette or None
        Outline of the whole mesh while part of it is hidden; None before a mesh is set.
    structure : StructureLayers
    arrows : ArrowLayer
    selection : SelectionLayer
        Marks of the selected hex and node.
    measurement : MeasurementLayer
    optional : dict of OptionalLayer
        Layers that are switched on and off, by their names in `LAYERS`.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0, on_failure: Callable[[Exception], object] = raise_error):
        self._pane, self._pixel_ratio = pane, pixel_ratio
        self._on_failure = on_failure
        self._dark = False
        self._failed: set[str] = set()
        self.optional: dict[str, OptionalLayer] = {
            switch.name: switch.drawn_by(pane, pixel_ratio) for switch in ordered_layers() if switch.drawn_by
        }
        self.ghosts = Ghosts(pane, pixel_ratio)  # translucent actors are drawn in the order of their creation
        self.outline: Silhouette | None = None
        self.structure = StructureLayers(pane, pixel_ratio)
        self.arrows = ArrowLayer(pane, pixel_ratio)
        self.selection = SelectionLayer(pane, pixel_ratio)
        self.measurement = MeasurementLayer(pane, pixel_ratio)

    @property
    def renderers(self) -> tuple[vtkRenderer, ...]:
        """Renderers in front of the renderer of the hexes, from back to front."""
        optional = [renderer for layer in self.optional.values() for renderer in layer.renderers]
        own = self.structure.layer, self.arrows.layer, *self.selection.layers
        return *own, *optional, *self.measurement.layers

    @property
    def places(self) -> np.ndarray:
        """Points of ghosts and optional layers that a fitted camera includes, (k, 3)."""
        return np.concatenate([self.ghosts.places, *(layer.places for layer in self.optional.values())])

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        self._dark = dark
        for layer in (self.selection, self.ghosts, *self.optional.values(), self.outline):
            if layer is not None:
                layer.set_dark(dark)  # type: ignore[attr-defined]

    def set_fast(self, fast: bool) -> None:
        """Omit details in fast frames, or draw everything again."""
        self._attempt("structure", self.structure.set_fast, fast)
        self._attempt("arrows", self.arrows.set_fast, fast)

    def set_mesh(self, frame: Frame) -> None:
        """Replace the mesh; nothing of the previous mesh remains drawn."""
        self.hide()
        self._failed.clear()
        self._attempt("outline", self._outline_mesh, frame)
        self._attempt("structure", self.structure.set_mesh, frame.mesh)
        self._attempt("selection", self.selection.set_mesh, frame.mesh)

    def _outline_mesh(self, frame: Frame) -> None:
        self.outline = Silhouette(self._pane.renderer, frame.mesh, self._pixel_ratio, frame.curved)
        self.outline.set_dark(self._dark)

    def update(self, frame: Frame, moved: bool, pinned: bool, classed: bool) -> None:
        """Update positions, pinned nodes or classes of boundary nodes of the same mesh, if they have changed."""
        if moved:
            self._attempt("selection", self.selection.move, frame.mesh)
            self._attempt("structure", self.structure.set_positions, frame.mesh)
        if pinned:
            self._attempt("structure", self.structure.set_pins, frame.mesh.pinned)
        if classed or pinned:
            self._attempt("structure", self.structure.set_kinds, frame.kinds)

    def draw_optional(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the optional layers that are on; parameters are those of `rebuild`."""
        for name, layer in self.optional.items():
            if frame.look.structure.is_on(name):
                self._attempt(name, layer.draw, frame, keep)
            else:
                layer.hide()

    def rebuild(
        self, frame: Frame, keep: np.ndarray | None, mesh_layer: MeshLayer, ghosts: Callable[[Frame], np.ndarray | None]
    ) -> None:
        """Draw the layers that depend on the shown hexes.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            True for hexes shown whole or in part; None for all.
        mesh_layer : MeshLayer
            Layer of the drawn hexes.
        ghosts : callable
            Returns the hexes that are drawn as ghosts, (m,) bool, or None.
        """
        look, points = frame.look, frame.mesh.points
        if self.outline is not None and self.outline.curved != frame.curved:
            self.outline.close()
            self._attempt("outline", self._outline_mesh, frame)
        self._attempt("selection", self.selection.set_curved, frame.curved)
        self._attempt("ghosts", lambda: self.ghosts.draw(frame, ghosts(frame), keep))
        self._attempt("arrows", self.arrows.draw, frame, keep, mesh_layer)
        if self.outline is not None:
            self._attempt("outline", self.outline.show, look, points, keep)
        self._attempt("measurement", self.measurement.draw, look.measurement)
        self._attempt("structure", self.structure.rebuild, look, points, frame.figures, mesh_layer.faces, keep)

    def move(self, frame: Frame, keep: np.ndarray | None, mesh_layer: MeshLayer) -> None:
        """Draw the same layers at the current positions of the nodes; parameters are those of `rebuild`."""
        points = frame.mesh.points
        self._attempt("ghosts", self.ghosts.move, frame)
        self._attempt("arrows", self.arrows.draw, frame, keep, mesh_layer)
        if self.outline is not None:
            self._attempt("outline", self.outline.move, points)
        self._attempt("structure", self.structure.move, points, frame.figures)

    def hide(self) -> None:
        """Hide all layers."""
        if self.outline is not None:
            self.outline.close()
            self.outline = None
        own = self.ghosts, self.structure, self.arrows, self.selection, self.measurement
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
            if layer is not None:
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

    def move(self, frame: Frame) -> None:
        """Draw the same ghosts at the current positions of their nodes."""
        if self.shown:
            self.move_faces(frame.mesh.points)
