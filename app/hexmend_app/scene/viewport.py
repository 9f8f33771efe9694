"""The 3D view of one mesh, in whatever plotter: a window's or one off screen."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend.mesh import Mesh
from hexmend.node_step import NodeStep
from hexmend.quality import ElementQuality, Node
from hexmend_app.scene.camera.fitting import fit
from hexmend_app.scene.camera.flight import ELEMENT_FAR, PATCH_FAR, Flight
from hexmend_app.scene.colours import Colouring, fitted, resolve
from hexmend_app.scene.cutting import cut
from hexmend_app.scene.filters import Filters
from hexmend_app.scene.layers.arrows import ArrowLayer
from hexmend_app.scene.layers.axes import Axes
from hexmend_app.scene.layers.coarse import MANY, coarse
from hexmend_app.scene.layers.halo import Halo
from hexmend_app.scene.layers.silhouette import Silhouette
from hexmend_app.scene.layers.structure import StructureLayers, uncut
from hexmend_app.scene.layers.surface import Surface, hexes_of, quads, set_colours, set_points
from hexmend_app.scene.palette import BACKGROUND
from hexmend_app.scene.pane import Pane
from hexmend_app.scene.pointing import Pointing
from hexmend_app.scene.skin import Faces, Skin
from hexmend_app.state.look import Arrows, Look
from hexmend_app.state.measured import values
from hexmend_app.state.movement import MOVEMENTS, Movement

_LIGHT = (-0.12, 0.25, 1.0)  # from over the viewer's left shoulder

#: Inverted elements that are outlined in every frame.
_MANY = 1000

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
    plotter : pyvista.BasePlotter or Pane
        What draws: a window of its own, or a part of one.
    axes : bool
        Draw the axes in a corner.
    """

    def __init__(self, plotter: pv.BasePlotter | Pane, axes: bool = True):
        self._plotter = plotter
        self._mesh: Mesh | None = None
        self._look = Look()
        self._fast = False
        self._measured = False
        self._coarse: pv.PolyData | None = None  # of the skin, drawn while the camera moves
        self._steady = False  # nothing but the camera has moved since the last fine frame
        self._colouring: Colouring | None = None
        self._dark = False
        plotter.remove_all_lights()  # five lights of a kit cost twice the frame of one
        plotter.add_light(pv.Light(position=_LIGHT, focal_point=(0, 0, 0), light_type="camera light", intensity=1.0))
        plotter.render_window.SetMultiSamples(0)
        self._skin_surface = Surface(plotter, "skin")
        self._section_surface = Surface(plotter, "section")
        self._halos = [
            (surface, Halo(plotter, name))
            for surface, name in ((self._skin_surface, "halo of skin"), (self._section_surface, "halo of section"))
        ]
        self._outline: Silhouette | None = None
        self._structure = StructureLayers(plotter)
        self._arrows = ArrowLayer(plotter)
        self._movement: Movement | None = None
        self._pointing = Pointing(plotter, (self._skin_surface, self._section_surface))
        self.axes = Axes(plotter) if axes else None
        self._beside: tuple[float, float] | None = None
        self.set_dark(False)

    def set_dark(self, dark: bool) -> None:
        """Draw on the dark theme's ground, or on the light one's, as pictures for reports are."""
        self._dark = dark
        self._plotter.set_background(BACKGROUND.of(dark))
        if self.axes is not None:
            self.axes.set_dark(dark)
        self._pointing.set_dark(dark)
        if self._outline is not None:
            self._outline.set_dark(dark)

    # What is drawn

    def set_mesh(self, mesh: Mesh, figures: ElementQuality, filters: Filters | None = None, fly: bool = True) -> None:
        """Draw another mesh.

        Parameters
        ----------
        mesh : Mesh
        figures : ElementQuality
            Of the mesh.
        filters : Filters, optional
            Those of another view of it, whose elements are then shown.
        fly : bool
            Bring the camera to where the mesh is seen whole from a corner.
        """
        self._mesh, self._figures, self._points = mesh, figures, mesh.points
        self._skin = Skin(mesh)
        self._filters = filters or Filters(mesh)
        self._outline = Silhouette(self._plotter, mesh)
        self._outline.set_dark(self._dark)
        self._structure.set_mesh(mesh)
        self.show_node_step(None)
        self.select(None)
        self._pointing.set_places(mesh.points, mesh.hexes)
        self._cull()
        self._measure()
        self._rebuild(self.kept())
        if fly:
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
        self._pointing.set_places(points, self._mesh.hexes)
        self._measure()
        keep = self.kept()
        if _same(keep, self._keep):
            self._move(keep)
        else:
            self._rebuild(keep)

    def set_pinned(self, pinned: np.ndarray | None) -> None:
        """Take which nodes are pinned, (n,) bool; drawn with the next points."""
        if pinned is not self._mesh.pinned:
            self._mesh = self._mesh.replace(pinned=pinned)
            self._structure.set_pins(self._mesh)

    def set_movement(self, movement: Movement | None) -> None:
        """Take what colours and arrows of a movement show; drawn with the next mesh, points or look."""
        if movement is not self._movement:
            self._movement, self._measured = movement, False

    def catch_up(self) -> None:
        """Draw another movement though neither the nodes nor the look have changed."""
        if not self._measured:
            self._measure()
            self._move(self._keep)

    def set_look(self, look: Look) -> None:
        """Draw it differently."""
        before, self._look = self._look, look
        for surface in (self._skin_surface, self._section_surface):
            surface.show_edges(look.edges)
        if self._mesh is not None and look != before:
            if look.scale != before.scale or not self._measured:
                self._measure()
            self._rebuild(self.kept())

    # What is pointed at

    def pick(self, x: float, y: float) -> tuple[int, int] | None:
        """The hex that is seen at a place, and the node of it that is nearest there; None beside the mesh.

        Parameters
        ----------
        x, y : float
            In pixels of the picture, from its lower left corner.
        """
        if self._mesh is None:
            return None
        self._set_fast(False)  # what is drawn coarsely, or without its sides, is not what is pointed at
        self._skin_surface.stand_in(None)
        return self._pointing.pick(x, y)

    def select(self, h: int | None, corners: bool = False, node: Node | None = None) -> None:
        """Mark one hex, with the quality at each of its corners or without, and one of its nodes; None marks none."""
        self._pointing.select(h, corners, node)

    def show_node_step(self, step: NodeStep | None) -> None:
        """Draw a node's step, in the place of the marks of the hex that is selected; None draws none."""
        self._pointing.show_node_step(step)

    def flight_to(self, *hexes: int) -> Flight:
        """The camera's way to a hex, or to a patch of several."""
        corners = self._points[self._mesh.hexes[list(hexes)].ravel()]
        centre = corners.mean(axis=0)
        radius = float(np.sqrt(np.square(corners - centre).sum(axis=1).max()))
        return Flight(self.camera, centre, radius, ELEMENT_FAR if len(hexes) == 1 else PATCH_FAR)

    def reset_depth(self) -> None:
        """Fit what is near and far enough to be drawn to where the camera is."""
        self._plotter.renderer.ResetCameraClippingRange()

    @property
    def bounds(self) -> tuple[float, float, float, float, float, float]:
        """x low, x high, y low, y high, z low, z high of the opened mesh, unused nodes left out."""
        points = self._mesh.points[self._mesh.topology.used]
        low, high = points.min(axis=0), points.max(axis=0)
        return tuple(float(c) for pair in zip(low, high, strict=True) for c in pair)

    @property
    def shown(self) -> int:
        """Number of hexes that are shown whole or in part, before a smooth cut."""
        keep = self.kept()
        return self._mesh.n_hexes if keep is None else int(np.count_nonzero(keep))

    def _measure(self) -> None:
        """The values that the colours show, and the range that they span."""
        figures, scale, movement = self._figures, self._look.scale, self._movement
        self._kinds, self._measured, title = figures.inverted, True, ""
        if scale.metric not in MOVEMENTS:
            self._values = values(scale.metric, self._points, self._mesh.hexes, figures)
        elif movement is None:
            self._values = np.zeros(self._mesh.n_hexes)
        else:
            self._values = movement.values(scale.metric)
            self._kinds = movement.kinds if scale.metric == "q-change" else figures.inverted
            title = movement.title(scale.metric)
        self._colouring = resolve(scale, self._values, figures.inverted, self._beside, title)

    @property
    def ends(self) -> tuple[float, float]:
        """The least and the greatest value drawn here, as `fitted` has them."""
        return fitted(self._values, self._figures.inverted)

    def span(self, beside: tuple[float, float] | None) -> None:
        """Let a range of colours that is fitted span these values too, which are drawn in a view beside this."""
        if beside == self._beside:
            return
        before, self._beside = self._colouring, beside
        self._measure()
        if (before.low, before.high) != (self._colouring.low, self._colouring.high):
            self._move(self._keep)

    def kept(self) -> np.ndarray | None:
        """The hexes that are shown whole or in part, (m,) bool; None for all."""
        return self._filters.kept(self._look, self._points, self._figures)

    def left(self) -> np.ndarray | None:
        """The hexes of which something is shown after a smooth cut too, (m,) bool; None for all."""
        keep, clip = self.kept(), self._look.clip
        if clip is None or clip.crinkle:
            return keep
        left = cut.left(self._points, self._mesh.hexes, clip)
        return left if keep is None else left & keep

    def _rebuild(self, keep: np.ndarray | None) -> None:
        """Find the visible faces anew."""
        self._keep = keep
        faces = self._faces = self._visible(keep)
        self._whole = quads(faces.places(self._points), faces.quads, self._face_colours(), faces.hexes)
        self._cut(keep)
        self._outline.move(self._points)
        self._outline.show(self._look.outline and (keep is not None or self._look.clip is not None))
        self._structure.choose(self._look, self._points, self._figures, faces, keep)

    def _visible(self, keep: np.ndarray | None) -> Faces:
        look = self._look
        if look.shrink and (look.clip is None or look.clip.crinkle):
            return self._skin.shrunk(look.shrink, keep, fine=not self._fast)
        return self._skin.visible(keep)

    def _move(self, keep: np.ndarray | None) -> None:
        """The same faces, elsewhere and in other colours."""
        set_points(self._whole, self._faces.places(self._points))
        set_colours(self._whole, self._face_colours())
        self._outline.move(self._points)
        self._cut(keep)
        self._structure.move(self._points, self._figures)

    def _cut(self, keep: np.ndarray | None) -> None:
        self._steady, self._coarse = False, None
        self._skin_surface.stand_in(None)
        self._replace(keep)
        self._outline_inverted()
        self._draw_arrows(keep)

    def _draw_arrows(self, keep: np.ndarray | None) -> None:
        traces, movement = self._look.traces, self._movement
        if traces.arrows is Arrows.NONE or movement is None:
            self._arrows.hide()
            return
        through, hexes = traces.arrows is Arrows.ALL, self._mesh.hexes
        nodes = np.zeros(self._mesh.n_nodes, bool)
        if through:
            nodes[hexes if keep is None else hexes[keep]] = True
        else:
            nodes[self._faces.nodes] = True
            if self._section_surface.shown:
                nodes[hexes[hexes_of(self._section_surface.poly)]] = True
        self._arrows.show(movement, nodes & uncut(self._look, self._points), traces.factor, through)

    @property
    def arrows(self) -> tuple[int, int]:
        """How many arrows are drawn, and how many nodes could have one."""
        return self._arrows.drawn, self._arrows.moved

    @property
    def movement(self) -> Movement | None:
        """What colours and arrows of a movement show."""
        return self._movement

    @property
    def apart(self) -> list[tuple[str, int, tuple[int, int, int]]]:
        """What has a colour of its own whatever its value: name, number of elements, colour."""
        counts = np.bincount(self._kinds, minlength=len(self._colouring.apart) + 1)
        return [(one.name, int(counts[k]), one.colour) for k, one in enumerate(self._colouring.apart, start=1)]

    def _outline_inverted(self) -> None:
        """Outline inverted elements; where they are many, in fine frames alone: they cost half of a fast one."""
        inverted = self._figures.n_inverted
        for surface, halo in self._halos:
            if surface.shown and 0 < inverted <= (_MANY if self._fast else inverted):
                halo.follow(surface.poly)
            else:
                halo.hide()

    def _replace(self, keep: np.ndarray | None) -> None:
        clip = self._look.clip
        if clip is None or clip.crinkle:
            if self._skin_surface.poly is not self._whole:
                self._skin_surface.replace(self._whole)
            self._section_surface.hide()
            return
        self._skin_surface.replace(cut.behind(self._whole, clip))
        every = self._colours(slice(None))
        self._section_surface.replace(cut.sections(self._points, self._mesh.hexes, keep, clip, every))

    def _cull(self) -> None:
        """Leave out faces seen from behind, a third of the frame, unless an inverted element may turn them to us."""
        self._skin_surface.cull(self._figures.n_inverted == 0)

    def _face_colours(self) -> np.ndarray:
        return self._colours(self._faces.hexes)

    def _colours(self, hexes: np.ndarray | slice) -> np.ndarray:
        return self._colouring.colours(self._values[hexes], self._kinds[hexes])

    @property
    def layers(self) -> tuple[vtkRenderer, ...]:
        """What draws this view, one layer over the other."""
        return self._plotter.renderer, self._structure.layer, self._arrows.layer, *self._pointing.layers

    def close(self) -> None:
        """Draw no more, and leave the part of the window to another view."""
        for layer in self.layers:
            layer.RemoveObservers("StartEvent")
            self._plotter.render_window.RemoveRenderer(layer)
        self._plotter.renderer.clear_actors()
        self._plotter.remove_all_lights()

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
        self._set_fast(True)

    def turning(self, views: int = 1) -> None:
        """Prepare for fast frames in which nothing but the camera moves; they are of so many views like this."""
        self.moving()
        if self._steady and self._skin_surface.poly is self._whole and len(self._faces.quads) * views > MANY:
            if self._coarse is None:
                self._coarse = coarse(self._whole)
            self._skin_surface.stand_in(self._coarse)

    def still(self) -> None:
        """Prepare for a fine frame: smooth edges."""
        self._plotter.render_window.SetMultiSamples(4)
        self._set_fast(False)
        self._skin_surface.stand_in(None)
        self._steady = True

    def _set_fast(self, fast: bool) -> None:
        if fast != self._fast:
            self._fast = fast
            self._structure.set_fast(fast)
            self._arrows.set_fast(fast)
            if self._mesh is not None and self._faces.many:
                self._rebuild(self.kept())
            elif self._mesh is not None:
                self._outline_inverted()

    @property
    def node_step(self) -> NodeStep | None:
        """The node's step that is drawn."""
        return self._pointing.node_step

    @property
    def look(self) -> Look:
        """How the mesh is drawn."""
        return self._look

    @property
    def filters(self) -> Filters:
        """What decides which elements are shown."""
        return self._filters

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


def _same(one: np.ndarray | None, other: np.ndarray | None) -> bool:
    """Whether two masks show the same hexes."""
    return one is other or (one is not None and other is not None and np.array_equal(one, other))
