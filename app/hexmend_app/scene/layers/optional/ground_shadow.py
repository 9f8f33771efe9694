"""A faint, soft shadow on the ground below the shown hexes."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTexture

from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.cut import Cut
from hexmend_app.scene.cutting.cut import remaining_hexes
from hexmend_app.scene.geometry.filters import same_mask
from hexmend_app.scene.geometry.footprint import footprint
from hexmend_app.scene.layers.flat_actor import flat_actor
from hexmend_app.scene.layers.optional_layer import LegendEntry, OptionalLayer, layer
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane

#: Opacity of the darkest part in the light and in the dark theme.
_OPACITY = {False: 0.2, True: 0.42}

#: Distance of the ground from the lowest point, as a fraction of the diagonal of the shown hexes.
_GAP = 0.015

#: Maximum number of hexes whose shadow is computed; of more hexes, every so many are taken.
_MAX_HEXES = 20_000

#: Smallest cosine of the angle between the vertical axis and the up direction of the picture: below, it is upside down.
_LEAST_UP = -0.05


@layer(
    "shadow",
    title="Ground shadow",
    help="A faint shadow on the ground below the mesh. Films and pictures on white or without a background omit it.",
    empty="None in this mesh.",
    action="&Ground shadow",
    order=99,
    offered_early=True,
    decorative=True,
)
class GroundShadow(OptionalLayer):
    """Draws a blurred projection of the shown hexes onto a plane below them.

    It is computed for fine frames only, in about 20 ms. Fast frames show it while the camera alone moves; while nodes
    move it would be outdated, and take 2 ms of each frame. There is none if the camera is below the ground or upside
    down.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self._pane = pane
        self._frame: Frame | None = None
        self._keep: np.ndarray | None = None
        self._drawn: tuple | None = None  # points, axis, smooth cut and mask of the shadow
        self._fast = False
        self._ground, self._up = np.zeros(3), np.zeros(3)
        self._actor = flat_actor(pane.renderer)
        self._actor.ForceTranslucentOn()
        self._actor.UseBoundsOff()  # the clipping range, and with it offsets of depth, stay those of the mesh
        self._texture = vtkTexture()
        self._texture.InterpolateOn()
        self._texture.RepeatOff()
        self._actor.SetTexture(self._texture)
        self._actor.GetProperty().SetColor(0.0, 0.0, 0.0)
        self.set_dark(False)
        pane.renderer.AddObserver("StartEvent", self._prepare)

    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw the shadow of the shown hexes of a frame in the next fine frame."""
        self._frame, self._keep = frame, keep

    def hide(self) -> None:
        """Hide the shadow."""
        self._frame = self._keep = self._drawn = None
        self._actor.VisibilityOff()

    def set_dark(self, dark: bool) -> None:
        """Use the opacity of the dark or of the light theme."""
        self._actor.GetProperty().SetOpacity(_OPACITY[dark])

    def set_fast(self, fast: bool) -> None:
        """Compute no shadow for fast frames."""
        self._fast = fast

    @classmethod
    def legend(cls, mesh: Mesh) -> list[LegendEntry]:
        """Return an entry without a mark."""
        return [(None, False, "")]

    def _prepare(self, *_: object) -> None:
        """Update the shadow before a fine frame, and hide it from below."""
        if self._frame is None:
            return
        axis = "xyz".index(self._pane.up)
        if not self._fast and not self._is_drawn(axis):
            self._drawn = self._frame.mesh.points, axis, self._smooth_cut, self._keep
            self._update(axis)
        self._actor.SetVisibility(self._is_drawn(axis) and self._is_seen())

    @property
    def _smooth_cut(self) -> Cut | None:
        """The cut if it is smooth: the mask contains the hexes that it cuts away."""
        cut = self._frame.look.cut
        return cut if cut.smooth else None

    def _is_drawn(self, axis: int) -> bool:
        if self._drawn is None:
            return False
        points, *others, keep = self._drawn
        return points is self._frame.mesh.points and others == [axis, self._smooth_cut] and same_mask(keep, self._keep)

    def _is_seen(self) -> bool:
        camera = self._pane.camera
        above = (np.array(camera.GetPosition()) - self._ground) @ self._up
        return bool(above > 0 and np.array(camera.GetViewUp()) @ self._up > _LEAST_UP)

    def _update(self, axis: int) -> None:
        mesh = self._frame.mesh
        keep = np.ones(mesh.n_hexes, bool) if self._keep is None else self._keep
        if self._smooth_cut is not None:
            keep = keep & remaining_hexes(mesh.points, mesh.hexes, self._smooth_cut)
        numbers = np.flatnonzero(keep)
        hexes = mesh.hexes[numbers[:: -(-len(numbers) // _MAX_HEXES) or 1]]
        if not len(hexes):
            self._drawn = None
            return
        image, low, high = footprint(mesh.points, hexes, axis)
        shown = mesh.points[hexes.ravel()]
        lowest = shown[:, axis].min()
        if self._keep is None and self._smooth_cut is None:
            lowest = mesh.points[mesh.topology.boundary, axis].min(initial=lowest)
        level = lowest - _GAP * np.linalg.norm(np.ptp(shown, axis=0))
        across = [k for k in range(3) if k != axis]
        corners = np.full((4, 3), level)
        corners[:, across[0]] = low[0], high[0], high[0], low[0]
        corners[:, across[1]] = low[1], low[1], high[1], high[1]
        self._ground, self._up = corners[0], np.eye(3)[axis]
        quad = pv.PolyData.from_regular_faces(corners, np.arange(4)[None])
        quad.GetPointData().SetTCoords(numpy_to_vtk(np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32), deep=True))
        self._actor.GetMapper().SetInputData(quad)
        self._texture.SetInputData(_black(image))


def _black(opacity: np.ndarray) -> vtkImageData:
    """Return a black image with an opacity, (n, n) float64 from 0 to 1, whose rows are along the second axis."""
    n = len(opacity)
    pixels = np.zeros((n * n, 4), np.uint8)
    pixels[:, 3] = np.rint(255 * opacity).ravel()
    image = vtkImageData()
    image.SetDimensions(n, n, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels, deep=True))
    return image
