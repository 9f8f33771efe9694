"""The boundary as it was when the mesh was opened: see-through, behind what the mesh has become."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.scene.filters import same_mask
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.layers.see_through import SeeThrough
from hexmend_app.scene.palette import ORIGINAL, rgb

#: How strongly its edges are drawn.
_EDGES = 0.55

#: How far its faces and edges are drawn behind their places, in VTK's units of depth: where the boundary is still
#: there, they are not seen.
_FACES_BEHIND, _EDGES_BEHIND = 40.0, 400.0


class Original:
    """Draws the boundary of a mesh as it was opened, wherever its nodes are now.

    Parameters
    ----------
    renderer : vtkRenderer
    pen : float
        How many pixels wide a thin line is.
    """

    def __init__(self, renderer: vtkRenderer, pen: float = 1.0):
        self._points: np.ndarray | None = None
        self._keep: np.ndarray | None = None
        self._skin = SeeThrough(renderer, pen, _EDGES)
        for actor in self._skin.actors:
            mapper = actor.GetMapper()
            mapper.SetResolveCoincidentTopologyToPolygonOffset()
            mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, _FACES_BEHIND)
            mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, _EDGES_BEHIND)
        self.set_dark(False)

    @property
    def poly(self) -> pv.PolyData:
        """What is drawn."""
        return self._skin.poly

    @property
    def shown(self) -> bool:
        """Whether it is drawn."""
        return self._skin.shown

    @property
    def places(self) -> np.ndarray:
        """Its corners, (k, 3); none where it is not drawn."""
        return self._skin.places

    def hide(self) -> None:
        """Draw nothing."""
        self._skin.show(False)

    def set_dark(self, dark: bool) -> None:
        """Draw for the dark ground, or for the light one."""
        self._skin.set_colour(rgb(ORIGINAL.of(dark)))

    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw what a frame wants of it; what is drawn already stays.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            Hexes that are shown, in whole or in part, to whose faces it is confined; None for all.
        """
        on = frame.look.structure.original and frame.original is not None
        if on and (frame.original is not self._points or not same_mask(keep, self._keep)):
            self._points, self._keep = frame.original, keep
            topology = frame.mesh.topology
            hexes = np.nonzero(topology.face_neighbours < 0)[0]
            self._take(frame.original, topology.boundary_faces[slice(None) if keep is None else keep[hexes]])
        self._skin.show(on)

    def _take(self, points: np.ndarray, faces: np.ndarray) -> None:
        if not len(faces):
            self._skin.take(pv.PolyData(), pv.PolyData())
            return
        nodes, quads = np.unique(faces, return_inverse=True)
        quads = quads.reshape(faces.shape)
        poly = pv.PolyData.from_regular_faces(points[nodes], quads)
        edges = np.unique(np.sort(np.stack([quads, np.roll(quads, 1, axis=1)], axis=-1).reshape(-1, 2), axis=1), axis=0)
        lines = pv.PolyData()
        lines.SetPoints(poly.GetPoints())
        lines.lines = np.column_stack([np.full(len(edges), 2), edges]).ravel()
        self._skin.take(poly, lines)
