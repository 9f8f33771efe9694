"""Last stage of mend: hexes that are invalid although their corners are positive become valid."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import os
import numpy as np

from hexmend.arrays import mask
from hexmend.energy import MeshEnergy
from hexmend.energy.validity_barrier import ValidityBarrier
from hexmend.iteration import Step
from hexmend.kernels.line_search import LineSearch
from hexmend.optimise.descent import descend
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.optimise.floors.region import Region
from hexmend.optimise.search_direction import TruncatedNewton, TruncatedNewtonConfig
from hexmend.quality import ElementQuality, measure
from hexmend.quality.validity import Validity


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
    band, weight : float
        Of the barriers; the band of Bernstein coefficients is in the greatest coefficient of a hex.
    share : float
        Share of the distance between its floor and the least coefficient by which the floor rises after a step.
    steps : int
        Most Newton steps with one share.
    min_rise, window : float, int
        The steps end where so many of them raise the floor by less than this.
    """

    kept_shares: tuple[float, ...] = tuple(map(float, os.environ.get("SH","0.98,0.9,0.5,0.0").split(",")))
    rings: int = 2
    band: float = 0.1
    weight: float = 1.0
    share: float = 0.9
    steps: int = int(os.environ.get("STEPS","60"))
    min_rise: float = 1e-3
    window: int = 5


CERTIFICATION = CertificationConfig()
_SEARCH = LineSearch(backtrack_factor=0.5)


def certify_hexes(
    energy: MeshEnergy, points: np.ndarray, config: CertificationConfig = CERTIFICATION
) -> Generator[Step, None, np.ndarray]:
    """Make hexes valid that are invalid between positive corners.

    The energy is minimised around them, with barriers of the lowest values of all hexes there, and of the Bernstein
    coefficients of det J of the invalid ones, whose floor rises until the certificate holds.

    Parameters
    ----------
    energy : MeshEnergy
        Of one rank; corners that are inverted at `points` are omitted.
    points : (n, 3) float64
    config : CertificationConfig

    Yields
    ------
    Step

    Returns
    -------
    (n, 3) float64
        Points with fewer invalid hexes; `points` where there are none.
    """
    hexes = energy.mesh.hexes
    best, quality, reached = points, measure(points, hexes), points
    for share in config.kept_shares:
        if not _curable(energy, quality).any():
            break
        found, reached = yield from _raise_coefficients(energy, reached, measure(reached, hexes), share, config)
        now = measure(found, hexes)
        if now.n_invalid < quality.n_invalid and now.n_inverted <= quality.n_inverted:
            best, quality = found, now
            yield Step(best, intermediate=True, quality=now)
    return best


def _curable(energy: MeshEnergy, quality: ElementQuality) -> np.ndarray:
    """Mark the hexes that are invalid between positive corners and have a free node, (m,) bool."""
    inside = (quality.validity != Validity.VALID) & ~quality.inverted
    return inside & energy.mesh.free[energy.mesh.hexes].any(axis=1)


def _raise_coefficients(
    energy: MeshEnergy, points: np.ndarray, quality: ElementQuality, share: float, config: CertificationConfig
) -> Generator[Step, None, np.ndarray]:
    """Take Newton steps from points (n, 3) on until all hexes that can be cured are valid, or the floor no longer rises.

    Hexes that become invalid on the way join the others.
    """
    mesh, x = energy.mesh, energy.to_edge_units(points)
    cured, best, fewest = _curable(energy, quality), points, quality.n_invalid
    values = MovableHexes(energy)
    least = [float(of.min(initial=np.inf)) for of in (values.jacobians(x), values.qualities(x))]
    floors = [value - (1 - share) * max(abs(value), config.band * 0.1) for value in least]
    left = config.steps
    while left > 0:
        around = cured
        for _ in range(config.rings):
            around = mask(mesh.hexes[around], mesh.n_nodes)[mesh.hexes].any(axis=1)
        region = Region(energy, np.flatnonzero(around), x)
        part, y = region.energy, region.inside(x)
        barrier = MovableHexes(part).barrier(*floors, config.band, config.band, config.weight)
        some = np.flatnonzero(cured[region.hexes])
        validity = ValidityBarrier.of(part.mesh.hexes[some], y, config.band, config.weight)
        direction = TruncatedNewton(TruncatedNewtonConfig(200, loosest=0.1))
        history = [float(np.minimum(validity.floors, 0).sum())]
        more = False
        gap = float(os.environ.get("GAP","0.25"))
        while left > 0:
            left -= 1
            step = descend(part.with_barrier(barrier).with_surface(validity), y, 0.0, direction, _SEARCH, 1.5)
            if step is None or step.alpha == 0:
                return best, energy.to_mesh_units(x)
            y = step.x
            validity = validity.raised(y, gap)
            floor = float(np.minimum(validity.floors, 0).sum())
            history.append(floor)
            now = measure(y, part.mesh.hexes)
            x = region.merged(x, y)
            print("   ", share, len(some), round(floor, 4), now.n_invalid, round(step.alpha, 4), round(now.scaled_jacobian.min(), 4))
            invalid = _curable(part, now)
            whole = energy.to_mesh_units(x)
            yield Step(whole, {"floor": floor}, intermediate=True)
            if not invalid.any():
                return whole, whole
            if measure(whole, mesh.hexes).n_invalid < fewest:
                best, fewest = whole, measure(whole, mesh.hexes).n_invalid
            new = region.hexes[invalid & ~cured[region.hexes]]
            if new.size:
                cured = cured.copy()
                cured[new] = True
                more = True
                break
            if len(history) > config.window and history[-1] - history[-1 - config.window] < config.min_rise:
                gap /= 2
                history = history[-1:]
                if gap < float(os.environ.get("GMIN","0.02")): return best, whole
        if not more:
            return best, whole
    return best, whole
