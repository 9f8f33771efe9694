"""The 3D view of one mesh, in whatever plotter: a window's or one off screen."""

from __future__ import annotations

import numpy as np
import pyvista as pv

from hexmend.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.scene import cut, sides
from hexmend_app.scene.colours import Colouring, resolve
from hexmend_app.scene.fitting import fit
from hexmend_app.scene.halo import Halo
from hexmend_app.scene.skin import Skin
from hexmend_app.scene.surface import Surface, quads, set_colours, set_points
from hexmend_app.scene.values import values
from hexmend_app.state.look import Look

_BACKGROUND = "#eef1f5"  # one colour: a gradient costs software rendering a fifth of the frame
_LIGHT = (-0.12, 0.25, 1.0)  # from over the viewer's left shoulder
_OUTLINE = "#8a93a3"

#: Directions to look from: the place of the camera, and what is up.
VIEWS: dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]] = {
    "iso": ((1.0, -1.3, 0.8), (0.0, 0.0, 1.0)),
    "+x": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "-x": ((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "+y": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "-y": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    "+z": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
    "-z": ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
}


class Viewport:
    """Draws a mesh by its skin, coloured by quality, cut and filtered as a `Look` says.

    Nothing is rendered here: the caller does, once for several changes.

    Parameters
    ----------
    plotter : pyvista.BasePlotter
    """

    def __init__(self, plotter: pv.BasePlotter):
        self._plotter = plotter
        self._mesh: Mesh | None = None
        self._look = Look()
        self._colouring: Colouring | None = None
        plotter.set_background(_BACKGROUND)
        plotter.remove_all_lights()  # five lights of a kit cost twice the frame of one
        plotter.add_light(pv.Light(position=_LIGHT, focal_point=(0, 0, 0), light_type="camera light", intensity=1.0))
        plotter.render_window.SetMultiSamples(0)
        self._skin_surface = Surface(plotter, "skin")
        self._section_surface = Surface(plotter, "section")
        self._halos = [
            (surface, Halo(plotter, name))
            for surface, name in ((self._skin_surface, "halo of skin"), (self._section_surface, "halo of section"))
        ]
        self._outline = None
        plotter.add_axes(line_width=2, labels_off=False, viewport=(0, 0, 0.13, 0.18), color="#39414d")

    # What is drawn

    def set_mesh(self, mesh: Mesh, figures: ElementQuality) -> None:
        """Draw another mesh, seen whole from a corner."""
        self._mesh, self._figures, self._points = mesh, figures, mesh.points
        self._skin = Skin(mesh)
        self._add_outline()
        self._cull()
        self._measure()
        self._choose_uncut()
        self._rebuild()
        self.view("iso")

    def set_points(self, points: np.ndarray, figures: ElementQuality) -> None:
        """Draw the same mesh with its nodes elsewhere.

        Parameters
        ----------
        points : (n, 3) float64
        figures : ElementQuality
            Of the mesh at these points.
        """
        self._points, self._figures = points, figures
        self._cull()
        self._measure()
        if self._look.quality_range is None:
            self._move()
        else:
            self._rebuild()

    def set_look(self, look: Look) -> None:
        """Draw it differently."""
        before, self._look = self._look, look
        for surface in (self._skin_surface, self._section_surface):
            surface.show_edges(look.edges)
        if self._mesh is not None and look != before:
            if look.clip != before.clip:
                self._choose_uncut()
            if look.scale != before.scale:
                self._measure()
            self._rebuild()

    @property
    def bounds(self) -> tuple[float, float, float, float, float, float]:
        """x low, x high, y low, y high, z low, z high of the opened mesh, unused nodes left out."""
        points = self._mesh.points[self._mesh.topology.used]
        low, high = points.min(axis=0), points.max(axis=0)
        return tuple(float(c) for pair in zip(low, high, strict=True) for c in pair)

    def _measure(self) -> None:
        """The values that the colours show, and the range that they span."""
        figures, scale = self._figures, self._look.scale
        self._values = values(scale.metric, self._points, self._mesh.hexes, figures)
        self._colouring = resolve(scale, self._values, figures.inverted)

    def _kept(self) -> np.ndarray | None:
        """The hexes that are shown whole or in part, (m,) bool; None for all."""
        look = self._look
        if look.quality_range is None:
            return self._uncut
        low, high = look.quality_range
        q = self._figures.q
        # The best hex has q = 1 but for rounding.
        chosen = (q >= low) & ((q <= high) | (high >= 1))
        return chosen if self._uncut is None else chosen & self._uncut

    def _choose_uncut(self) -> None:
        """What a cut by whole elements leaves: chosen as the cut is made, so that none flickers as nodes move."""
        plane = self._look.clip
        self._uncut = None
        if plane is not None and plane.crinkle:
            self._uncut = sides.centres_kept(self._points, self._mesh.hexes, *plane.equation)

    def _rebuild(self) -> None:
        """Find the visible faces anew."""
        keep = self._kept()
        self._faces = self._skin.visible(keep)
        self._whole = quads(self._points[self._faces.nodes], self._faces.quads, self._face_colours())
        self._cut(keep)
        if self._outline is not None:
            hidden = self._look.clip is not None or self._look.quality_range is not None
            self._outline.SetVisibility(hidden)

    def _move(self) -> None:
        """The same faces, elsewhere and in other colours."""
        set_points(self._whole, self._points[self._faces.nodes])
        set_colours(self._whole, self._face_colours())
        self._cut(self._uncut)

    def _cut(self, keep: np.ndarray | None) -> None:
        self._replace(keep)
        for surface, halo in self._halos:
            if self._figures.n_inverted and surface.shown:
                halo.follow(surface.poly)
            else:
                halo.hide()

    def _replace(self, keep: np.ndarray | None) -> None:
        plane = self._look.clip
        if plane is None or plane.crinkle:
            if self._skin_surface.poly is not self._whole:
                self._skin_surface.replace(self._whole)
            self._section_surface.hide()
            return
        self._skin_surface.replace(cut.behind(self._whole, plane))
        every = self._colours(slice(None))
        self._section_surface.replace(cut.section(self._points, self._mesh.hexes, keep, plane, every))

    def _cull(self) -> None:
        """Leave out faces seen from behind, a third of the frame, unless an inverted element may turn them to us."""
        self._skin_surface.cull(self._figures.n_inverted == 0)

    def _face_colours(self) -> np.ndarray:
        return self._colours(self._faces.hexes)

    def _colours(self, hexes: np.ndarray | slice) -> np.ndarray:
        return self._colouring.colours(self._values[hexes], self._figures.inverted[hexes])

    def _add_outline(self) -> None:
        """The box of the whole, which keeps it in mind when a part is hidden."""
        box = pv.Box(self.bounds).outline()
        self._outline = self._plotter.add_mesh(
            box,
            name="outline",
            color=_OUTLINE,
            line_width=1,
            lighting=False,
            reset_camera=False,
            pickable=False,
            render=False,
        )
        self._outline.SetVisibility(False)

    # Camera and frames

    def reset_camera(self) -> None:
        """Show the whole mesh, from where the camera looks."""
        if self._mesh is not None:
            bounds, renderer = self.bounds, self._plotter.renderer
            renderer.ResetCamera(bounds)
            fit(self._plotter.camera, bounds, renderer.GetTiledAspectRatio())
            renderer.ResetCameraClippingRange(bounds)

    def view(self, direction: str | tuple[float, float, float]) -> None:
        """Look at the whole mesh from a direction: a name of `VIEWS`, or a vector, with z up where it can be."""
        if isinstance(direction, str):
            place, up = VIEWS[direction]
        else:
            place, up = direction, (0.0, 0.0, 1.0) if any(direction[:2]) else (0.0, 1.0, 0.0)
        camera = self._plotter.camera
        camera.SetFocalPoint(0, 0, 0)
        camera.SetPosition(place)
        camera.SetViewUp(up)
        self.reset_camera()

    def set_parallel(self, on: bool) -> None:
        """Parallel projection, or perspective."""
        self._plotter.camera.SetParallelProjection(on)

    def moving(self) -> None:
        """Prepare for fast frames."""
        self._plotter.render_window.SetMultiSamples(0)

    def still(self) -> None:
        """Prepare for a fine frame: smooth edges."""
        self._plotter.render_window.SetMultiSamples(4)

    @property
    def look(self) -> Look:
        """How the mesh is drawn."""
        return self._look

    @property
    def colouring(self) -> Colouring | None:
        """What the colours that are drawn stand for; None before there is a mesh."""
        return self._colouring

    @property
    def mesh(self) -> Mesh:
        """The mesh with its nodes where they are drawn."""
        return self._mesh.with_points(self._points)

    @property
    def figures(self) -> ElementQuality:
        """The figures that are drawn."""
        return self._figures

    @property
    def camera(self) -> pv.Camera:
        """The plotter's camera."""
        return self._plotter.camera
