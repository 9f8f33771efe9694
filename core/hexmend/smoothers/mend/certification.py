"""Last stage of mend: hexes that are invalid although their corners are positive become valid."""

from __future__ import annotations

from collections.abc import Generator, Iterable
from dataclasses import dataclass

import numpy as np

from hexmend.arrays import mask
from hexmend.energy import MeshEnergy
from hexmend.energy.barriers.validity_barrier import ValidityBarrier
from hexmend.energy.terms import Term, Terms
from hexmend.iteration import Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.optimise.floors.region import Region
from hexmend.optimise.search_direction import TruncatedNewton
from hexmend.quality import ElementQuality, locked_hexes, measure
from hexmend.smoothers.mend.floors import FLOORS
from hexmend.smoothers.mend.newton_steps import newton_step
from hexmend.smoothers.mend.untangling import PATIENCE


@dataclass(frozen=True)
class CertificationConfig:
    """Settings of the stage.

    Parameters
    ----------
    kept_shares : tuple of float
        Shares of the minimum scaled Jacobian and of the least q(H) below which these may not fall, one after the other
        until all hexes are valid.
    rings : int
        Layers of hexes around the invalid ones whose nodes move.
    band : float
        Width of the barriers above their floors, in scaled Jacobian, q(H), and det J over the greatest in the hex.
    gap : float
        Of `ValidityBarrier.with_higher_floors` at first; it is halved where the floors no longer rise.
    steps : int
        Most Newton steps with one share.
    """

    kept_shares: tuple[float, ...] = (0.98, 0.9, 0.5, 0.0)
    rings: int = 2
    band: float = FLOORS.band
    gap: float = 0.25
    steps: int = PATIENCE


CERTIFICATION = CertificationConfig()


def certify_hexes(
    energies: Iterable[MeshEnergy], points: np.ndarray, config: CertificationConfig = CERTIFICATION
) -> Generator[Step, None, np.ndarray]:
    """Make hexes valid that are invalid between positive corners.

    The energy is minimised around them, above floors of the scaled Jacobians and of q(H), while floors of the Bernstein
    coefficients of their det J rise, until the certificate holds.

    Parameters
    ----------
    energies : iterable of MeshEnergy
        Of one rank, for one share of the least values after the other; corners that are inverted at `points` are
        omitted.
    points : (n, 3) float64
    config : CertificationConfig

    Yields
    ------
    Step

    Returns
    -------
    (n, 3) float64
        Points with fewer invalid hexes, or `points`.
    """
    best, reached = points, points
    for share, energy in zip(config.kept_shares, energies, strict=False):
        if not curable_hexes(energy.mesh, measure(best, energy.mesh.elements)).any():
            break
        best, reached = yield from _Certification(energy, reached, best, share, config).steps()
    if reached is not best:
        yield Step(best, intermediate=True)  # else a run would keep what was reached: of equals it keeps the last
    return best


def curable_hexes(mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    """Mark the invalid cells that can become valid, (m,) bool.

    They have a free node, and no corner that fixed nodes lock in inversion. Of hexes that overlap at a node wherever it
    is, the worst stays invalid.
    """
    locked = locked_hexes(mesh.points, mesh.elements, mesh.fixed, quality.inverted)
    curable = quality.invalid & ~locked & mesh.free[mesh.elements].any(axis=1)
    overlapping = mesh.topology.overlapping_corners
    for node in np.flatnonzero(np.diff(overlapping.start)):
        hexes = np.unique(overlapping[node] // 8)
        curable[hexes[quality.scaled_jacobian[hexes].argmin()]] = False
    return curable


class _Certification:
    """Newton steps from points (n, 3) on, with a share of the least values that is kept.

    `best` are the points with the fewest invalid hexes so far.
    """

    def __init__(
        self, energy: MeshEnergy, points: np.ndarray, best: np.ndarray, share: float, config: CertificationConfig
    ):
        self._energy, self._config, self._points = energy, config, points
        self._best, self._fewest = best, measure(best, energy.mesh.elements).n_invalid
        values, x = MovableHexes(energy), energy.to_edge_units(points)
        least = [float(of.min(initial=np.inf)) for of in (values.jacobians(x), values.qualities(x))]
        self._floors = [value - (1 - share) * max(abs(value), 0.1 * config.band) for value in least]

    def steps(self) -> Generator[Step, None, tuple[np.ndarray, np.ndarray]]:
        """Step until all hexes are valid that can be, or their coefficients no longer rise.

        Returns
        -------
        best, reached : (n, 3) float64
        """
        mesh = self._energy.mesh
        cured = curable_hexes(mesh, measure(self._points, mesh.elements))
        left, joined = self._config.steps, cured
        while joined.any() and left > 0:
            cured = cured | joined
            used, joined = yield from self._raise_coefficients(cured, left)
            left -= used
        return self._best, self._points

    def _raise_coefficients(self, cured: np.ndarray, most: int) -> Generator[Step, None, tuple[int, np.ndarray]]:
        """Raise the floors of some hexes (m,) bool, by `most` steps at most, until others become invalid too.

        Returns the number of steps, and a mark of these others, (m,) bool.
        """
        energy, config, none = self._energy, self._config, np.zeros(len(cured), dtype=bool)
        x = energy.to_edge_units(self._points)
        region = Region(energy, mask(energy.mesh.elements[self._around(cured)], energy.mesh.n_nodes), x)
        barrier = MovableHexes(region.energy).barrier(*self._floors, config.band, config.band, 1.0)
        part, y = region.energy.with_barrier(barrier), region.inside(x)
        validity = ValidityBarrier.of(part.mesh.elements[cured[region.hexes]], y, config.band, 1.0)
        direction, gap = TruncatedNewton(), config.gap
        for number in range(1, most + 1):
            step = newton_step(_with_term(part, validity), y, 0.0, direction)
            if step is None or step.alpha == 0:
                return most, none
            before = validity.deficit
            y, validity = step.x, validity.with_higher_floors(step.x, gap)
            yield self._take(energy.to_mesh_units(region.merged(x, y)), validity)
            invalid = curable_hexes(part.mesh, measure(y, part.mesh.elements))
            if not invalid.any():
                return most, none
            joined = none.copy()
            joined[region.hexes[invalid]] = True
            joined &= ~cured
            if joined.any():
                return number, joined
            if not validity.deficit < before:
                gap /= 2
        return most, none

    def _around(self, hexes: np.ndarray) -> np.ndarray:
        """Mark hexes (m,) bool and those in the rings around them."""
        mesh = self._energy.mesh
        for _ in range(self._config.rings):
            hexes = mask(mesh.elements[hexes], mesh.n_nodes)[mesh.elements].any(axis=1)
        return hexes

    def _take(self, points: np.ndarray, validity: ValidityBarrier) -> Step:
        """Take over points (n, 3), and return the step to them."""
        quality = measure(points, self._energy.mesh.elements)
        if quality.n_invalid < self._fewest:
            self._best, self._fewest = points, quality.n_invalid
        self._points = points
        return Step(points, {"deficit": validity.deficit}, intermediate=True, quality=quality)


def _with_term(energy: MeshEnergy, term: Term) -> MeshEnergy:
    """Return an energy with one more term."""
    return energy.with_surface(term if energy.surface is None else Terms(energy.surface, term))
