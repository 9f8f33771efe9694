"""Faces and their edges in one translucent colour."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor

from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.coloured_polygons import quads
from hexmend_app.scene.geometry.curved_faces import CurvedFaces, divisions_of
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.geometry.skin import Faces
from hexmend_app.scene.layers.flat_actor import flat_actor
from hexmend_app.scene.layers.invalid_outline import outlines
from hexmend_app.theme.palette import Role, rgb


class TranslucentSurface:
    """Base class of layers that draw a translucent surface and lines on it.

    Its two actors have one colour and no lighting, so that the drawing order of faces does not matter.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.

    Attributes
    ----------
    poly : pyvista.PolyData
        The surface; may be empty.
    actors : tuple of vtkActor
        Actors of the faces and of the lines.
    """

    colour: Role
    face_opacity, edge_opacity = 0.22, 0.5

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self.poly = pv.PolyData()
        self._drawn: tuple[object, ...] = ()
        self.actors: tuple[vtkActor, vtkActor] = (
            flat_actor(pane.renderer, opacity=self.face_opacity),
            flat_actor(pane.renderer, pixel_ratio, self.edge_opacity),
        )
        self.set_dark(False)

    @property
    def shown(self) -> bool:
        """True while the surface is drawn."""
        return bool(self.actors[0].GetVisibility())

    @property
    def places(self) -> np.ndarray:
        """Points of the surface, (k, 3); empty while it is hidden."""
        return np.asarray(self.poly.points) if self.shown else np.empty((0, 3))

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        for actor in self.actors:
            actor.GetProperty().SetColor(rgb(self.colour.of(dark)))

    def set_data(self, poly: pv.PolyData, edges: bool = True) -> None:
        """Replace the surface, with lines along its edges or without any."""
        self.poly, lines = poly, pv.PolyData()
        if edges and poly.n_cells:
            lines.SetPoints(poly.GetPoints())
            lines.SetLines(pv.CellArray.from_regular_cells(outlines(poly, np.ones(poly.n_cells, dtype=bool))[0]))
        for actor, data in zip(self.actors, (poly, lines), strict=True):
            actor.GetMapper().SetInputData(data)

    def set_faces(self, frame: Frame, points: np.ndarray, faces: Faces) -> None:
        """Replace the surface by faces of the hexes of a frame, curved if faces are, at points (n, 3) float64."""
        divisions = divisions_of(len(faces.quads)) if frame.curved else 1
        colours = np.zeros((len(faces.quads), 3), dtype=np.uint8)
        if divisions > 1:
            self.set_data(CurvedFaces(frame.mesh, faces, divisions).quads(points, colours))
        else:
            self.set_data(quads(faces.places(points), faces.quads, colours, faces.hexes))

    def changes(self, *drawn: object) -> bool:
        """Return True if the arrays and values that the surface is made from are others than the last time.

        Masks of hexes are compared by their values, other arrays by identity.
        """
        last, self._drawn = self._drawn, drawn
        return len(last) != len(drawn) or not all(map(_same, last, drawn))

    def show(self) -> None:
        """Draw the surface unless it is empty."""
        self._set_visible(bool(self.poly.n_cells))

    def hide(self) -> None:
        """Hide the surface."""
        self._set_visible(False)

    def _set_visible(self, on: bool) -> None:
        for actor in self.actors:
            actor.SetVisibility(on)


def _same(one: object, other: object) -> bool:
    masks = all(isinstance(value, np.ndarray) and value.dtype == bool for value in (one, other))
    return one is other or (masks and np.array_equal(one, other))  # type: ignore[arg-type]
