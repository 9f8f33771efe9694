"""Structure of a mesh: irregular edges, sharp edges, and nodes by class."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend.boundary import NodeClass
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE
from hexmend.kernels import skin
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, locked_hexes
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.layer_switch import EDGE_LAYERS
from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.curved_edges import CurvedEdges
from hexmend_app.scene.geometry.skin import Faces
from hexmend_app.scene.layers.marks import Marks
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

#: Maximum number of marks of one kind that are drawn in full. More are drawn thinner, and paler inside the mesh, to
#: keep the mesh visible; fast frames omit their rims and marks inside, which saves 0.1 s for 26,000 marks in software
#: rendering.
_MANY = 1500

#: Edge length of hexes in pixels from which marks have their full size.
_FULL_SIZE = 25.0


class StructureLayers:
    """Draws the layers of the mesh structure that a `Look` switches on; the others are not computed.

    Attributes
    ----------
    irregular, irregular_inside, sharp, nodes : Marks
        Marks of visible irregular edges, of irregular edges inside the mesh, of sharp edges and of nodes.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self._inside = pane.overlay()  # shows hidden marks; visible ones are drawn in both renderers
        front = self._front = pane.renderer
        self._full_size = pixel_ratio * _FULL_SIZE
        self.irregular, self.irregular_inside = (
            Marks(front, 4, 1.25, pixel_ratio),
            Marks(self._inside, 1.5, 0.75, pixel_ratio),
        )
        self._ends, self._ends_inside = Marks(front, 7, 2, pixel_ratio), Marks(self._inside, 4, 1.5, pixel_ratio)
        self._boundary, self.sharp = Marks(front, 4, 1.25, pixel_ratio), Marks(front, 3, 0.5, pixel_ratio)
        self.nodes, self._locked = Marks(front, 5, 1.5, pixel_ratio), Marks(front, 5, 1.5, pixel_ratio)
        self._edge_marks = (
            self.irregular, self.irregular_inside, self._ends, self._ends_inside, self._boundary, self.sharp,
        )  # fmt: skip
        self._structure: MeshStructure | None = None
        self._fast = False
        self._inside.DrawOff()
        front.AddObserver("StartEvent", self._scale)

    @property
    def layer(self) -> vtkRenderer:
        """Renderer of marks inside the mesh."""
        return self._inside

    def set_mesh(self, mesh: Mesh) -> None:
        """Replace the mesh; its structure is computed when first needed."""
        self._mesh, self._structure = mesh, None
        self.set_kinds(None)
        self.set_positions(mesh)

    def set_positions(self, mesh: Mesh) -> None:
        """Set the same mesh with other positions: classes that were not given are computed anew when needed."""
        self._positions = mesh
        if not self._given:
            self.set_kinds(None)

    def set_pins(self, pinned: np.ndarray | None) -> None:
        """Set the pinned nodes of the same mesh, (n,) bool; `move` draws them."""
        self._mesh = self._mesh.replace(pinned=pinned)

    def set_kinds(self, kinds: np.ndarray | None) -> None:
        """Set the boundary classes of nodes of the same mesh, (n,) uint8; None computes them when needed."""
        self._kinds, self._given = kinds, kinds is not None

    def rebuild(
        self, look: Look, points: np.ndarray, figures: ElementQuality, faces: Faces, keep: np.ndarray | None
    ) -> None:
        """Draw the structure of the shown hexes.

        Parameters
        ----------
        look : Look
        points : (n, 3) float64
        figures : ElementQuality
            Quality of the mesh at `points`.
        faces : Faces
            Visible faces; only their nodes are marked.
        keep : (m,) bool, optional
            True for hexes shown whole or in part; None for all.
        """
        self._look, self._keep, self._faces = look, keep, faces
        for marks in self._edge_marks:
            marks.hide()
        if not look.structure.on.isdisjoint(EDGE_LAYERS):
            self._draw_edges(look.structure, points)
        self._draw_nodes(points, figures)
        self._update_detail()
        quads = faces.quads[:: max(1, len(faces.quads) // 1000)]
        ends = points[faces.nodes[quads[:, :2]]]
        self._spacing = float(np.median(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))) if len(quads) else 0.0

    def move(self, points: np.ndarray, figures: ElementQuality) -> None:
        """Draw the same marks at the current positions of the nodes, (n, 3) float64."""
        for marks in self._edge_marks:
            marks.move(points)
        self._draw_nodes(points, figures)
        self._update_detail()

    def set_fast(self, fast: bool) -> None:
        """Omit details of many marks in fast frames, or draw everything again."""
        self._fast = fast
        self._update_detail()

    def hide(self) -> None:
        """Hide all marks."""
        for marks in (*self._edge_marks, self.nodes, self._locked):
            marks.hide()
        self._inside.DrawOff()

    def _update_detail(self) -> None:
        for marks in (*self._edge_marks, self.nodes):
            marks.show_rims(not self._reduced(marks))
        self._inside.SetDraw(self.irregular_inside.shown and not self._reduced(self.irregular_inside))

    def _reduced(self, marks: Marks) -> bool:
        return self._fast and marks.count > _MANY

    def _draw_edges(self, switches: Structure, points: np.ndarray) -> None:
        if self._structure is None:
            self._structure = find_structure(self._mesh)
        structure = self._structure
        if switches.is_on("irregular"):
            shown = self._shown(structure.interior, points)
            edges, colours = structure.interior[shown], valence_colours(structure.interior_valence[shown])
            nodes = np.intersect1d(structure.nodes, edges)[:, None]
            ends = _rgb(IRREGULAR_NODE).repeat(len(nodes), axis=0)
            opacity = min(1.0, (_MANY / max(1, len(edges))) ** 0.5)
            curves = self._curves(edges)
            self.irregular.show(edges, colours, points, curves=curves)
            self.irregular_inside.show(edges, colours, points, opacity, curves)
            self._ends.show(nodes, ends, points)
            self._ends_inside.show(nodes, ends, points, opacity)
        if switches.is_on("boundary"):
            shown = self._shown(structure.boundary, points)
            edges, colours = structure.boundary[shown], valence_colours(structure.boundary_valence[shown])
            self._boundary.show(edges, colours, points, curves=self._curves(edges))
        if switches.is_on("sharp"):
            edges = structure.sharp[self._shown(structure.sharp, points)]
            self.sharp.show(edges, _rgb(SHARP).repeat(len(edges), axis=0), points, curves=self._curves(edges))

    def _curves(self, edges: np.ndarray) -> CurvedEdges | None:
        """Return the curves of edges, (k, 2); None if edges are drawn straight."""
        curved = self._mesh.mid_nodes is not None and self._look.structure.is_on("curved")
        return CurvedEdges(self._mesh, edges) if curved else None

    def _shown(self, edges: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Return True for edges, (k, 2), of shown hexes that a smooth cut leaves, (k,) bool."""
        rows = self._mesh.topology.node_corners
        mask = np.ones(len(edges), bool)
        if self._keep is not None:
            skin.edges_kept(self._mesh.hexes, rows.start, rows.items, edges, self._keep, mask)
        return mask & points_kept_by_cut(self._look, points[edges].mean(axis=1))

    def _draw_nodes(self, points: np.ndarray, figures: ElementQuality) -> None:
        switches = self._look.structure
        if switches.on.isdisjoint(("fixed", "free", "locked", "kinds")):
            self.nodes.hide()
            self._locked.hide()
            return
        places = self._faces.places(points)
        if switches.is_on("kinds") and self._kinds is None:
            mesh = self._positions.replace(pinned=self._mesh.pinned)
            self._kinds = node_classes(mesh, FEATURE_ANGLE, departures_from_surface(mesh, FEATURE_ANGLE))
        kinds = node_marks(self._mesh, points, figures, switches, self._kinds)[self._faces.nodes]
        marked = (kinds > 0) & points_kept_by_cut(self._look, places)
        for marks, nodes in ((self.nodes, marked & (kinds != _LOCKED)), (self._locked, marked & (kinds == _LOCKED))):
            marks.show(np.flatnonzero(nodes)[:, None], _COLOURS[kinds[nodes]], places)

    def _scale(self, *_: object) -> None:
        """Scale the marks to the size of hexes in the picture."""
        shown = [marks for marks in (*self._edge_marks, self.nodes, self._locked) if marks.shown]
        if shown:
            camera = self._front.GetActiveCamera()
            factor = min(1.0, pixels(self._front, self._spacing, np.array(camera.GetFocalPoint())) / self._full_size)
            for marks in shown:
                least = 0.5 if marks is self.nodes else 0.0 if marks.count > _MANY else 1.0
                marks.scale(max(factor, least))


def valence_colours(valence: np.ndarray) -> np.ndarray:
    """Return the colours of edges, (k, 3) uint8, by their number of hexes, (k,) int."""
    table = _rgb(OTHER).repeat(max(VALENCES) + 2, axis=0)
    for number, colour in VALENCES.items():
        table[number] = _rgb(colour)
    return table[np.minimum(valence, len(table) - 1)]


def node_marks(
    mesh: Mesh, points: np.ndarray, figures: ElementQuality, switches: Structure, kinds: np.ndarray | None = None
) -> np.ndarray:
    """Return the mark of each node, (n,) uint8: a row number of `_COLOURS`, 0 for none.

    Parameters
    ----------
    mesh : Mesh
    points : (n, 3) float64
    figures : ElementQuality
        Quality of the mesh at `points`.
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
    if switches.is_on("locked") and figures.n_inverted:
        marks[mesh.hexes[locked_hexes(points, mesh.hexes, mesh.fixed, figures.inverted)]] = _LOCKED
    return marks


def points_kept_by_cut(look: Look, points: np.ndarray) -> np.ndarray | bool:
    """Return True for points, (k, 3), that a smooth cut leaves; True if there is no smooth cut."""
    return ~look.cut.hidden(points) if look.cut.smooth else True


def _rgb(colour: str) -> np.ndarray:
    """Convert a colour to (1, 3) uint8."""
    return np.frombuffer(bytes.fromhex(colour[1:]), np.uint8)[None]


#: Colours of node marks: none, boundary, pinned, free, locked, then those of `KINDS`.
_COLOURS = np.concatenate([_rgb(colour) for colour in ("#000000", BOUNDARY, PINNED, FREE, LOCKED, *KINDS.values())])
_BOUNDARY, _PINNED, _FREE, _LOCKED = range(1, 5)
