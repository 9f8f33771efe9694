"""3D view of a mesh in a pane of a window, on or off screen."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

from hexmend_app.scene.camera.camera_controller import CameraController
from hexmend_app.scene.camera.fitting import bounds_of
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.scene.colour.hex_colours import HexColours
from hexmend_app.scene.cutting.filters import Filters, same_mask
from hexmend_app.scene.geometry import occlusion
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers.axes import AxesLayer
from hexmend_app.scene.layers.mesh import MeshLayer
from hexmend_app.scene.layers.overlay_layers import OverlayLayers, raise_error
from hexmend_app.scene.views.picking import Hit, Picker
from hexmend_app.theme.palette import BACKGROUND, BACKGROUND_ABOVE, BACKGROUND_BELOW


class Viewport:
    """Draws frames of a mesh: its skin, coloured, cut and filtered as specified by the look.

    Methods do not render; the caller renders once after several changes.

    Attributes
    ----------
    frame : Frame or None
        The drawn frame; None before a mesh is drawn.
    filters : Filters
        Filters that select the shown hexes.
    colours : HexColours
    mesh_layer : MeshLayer
    overlay_layers : OverlayLayers
        Layers besides the hexes.

    Parameters
    ----------
    pane : Pane
    axes : bool
        Draw the axes in a corner.
    filters : Filters, optional
        Filters of another view, reused if its mesh has the same hexes.
    pixel_ratio : float
        Width of a thin line, in pixels.
    on_failure : callable, optional
        Called with the exception of a layer that fails, which is then hidden; by default the exception is raised.
    gradient : bool
        Draw a gradient of the background in fine frames.
    """

    def __init__(
        self,
        pane: Pane,
        axes: bool = True,
        filters: Filters | None = None,
        pixel_ratio: float = 1.0,
        on_failure: Callable[[Exception], object] = raise_error,
        gradient: bool = False,
    ):
        self._pane, self._gradient = pane, gradient
        self.frame: Frame | None = None
        self.filters = filters
        self._keep: np.ndarray | None = None
        pane.window.SetMultiSamples(0)
        self.colours = HexColours()
        self.mesh_layer = MeshLayer(pane, pixel_ratio)
        self.overlay_layers = OverlayLayers(pane, pixel_ratio, on_failure)
        self._picker = Picker(pane, (self.mesh_layer.skin, self.mesh_layer.section))
        self.axes = AxesLayer(pane, pixel_ratio) if axes else None
        self.set_dark(False)

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        ends = (BACKGROUND_BELOW.of(dark), BACKGROUND_ABOVE.of(dark)) if self._gradient else None
        self._pane.set_background(BACKGROUND.of(dark), ends)
        if self.axes is not None:
            self.axes.set_dark(dark)
        self.overlay_layers.set_dark(dark)

    def set_background(self, colour: str) -> None:
        """Replace the theme's background colour by another, #rrggbb."""
        self._pane.set_background(colour)

    # Content

    def draw(self, frame: Frame) -> None:
        """Draw a frame, and update only what differs from the last frame.

        If drawing a new mesh fails, the view is cleared.
        """
        new_mesh = not frame.is_of(self.frame)
        try:
            self._draw(frame, new_mesh)
        except Exception:
            if new_mesh:
                self.clear()
            raise

    def clear(self) -> None:
        """Draw no mesh."""
        self.frame = self.filters = self.colours.colouring = None
        self.mesh_layer.hide()
        self.overlay_layers.hide()

    def _draw(self, frame: Frame, new_mesh: bool) -> None:
        last, self.frame = self.frame, frame
        moved = new_mesh or frame.mesh.points is not last.mesh.points or frame.quality is not last.quality
        restyled = new_mesh or frame.look != last.look
        recoloured = moved or frame.movement is not last.movement or frame.look.colours != last.look.colours
        if new_mesh:
            if self.filters is None or not self.filters.matches(frame.mesh):
                self.filters = Filters(frame.mesh)
            self.mesh_layer.set_mesh(frame.mesh)
        if recoloured:
            self.colours.measure(frame)
        keep = self.kept()
        if restyled or not same_mask(keep, self._keep):
            self._keep = keep
            self.mesh_layer.rebuild(frame, keep, self.colours)
        elif recoloured:
            self.mesh_layer.move(frame, keep, self.colours)
        self.overlay_layers.draw(frame, keep, self.mesh_layer, self.filters.ghosts(frame))

    def extend_range(self, ends: tuple[float, float] | None) -> None:
        """Extend a fitted colour range to these ends, the range of all views; None fits it to this view alone."""
        if self.colours.extend_range(ends):
            self.mesh_layer.move(self.frame, self._keep, self.colours)

    # Shown hexes

    def kept(self) -> np.ndarray | None:
        """Return True for hexes shown whole or in part, (m,) bool; None for all."""
        return None if self.frame is None else self.filters.kept(self.frame)

    def remaining_after_cut(self) -> np.ndarray | None:
        """Return True for shown hexes that a smooth cut leaves at least in part, (m,) bool; None for all."""
        return None if self.frame is None else self.filters.remaining_after_cut(self.frame)

    @property
    def shown(self) -> int:
        """Number of hexes shown whole or in part, before a smooth cut; 0 before a mesh is drawn."""
        if self.frame is None:
            return 0
        keep = self.kept()
        return self.frame.mesh.n_elements if keep is None else int(np.count_nonzero(keep))

    @property
    def colouring(self) -> Colouring | None:
        """Colouring of the mesh; None before a mesh is drawn."""
        return self.colours.colouring

    # Picking

    def pick(self, x: float, y: float) -> Hit | None:
        """Pick at a position in pixels of the picture, from its lower left corner; None outside the mesh."""
        if self.frame is None:
            return None
        self.mesh_layer.show_fine()
        return self._picker.pick(x, y, self.frame.mesh)

    # Camera

    @property
    def camera(self) -> vtkCamera:
        """Camera of the view."""
        return self._pane.camera

    @property
    def bounds(self) -> tuple[float, float, float, float, float, float]:
        """Bounds of the mesh without unused nodes: x low, x high, y low, y high, z low, z high."""
        return bounds_of(self.frame.mesh.points[self.frame.mesh.topology.used])

    @property
    def places(self) -> np.ndarray:
        """Points that a fitted camera includes, (k, 3): of everything shown, or of the mesh if nothing is shown.

        While a cut is outlined, they include the outline of the part that it removes, unless hexes are isolated.
        """
        places = np.concatenate([self.mesh_layer.places, self.overlay_layers.places])
        mesh, look = self.frame.mesh, self.frame.look
        outlined = look.cut.active and look.show.outline and look.show.isolate is None
        whole = mesh.points[mesh.topology.used] if outlined or not len(places) else np.empty((0, 3))
        return np.concatenate([places, whole])

    def view(self, direction: str | tuple[float, float, float]) -> None:
        """Show the mesh from a direction: a name of `DIRECTIONS`, or a vector, with z up if possible."""
        CameraController.of(self).look_along(direction)

    # Fast and fine frames

    def moving(self) -> None:
        """Prepare for fast frames."""
        self._pane.window.SetMultiSamples(0)
        self._pane.set_fast(True)

    def turning(self, views: int = 1) -> None:
        """Prepare for fast frames in which only the camera moves; the window shows `views` views."""
        self.moving()
        if self.frame is not None:
            self.mesh_layer.turn(views)

    def still(self) -> None:
        """Prepare for a fine frame, with antialiasing."""
        self._pane.window.SetMultiSamples(4)
        self._pane.set_fast(False)
        self.mesh_layer.come_to_rest()

    def shade(self) -> None:
        """Compute the shading of a fine frame in this thread, if necessary."""
        polygons = self.mesh_layer.needs_shading
        if polygons is not None:
            self.mesh_layer.apply_shading(polygons, occlusion.ambient_light(polygons))

    @property
    def layers(self) -> tuple[vtkRenderer, ...]:
        """Renderers of this view, from back to front."""
        return self._pane.renderer, *self.overlay_layers.renderers

    def close(self) -> None:
        """Remove the view from the window."""
        for layer in self.layers:
            layer.RemoveObservers("StartEvent")
            self._pane.window.RemoveRenderer(layer)
