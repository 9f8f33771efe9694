"""The boundary as it was when the mesh was opened: see-through, behind what the mesh has become."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.scene.filters import same_mask
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.layers.flat import flat_actor
from hexmend_app.scene.palette import ORIGINAL, rgb

#: How strongly it is drawn. It has one colour and no light, so that it does not matter which face is drawn first.
_FACES, _EDGES = 0.22, 0.55

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
        self.poly = pv.PolyData()
        self._actors = flat_actor(renderer, opacity=_FACES), flat_actor(renderer, pen, _EDGES)
        for actor in self._actors:
            mapper = actor.GetMapper()
            mapper.SetResolveCoincidentTopologyToPolygonOffset()
            mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, _FACES_BEHIND)
            mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, _EDGES_BEHIND)
        self.set_dark(False)

    @property
    def shown(self) -> bool:
        """Whether it is drawn."""
        return bool(self._actors[0].GetVisibility())

    @property
    def places(self) -> np.ndarray:
        """Its corners, (k, 3); none where it is not drawn."""
        return np.asarray(self.poly.points) if self.shown else np.empty((0, 3))

    def set_dark(self, dark: bool) -> None:
        """Draw for the dark ground, or for the light one."""
        for actor in self._actors:
            actor.GetProperty().SetColor(rgb(ORIGINAL.of(dark)))

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
        for actor in self._actors:
            actor.SetVisibility(on and self.poly.n_cells > 0)

    def _take(self, points: np.ndarray, faces: np.ndarray) -> None:
        if not len(faces):
            self.poly = pv.PolyData()
            return
        nodes, quads = np.unique(faces, return_inverse=True)
        quads = quads.reshape(faces.shape)
        self.poly = pv.PolyData.from_regular_faces(points[nodes], quads)
        edges = np.unique(np.sort(np.stack([quads, np.roll(quads, 1, axis=1)], axis=-1).reshape(-1, 2), axis=1), axis=0)
        lines = pv.PolyData()
        lines.SetPoints(self.poly.GetPoints())
        lines.lines = np.column_stack([np.full(len(edges), 2), edges]).ravel()
        for actor, poly in zip(self._actors, (self.poly, lines), strict=True):
            actor.GetMapper().SetInputData(poly)
