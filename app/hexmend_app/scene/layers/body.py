"""The elements of one view: their skin, the section of a smooth cut, and the outlines of what is inverted."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh import Mesh
from hexmend_app.scene.cutting import cut
from hexmend_app.scene.element_colours import ElementColours
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.layers.coarse import MANY, coarse
from hexmend_app.scene.layers.halo import Halo
from hexmend_app.scene.layers.surface import Surface, hexes_of, quads, set_colours, set_points
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
    plotter : pyvista.BasePlotter or Pane
    """

    def __init__(self, plotter: pv.BasePlotter | Pane):
        self.skin, self.section = Surface(plotter, "skin"), Surface(plotter, "section")
        self._halos = (
            (self.skin, Halo(plotter, "halo of skin")),
            (self.section, Halo(plotter, "halo of section")),
        )
        self._coarse: pv.PolyData | None = None  # of the skin, drawn while the camera moves
        self._steady = False  # nothing but the camera has moved since the last fine frame
        self.fast = False
        self.faces: Faces | None = None

    def set_mesh(self, mesh: Mesh) -> None:
        """Take another mesh; `rebuild` draws it."""
        self._skin = Skin(mesh)

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
        self.whole = quads(faces.places(frame.mesh.points), faces.quads, colours.of(faces.hexes), faces.hexes)
        self._draw(frame, keep, colours)

    def move(self, frame: Frame, keep: np.ndarray | None, colours: ElementColours) -> None:
        """Draw the same faces elsewhere and in other colours; parameters are those of `rebuild`."""
        set_points(self.whole, self.faces.places(frame.mesh.points))
        set_colours(self.whole, colours.of(self.faces.hexes))
        self._draw(frame, keep, colours)

    def _visible(self, frame: Frame, keep: np.ndarray | None) -> Faces:
        look = frame.look
        if look.shrink and (look.clip is None or look.clip.crinkle):
            return self._skin.shrunk(look.shrink, keep, fine=not self.fast)
        return self._skin.visible(keep)

    def _draw(self, frame: Frame, keep: np.ndarray | None, colours: ElementColours) -> None:
        self._steady, self._coarse = False, None
        self.skin.stand_in(None)
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
                self._coarse = coarse(self.whole)
            self.skin.stand_in(self._coarse)

    def come_to_rest(self) -> None:
        """Draw the skin as it is, and coarsely from now on while the camera turns."""
        self.show_fine()
        self._steady = True

    def show_fine(self) -> None:
        """Draw the skin as it is."""
        self.skin.stand_in(None)

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
