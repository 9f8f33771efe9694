"""Step of a node: its patch, gradient, search direction, trial steps and the accepted step."""

from __future__ import annotations

import numpy as np
import pyvista as pv
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.node_step import NodeStep
from hexmend_app.scene.views.pane import Pane
from hexmend_app.theme.palette import OTHERWISE, PATCH, SEARCH, TAKEN, TRIED, UPHILL, Role, rgb

_RIM = "#11151c"

# In mean edge lengths of the patch: lengths of the arrows of gradient and direction, and how far off a trial is drawn;
# radii of an arrow's shaft and tip, the length of its tip; radii of balls; and how much a dark rim adds to a radius.
_GRADIENT, _DIRECTION, _FAR = 0.75, 1.0, 2.5
_SHAFT, _TIP, _TIP_LENGTH, _RIM_WIDTH = 0.026, 0.065, 0.2, 0.011
_BALLS = {"pulls": 0.04, "tried": 0.042, "taken": 0.05, "node": 0.055}


class NodeStepMarks:
    """Draws one step in front of everything else.

    Where the mesh shows the node before its step, the patch as it would be after it is drawn pale; where it shows the
    node after it, the patch as it was.

    Parameters
    ----------
    pane : Pane
    pixel_ratio : float
        Width of a thin line, in pixels.

    Attributes
    ----------
    step : NodeStep or None
        The drawn step.
    """

    def __init__(self, pane: Pane, pixel_ratio: float = 1.0):
        self._pixel_ratio = pixel_ratio
        self._behind, self._front = (pane.overlay() for _ in range(2))  # the patch, and what is drawn over it
        self.step: NodeStep | None = None
        self._dark = False
        self._roles: dict[vtkActor, Role] = {}
        self._ghost = self._add(self._behind, OTHERWISE, opacity=0.12)
        self._ghost_edges = self._add(self._behind, OTHERWISE, width=3)
        self._edges = self._add(self._behind, PATCH, width=1, opacity=0.45)
        self._spokes = self._add(self._behind, None, width=3.5), self._add(self._behind, PATCH, width=1.5)
        self._arrows = {role: self._solid(role) for role in (UPHILL, SEARCH, TAKEN)}
        self._balls = {
            name: self._solid(role)
            for name, role in (("pulls", PATCH), ("tried", TRIED), ("taken", TAKEN), ("node", PATCH))
        }
        self.hide()

    @property
    def layers(self) -> tuple[vtkRenderer, ...]:
        """The renderers in front of everything else."""
        return self._behind, self._front

    def _add(self, layer: vtkRenderer, role: Role | None, width: float = 1, opacity: float = 1.0) -> vtkActor:
        actor = vtkActor()
        actor.SetMapper(vtkPolyDataMapper())
        actor.GetMapper().SetInputData(pv.PolyData())
        prop = actor.GetProperty()
        prop.LightingOff()
        prop.SetLineWidth(self._pixel_ratio * width)
        prop.SetOpacity(opacity)
        prop.SetColor(rgb(_RIM))
        if role is not None:
            self._roles[actor] = role
        layer.AddActor(actor)
        return actor

    def _solid(self, role: Role) -> tuple[vtkActor, vtkActor]:
        """Make the actors of a solid and its dark rim, of which only the inside of the back is visible."""
        around = self._add(self._front, None)
        around.GetProperty().FrontfaceCullingOn()
        return around, self._add(self._front, role)

    def set_dark(self, dark: bool) -> None:
        """Draw for the dark theme, or for the light one."""
        for actor, role in self._roles.items():
            actor.GetProperty().SetColor(rgb(role.of(dark)))

    def show(self, step: NodeStep, hexes: np.ndarray, points: np.ndarray) -> None:
        """Draw a step.

        Parameters
        ----------
        step : NodeStep
        hexes : (k, 8) int32
            The nodes of its patch.
        points : (n, 3) float64
            Drawn positions of all nodes.
        """
        self.step, self._hexes = step, hexes
        for layer in self.layers:
            layer.DrawOn()
        self.move(points)

    def move(self, points: np.ndarray) -> None:
        """Draw the same step at the present nodes, (n, 3) float64."""
        if self.step is None:
            return
        step, nodes = self.step, np.unique(self._hexes)
        places, node = np.searchsorted(nodes, self._hexes), int(np.searchsorted(nodes, step.node))
        x = points[nodes]
        edges = np.unique(np.sort(places[:, EDGES].reshape(-1, 2), axis=1), axis=0)
        spokes = edges[(edges == node).any(axis=1)]
        length = float(np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1).mean())
        _draw(self._edges, _lines(x, edges))
        for actor in self._spokes:
            _draw(actor, _lines(x, spokes))
        self._draw_otherwise(x, node, places, spokes)
        gradient = step.gradient if np.isfinite(step.gradient).all() else np.zeros(3)
        self._draw_arrow(UPHILL, _scaled(gradient, _GRADIENT * length), length)
        self._draw_arrow(SEARCH, _scaled(step.direction, _DIRECTION * length), length)
        self._draw_arrow(TAKEN, step.after - step.before, 1.4 * length)
        tried = [step.before + trial.alpha * step.direction for trial in step.trials if trial.alpha != step.alpha]
        near = [place for place in tried if np.linalg.norm(place - step.before) < _FAR * length]
        self._draw_balls("tried", near, length)
        self._draw_balls("taken", [step.after] if step.move > 0 else [], length)
        self._draw_balls("pulls", [pull.place for pull in step.pulls], length)
        self._draw_balls("node", [step.before], length)

    def _draw_otherwise(self, x: np.ndarray, node: int, places: np.ndarray, spokes: np.ndarray) -> None:
        """Draw edges and faces at the node, with the node at the other end of its step."""
        step, there = self.step, x.copy()
        at_end = np.square(x[node] - step.after).sum() < np.square(x[node] - step.before).sum()
        there[node] = step.before if at_end else step.after
        faces = places[:, FACES].reshape(-1, 4)
        moves = step.move > 0
        _draw(self._ghost, pv.PolyData.from_regular_faces(there, faces[(faces == node).any(axis=1) & moves]))
        _draw(self._ghost_edges, _lines(there, spokes[: len(spokes) * moves]))

    def _draw_arrow(self, role: Role, vector: np.ndarray, length: float) -> None:
        """Draw an arrow from the node; `length` is the mean edge length, the unit of all sizes."""
        far = float(np.linalg.norm(vector))
        tip = min(_TIP_LENGTH * length, 0.6 * far)
        thick = tip / _TIP_LENGTH  # a short arrow is a thin one
        for actor, rim in zip(self._arrows[role], (_RIM_WIDTH * length, 0.0), strict=True):
            actor.SetVisibility(far > 1e-6 * length)
            if actor.GetVisibility():
                drawn = pv.Arrow(
                    start=self.step.before,
                    direction=vector,
                    scale=far + 2 * rim,
                    tip_length=(tip + 2.5 * rim) / (far + 2 * rim),
                    tip_radius=(_TIP * thick + 1.5 * rim) / (far + 2 * rim),
                    shaft_radius=(_SHAFT * thick + rim) / (far + 2 * rim),
                )
                _draw(actor, drawn)

    def _draw_balls(self, name: str, places: list[np.ndarray], length: float) -> None:
        for actor, rim in zip(self._balls[name], (_RIM_WIDTH, 0.0), strict=True):
            actor.SetVisibility(bool(places))
            if places:
                ball = pv.Sphere(radius=(_BALLS[name] + rim) * length, theta_resolution=16, phi_resolution=12)
                _draw(actor, pv.PolyData(np.array(places)).glyph(geom=ball, scale=False, orient=False))

    def hide(self) -> None:
        """Draw nothing."""
        self.step = None
        for layer in self.layers:
            layer.DrawOff()


def _draw(actor: vtkActor, poly: pv.PolyData) -> None:
    actor.GetMapper().SetInputData(poly)


def _lines(points: np.ndarray, edges: np.ndarray) -> pv.PolyData:
    """Build lines between points (k, 3), by edges (j, 2)."""
    return pv.PolyData(points, lines=np.column_stack([np.full(len(edges), 2), edges]).ravel())


def _scaled(vector: np.ndarray, length: float) -> np.ndarray:
    """Scale a vector to another length; a zero vector stays zero."""
    far = float(np.linalg.norm(vector))
    return vector * (length / far) if far > 0 else vector
