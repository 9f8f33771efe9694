"""The least scaled Jacobian as an unknown: energy + barrier of all corners above a floor t - K t, with t eliminated.

At each position t is the minimiser, found by Newton's method in one dimension. The gradient is that of the barrier at
this t; the Hessian has one more term, -b b^T/c, where c is the second derivative by t and b that by t and the
positions: the direction is corrected for it by the formula of Sherman and Morrison.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, cast

import numpy as np

from hexmend.energy import Hessian, MeshEnergy
from hexmend.energy.barriers.floor_barrier import FloorBarrier
from hexmend.energy.barriers.height_barrier import HeightBarrier
from hexmend.energy.ranks import Ranks
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.optimise.search_direction import SearchDirection, TruncatedNewton


class Floor(NamedTuple):
    """The floor t that minimises at some positions, its value with the reward, and the second derivative by t."""

    t: float
    value: float
    curvature: float


@dataclass(frozen=True)
class Reward:
    """Worth of a higher least value.

    Parameters
    ----------
    reward : float
        K, for each unit of the floor.
    weight : float
        Of the barrier.
    band : float
        Width of the barrier.
    quality_floor : float
        Floor of q(H), whose barrier is as wide; -inf: none.
    """

    reward: float
    weight: float
    band: float
    quality_floor: float = -np.inf

    @property
    def gap(self) -> float:
        """Distance of the floor from the least value, nearly, if one corner alone is near it."""
        return self.weight / self.reward


class MaximisedFloor:
    """Energy with the floor of the scaled Jacobians as an eliminated unknown; the rest is that of `energy`.

    Parameters
    ----------
    energy : MeshEnergy
    reward : Reward
    hexes : MovableHexes
        Of the energy.
    """

    def __init__(self, energy: MeshEnergy, reward: Reward, hexes: MovableHexes):
        self._energy, self._reward, self.hexes = energy, reward, hexes
        self._known: list[tuple[np.ndarray, Floor]] = []
        self._limit, self.barrier = -1.0, self._barrier(0.0)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._energy, name)

    @property
    def as_energy(self) -> MeshEnergy:
        """This, as the type that `descend` takes: it has all that is used there."""
        return cast(MeshEnergy, self)

    def _barrier(self, t: float) -> FloorBarrier | HeightBarrier:
        reward = self._reward
        return self.hexes.barrier(t, reward.quality_floor, reward.band, reward.band, reward.weight)

    def _at(self, t: float) -> MeshEnergy:
        """Return the energy with the barrier of a floor."""
        return self._energy.with_barrier(self._barrier(t))

    def floor(self, x: np.ndarray) -> Floor:
        """Find the floor at positions x (n, 3) in mean edge lengths; the last two results are kept."""
        for known, floor in self._known:
            if known is x:
                return floor
        floor = self._floor(x)
        self._known[:] = [(x, floor), *self._known[:1]]
        return floor

    def _floor(self, x: np.ndarray) -> Floor:
        band, reward = self._reward.band, self._reward.reward
        weight, ranks = self._reward.weight, self._energy.ranks
        values = self.hexes.corners(x)
        least = ranks.least(float(values.min(initial=np.inf)))
        values = values[values < least + band]

        def terms(t: float) -> tuple[float, float, float]:
            y = (values - t) / band
            y = y[y < 1]
            return (
                weight * ranks.sum(float((-np.log(y) + (y - 1) - (y - 1) ** 2 / 2).sum())) - reward * t,
                weight / band * ranks.sum(float((1 / y - 1 + (y - 1)).sum())) - reward,
                weight / band**2 * ranks.sum(float((1 / y**2 - 1).sum())),
            )

        low, high = least - band * (1 - 1e-9), float(np.nextafter(least, -np.inf))
        t = min(max(low, least - self._reward.gap), high)
        value, slope, curvature = terms(t)
        while low < t < high and slope != 0:  # Newton's method, or bisection, until the next number is the same
            low, high = (low, t) if slope > 0 else (t, high)
            newton = t - slope / max(curvature, 1e-300)
            if newton == t:
                break
            t = newton if low < newton < high else (low + high) / 2
            value, slope, curvature = terms(t)
        return Floor(t, value, curvature)

    def multipliers(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Find the corners in the band at positions x (n, 3): hexes, apex nodes and shares of the reward, (k,)."""
        band, t, corners = self._reward.band, self.floor(x).t, self.hexes.corners_in_place(x)
        hexes, at = np.nonzero(corners < t + band)
        y = (corners[hexes, at] - t) / band
        shares = self._reward.gap / band * (1 / y - 1 + (y - 1))
        return hexes, self._energy.mesh.elements[hexes, at].astype(np.int64), shares

    def value(self, x: np.ndarray, delta: float = 0.0) -> float:
        """Compute the energy at positions x (n, 3) with the floor that minimises it."""
        floor, reward, rest = self.floor(x), self._reward, self._energy
        if reward.quality_floor > -np.inf:
            rest = rest.with_barrier(
                self.hexes.barrier(-np.inf, reward.quality_floor, reward.band, reward.band, reward.weight)
            )
        value = rest.value(x, delta)
        return value + floor.value if np.isfinite(value) else np.inf

    def gradient(self, x: np.ndarray, delta: float = 0.0) -> np.ndarray:
        """Compute the gradient at positions x (n, 3); t is at its minimum, so that its change does not count."""
        t = self.floor(x).t
        self._limit = t - self._reward.gap
        return self._at(t).gradient(x, delta)

    def hessian(self, x: np.ndarray, delta: float = 0.0) -> Hessian:
        """Return the Hessian at positions x (n, 3) with the floor as it is there; see `FloorDirection`."""
        return self._at(self.floor(x).t).hessian(x, delta)

    def directional_derivative(self, x: np.ndarray, delta: float, step: np.ndarray, gradient: np.ndarray) -> float:
        """Compute the slope at positions x (n, 3) along a step (k, 3); see `MeshEnergy`."""
        return self._at(self.floor(x).t).directional_derivative(x, delta, step, gradient)

    def with_barriers(self, x: np.ndarray, delta: float, among: np.ndarray | None = None) -> np.ndarray:
        """Compute the energies of hexes with the barrier of a lower floor than in the last gradient; see `descend`."""
        return self._at(self._limit).with_barriers(x, delta, among)

    def mixed(self, x: np.ndarray) -> np.ndarray:
        """Derivative of the gradient at positions x (n, 3) by the floor, (k, 3)."""
        t, h = self.floor(x).t, min(1e-4 * self._reward.gap, 1e-5)
        energy = self._energy.with_surface(None)  # which does not depend on the floor
        high, low = (energy.with_barrier(self._barrier(each)).gradient(x) for each in (t + h, t - h))
        return (high - low) / (2 * h)


class FloorDirection:
    """Newton direction of a `MaximisedFloor`, by two solutions with one matrix."""

    def __init__(self, energy: MaximisedFloor, newton: TruncatedNewton | None = None):
        self._energy, self._newton = energy, newton or TruncatedNewton()
        self._mixed, self._curvature = np.empty(0), 0.0  # derivatives by the floor, at the last positions

    def __call__(self, value: float, gradient: np.ndarray, hessian: Hessian) -> SearchDirection:
        # First, as the matrix lends its memory to gradients afterwards.
        self._mixed, self._curvature = self._energy.mixed(hessian.x), self._energy.floor(hessian.x).curvature
        return self._corrected(self._newton(value, gradient, hessian), gradient, hessian.energy.ranks)

    def damped(self, gradient: np.ndarray, hessian: Hessian) -> SearchDirection | None:
        """Return the direction at the same positions with more damping; see `TruncatedNewton.damped`."""
        found = self._newton.damped(gradient, hessian)
        return None if found is None else self._corrected(found, gradient, hessian.energy.ranks)

    def shortened(self) -> None:
        """See `TruncatedNewton.shortened`."""
        self._newton.shortened()

    def _corrected(self, found: SearchDirection, gradient: np.ndarray, ranks: Ranks) -> SearchDirection:
        """Correct the direction without the floor for its change."""
        mixed, curvature, vector = self._mixed, self._curvature, found.vector
        other, iterations, is_definite = self._newton.solve_again(mixed)
        rest = curvature - ranks.sum(float((mixed * other).sum()))
        if rest > 0 and is_definite:
            along = ranks.sum(float((mixed * vector).sum()))
            corrected = vector + other * (along / max(rest, 1e-3 * curvature))
            if ranks.sum(float((gradient * corrected).sum())) < 0:
                vector = corrected
        return SearchDirection(vector, found.solver_iterations + iterations, found.shift)
