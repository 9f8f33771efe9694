"""Structure of a mesh: irregular and sharp edges, and kinds of nodes."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend.boundary import NodeClass
from hexmend.boundary.features import FEATURE_ANGLE
from hexmend.kernels import skin
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.structure import Structure as Found
from hexmend.mesh.structure import find_structure
from hexmend.quality import ElementQuality, locked_hexes
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.scene.camera.fitting import pixels
from hexmend_app.scene.geometry.skin import Faces
from hexmend_app.scene.layers.marks import Marks
from hexmend_app.scene.views.pane import Pane
from hexmend_app.state.tasks.boundary_classifier import PIN, WHISKER, node_classes

#: Colours by the number of elements around an edge, Okabe and Ito's; OTHER for numbers that are not here.
VALENCES: dict[int, str] = {3: "#56b4e9", 5: "#e69f00", 6: "#f0e442"}
OTHER = "#ffffff"
IRREGULAR_NODE = "#ffffff"
SHARP = "#11151c"

#: Colours of nodes.
BOUNDARY, PINNED, FREE, LOCKED = "#9aa5b4", "#e69f00", "#ffffff", "#f0e442"

#: Colours of nodes by what they are to the boundary.
KINDS: dict[int, str] = {
    NodeClass.CORNER: "#d55e00", NodeClass.CURVE: "#56b4e9", NodeClass.PATCH: "#009e73",
    WHISKER: "#cc79a7", PIN: PINNED,
}  # fmt: skip

#: Marks of one sort that are drawn in full. More of them are drawn thinner, and paler inside, or nothing else is seen;
#: in fast frames without rims and not inside, or 26,000 would cost a tenth of a second without a graphics card.
_MANY = 1500

#: Length of an element's edge, in pixels, from which on marks are drawn in full size.
_SPACE = 25.0


class StructureLayers:
    """Draws the structure of one mesh as far as a `Look` switches it on; layers that are off cost nothing.

    Attributes
    ----------
    irregular, irregular_inside, sharp, nodes : Marks
        Marks of edges, visible and inside the mesh, and of nodes.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self._inside = pane.overlay()  # what is not hidden is drawn twice, thick
        front = self._front = pane.renderer
        self._space = pixel_ratio * _SPACE
        self.irregular, self.irregular_inside = (
            Marks(front, 4, 1.25, pixel_ratio),
            Marks(self._inside, 1.5, 0.75, pixel_ratio),
        )
        self._ends, self._ends_inside = Marks(front, 7, 2, pixel_ratio), Marks(self._inside, 4, 1.5, pixel_ratio)
        self._boundary, self.sharp = Marks(front, 4, 1.25, pixel_ratio), Marks(front, 3, 0.5, pixel_ratio)
        self.nodes, self._locked = Marks(front, 5, 1.5, pixel_ratio), Marks(front, 5, 1.5, pixel_ratio)
        self._lines = (
            self.irregular, self.irregular_inside, self._ends, self._ends_inside, self._boundary, self.sharp,
        )  # fmt: skip
        self._found: Found | None = None
        self._fast = False
        self._inside.DrawOff()
        front.AddObserver("StartEvent", self._fit)

    @property
    def layer(self) -> vtkRenderer:
        """The renderer of marks inside the mesh."""
        return self._inside

    def set_mesh(self, mesh: Mesh) -> None:
        """Replace the mesh; its structure is found when first needed."""
        self._mesh, self._found, self._kinds = mesh, None, None

    def set_pins(self, pinned: np.ndarray | None) -> None:
        """Set the pinned nodes of the same mesh, (n,) bool; `move` draws them."""
        self._mesh = self._mesh.replace(pinned=pinned)

    def set_kinds(self, kinds: np.ndarray | None) -> None:
        """Set the boundary classes of nodes of the same mesh, (n,) uint8; None computes them when needed."""
        self._kinds = kinds

    def choose(
        self, look: Look, points: np.ndarray, figures: ElementQuality, faces: Faces, keep: np.ndarray | None
    ) -> None:
        """Draw the structure of the shown hexes.

        Parameters
        ----------
        look : Look
        points : (n, 3) float64
        figures : ElementQuality
            Of the mesh at these points.
        faces : Faces
            In sight; of their nodes alone is anything drawn.
        keep : (m,) bool, optional
            Hexes that are shown, in whole or in part; None for all.
        """
        self._look, self._keep, self._faces = look, keep, faces
        for marks in self._lines:
            marks.hide()
        if look.structure.edges:
            self._choose_edges(look.structure, points)
        self._choose_nodes(points, figures)
        self._thin_out()
        quads = faces.quads[:: max(1, len(faces.quads) // 1000)]
        ends = points[faces.nodes[quads[:, :2]]]
        self._spacing = float(np.median(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))) if len(quads) else 0.0

    def move(self, points: np.ndarray, figures: ElementQuality) -> None:
        """Draw the same marks at the present nodes, (n, 3) float64."""
        for marks in self._lines:
            marks.move(points)
        self._choose_nodes(points, figures)
        self._thin_out()

    def set_fast(self, fast: bool) -> None:
        """Draw many marks sparingly, or everything again."""
        self._fast = fast
        self._thin_out()

    def hide(self) -> None:
        """Draw nothing."""
        for marks in (*self._lines, self.nodes, self._locked):
            marks.hide()
        self._inside.DrawOff()

    def _thin_out(self) -> None:
        for marks in (*self._lines, self.nodes):
            marks.show_rims(not self._sparing(marks))
        self._inside.SetDraw(self.irregular_inside.shown and not self._sparing(self.irregular_inside))

    def _sparing(self, marks: Marks) -> bool:
        return self._fast and marks.count > _MANY

    def _choose_edges(self, wanted: Structure, points: np.ndarray) -> None:
        if self._found is None:
            self._found = find_structure(self._mesh)
        found = self._found
        if wanted.irregular:
            shown = self._shown(found.interior, points)
            edges, colours = found.interior[shown], valence_colours(found.interior_valence[shown])
            nodes = np.intersect1d(found.nodes, edges)[:, None]
            ends = _rgb(IRREGULAR_NODE).repeat(len(nodes), axis=0)
            opacity = min(1.0, (_MANY / max(1, len(edges))) ** 0.5)
            self.irregular.show(edges, colours, points)
            self.irregular_inside.show(edges, colours, points, opacity)
            self._ends.show(nodes, ends, points)
            self._ends_inside.show(nodes, ends, points, opacity)
        if wanted.boundary:
            shown = self._shown(found.boundary, points)
            self._boundary.show(found.boundary[shown], valence_colours(found.boundary_valence[shown]), points)
        if wanted.sharp:
            edges = found.sharp[self._shown(found.sharp, points)]
            self.sharp.show(edges, _rgb(SHARP).repeat(len(edges), axis=0), points)

    def _shown(self, edges: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Return True for the edges, (k, 2), of shown hexes before a smooth cut, (k,) bool."""
        rows = self._mesh.topology.node_corners
        answer = np.ones(len(edges), bool)
        if self._keep is not None:
            skin.edges_kept(self._mesh.hexes, rows.start, rows.items, edges, self._keep, answer)
        return answer & uncut(self._look, points[edges].mean(axis=1))

    def _choose_nodes(self, points: np.ndarray, figures: ElementQuality) -> None:
        wanted = self._look.structure
        if not (wanted.fixed or wanted.free or wanted.locked or wanted.kinds):
            self.nodes.hide()
            self._locked.hide()
            return
        places = self._faces.places(points)
        if wanted.kinds and self._kinds is None:
            self._kinds = node_classes(self._mesh, FEATURE_ANGLE)
        kinds = node_marks(self._mesh, points, figures, wanted, self._kinds)[self._faces.nodes]
        chosen = (kinds > 0) & uncut(self._look, places)
        for marks, these in ((self.nodes, chosen & (kinds != _LOCKED)), (self._locked, chosen & (kinds == _LOCKED))):
            marks.show(np.flatnonzero(these)[:, None], _COLOURS[kinds[these]], places)

    def _fit(self, *_: object) -> None:
        """Scale many marks to the size of hexes in the picture."""
        shown = [marks for marks in (*self._lines, self.nodes, self._locked) if marks.shown]
        if shown:
            camera = self._front.GetActiveCamera()
            share = min(1.0, pixels(self._front, self._spacing, np.array(camera.GetFocalPoint())) / self._space)
            for marks in shown:
                least = 0.5 if marks is self.nodes else 0.0 if marks.count > _MANY else 1.0
                marks.fit(max(share, least))


def valence_colours(valence: np.ndarray) -> np.ndarray:
    """Return the colours of edges by their number of hexes, (k,) int to (k, 3) uint8."""
    table = _rgb(OTHER).repeat(max(VALENCES) + 2, axis=0)
    for number, colour in VALENCES.items():
        table[number] = _rgb(colour)
    return table[np.minimum(valence, len(table) - 1)]


def node_marks(
    mesh: Mesh, points: np.ndarray, figures: ElementQuality, wanted: Structure, kinds: np.ndarray | None = None
) -> np.ndarray:
    """Return the mark of each node, (n,) uint8: a row of `_COLOURS`, 0 for none.

    Parameters
    ----------
    mesh : Mesh
    points : (n, 3) float64
    figures : ElementQuality
        Of the mesh at these points.
    wanted : Structure
    kinds : (n,) uint8, optional
        Boundary class of each node.
    """
    marks = np.zeros(mesh.n_nodes, np.uint8)
    if wanted.fixed:
        if mesh.pinned is not None:
            marks[mesh.pinned] = _PINNED
        marks[mesh.topology.boundary] = _BOUNDARY
    if wanted.kinds and kinds is not None:
        boundary = kinds > 0
        marks[boundary] = _LOCKED + kinds[boundary]
    if wanted.free:
        marks[mesh.free] = _FREE
    if wanted.locked and figures.n_inverted:
        marks[mesh.hexes[locked_hexes(points, mesh.hexes, mesh.fixed, figures.inverted)]] = _LOCKED
    return marks


def uncut(look: Look, points: np.ndarray) -> np.ndarray | bool:
    """Return True for points, (k, 3), that a smooth cut leaves; other cuts leave all."""
    clip = look.clip
    if clip is None or clip.crinkle:
        return True
    beyond = [plane.signed_distance(points) > 0 for plane in clip.planes]
    return ~(np.all(beyond, axis=0) if clip.notch else np.any(beyond, axis=0))


def _rgb(colour: str) -> np.ndarray:
    """Convert a colour to (1, 3) uint8."""
    return np.frombuffer(bytes.fromhex(colour[1:]), np.uint8)[None]


#: Colours of nodes by what they are among what is wanted; behind the locked those of `KINDS`.
_COLOURS = np.concatenate([_rgb(colour) for colour in ("#000000", BOUNDARY, PINNED, FREE, LOCKED, *KINDS.values())])
_BOUNDARY, _PINNED, _FREE, _LOCKED = range(1, 5)
