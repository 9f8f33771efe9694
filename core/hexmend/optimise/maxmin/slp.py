"""Sequential linear programming with a trust region: the least value of a measure is raised as far as it goes.

The least of many functions has no derivative where two of them are equal, which is where its maximum lies. So each step
takes all functions that could become the least by their linear models, and finds the displacement within a trust region
that raises their least most: a linear program (Madsen 1975; Fletcher and Sainz de la Maza 1989). At the end its
multipliers name the active corners: hardly any direction raises one of them without lowering another.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hexmend.boundary import NodeClass, SlidingBoundary
from hexmend.mesh.edge_length import shortest_edges
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.constrained_directions import constrained_directions, least_of_tied
from hexmend.optimise.maxmin.corner_measure import SCALED_JACOBIAN, CornerMeasure
from hexmend.optimise.maxmin.corner_set import MovableCorners
from hexmend.optimise.maxmin.directions import step_directions
from hexmend.optimise.maxmin.envelope import Envelope
from hexmend.optimise.maxmin.linear_program import INITIAL_MARGIN, SMALL_MARGIN, LinearConstraints, solve
from hexmend.optimise.maxmin.slp_config import SLP, SLPConfig
from hexmend.optimise.maxmin.slp_step import ActiveCorners, MaxMinStep
from hexmend.optimise.maxmin.vertex import Vertex


class MaxMinOptimiser:
    """Optimiser of the least value of the corners that can be moved.

    Parameters
    ----------
    mesh : Mesh
        Its free nodes are moved.
    points : (n, 3) float64
        The points to begin with.
    sliding : SlidingBoundary, optional
        The boundary's nodes slide on it; `mesh` is its mesh then.
    config : SLPConfig, optional
    measure : CornerMeasure, optional
        The scaled Jacobian by default.

    Attributes
    ----------
    points : (n, 3) float64
        The current points.
    corners : MovableCorners
        Their values at these points.
    envelope : Envelope
        The band in which the boundary stays.
    programs : int
        Number of linear programs that were solved.
    at_maximum : bool
        The last linear program promised no gain, whatever its trust region: no step raises the least.
    band_limits : bool
        The band around the surface limited the gain of the last linear program.
    """

    def __init__(
        self,
        mesh: Mesh,
        points: np.ndarray,
        sliding: SlidingBoundary | None = None,
        config: SLPConfig = SLP,
        measure: CornerMeasure = SCALED_JACOBIAN,
    ):
        self.config = config
        self.points, self.corners = points, MovableCorners(mesh, points, measure)
        self.envelope, self.programs, self._vertex = Envelope(mesh.n_nodes, sliding), 0, Vertex()
        self.at_maximum = self.band_limits = False
        self._begin()

    @property
    def mesh(self) -> Mesh:
        """The mesh with its current fixed nodes: released nodes are free."""
        return self.corners.mesh

    @property
    def least(self) -> float:
        """The least value of the corners that are raised, in the mesh's unit."""
        return self.corners.active_minimum * self.corners.measure.unit

    def measured_by(self, measure: CornerMeasure) -> MaxMinOptimiser:
        """Return an optimiser of another measure that continues from here, with the same released nodes and band."""
        other = MaxMinOptimiser(self.mesh, self.points, config=self.config, measure=measure)
        other.envelope = self.envelope
        return other

    def fork(self) -> MaxMinOptimiser:
        """Return an optimiser that continues from here by itself, with the same released nodes and band."""
        other = MaxMinOptimiser(self.mesh, self.points, self.envelope.sliding, self.config, self.corners.measure)
        other.envelope.released |= self.envelope.released
        other.envelope.off_surface |= self.envelope.off_surface
        other.envelope.limit_to(self.envelope.max_deviation)
        return other

    def improve_to(self, points: np.ndarray) -> None:
        """Go on from other points (n, 3), if their least is higher."""
        before = self.corners.active_minimum, self.corners.values.copy()
        self.corners.update(points, np.arange(self.mesh.n_hexes))
        if self.corners.active_minimum > before[0]:
            self.points = points
        else:
            self.corners.set_values(np.arange(self.mesh.n_hexes), before[1])

    def move_to(self, points: np.ndarray) -> None:
        """Go on from other points (n, 3)."""
        self.points, self.at_maximum = points, False
        self.corners.update(points, np.arange(self.mesh.n_hexes))

    def steps(self, target: float = np.inf, patient_below: float = -np.inf) -> Iterator[MaxMinStep | ActiveCorners]:
        """Raise the least until steps gain or programs promise too little, or it has reached `target`.

        Below `patient_below` a program that promises little is no reason to end.

        Yields
        ------
        MaxMinStep or ActiveCorners
            Each accepted step; at last the corners that limit the least.
        """
        config = self.config
        self._begin()
        gains = [np.inf] * config.window
        while self._radius > config.min_radius and self.corners.active_minimum < target:
            values, least, radius = self.corners.active_values.ravel(), self.corners.active_minimum, self._radius
            band = float(np.clip(config.active_band * radius, config.min_active_band, config.max_active_band))
            low = np.flatnonzero(values < least + band)
            whole = low.size <= self._max_corners
            if not whole:
                low = low[np.argpartition(values[low], self._max_corners)[: self._max_corners]]
            promised, points, moved = self._step(low, band)
            gain = self._accept(points, moved, least, promised) if promised > config.no_gain else 0.0
            if gain > 0:
                yield MaxMinStep(self.points, self.least, low.size, radius)
            gains.append(gain)
            is_sound = least >= config.acceptable
            enough = config.min_gain_acceptable if is_sound else config.min_gain
            least_promise = config.no_gain
            if is_sound and least >= patient_below:
                per_step = config.promise * enough / config.window * min(radius / config.initial_radius, 1.0)
                least_promise = max(least_promise, per_step)
            if promised <= least_promise or sum(gains[-config.window :]) < enough:
                if whole or self._max_corners >= config.max_corners:
                    break
                self._max_corners, self._radius = 2 * self._max_corners, max(self._radius, config.min_active_band)
                gains.append(np.inf)
        yield self._active_corners()

    def return_to_band(self, max_deviation: float) -> Iterator[MaxMinStep]:
        """Bring the boundary nearer to the surface until it is in its band, with the least loss of the minimum.

        Where that takes too many steps, the loss no longer counts; it is given up where it takes too many still. Frozen
        corners are free again.

        Parameters
        ----------
        max_deviation : float
            Distance of boundary and surface in the band, in the mesh's unit of length.
        """
        config = self.config
        self._begin()
        self.corners.unfreeze()
        careful, distances = True, list[float]()
        corners, envelope, edge = self.corners, self.envelope, self.mesh.mean_edge_length
        allowed, share = max_deviation * (1 + config.return_tolerance), config.return_step
        while self._radius > config.min_radius and (far := envelope.largest_deviation(self.points, allowed)) > allowed:
            distances.append(far)
            if _too_slow(distances, max_deviation, config):
                if not careful:
                    break
                careful, distances, self._radius, share = False, [], config.initial_radius, config.return_step
            radius = self._radius
            envelope.limit_to(max(max_deviation, far - share * radius * edge))
            near = corners.active_values.ravel() < corners.active_minimum + config.min_active_band
            low = np.flatnonzero(near)[: self._max_corners]
            outside = envelope.nodes_outside_band(self.points)
            least = corners.active_minimum
            promised, points, moved = self._step(low, config.min_active_band, outside[self.mesh.free[outside]])
            if points is self.points and share > config.min_return_step:
                share = max(config.shrink * share, config.min_return_step)  # edges here may be shorter than others
                continue
            if envelope.largest_deviation(points, allowed) > far - config.accept * (far - envelope.max_deviation):
                self._radius *= config.shrink
                continue
            hexes = corners.hexes_at(moved)
            before = corners.values[hexes]
            corners.update(points, hexes)
            if careful and corners.active_minimum < least + promised - config.return_loss:
                corners.set_values(hexes, before)
                self._radius *= config.shrink
                continue
            envelope.track(self.points, points, moved)
            self.points, self._radius = points, min(config.grow * self._radius, config.max_radius)
            share = min(config.grow * share, config.return_step)
            yield MaxMinStep(points, self.least, low.size, radius)
        envelope.limit_to(max_deviation)

    def freeze(self, active: ActiveCorners) -> None:
        """Fix the nodes of corners that hold each other, so that the corners above them can be raised further."""
        self.corners.freeze(8 * active.hexes + active.corners)

    def release(self, active: ActiveCorners, around: bool = False) -> bool:
        """Let nodes of corners that hold each other leave their curve or the surface; return True if any was released.

        Nodes of curves go onto the patches first, and leave the surface where that is not enough. Where a hex is
        inverted they leave it at once, and corners of the surface too if no other node is left. With `around`, nodes of
        the hexes around these corners follow.
        """
        envelope, sliding, mesh = self.envelope, self.envelope.sliding, self.mesh
        if sliding is None or not envelope.max_deviation > 0:
            return False
        holding = np.unique(self.corners.nodes_of(8 * active.hexes + active.corners))
        if around:
            holding = np.unique(mesh.hexes[self.corners.hexes_at(holding)])
        nodes = holding[envelope.slides(holding) & ~sliding.confined[holding]]
        if active.least > 0:
            of_curves = nodes[sliding.node_class[nodes] == NodeClass.CURVE]
            if of_curves.size:
                envelope.move_onto_patches(of_curves)
                return True
        elif not nodes.size:
            nodes = holding[sliding.releasable[holding] & ~mesh.free[holding]]
        self.release_nodes(nodes)
        return nodes.size > 0

    def release_nodes(self, nodes: np.ndarray) -> None:
        """Let nodes (k,) of the boundary leave the surface, corners too."""
        fixed = self.mesh.fixed.copy()
        fixed[nodes] = False
        self.corners.set_mesh(self.mesh.with_fixed(fixed))
        self.envelope.release(nodes)

    def _begin(self) -> None:
        self._radius, self._max_corners = self.config.initial_radius, self.config.initial_corners
        self._multipliers: tuple[np.ndarray, np.ndarray] = np.empty(0, np.int64), np.empty(0)

    def _step(
        self, low: np.ndarray, band: float, outside: np.ndarray | None = None
    ) -> tuple[float, np.ndarray, np.ndarray]:
        """Solve the linear program of the nodes at corners `low`; with nodes outside the band, the least may fall.

        Returns the gain that it promises, all points with these nodes moved and projected, and the numbers of these.
        """
        self.programs, self.at_maximum, self.band_limits = self.programs + 1, False, False
        corners, envelope, radius, least = self.corners, self.envelope, self._radius, self.corners.active_minimum
        nodes = corners.movable(np.unique(corners.nodes_of(low)))
        if outside is not None:
            nodes = np.union1d(nodes, outside)
        around = corners.hexes_at(nodes)
        near = (8 * around[:, None] + np.arange(8)).ravel()
        near = near[corners.active_values.ravel()[near] - least < band + self.config.max_slope * radius]
        corner_nodes = corners.nodes_of(near)
        models = corners.measure.models(self.points, corner_nodes)
        size, motion = shortest_edges(self.points, self.mesh.hexes[around]), self.mesh.linear_motion
        if motion is not None:
            size = least_of_tied(size, motion)
        slack = np.maximum(models.values - least, 0.0)
        constraints = LinearConstraints(corner_nodes[models.corner], slack, models.derivatives, np.ones(slack.size))
        moves = np.zeros(len(self.points))
        moves[nodes] = radius * size[nodes]
        bounds = envelope.bounds(self.points, moves)
        if outside is None:
            np.maximum(bounds.slack, 0.0, out=bounds.slack)
        x, slides = self.points[nodes], envelope.slides(nodes)
        directions = step_directions(x, size[nodes], radius, nodes, slides, envelope.sliding)
        if motion is not None:
            directions = constrained_directions(directions, nodes, size[nodes], motion)
        on_surface = envelope.sliding is not None and not envelope.released.any()
        margin = SMALL_MARGIN if on_surface else INITIAL_MARGIN
        models_and_bounds = constraints.concatenate(bounds)
        solved = solve(nodes, directions, models_and_bounds, radius, outside is not None, margin, self._vertex)
        if solved is None:
            return 0.0, self.points, nodes
        self.at_maximum = solved.gain <= self.config.no_gain * radius
        self.band_limits = bool((solved.multipliers[slack.size :] > self.config.min_multiplier).any())
        self._multipliers = near, np.bincount(models.corner, solved.multipliers[: slack.size], near.size)
        points = self.points.copy()
        lengths = solved.lengths[directions.columns, None]
        np.add.at(points, nodes[directions.node_index], lengths * directions.displacements)
        return solved.gain, envelope.project(self.points, self.mesh.constrained(points), nodes), nodes

    def _accept(self, points: np.ndarray, moved: np.ndarray, least: float, promised: float) -> float:
        """Accept `points` if the gain is large enough, and adapt the trust region; returns the gain, 0 if rejected."""
        corners, config = self.corners, self.config
        hexes = corners.hexes_at(moved)
        before = corners.values[hexes]
        corners.update(points, hexes)
        gain = corners.active_minimum - least
        if gain > config.accept * promised and self.envelope.leaves_band(self.points, points, moved):
            gain = -np.inf
        share = gain / promised
        if share > config.good:
            self._radius = min(config.grow * self._radius, config.max_radius)
        elif share < config.poor:
            self._radius *= config.shrink
        if share > config.accept:
            self.points = points
            return gain
        corners.set_values(hexes, before)
        return 0.0

    def _active_corners(self) -> ActiveCorners:
        corners, weights = self._multipliers
        order = np.argsort(-weights, kind="stable")
        order = order[weights[order] > self.config.min_multiplier]
        return ActiveCorners(self.corners.active_minimum, corners[order] // 8, corners[order] % 8)


def _too_slow(distances: list[float], max_deviation: float, config: SLPConfig) -> bool:
    """Return True if the distances from a band fall so slowly that it is not reached."""
    if len(distances) <= config.return_window:
        return False
    return distances[-1] - max_deviation > config.return_pace * (distances[-1 - config.return_window] - max_deviation)
