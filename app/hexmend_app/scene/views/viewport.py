"""The 3D view of one mesh, in a pane of a window, on or off screen."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

from hexmend_app.scene.camera.camera_controller import CameraController
from hexmend_app.scene.camera.fitting import bounds_of
from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.scene.colour.hex_colours import ElementColours
from hexmend_app.scene.geometry import occlusion
from hexmend_app.scene.geometry.filters import Filters, same_mask
from hexmend_app.scene.layers.axes import AxesLayer
from hexmend_app.scene.layers.extra_layers import ExtraLayers, raise_error
from hexmend_app.scene.layers.mesh import MeshLayer
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane
from hexmend_app.scene.views.picking import Hit, Picker
from hexmend_app.theme.palette import BACKGROUND


class Viewport:
    """Draws frames of a mesh: its skin, coloured by quality, cut and filtered as the look says.

    Nothing is rendered here: the caller does, once for several changes.

    Attributes
    ----------
    frame : Frame or None
        The drawn frame.
    filters : Filters
        Selection of the shown hexes.
    colours : ElementColours
    body : MeshLayer
    extras : ExtraLayers
        Layers besides the hexes.

    Parameters
    ----------
    pane : Pane
    axes : bool
        Draw the axes in a corner.
    filters : Filters, optional
        Filters of another view, which apply here too if the mesh has the same hexes.
    pixel_ratio : float
        Width of a thin line, in pixels.
    on_failure : callable, optional
        Called with the exception of a layer that fails, which is then left out; without it, the exception is raised.
    """

    def __init__(
        self,
        pane: Pane,
        axes: bool = True,
        filters: Filters | None = None,
        pixel_ratio: float = 1.0,
        on_failure: Callable[[Exception], object] = raise_error,
    ):
        self._pane = pane
        self.frame: Frame | None = None
        self.filters = filters
        self._fast = False
        pane.window.SetMultiSamples(0)
        self.colours = ElementColours()
        self.body = MeshLayer(pane, pixel_ratio)
        self.extras = ExtraLayers(pane, pixel_ratio, on_failure)
        self._picker = Picker(pane, (self.body.skin, self.body.section))
        self.axes = AxesLayer(pane, pixel_ratio) if axes else None
        self.set_dark(False)

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme, which pictures in reports have."""
        self._pane.set_background(BACKGROUND.of(dark))
        if self.axes is not None:
            self.axes.set_dark(dark)
        self.extras.set_dark(dark)

    def set_ground(self, colour: str) -> None:
        """Set a background colour, #rrggbb, other than that of the theme."""
        self._pane.set_background(colour)

    # What is drawn

    def draw(self, frame: Frame) -> None:
        """Draw a frame; work that it shares with the last one is not repeated.

        If the hexes of another mesh cannot be drawn, nothing is drawn; the previous mesh does not remain.
        """
        another = not frame.is_of(self.frame)
        try:
            self._draw(frame, another)
        except Exception:
            if another:
                self.clear()
            raise

    def clear(self) -> None:
        """Draw no mesh."""
        self.frame = self.filters = self.colours.colouring = None
        self.body.hide()
        self.extras.hide()

    def _draw(self, frame: Frame, another: bool) -> None:
        last, self.frame = self.frame, frame
        moved = another or frame.mesh.points is not last.mesh.points or frame.figures is not last.figures
        pinned = not another and frame.mesh.pinned is not last.mesh.pinned
        classed = another or frame.kinds is not last.kinds
        looked = another or frame.look != last.look
        measured = moved or frame.movement is not last.movement or not frame.look.coloured_as(last.look)
        if another:
            self._take_mesh()
        self.extras.update(frame, moved and not another, pinned, classed)
        if measured:
            self.colours.measure(frame)
        keep = self.kept()
        self.extras.draw_optional(frame, keep)
        if looked or not same_mask(keep, self._keep):
            self._keep = keep
            self._rebuild()
        elif measured or pinned or classed:
            self._move()

    def _take_mesh(self) -> None:
        self.extras.set_mesh(self.frame)
        mesh = self.frame.mesh
        if self.filters is None or not self.filters.suit(mesh):
            self.filters = Filters(mesh)
        self.body.set_mesh(mesh)

    def _rebuild(self) -> None:
        """Find the visible faces anew."""
        self.body.rebuild(self.frame, self._keep, self.colours)
        self.extras.rebuild(self.frame, self._keep, self.body, self.filters.ghosts)

    def _move(self) -> None:
        """Update positions and colours of the same faces."""
        self.body.move(self.frame, self._keep, self.colours)
        self.extras.move(self.frame, self._keep, self.body)

    def span(self, neighbour: tuple[float, float] | None) -> None:
        """Extend a fitted colour range to values of other views."""
        if self.colours.span(neighbour):
            self._move()

    # Which elements are shown

    def kept(self) -> np.ndarray | None:
        """Return the hexes that are shown whole or in part, (m,) bool; None for all."""
        return None if self.frame is None else self.filters.kept(self.frame)

    def left(self) -> np.ndarray | None:
        """Return the hexes that remain visible after a smooth cut, (m,) bool; None for all."""
        return None if self.frame is None else self.filters.left(self.frame)

    @property
    def shown(self) -> int:
        """Number of hexes that are shown whole or in part, before a smooth cut; 0 where none is drawn."""
        if self.frame is None:
            return 0
        keep = self.kept()
        return self.frame.mesh.n_hexes if keep is None else int(np.count_nonzero(keep))

    @property
    def colouring(self) -> Colouring | None:
        """The colouring of the mesh; None before there is one."""
        return self.colours.colouring

    # What is pointed at

    def pick(self, x: float, y: float) -> Hit | None:
        """Pick at a position in pixels of the picture, from its lower left corner; None outside the mesh."""
        if self.frame is None:
            return None
        self._set_fast(False)  # what is drawn coarsely, or without its sides, is not what is pointed at
        self.body.show_fine()
        return self._picker.pick(x, y, self.frame.mesh)

    # From where it is seen

    @property
    def camera(self) -> vtkCamera:
        """The camera."""
        return self._pane.camera

    @property
    def bounds(self) -> tuple[float, float, float, float, float, float]:
        """x low, x high, y low, y high, z low, z high of the mesh, without unused nodes."""
        return bounds_of(self.frame.mesh.points[self.frame.mesh.topology.used])

    @property
    def places(self) -> np.ndarray:
        """Points that a fitted camera includes, (k, 3): of everything shown, or else of the mesh."""
        places = np.concatenate([self.body.places, self.extras.places])
        mesh = self.frame.mesh
        return places if len(places) else mesh.points[mesh.topology.used]

    def view(self, direction: str | tuple[float, float, float]) -> None:
        """Show the mesh from a direction: a name of `VIEWS`, or a vector, with z up if possible."""
        CameraController.of(self).look_along(direction)

    # Fast frames and fine ones

    def moving(self) -> None:
        """Prepare for fast frames."""
        self._pane.window.SetMultiSamples(0)
        self._set_fast(True)

    def turning(self, views: int = 1) -> None:
        """Prepare for fast frames in which only the camera moves; a frame consists of `views` views."""
        self.moving()
        if self.frame is not None:
            self.body.turn(views)

    def still(self) -> None:
        """Prepare for a fine frame, with smooth edges."""
        self._pane.window.SetMultiSamples(4)
        self._set_fast(False)
        self.body.come_to_rest()

    def shade(self) -> None:
        """Compute the shading of a fine frame in this thread, if it is switched on and unknown."""
        scene = self.body.needs_shading
        if scene is not None:
            self.body.apply_shading(scene, occlusion.light(scene))

    def _set_fast(self, fast: bool) -> None:
        if fast == self._fast:
            return
        self._fast = self.body.fast = fast
        self.extras.set_fast(fast)
        if self.frame is None:
            return
        if self.body.faces.many:
            self._rebuild()
        else:
            self.body.outline_inverted()

    @property
    def layers(self) -> tuple[vtkRenderer, ...]:
        """The renderers of this view, from the bottom up."""
        return self._pane.renderer, *self.extras.renderers

    def close(self) -> None:
        """Remove the view from the window."""
        for layer in self.layers:
            layer.RemoveObservers("StartEvent")
            self._pane.window.RemoveRenderer(layer)
