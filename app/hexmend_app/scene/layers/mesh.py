"""The hexes of one view: skin, section of a smooth cut, and outlines of inverted hexes."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh.mesh import Mesh
from hexmend_app.scene.colour.hex_colours import ElementColours
from hexmend_app.scene.cutting import cut
from hexmend_app.scene.cutting.polygons import Polygons, together
from hexmend_app.scene.geometry.decimated_surface import MANY, decimated
from hexmend_app.scene.geometry.shaded_surface import shaded, shaded_surface
from hexmend_app.scene.geometry.skin import Faces, Skin
from hexmend_app.scene.layers.inverted_outline import InvertedOutline
from hexmend_app.scene.layers.surface import Surface, colours_of, hexes_of, quads, recoloured, set_colours, set_points
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane

#: Inverted elements that are outlined in every frame.
_MANY = 1000


class MeshLayer:
    """Draws the shown hexes of a mesh.

    Attributes
    ----------
    faces : Faces
        In sight, before a smooth cut.
    whole : pyvista.PolyData
        These faces as they are drawn.
    skin, section : Surface
        Remaining skin and sections of a smooth cut.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self.skin, self.section = Surface(pane.renderer, pixel_ratio), Surface(pane.renderer, pixel_ratio)
        self._halos = [(surface, InvertedOutline(pane.renderer, pixel_ratio)) for surface in (self.skin, self.section)]
        self._coarse: pv.PolyData | None = None  # of the skin, drawn while the camera moves
        self._steady = False  # nothing but the camera has moved since the last fine frame
        self._shading = True
        self._scene: Polygons | None = None  # all that stands in the light; None before the first fine frame of it
        self._lit: tuple[Polygons, np.ndarray] | None = None  # a scene, and what reaches its corners
        self.fast = False
        self.faces: Faces | None = None

    def set_mesh(self, mesh: Mesh) -> None:
        """Replace the mesh; `rebuild` draws it."""
        self._skin = Skin(mesh)

    def hide(self) -> None:
        """Draw nothing."""
        self._scene, self._coarse = None, None
        for surface, halo in self._halos:
            surface.hide()
            halo.hide()

    def rebuild(self, frame: Frame, keep: np.ndarray | None, colours: ElementColours) -> None:
        """Find the visible faces anew.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            Hexes that are shown, in whole or in part; None for all.
        colours : ElementColours
            Of the frame.
        """
        for surface in (self.skin, self.section):
            surface.show_edges(frame.look.edges)
        faces = self.faces = self._visible(frame, keep)
        self._opened = self._skin.opened(faces, keep) if frame.look.neutral else None
        coloured = colours.of(faces.hexes, self._opened)
        self.whole = quads(faces.places(frame.mesh.points), faces.quads, coloured, faces.hexes)
        self._draw(frame, keep, colours)

    def move(self, frame: Frame, keep: np.ndarray | None, colours: ElementColours) -> None:
        """Update positions and colours of the same faces; parameters are those of `rebuild`."""
        set_points(self.whole, self.faces.places(frame.mesh.points))
        set_colours(self.whole, colours.of(self.faces.hexes, self._opened))
        self._draw(frame, keep, colours)

    def _visible(self, frame: Frame, keep: np.ndarray | None) -> Faces:
        look = frame.look
        if look.shrink and (look.clip is None or look.clip.crinkle):
            return self._skin.shrunk(look.shrink, keep, fine=not self.fast)
        return self._skin.visible(keep)

    def _draw(self, frame: Frame, keep: np.ndarray | None, colours: ElementColours) -> None:
        self._steady, self._coarse, self._scene = False, None, None
        self._shading = frame.look.shading
        for surface in (self.skin, self.section):
            surface.show_proxy(None)
        # Faces seen from behind are a third of the frame, but an inverted element may turn them to us.
        self._inverted = frame.figures.n_inverted
        self.skin.cull(self._inverted == 0)
        self._replace(frame, keep, colours)
        self.outline_inverted()

    def _replace(self, frame: Frame, keep: np.ndarray | None, colours: ElementColours) -> None:
        clip = frame.look.clip
        if clip is None or clip.crinkle:
            if self.skin.poly is not self.whole:
                self.skin.replace(self.whole)
            self.section.hide()
            return
        self.skin.replace(cut.behind(self.whole, clip))
        mesh, every = frame.mesh, colours.of(slice(None))
        self.section.replace(cut.sections(mesh.points, mesh.hexes, keep, clip, every))

    def outline_inverted(self) -> None:
        """Outline inverted hexes; many of them only in fine frames, as outlines cost half of a fast frame."""
        for surface, halo in self._halos:
            if surface.shown and 0 < self._inverted <= (_MANY if self.fast else self._inverted):
                halo.follow(surface.poly)
            else:
                halo.hide()

    def turn(self, views: int) -> None:
        """Draw a large skin coarsely while only the camera moves; a frame consists of several views."""
        if self._steady and self.skin.poly is self.whole and len(self.faces.quads) * views > MANY:
            if self._coarse is None:
                self._coarse = self._coarsened()
            self.skin.show_proxy(self._coarse)

    def _coarsened(self) -> pv.PolyData:
        light = self.light
        if light is None:
            return decimated(self.whole)
        of_faces = light[: self.skin.corners].reshape(-1, 4).mean(axis=1)
        return decimated(recoloured(self.whole, shaded(colours_of(self.whole), of_faces)))

    # Fine frames, and the light in them

    def come_to_rest(self) -> None:
        """Draw a fine frame; from now on the skin may be coarse while the camera turns."""
        self.show_fine()
        self._steady = True

    def show_fine(self) -> None:
        """Draw a fine frame, with the shading that is known."""
        if self._scene is None:
            drawn = [Polygons.of(surface.poly) for surface in self._shown]
            self._scene = together(drawn) if drawn else Polygons.of(pv.PolyData())
            self._refine()
        for surface in self._shown:
            surface.show_fine()

    @property
    def _shown(self) -> list[Surface]:
        return [surface for surface in (self.skin, self.section) if surface.shown]

    @property
    def light(self) -> np.ndarray | None:
        """Ambient light at the corners of the scene; None if it is unknown, or switched off."""
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
        """The polygons of a fine frame that lack shading; None if there is nothing to compute."""
        if self._scene is None or not self._shading or self.light is not None:
            return None
        return self._scene

    def draws(self, scene: Polygons) -> bool:
        """Return True if this scene is drawn; safe from any thread."""
        return scene is self._scene

    def apply_shading(self, scene: Polygons, light: np.ndarray) -> bool:
        """Set the ambient light at the corners of a scene, (c,) float64; return False if it is no longer drawn."""
        if not self.draws(scene):
            return False
        self._lit, self._coarse = (scene, light), None
        self._refine()
        return True

    def nodes_in_sight(self, mesh: Mesh) -> np.ndarray:
        """Return True for nodes of visible faces, and of hexes that a plane cuts, (n,) bool."""
        nodes = np.zeros(mesh.n_nodes, bool)
        nodes[self.faces.nodes] = True
        if self.section.shown:
            nodes[mesh.hexes[hexes_of(self.section.poly)]] = True
        return nodes

    @property
    def places(self) -> np.ndarray:
        """Points of all drawn faces, (k, 3)."""
        drawn = [np.asarray(one.poly.points) for one in (self.skin, self.section) if one.shown]
        return np.concatenate(drawn) if drawn else np.empty((0, 3))
