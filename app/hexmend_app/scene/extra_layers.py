"""What a view draws besides the elements: each layer for itself, so that one that fails takes no other with it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.scene.frame import Frame
from hexmend_app.scene.layers.arrows import ArrowLayer
from hexmend_app.scene.layers.body import Body
from hexmend_app.scene.layers.chosen import Chosen
from hexmend_app.scene.layers.ghosts import Ghosts
from hexmend_app.scene.layers.original import Original
from hexmend_app.scene.layers.others import OtherCells
from hexmend_app.scene.layers.silhouette import Silhouette
from hexmend_app.scene.layers.structure import StructureLayers
from hexmend_app.scene.pane import Pane


def raise_error(error: Exception) -> None:
    """Raise what a layer has raised: for pictures that are written to files."""
    raise error


class ExtraLayers:
    """Draws ghosts, the original surface, other cells, the outline, the structure, arrows and the selection.

    A layer that raises is reported, and hidden until another mesh is drawn: the other layers are drawn all the same.

    Parameters
    ----------
    pane : Pane
    pen : float
        How many pixels wide a thin line is.
    on_failure : callable
        Called with the exception of a layer that failed.

    Attributes
    ----------
    ghosts : Ghosts
    original : Original
    others : OtherCells
    outline : Silhouette or None
        What a part is cut from, once there is a mesh.
    structure : StructureLayers
    arrows : ArrowLayer
    selection : Chosen
        The marks of the selected hex and node.
    """

    def __init__(self, pane: Pane, pen: float = 1.0, on_failure: Callable[[Exception], object] = raise_error):
        self._pane, self._pen = pane, pen
        self._on_failure = on_failure
        self._dark = False
        self._failed: set[str] = set()
        self.ghosts = Ghosts(pane.renderer, pen)
        self.original = Original(pane.renderer, pen)
        self.others = OtherCells(pane.renderer, pen)
        self.outline: Silhouette | None = None
        self.structure = StructureLayers(pane, pen)
        self.arrows = ArrowLayer(pane, pen)
        self.selection = Chosen(pane, pen)

    @property
    def renderers(self) -> tuple[vtkRenderer, ...]:
        """What draws over the elements, one layer over the other."""
        return self.structure.layer, self.arrows.layer, *self.selection.layers

    @property
    def places(self) -> np.ndarray:
        """The corners of ghosts and other cells, (k, 3)."""
        return np.concatenate([self.ghosts.places, self.others.places])

    def set_dark(self, dark: bool) -> None:
        """Draw for the dark theme, or for the light one."""
        self._dark = dark
        for layer in (self.selection, self.ghosts, self.original, self.others, self.outline):
            if layer is not None:
                layer.set_dark(dark)

    def set_fast(self, fast: bool) -> None:
        """Draw less, for fast frames, or all again."""
        self._attempt("structure", self.structure.set_fast, fast)
        self._attempt("arrows", self.arrows.set_fast, fast)

    def set_mesh(self, frame: Frame) -> None:
        """Take another mesh: nothing of the mesh before is drawn any more."""
        self.hide()
        self._failed.clear()
        self._attempt("outline", self._outline_mesh, frame)
        self._attempt("structure", self.structure.set_mesh, frame.mesh)
        self._attempt("selection", self.selection.set_mesh, frame.mesh)

    def _outline_mesh(self, frame: Frame) -> None:
        self.outline = Silhouette(self._pane.renderer, frame.mesh, self._pen)
        self.outline.set_dark(self._dark)

    def follow(self, frame: Frame, moved: bool, pinned: bool, classed: bool) -> None:
        """Take what has changed of the same mesh: places of nodes, which nodes are pinned, their kinds."""
        if moved:
            self._attempt("selection", self.selection.move, frame.mesh)
        if pinned:
            self._attempt("structure", self.structure.set_pins, frame.mesh.pinned)
        if classed or pinned:
            self._attempt("structure", self.structure.set_kinds, frame.kinds)

    def draw_around(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the original surface and other cells."""
        self._attempt("original", self.original.draw, frame, keep)
        self._attempt("others", self.others.draw, frame)

    def rebuild(
        self, frame: Frame, keep: np.ndarray | None, body: Body, ghosts: Callable[[Frame], np.ndarray | None]
    ) -> None:
        """Draw what belongs to the elements that are shown now.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            Hexes that are shown, in whole or in part; None for all.
        body : Body
            Has drawn the elements.
        ghosts : callable
            Gives the hexes that are drawn as ghosts, (m,) bool, or None.
        """
        look, points = frame.look, frame.mesh.points
        self._attempt("ghosts", lambda: self.ghosts.draw(frame, ghosts(frame), keep))
        self._attempt("arrows", self.arrows.draw, frame, keep, body)
        if self.outline is not None:
            self._attempt("outline", self.outline.show, look, points, keep)
        self._attempt("structure", self.structure.choose, look, points, frame.figures, body.faces, keep)

    def move(self, frame: Frame, keep: np.ndarray | None, body: Body) -> None:
        """Draw the same where the nodes are now; parameters are those of `rebuild`."""
        points = frame.mesh.points
        self._attempt("ghosts", self.ghosts.move, frame)
        self._attempt("arrows", self.arrows.draw, frame, keep, body)
        if self.outline is not None:
            self._attempt("outline", self.outline.move, points)
        self._attempt("structure", self.structure.move, points, frame.figures)

    def hide(self) -> None:
        """Draw nothing."""
        if self.outline is not None:
            self.outline.close()
            self.outline = None
        for layer in (self.ghosts, self.original, self.others, self.structure, self.arrows, self.selection):
            layer.hide()

    def _attempt(self, name: str, draw: Callable[..., object], *values: object) -> None:
        """Have a layer drawn, unless it has failed before; hide and report it if it fails."""
        if name in self._failed:
            return
        try:
            draw(*values)
        except Exception as error:  # whatever it is, the other layers are drawn
            self._failed.add(name)
            if (layer := getattr(self, name)) is not None:
                layer.hide()
            self._on_failure(error)
