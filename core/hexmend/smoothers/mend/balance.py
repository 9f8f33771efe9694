"""Stage of mend for the goal balanced: the best shape above floors of the scaled Jacobian and of q(H)."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass, replace

import numpy as np

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.sliding_energy import SlidingEnergy
from hexmend.iteration import Step
from hexmend.optimise.floors.central_path import PATH, CentralPath, CentralPathConfig, Least
from hexmend.quality import measure

_PATIENT = replace(
    PATH,
    jacobian_gap=0.01,
    quality_gap=0.01,
    max_hexes=0.2,
    few_hexes=20_000,
    min_gain=1e-3,
    window=4,
    max_floors=50,
)
_FACETED = replace(PATH, window=4)
_CAREFUL = replace(_PATIENT, jacobian_gap=5e-3, quality_gap=5e-3, min_gain=2e-4, max_floors=20)


@dataclass(frozen=True)
class BalanceConfig:
    """Settings of the stage.

    Parameters
    ----------
    kept_share : tuple of float
        Shares of the highest minimum scaled Jacobian tried as its floor, until the mean of q(H) is no lower than
        at the start.
    quality_margin : float
        Share by which the least q(H) is raised above its floor at first.
    margin, last_margin : float
        Least distance of a floor from the value above it, as a share; the second of the minimum scaled Jacobian of a
        result, where that is as high as it goes.
    weights, last_weights : tuple of float
        Of the barrier while the energy falls above the floors; the second above the least values of a result.
    returns : tuple of float
        Shares of the way from the given mesh to the result that are tried where the mean of q(H) is lower all the same.
    much : float
        Multiple of the floor of the minimum scaled Jacobian above which the first rise is followed by a patient one,
        unless the surface is faceted.
    worth_rising : float
        Share by which that has to raise the least.
    sound : float
        Minimum scaled Jacobian from which on nothing is to be gained.
    target_fall : float
        Share by which the least values may fall where a mesh has a target.
    path, faceted : CentralPathConfig
        Of the first rise; the second on a faceted surface, where single floors gain little on the way.
    patient : CentralPathConfig
        Of the rise after it, where figures of the given mesh are not reached yet.
    careful : CentralPathConfig
        Of the rise from the given mesh, where they cannot be reached otherwise.
    """

    kept_share: tuple[float, ...] = (0.96, 0.9, 0.75, 0.5, 0.0)
    quality_margin: float = 2e-3
    margin: float = 1e-4
    last_margin: float = 1e-5
    weights: tuple[float, ...] = (1.0, 0.1, 0.01)
    last_weights: tuple[float, ...] = (0.1, 0.01)
    returns: tuple[float, ...] = (0.5, 0.25, 0.125, 0.0625)
    much: float = 2.0
    worth_rising: float = 0.01
    sound: float = 0.99
    target_fall: float = 0.05
    path: CentralPathConfig = PATH
    faceted: CentralPathConfig = _FACETED
    patient: CentralPathConfig = _PATIENT
    careful: CentralPathConfig = _CAREFUL


BALANCE = BalanceConfig()

#: Fall of the mean of q(H) from which on a message speaks of it.
_COSTS = 1e-3


@dataclass(frozen=True)
class Floors:
    """Least values that a result must have: those at the start, where they were sound, or at the optimum of shape.

    Parameters
    ----------
    jacobian, quality : float
        Of the scaled Jacobians and of q(H) of what can be moved; -inf: none.
    mean : float
        Of q(H) of all hexes.
    """

    jacobian: float
    quality: float
    mean: float


@dataclass(frozen=True, eq=False)
class Balanced:
    """Result of the stage: points (n, 3), and a sentence about the floors, "" where nothing was to be gained."""

    points: np.ndarray
    message: str


def floors_of(energy: MeshEnergy, points: np.ndarray) -> Floors:
    """Compute the floors that a mesh with these points (n, 3) sets; none if what can be moved is inverted."""
    least, quality = CentralPath(energy, points).least, measure(points, energy.mesh.hexes)
    if not least.jacobian > 0:
        return Floors(-np.inf, -np.inf, -np.inf)
    return Floors(least.jacobian, least.quality, energy.mean(quality.q))


def balance(
    energy: MeshEnergy,
    points: np.ndarray,
    given: np.ndarray,
    config: BalanceConfig = BALANCE,
    begin: np.ndarray | None = None,
) -> Generator[Step, None, Balanced]:
    """Raise the minimum scaled Jacobian and the least q(H), then improve the shape above floors just below them.

    Parameters
    ----------
    energy : MeshEnergy
        With p = 1; corners that are inverted are omitted.
    points : (n, 3) float64
        The optimum of shape.
    given : (n, 3) float64
        The points of the given mesh, whose figures the result is not to lower.
    config : BalanceConfig
    begin : (n, 3) float64, optional
        Other points from which the values rise, if the minimum scaled Jacobian is higher there than at the optimum.

    Yields
    ------
    Step
        After each floor.

    Returns
    -------
    Balanced
    """
    path = CentralPath(energy, points, config.faceted if energy.faceted else config.path)
    start = floors_of(energy, given)
    shape = path.least
    if not shape.jacobian < config.sound:
        return Balanced(points, "")
    if energy.target is not None:  # the lengths that are wanted come first: raising corners would change them
        share = 1 - config.target_fall
        if shape.jacobian >= share * start.jacobian and shape.quality >= share * start.quality:
            return Balanced(points, "")
    if begin is not None:
        _go_to_higher(path, energy.to_edge_units(begin))
        shape = path.least
    floor = Least(max(start.jacobian, shape.jacobian), max(start.quality, shape.quality))
    top_jacobian = np.inf if energy.target is None else floor.jacobian * (1 + config.quality_margin)
    target = Least(top_jacobian, floor.quality * (1 + config.quality_margin))
    yield from _steps(path, path.rise(target), energy.norm)
    if not _is_above(path.least, floor, config.margin):  # on with all hexes, until the floors are reached
        target = Least(floor.jacobian * (1 + config.quality_margin), target.quality)
        yield from _steps(path, path.rise(target, config.patient), energy.norm)
    elif path.least.jacobian > config.much * floor.jacobian and not energy.faceted:  # more may be had where so much was
        yield from _rise_on(path, target, config)
    if not _is_above(path.least, floor, config.margin) and start.jacobian > 0:  # another way: from the given mesh
        floor = Least(start.jacobian, start.quality)
        path.move_to(energy.to_edge_units(given))
        target = Least(floor.jacobian * (1 + config.quality_margin), floor.quality * (1 + config.quality_margin))
        yield from _steps(path, path.rise(target, config.careful), energy.norm)
    top = path.least
    yield from _improve_above(path, floor, start, given, config)
    return Balanced(path.points, _message(path, top, energy.mean(measure(points, energy.mesh.hexes).q)))


def _go_to_higher(path: CentralPath, x: np.ndarray) -> None:
    """Go to other positions, x (n, 3), if the minimum scaled Jacobian is higher there."""
    before, least = path.x, path.least
    path.move_to(x)
    if not path.least.jacobian > least.jacobian:
        path.move_to(before)


def _improve_above(
    path: CentralPath, floor: Least, start: Floors, given: np.ndarray, config: BalanceConfig
) -> Iterator[Step]:
    """Minimise the energy above a share of the highest values: less of them until the mean is no lower than given."""
    energy = path.energy
    top, highest = path.least, path.x
    for share in config.kept_share:
        path.move_to(highest)
        floors = Least(
            min(max(share * top.jacobian, floor.jacobian), _below(top.jacobian, config.margin)),
            min(floor.quality, _below(top.quality, config.margin)),
        )
        yield from _steps(path, path.minimise_above(floors, config.weights), energy.norm)
        if not energy.mean(measure(path.points, energy.mesh.hexes).q) < start.mean:
            break
    else:
        yield from _return_towards(path, energy.to_edge_units(given), start, config.returns)


def _rise_on(path: CentralPath, target: Least, config: BalanceConfig) -> Iterator[Step]:
    """Rise patiently after the first rise; go back where that raises the least by too little."""
    reached, x = path.least.jacobian, path.x
    yield from _steps(path, path.rise(target, config.patient), path.energy.norm)
    if path.least.jacobian < (1 + config.worth_rising) * reached:
        path.move_to(x)


def _message(path: CentralPath, top: Least, mean_without: float) -> str:
    """Say what was reached, which floors hold, and what they cost: the optimum of shape has a higher mean of q(H)."""
    kept, quality = path.least, measure(path.points, path.energy.mesh.hexes)
    mean, fixed = path.energy.mean(quality.q), path.energy.ranks.least(float(quality.scaled_jacobian.min()))
    reached = max(top.jacobian, kept.jacobian)
    message = (
        f"The minimum scaled Jacobian of the corners that can be moved reached {reached:.4f}; it is kept at "
        f"{kept.jacobian:.4f} at least, and the least q(H) at {kept.quality:.4f}."
    )
    if 0 < fixed < kept.jacobian - 5e-5:
        message += f" A corner that cannot be moved has {fixed:.4f}."
    cost = mean_without - mean
    if cost < _COSTS:
        return message
    return f"{message} Both together cost {cost:.4f} of q mean, which would be {mean_without:.4f} without."


def _return_towards(path: CentralPath, given: np.ndarray, start: Floors, shares: tuple[float, ...]) -> Iterator[Step]:
    """Go back towards the given mesh, x (n, 3), until the mean of q(H) is no lower than there, above the floors.

    The worst hexes gain on the first part of the way, where the others lose little. Positions on a surface do not allow
    it.
    """
    if isinstance(path.energy, SlidingEnergy):
        return
    far = path.x
    for share in shares:
        path.move_to(given + share * (far - given))
        least = path.least
        if (
            least.jacobian >= start.jacobian
            and least.quality >= start.quality
            and not path.energy.mean(measure(path.points, path.energy.mesh.hexes).q) < start.mean
        ):
            yield from _steps(path, iter([least]), path.energy.norm)
            return
    path.move_to(far)


def _is_above(least: Least, floor: Least, margin: float) -> bool:
    """Return True if floors can be kept: both values are above them by a margin."""
    return _below(least.jacobian, margin) >= floor.jacobian and _below(least.quality, margin) >= floor.quality


def raise_jacobian(
    energy: MeshEnergy, points: np.ndarray, config: BalanceConfig = BALANCE
) -> Generator[Step, None, np.ndarray]:
    """Raise the minimum scaled Jacobian of what can be moved from points (n, 3) on; returns the points reached."""
    path = CentralPath(energy, points, config.path)
    target = Least(np.inf, -np.inf)
    yield from _steps(path, path.rise(target))
    if not energy.faceted:
        yield from _steps(path, path.rise(target, config.patient))
    return path.points


def improve_above_least(
    energy: MeshEnergy, points: np.ndarray, config: BalanceConfig = BALANCE
) -> Generator[Step, None, np.ndarray]:
    """Minimise the energy from points (n, 3) on, above floors just below their least values; returns the points.

    For points whose minimum scaled Jacobian is as high as it goes: the nodes that do not limit it are free to move.
    """
    path = CentralPath(energy, points, config.path)
    least = path.least
    floors = Least(_below(least.jacobian, config.last_margin), _below(least.quality, config.margin))
    yield from _steps(path, path.minimise_above(floors, config.last_weights))
    return path.points


def _below(value: float, margin: float) -> float:
    return value - margin * abs(value) if value < np.inf else value


def _steps(path: CentralPath, stages: Iterator[Least], norm: ObjectiveNorm | None = None) -> Iterator[Step]:
    """Convert what a path yields to steps of the smoother."""
    for least in stages:
        diagnostics = {"least": least.jacobian, "least_q": least.quality, "solver_iterations": path.solver_iterations}
        yield Step(path.points, diagnostics, intermediate=True, norm=norm)
