"""Hexes of a view: skin, sections of a smooth cut, and outlines of invalid hexes."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh.mesh import Mesh
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.colour.hex_colours import HexColours
from hexmend_app.scene.cutting.cut import remaining_skin, sections
from hexmend_app.scene.geometry.coloured_polygons import hexes_of, quads, set_colours, set_points
from hexmend_app.scene.geometry.curved_faces import CurvedFaces, divisions_of
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.geometry.polygons import Polygons, merge_polygons
from hexmend_app.scene.geometry.skin import Faces, Skin
from hexmend_app.scene.layers.invalid_outline import InvalidOutline
from hexmend_app.scene.layers.shaded_surface import MANY, decimated, shaded_surface
from hexmend_app.scene.layers.surface import Surface


class MeshLayer:
    """Draws the shown hexes of a mesh.

    Attributes
    ----------
    faces : Faces
        Visible faces before a smooth cut.
    whole : pyvista.PolyData
        Polygons of `faces`; curved faces are divided into quads.
    skin, section : Surface
        Skin that a smooth cut leaves, and sections of the cut.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self.skin, self.section = Surface(pane.renderer, pixel_ratio), Surface(pane.renderer, pixel_ratio)
        self._outlines = [(s, InvalidOutline(pane.renderer, pixel_ratio)) for s in (self.skin, self.section)]
        self._coarse: pv.PolyData | None = None  # decimated skin, drawn while the camera moves
        self._steady = False  # True if only the camera has moved since the last fine frame
        self._shading = True
        self._scene: Polygons | None = None  # all drawn polygons; None before their first fine frame
        self._lit: tuple[Polygons, np.ndarray] | None = None  # polygons, and the ambient light at their corners
        self.faces: Faces | None = None
        self._curved: CurvedFaces | None = None  # curved faces; None for flat ones

    def set_mesh(self, mesh: Mesh) -> None:
        """Replace the mesh; `rebuild` draws it."""
        self._skin = Skin(mesh)

    def hide(self) -> None:
        """Hide the hexes."""
        self._scene, self._coarse = None, None
        for surface, outline in self._outlines:
            surface.hide()
            outline.hide()

    def rebuild(self, frame: Frame, keep: np.ndarray | None, colours: HexColours) -> None:
        """Find the visible faces again, and draw them.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            True for hexes shown whole or in part; None for all.
        colours : HexColours
            Colours of the hexes of the frame.
        """
        for surface in (self.skin, self.section):
            surface.show_edges(frame.look.lines.shown)
        faces = self.faces = self._visible(frame, keep)
        self._opened = self._skin.opened(faces, keep) if frame.look.colours.neutral else None
        face_colours = colours.of(faces.hexes, self._opened)
        divisions = divisions_of(len(faces.quads)) if frame.curved else 1
        self._curved = CurvedFaces(frame.mesh, faces, divisions) if divisions > 1 else None
        if self._curved is None:
            self.whole = quads(faces.places(frame.mesh.points), faces.quads, face_colours, faces.hexes)
        else:
            self.whole = self._curved.quads(frame.mesh.points, face_colours)
        self._draw(frame, keep, colours)

    def move(self, frame: Frame, keep: np.ndarray | None, colours: HexColours) -> None:
        """Update positions and colours of the same faces; parameters are those of `rebuild`."""
        points, face_colours = frame.mesh.points, colours.of(self.faces.hexes, self._opened)
        if self._curved is None:
            set_points(self.whole, self.faces.places(points))
            set_colours(self.whole, face_colours)
        else:
            self._curved.move(self.whole, points, face_colours)
        self._draw(frame, keep, colours)

    def _visible(self, frame: Frame, keep: np.ndarray | None) -> Faces:
        look = frame.look
        if look.show.shrink and not look.cut.smooth:
            return self._skin.shrunk(look.show.shrink, keep)
        return self._skin.visible(keep)

    def _draw(self, frame: Frame, keep: np.ndarray | None, colours: HexColours) -> None:
        self._steady, self._coarse, self._scene = False, None, None
        self._shading = frame.look.page.shading
        for surface in (self.skin, self.section):
            surface.show_proxy(None)
            surface.divide_edges(self._divisions)
        # Back faces take a third of the frame time, but invalid hexes may turn them towards the viewer.
        invalid = frame.quality.n_invalid > 0
        self.skin.actor.GetProperty().SetBackfaceCulling(not invalid)
        self._replace(frame, keep, colours)
        for surface, outline in self._outlines:
            if surface.shown and invalid:
                outline.outline(surface.poly, self._divisions)
            else:
                outline.hide()

    def _replace(self, frame: Frame, keep: np.ndarray | None, colours: HexColours) -> None:
        if not frame.look.cut.smooth:
            if self.skin.poly is not self.whole:
                self.skin.replace(self.whole)
            self.section.hide()
            return
        self.skin.replace(remaining_skin(self.whole, frame.look.cut))
        mesh, cut, of_hexes = frame.mesh, frame.look.cut, colours.of(slice(None))
        divisions = None if self._curved is None else self._divisions
        self.section.replace(sections(mesh, keep, cut, of_hexes, divisions))

    def turn(self, views: int) -> None:
        """Draw a large skin coarsely while only the camera moves; `views` is the number of views in the window."""
        if not self._steady or self.skin.poly is not self.whole or self.whole.n_cells * views <= MANY:
            return
        if self._coarse is None:
            self._coarse = decimated(self.whole)
        self.skin.show_proxy(self._coarse)

    @property
    def _divisions(self) -> int:
        """Number of parts into which the edges of faces are divided."""
        return 1 if self._curved is None else self._curved.divisions

    # Fine frames and their shading

    def come_to_rest(self) -> None:
        """Draw a fine frame; after it, the skin may be coarse while only the camera moves."""
        self.show_fine()
        self._steady = True

    def show_fine(self) -> None:
        """Draw a fine frame, with the shading if it has been computed."""
        if self._scene is None:
            parts = [Polygons.of(surface.poly) for surface in self._shown]
            self._scene = merge_polygons(parts) if parts else Polygons.of(pv.PolyData())
            self._refine()
        for surface in self._shown:
            surface.divide_edges(self._divisions)
            surface.show_fine()

    @property
    def _shown(self) -> list[Surface]:
        return [surface for surface in (self.skin, self.section) if surface.shown]

    @property
    def light(self) -> np.ndarray | None:
        """Ambient light at the corners of the drawn polygons; None if it is unknown or switched off."""
        if not self._shading or self._lit is None or self._scene is None:
            return None
        scene, light = self._lit
        return light if scene.same(self._scene) else None

    def _refine(self) -> None:
        light, begin = self.light, 0
        for surface in self._shown:
            end = begin + surface.corners
            surface.refine(shaded_surface(surface.poly, None if light is None else light[begin:end]))
            begin = end

    @property
    def needs_shading(self) -> Polygons | None:
        """Polygons of a fine frame whose shading must be computed; None if there are none."""
        if self._scene is None or not self._shading or self.light is not None:
            return None
        return self._scene

    def draws(self, scene: Polygons) -> bool:
        """Return True if these polygons are drawn; may be called from any thread."""
        return scene is self._scene

    def apply_shading(self, scene: Polygons, light: np.ndarray) -> bool:
        """Set the ambient light at the corners of polygons, (c,) float64; return False if they are no longer drawn."""
        if not self.draws(scene):
            return False
        self._lit, self._coarse = (scene, light), None
        self._refine()
        return True

    def visible_nodes(self, mesh: Mesh) -> np.ndarray:
        """Return True for nodes of visible faces and of hexes cut by a plane, (n,) bool."""
        nodes = np.zeros(mesh.n_nodes, bool)
        nodes[self.faces.nodes] = True
        if self.section.shown:
            nodes[mesh.elements[hexes_of(self.section.poly)]] = True
        return nodes

    @property
    def places(self) -> np.ndarray:
        """Points of all drawn polygons, (k, 3)."""
        points = [np.asarray(surface.poly.points) for surface in self._shown]
        return np.concatenate(points) if points else np.empty((0, 3))
