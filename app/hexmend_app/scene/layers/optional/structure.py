"""Structure of a mesh: irregular edges, sharp edges, and nodes by class."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend.boundary import NodeClass
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, locked_hexes
from hexmend_app.picture.appearance import Structure
from hexmend_app.picture.layer_switch import EDGE_LAYERS
from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.cutting.cut import remaining_points
from hexmend_app.scene.geometry.curved_edges import CurvedEdges
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.geometry.skin import Faces, edges_of_kept
from hexmend_app.scene.layers.marks import MANY, Marks
from hexmend_app.state.mesh.structure import MeshStructure, find_structure
from hexmend_app.state.tasks.boundary_classifier import LEFT, PIN, WHISKER, departures_from_surface, node_classes

#: Colours of edges by their number of hexes, from the palette of Okabe and Ito; OTHER is for all other numbers.
VALENCES: dict[int, str] = {3: "#56b4e9", 5: "#e69f00", 6: "#f0e442"}
OTHER = "#ffffff"
IRREGULAR_NODE = "#ffffff"
SHARP = "#11151c"

#: Colours of nodes.
BOUNDARY, PINNED, FREE, LOCKED = "#9aa5b4", "#e69f00", "#ffffff", "#f0e442"

#: Colours of boundary nodes by class.
KINDS: dict[int, str] = {
    NodeClass.CORNER: "#d55e00", NodeClass.CURVE: "#56b4e9", NodeClass.PATCH: "#009e73",
    WHISKER: "#cc79a7", PIN: PINNED, LEFT: "#9b30ff",
}  # fmt: skip

#: Edge length of hexes in pixels from which marks have their full size.
_FULL_SIZE = 25.0


class StructureLayers:
    """Draws the layers of the mesh structure that a `Look` switches on; the others are not computed.

    Attributes
    ----------
    renderer : vtkRenderer
        Renderer of marks inside the mesh.
    irregular, irregular_inside, sharp, nodes : Marks
        Marks of visible irregular edges, of irregular edges inside the mesh, of sharp edges and of nodes.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self.renderer = pane.overlay()  # shows hidden marks; visible ones are drawn in both renderers
        front = self._front = pane.renderer

        def marks(renderer: vtkRenderer, size: float, rim: float) -> Marks:
            return Marks(renderer, size, rim, pixel_ratio)

        self._full_size = pixel_ratio * _FULL_SIZE
        self.irregular, self.irregular_inside = marks(front, 4, 1.25), marks(self.renderer, 1.5, 0.75)
        self._ends, self._ends_inside = marks(front, 7, 2), marks(self.renderer, 4, 1.5)
        self._boundary, self.sharp = marks(front, 4, 1.25), marks(front, 3, 0.5)
        self.nodes, self._locked = marks(front, 5, 1.5), marks(front, 5, 1.5)
        self._all = (
            self.irregular, self.irregular_inside, self._ends, self._ends_inside, self._boundary, self.sharp,
            self.nodes, self._locked,
        )  # fmt: skip
        self._frame: Frame | None = None
        self._structure: MeshStructure | None = None
        self._classes: np.ndarray | None = None  # of the nodes of the last frame, if it has none itself
        front.AddObserver("StartEvent", self._scale)

    def draw(self, frame: Frame, keep: np.ndarray | None, faces: Faces) -> None:
        """Draw the structure of the shown hexes.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            True for hexes shown whole or in part; None for all.
        faces : Faces
            Visible faces; only their nodes are marked.
        """
        last, self._frame, self._keep = self._frame, frame, keep
        if not frame.is_of(last):
            self._structure = None
        if last is None or last.mesh.points is not frame.mesh.points or last.mesh.pinned is not frame.mesh.pinned:
            self._classes = None
        self.hide()
        if not frame.look.structure.on.isdisjoint(EDGE_LAYERS):
            self._draw_edges()
        if not frame.look.structure.on.isdisjoint(("fixed", "free", "locked", "kinds")):
            self._draw_nodes(faces)
        quads = faces.quads[:: max(1, len(faces.quads) // 1000)]
        ends = frame.mesh.points[faces.nodes[quads[:, :2]]]
        self._spacing = float(np.median(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))) if len(quads) else 0.0

    def hide(self) -> None:
        """Hide all marks."""
        for marks in self._all:
            marks.hide()

    def _draw_edges(self) -> None:
        mesh, switches = self._frame.mesh, self._frame.look.structure
        points = mesh.points
        if self._structure is None:
            self._structure = find_structure(mesh)
        structure = self._structure
        if switches.is_on("irregular"):
            shown = self._shown(structure.interior)
            edges, colours = structure.interior[shown], valence_colours(structure.interior_valence[shown])
            nodes = np.intersect1d(structure.nodes, edges)[:, None]
            ends = _rgb(IRREGULAR_NODE).repeat(len(nodes), axis=0)
            opacity = min(1.0, (MANY / max(1, len(edges))) ** 0.5)
            curves = self._curves(edges)
            self.irregular.show(edges, colours, points, curves=curves)
            self.irregular_inside.show(edges, colours, points, opacity, curves)
            self._ends.show(nodes, ends, points)
            self._ends_inside.show(nodes, ends, points, opacity)
        if switches.is_on("boundary"):
            shown = self._shown(structure.boundary)
            edges, colours = structure.boundary[shown], valence_colours(structure.boundary_valence[shown])
            self._boundary.show(edges, colours, points, curves=self._curves(edges))
        if switches.is_on("sharp"):
            edges = structure.sharp[self._shown(structure.sharp)]
            self.sharp.show(edges, _rgb(SHARP).repeat(len(edges), axis=0), points, curves=self._curves(edges))

    def _curves(self, edges: np.ndarray) -> CurvedEdges | None:
        """Return the curves of edges, (k, 2); None if edges are drawn straight."""
        return CurvedEdges(self._frame.mesh, edges) if self._frame.curved else None

    def _shown(self, edges: np.ndarray) -> np.ndarray:
        """Return True for edges, (k, 2), of shown hexes that a smooth cut leaves, (k,) bool."""
        mesh = self._frame.mesh
        middles = mesh.points[edges].mean(axis=1)
        return edges_of_kept(mesh, edges, self._keep) & remaining_points(middles, self._frame.look.cut)

    def _draw_nodes(self, faces: Faces) -> None:
        frame, classes = self._frame, self._frame.kinds
        if frame.look.structure.is_on("kinds") and classes is None:
            if self._classes is None:
                self._classes = node_classes(
                    frame.mesh, FEATURE_ANGLE, departures_from_surface(frame.mesh, FEATURE_ANGLE)
                )
            classes = self._classes
        places = faces.places(frame.mesh.points)
        marks = node_marks(frame.mesh, frame.quality, frame.look.structure, classes)[faces.nodes]
        marked = (marks > 0) & remaining_points(places, frame.look.cut)
        for layer, nodes in ((self.nodes, marked & (marks != _LOCKED)), (self._locked, marked & (marks == _LOCKED))):
            layer.show(np.flatnonzero(nodes)[:, None], _COLOURS[marks[nodes]], places)

    def _scale(self, *_: object) -> None:
        """Scale the marks to the size of hexes in the picture."""
        shown = [marks for marks in self._all if marks.shown]
        if shown:
            camera = self._front.GetActiveCamera()
            factor = min(1.0, pixels(self._front, self._spacing, np.array(camera.GetFocalPoint())) / self._full_size)
            for marks in shown:
                least = 0.5 if marks is self.nodes else 0.0 if marks.count > MANY else 1.0
                marks.scale(max(factor, least))


def valence_colours(valence: np.ndarray) -> np.ndarray:
    """Return the colours of edges, (k, 3) uint8, by their number of hexes, (k,) int."""
    table = _rgb(OTHER).repeat(max(VALENCES) + 2, axis=0)
    for number, colour in VALENCES.items():
        table[number] = _rgb(colour)
    return table[np.minimum(valence, len(table) - 1)]


def node_marks(mesh: Mesh, quality: ElementQuality, switches: Structure, kinds: np.ndarray | None = None) -> np.ndarray:
    """Return the mark of each node, (n,) uint8: a row number of `_COLOURS`, 0 for none.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality
        Quality of the mesh.
    switches : Structure
        Switches of the layers.
    kinds : (n,) uint8, optional
        Boundary class of each node.
    """
    marks = np.zeros(mesh.n_nodes, np.uint8)
    if switches.is_on("fixed"):
        if mesh.interfaces is not None:  # kept like the boundary
            marks[mesh.interfaces.interface_nodes & mesh.fixed] = _BOUNDARY
        if mesh.pinned is not None:
            marks[mesh.pinned] = _PINNED
        marks[mesh.topology.boundary] = _BOUNDARY
    if switches.is_on("kinds") and kinds is not None:
        boundary = kinds > 0
        marks[boundary] = _LOCKED + kinds[boundary]
    if switches.is_on("free"):
        marks[mesh.free] = _FREE
    if switches.is_on("locked") and quality.n_inverted:
        marks[mesh.elements[locked_hexes(mesh.points, mesh.elements, mesh.fixed, quality.inverted)]] = _LOCKED
    return marks


def _rgb(colour: str) -> np.ndarray:
    """Convert a colour to (1, 3) uint8."""
    return np.frombuffer(bytes.fromhex(colour[1:]), np.uint8)[None]


#: Colours of node marks: none, boundary, pinned, free, locked, then those of `KINDS`.
_COLOURS = np.concatenate([_rgb(colour) for colour in ("#000000", BOUNDARY, PINNED, FREE, LOCKED, *KINDS.values())])
_BOUNDARY, _PINNED, _FREE, _LOCKED = range(1, 5)
