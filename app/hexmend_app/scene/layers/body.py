"""The elements of one view: their skin, the section of a smooth cut, and the outlines of what is inverted."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh.mesh import Mesh
from hexmend_app.scene.cutting import cut
from hexmend_app.scene.cutting.polygons import Polygons, together
from hexmend_app.scene.element_colours import ElementColours
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.layers.coarse import MANY, coarse
from hexmend_app.scene.layers.fine import fine, shaded
from hexmend_app.scene.layers.halo import Halo
from hexmend_app.scene.layers.surface import Surface, colours_of, hexes_of, quads, recoloured, set_colours, set_points
from hexmend_app.scene.pane import Pane
from hexmend_app.scene.skin import Faces, Skin

#: Inverted elements that are outlined in every frame.
_MANY = 1000


class Body:
    """Draws the elements that are left of a mesh.

    Attributes
    ----------
    faces : Faces
        In sight, before a smooth cut.
    whole : pyvista.PolyData
        These faces as they are drawn.
    skin, section : Surface
        What a smooth cut leaves of them, and what is seen in its planes.

    Parameters
    ----------
    pane : Pane
    pen : float
        How many pixels wide a thin line is.
    """

    def __init__(self, pane: Pane, pen: float = 1.0):
        self.skin, self.section = Surface(pane.renderer, pen), Surface(pane.renderer, pen)
        self._halos = [(surface, Halo(pane.renderer, pen)) for surface in (self.skin, self.section)]
        self._coarse: pv.PolyData | None = None  # of the skin, drawn while the camera moves
        self._steady = False  # nothing but the camera has moved since the last fine frame
        self._shading = True
        self._scene: Polygons | None = None  # all that stands in the light; None before the first fine frame of it
        self._lit: tuple[Polygons, np.ndarray] | None = None  # a scene, and what reaches its corners
        self.fast = False
        self.faces: Faces | None = None

    def set_mesh(self, mesh: Mesh) -> None:
        """Take another mesh; `rebuild` draws it."""
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
        """Draw the same faces elsewhere and in other colours; parameters are those of `rebuild`."""
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
            surface.stand_in(None)
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
        """Outline inverted elements; where they are many, in fine frames alone: they cost half of a fast one."""
        for surface, halo in self._halos:
            if surface.shown and 0 < self._inverted <= (_MANY if self.fast else self._inverted):
                halo.follow(surface.poly)
            else:
                halo.hide()

    def turn(self, views: int) -> None:
        """Draw a large skin coarsely, where nothing but the camera moves; frames are of so many views like this."""
        if self._steady and self.skin.poly is self.whole and len(self.faces.quads) * views > MANY:
            if self._coarse is None:
                self._coarse = self._coarsened()
            self.skin.stand_in(self._coarse)

    def _coarsened(self) -> pv.PolyData:
        light = self.light
        if light is None:
            return coarse(self.whole)
        of_faces = light[: self.skin.corners].reshape(-1, 4).mean(axis=1)
        return coarse(recoloured(self.whole, shaded(colours_of(self.whole), of_faces)))

    # Fine frames, and the light in them

    def come_to_rest(self) -> None:
        """Draw what is shown as it is, and coarsely from now on while the camera turns."""
        self.show_fine()
        self._steady = True

    def show_fine(self) -> None:
        """Draw what is shown as it is, under the light that is known to reach it."""
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
        """What reaches the corners of the scene; None where that is not known, or not wanted."""
        if not self._shading or self._lit is None or self._scene is None:
            return None
        scene, light = self._lit
        return light if scene.same(self._scene) else None

    def _refine(self) -> None:
        light, begin = self.light, 0
        for surface in self._shown:
            end = begin + surface.corners
            surface.refine(fine(surface.poly, None if light is None else light[begin:end]))
            begin = end

    @property
    def unlit(self) -> Polygons | None:
        """What stands in a fine frame without the light that is wanted; None where there is nothing to work out."""
        if self._scene is None or not self._shading or self.light is not None:
            return None
        return self._scene

    def draws(self, scene: Polygons) -> bool:
        """Whether it is this scene that is drawn; any thread may ask."""
        return scene is self._scene

    def shine(self, scene: Polygons, light: np.ndarray) -> bool:
        """Take the light that reaches the corners of a scene, (c,) float64; False where it is no longer drawn."""
        if not self.draws(scene):
            return False
        self._lit, self._coarse = (scene, light), None
        self._refine()
        return True

    def nodes_in_sight(self, mesh: Mesh) -> np.ndarray:
        """True for nodes of faces that are seen, and of elements that are cut through, (n,) bool."""
        nodes = np.zeros(mesh.n_nodes, bool)
        nodes[self.faces.nodes] = True
        if self.section.shown:
            nodes[mesh.hexes[hexes_of(self.section.poly)]] = True
        return nodes

    @property
    def places(self) -> np.ndarray:
        """The corners of all that is drawn, (k, 3); none where nothing is left."""
        drawn = [np.asarray(one.poly.points) for one in (self.skin, self.section) if one.shown]
        return np.concatenate(drawn) if drawn else np.empty((0, 3))
