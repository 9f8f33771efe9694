"""Marks of a node step: patch, steepest descent, search direction, trial steps and accepted step."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from hexmend.mesh.solid_cells import cell_faces, edges_of
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.layers.flat_actor import flat_actor
from hexmend_app.state.node_step import NodeStep
from hexmend_app.theme.palette import DESCENT, OTHERWISE, PATCH, SEARCH, TAKEN, TRIED, Role, rgb

_RIM = "#11151c"

# Sizes in mean edge lengths of the patch: lengths of the arrows of steepest descent and of the search direction, and
# the distance up to which trial steps are drawn; radii of shafts and tips, length of tips, and width of dark rims;
# radii of balls. The two arrows may have the same direction: the shorter one is thicker.
_DESCENT, _DIRECTION, _MAX_DISTANCE = 0.55, 1.0, 2.5
_DESCENT_WIDTH = 1.7
_SHAFT, _TIP, _TIP_LENGTH, _RIM_WIDTH = 0.026, 0.065, 0.2, 0.011
_BALLS = {"pulls": 0.04, "tried": 0.042, "taken": 0.05, "node": 0.055}


class NodeStepMarks:
    """Draws a node step in front of everything else.

    If the mesh has the node at its position before the step, the patch after the step is drawn pale; otherwise the
    patch before the step is.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.

    Attributes
    ----------
    step : NodeStep or None
        The drawn step.
    arrows : dict of (vtkActor, vtkActor)
        Actors of the rim and of the solid of each arrow, by its colour.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self._pixel_ratio = pixel_ratio
        self._behind, self._front = (pane.overlay() for _ in range(2))  # of the patch, and of arrows and balls
        self.step: NodeStep | None = None
        self._dark = False
        self._roles: dict[vtkActor, Role] = {}
        self._ghost = self._add(self._behind, OTHERWISE, opacity=0.12)
        self._ghost_edges = self._add(self._behind, OTHERWISE, width=3)
        self._edges = self._add(self._behind, PATCH, width=1, opacity=0.45)
        self._spokes = self._add(self._behind, None, width=3.5), self._add(self._behind, PATCH, width=1.5)
        self.arrows = {role: self._solid(role) for role in (DESCENT, SEARCH, TAKEN)}
        self._balls = {
            name: self._solid(role)
            for name, role in (("pulls", PATCH), ("tried", TRIED), ("taken", TAKEN), ("node", PATCH))
        }
        self.hide()

    @property
    def layers(self) -> tuple[vtkRenderer, ...]:
        """Renderers in front of everything else."""
        return self._behind, self._front

    def _add(self, layer: vtkRenderer, role: Role | None, width: float = 1, opacity: float = 1.0) -> vtkActor:
        actor = flat_actor(layer, self._pixel_ratio * width, opacity, _RIM)
        actor.VisibilityOn()
        actor.GetMapper().SetInputData(pv.PolyData())
        if role is not None:
            self._roles[actor] = role
        return actor

    def _solid(self, role: Role) -> tuple[vtkActor, vtkActor]:
        """Make the actors of the dark rim of a solid, whose front faces are culled, and of the solid."""
        rim = self._add(self._front, None)
        rim.GetProperty().FrontfaceCullingOn()
        return rim, self._add(self._front, role)

    def set_dark(self, dark: bool) -> None:
        """Use the colours of the dark or of the light theme."""
        for actor, role in self._roles.items():
            actor.GetProperty().SetColor(rgb(role.of(dark)))

    def show(self, step: NodeStep, hexes: np.ndarray, points: np.ndarray) -> None:
        """Draw a step.

        Parameters
        ----------
        step : NodeStep
        hexes : (k, 8) int32
            Nodes of the hexes of the patch.
        points : (n, 3) float64
            Positions of all nodes.
        """
        self.step, self._hexes = step, hexes
        for layer in self.layers:
            layer.DrawOn()
        self.move(points)

    def move(self, points: np.ndarray) -> None:
        """Draw the same step at the current positions of the nodes, (n, 3) float64."""
        if self.step is None:
            return
        step, nodes = self.step, np.unique(self._hexes)
        hexes, node = np.searchsorted(nodes, self._hexes), int(np.searchsorted(nodes, step.node))
        x = points[nodes]
        edges = np.unique(np.sort(edges_of(hexes), axis=1), axis=0)
        spokes = edges[(edges == node).any(axis=1)]
        length = float(np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1).mean())
        for actor, ends in ((self._edges, edges), *((actor, spokes) for actor in self._spokes)):
            _draw(actor, pv.PolyData(x, lines=pv.CellArray.from_regular_cells(ends)))
        self._draw_ghost(x, node, hexes, spokes)
        self._draw_arrow(DESCENT, _scaled(step.descent, _DESCENT * length), length, _DESCENT_WIDTH)
        self._draw_arrow(SEARCH, _scaled(step.search_direction, _DIRECTION * length), length)
        self._draw_arrow(TAKEN, step.after - step.before, 1.4 * length)
        tried = [step.before + trial.alpha * step.direction for trial in step.trials if trial.alpha != step.alpha]
        near = [point for point in tried if np.linalg.norm(point - step.before) < _MAX_DISTANCE * length]
        self._draw_balls("tried", near, length)
        self._draw_balls("taken", [step.after] if step.move > 0 else [], length)
        self._draw_balls("pulls", [pull.place for pull in step.pulls], length)
        self._draw_balls("node", [step.before], length)

    def _draw_ghost(self, x: np.ndarray, node: int, hexes: np.ndarray, spokes: np.ndarray) -> None:
        """Draw edges and faces at the node, with the node at the other end of its step."""
        step, moved = self.step, x.copy()
        at_end = np.square(x[node] - step.after).sum() < np.square(x[node] - step.before).sum()
        moved[node] = step.before if at_end else step.after
        faces = cell_faces(hexes).reshape(-1, 4)
        moves = step.move > 0
        _draw(self._ghost, pv.PolyData.from_regular_faces(moved, faces[(faces == node).any(axis=1) & moves]))
        _draw(
            self._ghost_edges, pv.PolyData(moved, lines=pv.CellArray.from_regular_cells(spokes[: len(spokes) * moves]))
        )

    def _draw_arrow(self, role: Role, vector: np.ndarray, length: float, width: float = 1.0) -> None:
        """Draw an arrow from the node; `length` is the mean edge length, the unit of all sizes but the `width`."""
        arrow_length = float(np.linalg.norm(vector))
        tip = min(_TIP_LENGTH * length, 0.6 * arrow_length)
        thickness = width * tip / _TIP_LENGTH  # short arrows are thin
        for actor, rim in zip(self.arrows[role], (_RIM_WIDTH * length, 0.0), strict=True):
            actor.SetVisibility(arrow_length > 1e-6 * length)
            if actor.GetVisibility():
                scale = arrow_length + 2 * rim
                arrow = pv.Arrow(
                    start=self.step.before,
                    direction=vector,
                    scale=scale,
                    tip_length=(tip + 2.5 * rim) / scale,
                    tip_radius=(_TIP * thickness + 1.5 * rim) / scale,
                    shaft_radius=(_SHAFT * thickness + rim) / scale,
                )
                _draw(actor, arrow)

    def _draw_balls(self, name: str, centres: list[np.ndarray], length: float) -> None:
        for actor, rim in zip(self._balls[name], (_RIM_WIDTH, 0.0), strict=True):
            actor.SetVisibility(bool(centres))
            if centres:
                ball = pv.Sphere(radius=(_BALLS[name] + rim) * length, theta_resolution=16, phi_resolution=12)
                _draw(actor, pv.PolyData(np.array(centres)).glyph(geom=ball, scale=False, orient=False))

    def hide(self) -> None:
        """Hide the marks."""
        self.step = None
        for layer in self.layers:
            layer.DrawOff()


def _draw(actor: vtkActor, poly: pv.PolyData) -> None:
    actor.GetMapper().SetInputData(poly)


def _scaled(vector: np.ndarray, length: float) -> np.ndarray:
    """Return a vector scaled to a length; a zero vector stays zero."""
    norm = float(np.linalg.norm(vector))
    return vector * (length / norm) if norm > 0 else vector
