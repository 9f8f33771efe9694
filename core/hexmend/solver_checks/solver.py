"""Checks of each solver, read from `limits.toml`, and the report on a mesh.

Quantities that one solver alone checks, computed from the measures of a mesh.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from operator import attrgetter, methodcaller
from pathlib import Path
from typing import Any

import numpy as np

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import jacobian_range
from hexmend.quality.finite_volume.geometry import chunks, cross, divide, dot
from hexmend.quality.measure import ElementQuality, corner_determinants
from hexmend.quality.validity import jacobian_bounds
from hexmend.registry import Registry
from hexmend.solver_checks.check import Check, CheckResult, Level
from hexmend.solver_checks.measures import Measures
from hexmend.terminal_text import count_phrase


def _certified_ratios(measures: Measures) -> np.ndarray:
    """Certified lower bound of the least det J of each hex over the greatest, (m,); above 0 just where it is valid."""
    mesh = measures.mesh
    bounds = jacobian_bounds(mesh.points, mesh.elements, mesh.mid_nodes)
    scale = np.abs(bounds).max(axis=1)
    ratios = np.divide(bounds[:, 0], scale, out=np.zeros(len(bounds)), where=(scale > 0) & np.isfinite(scale))
    smallest = np.finfo(np.float64).tiny
    return np.where(measures.quality.invalid, np.minimum(ratios, 0.0), np.maximum(ratios, smallest))


VALIDITY = Check(
    name="invalid hexes",
    of=_certified_ratios,
    unit_of_count="hexes",
    better=1,
    limit=0.0,
    level=Level.ERROR,
    definition="certified lower bound of the least Jacobian determinant everywhere in a hex over the greatest",
    source="Hexmend, for every solver: its own checks can miss hexes that are inverted at a corner or invalid inside",
    inclusive=True,
)


#: Reservation on limits whose document was not at hand: the values are quoted from others.
QUOTED = "values as commonly quoted; check them against your version's manual"


@dataclass(frozen=True)
class Solver:
    """Checks of a solver.

    Parameters
    ----------
    name, title : str
    tests_validity : str
        Where the solver itself tests the Jacobian of a hex, as a sentence: which invalid hexes it refuses.
    own_checks : tuple of Check
        Those of the solver itself.
    omitted : str
        Sentence on the solver's checks that are left out, and why.
    reservation : str
        `QUOTED` where limits are not from the solver's own document; "" otherwise.
    """

    name: str
    title: str
    tests_validity: str
    own_checks: tuple[Check, ...]
    omitted: str
    reservation: str = ""

    @property
    def checks(self) -> tuple[Check, ...]:
        """Its own checks, and that for invalid hexes, which every solver has."""
        return *self.own_checks, VALIDITY


@dataclass(frozen=True)
class Report:
    """Results of a solver's checks on a mesh.

    Parameters
    ----------
    solver : Solver
    results : tuple of CheckResult
        Of the checks for which the mesh has values: one without internal faces has no non-orthogonality.
    """

    solver: Solver
    results: tuple[CheckResult, ...]

    @property
    def verdict(self) -> str:
        """The worst verdict: "failed", "warning" or "passed"."""
        verdicts = {result.verdict for result in self.results}
        return next((verdict for verdict in ("failed", "warning") if verdict in verdicts), "passed")

    @property
    def sentence(self) -> str:
        """The verdict as a sentence."""
        failed, warned = (sum(one.verdict == verdict for one in self.results) for verdict in ("failed", "warning"))
        words = [count_phrase(failed, "check fails", "checks fail")] * bool(failed)
        words += [count_phrase(warned, "check gives a warning", "checks give a warning")] * bool(warned)
        return f"{self.solver.title}: {', '.join(words) or 'every value is within its limit'}."


def check_mesh(mesh: Mesh, solver: str, quality: ElementQuality | None = None) -> Report:
    """Apply a solver's checks to a mesh.

    Parameters
    ----------
    mesh : Mesh
    solver : str
        Name in `SOLVERS`.
    quality : ElementQuality, optional
        Quality of the hexes, if it is measured already.

    Returns
    -------
    Report

    Raises
    ------
    ParameterError
        For a solver that does not exist.
    """
    chosen, measures = SOLVERS[solver], Measures(mesh, quality)
    return Report(chosen, tuple(result for check in chosen.checks if (result := check.on(measures)).total))


SOLVERS: Registry[Solver] = Registry("solver")
"""Solvers by name."""


def _check(better: str, level: str, of: str, where: str = "", **fields: Any) -> Check:
    """Make a check of its entry in the table."""
    values = {"unit_of_count": "hexes", "limit": None} | fields
    return Check(of=quantity(of, where), better=1 if better == "higher" else -1, level=Level[level.upper()], **values)


#: Default of LS-DYNA's TSSFAC in *CONTROL_TIMESTEP.
TIME_STEP_FACTOR = 0.9
#: Abscissae of the two-point Gauss rule on [0, 1].
_GAUSS = 0.5 - np.sqrt(1 / 12), 0.5 + np.sqrt(1 / 12)
#: Volumes below it, in the cube of the size of the mesh, are rounding errors.
_ROUNDING = 1e-18


def time_steps(measures: Measures) -> np.ndarray:
    """LS-DYNA's time step of each hex at wave speed 1, without bulk viscosity, (m,) float64."""
    return TIME_STEP_FACTOR * measures.characteristic_lengths


def jacobian_ratios(measures: Measures) -> np.ndarray:
    """ANSYS's Jacobian ratio, (m,) float64; +inf where the least determinant is not positive."""
    mesh = measures.mesh
    sigma = corner_determinants(mesh.points, mesh.elements)
    least, greatest = sigma.min(axis=1), sigma.max(axis=1)
    if mesh.mid_nodes is not None:
        of_nodes = jacobian_range(mesh.points, mesh.elements, mesh.mid_nodes, gauss=False)
        known = ~np.isnan(of_nodes[:, 0])
        least, greatest = np.where(known, of_nodes[:, 0], least), np.where(known, of_nodes[:, 1], greatest)
    return np.where(least > 0, divide(greatest, least, np.inf), np.inf)


def gauss_determinants(measures: Measures) -> np.ndarray:
    """Least Jacobian determinant at the Gauss points, (m,) float64, in mesh unit³.

    These are 2 x 2 x 2 points of a hex of eight nodes, 3 x 3 x 3 of one of second order; corners of other cells.
    """
    mesh, cells = measures.mesh, measures.cells
    least = np.full(mesh.n_hexes, np.inf)
    places = [np.array(place) for place in np.stack(np.meshgrid(_GAUSS, _GAUSS, _GAUSS), axis=-1).reshape(-1, 3)]
    for part in chunks(mesh.n_hexes):
        corners = cells.points[:, mesh.hexes[part].T]
        for place in places:
            x, y, z = np.einsum("xck,cd->dxk", corners, _gradients(place))
            least[part] = np.minimum(least[part], dot(x, cross(y, z)))
    least *= cells.unit**3
    if mesh.mid_nodes is not None:
        of_second = jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes, nodes=False)[:, 0]
        least = np.where(np.isnan(of_second), least, of_second)
    return np.append(least, measures.quality.sigma[mesh.n_hexes :])


def _gradients(place: np.ndarray) -> np.ndarray:
    """Derivatives of the trilinear functions at a place of the unit cube, (8, 3)."""
    factors = np.where(UNIT_CUBE == 1, place, 1 - place)
    slopes = 2 * UNIT_CUBE - 1
    return np.column_stack([slopes[:, i] * np.delete(factors, i, axis=1).prod(axis=1) for i in range(3)])


def pyramid_volumes(measures: Measures) -> np.ndarray:
    """Volumes of the pyramids over each face of each hex, with the hex's centre as apex, (6 m,), in mesh unit³.

    What differs from 0 by rounding only is 0.
    """
    cells = measures.cells
    volumes = dot(cells.face_areas, cells.face_centres - cells.centres[:, None]).ravel() / 3
    return np.where(np.abs(volumes) > _ROUNDING, volumes, 0.0) * cells.unit**3


def finite_volume_aspect_ratios(measures: Measures) -> np.ndarray:
    """OpenFOAM's aspect ratio of cells, (m,) float64; +inf for a volume of 0 or below.

    The greater of two ratios (`primitiveMeshTools::cellClosedness`). The first is that of the greatest and the least of
    the sums of |Sx|, |Sy|, |Sz| over the faces. The second is a sixth of these sums' total over volume^(2/3).
    """
    cells = measures.cells
    sums = np.abs(cells.face_areas).sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        of_sums = sums.max(axis=0) / sums.min(axis=0)
        of_volume = sums.sum(axis=0) / 6 / np.cbrt(np.maximum(cells.volumes, 0.0)) ** 2
    ratios = np.maximum(of_sums, of_volume)
    return np.where(np.isnan(ratios), np.inf, ratios)


#: Functions by name.
QUANTITIES: dict[str, Callable[[Measures], np.ndarray]] = {
    function.__name__: function
    for function in (time_steps, jacobian_ratios, gauss_determinants, pyramid_volumes, finite_volume_aspect_ratios)
}


def quantity(name: str, where: str = "") -> Callable[[Measures], np.ndarray]:
    """Return the function of a quantity.

    Parameters
    ----------
    name : str
        In `QUANTITIES`, an attribute of `Measures`, with dots, or "metric" and the name of a quality metric.
    where : str
        Attribute of `Measures`, with dots, that marks the faces or hexes to be taken; "" for all.
    """
    _, is_metric, metric = name.rpartition("metric ")
    of = methodcaller("metric", metric) if is_metric else QUANTITIES.get(name) or attrgetter(name)
    return (lambda measures: of(measures)[attrgetter(where)(measures)]) if where else of


for _name, _entry in tomllib.loads(Path(__file__).with_name("limits.toml").read_text(encoding="utf-8")).items():
    _checks = tuple(_check(**check) for check in _entry["checks"])
    _reservation = QUOTED if _entry.get("quoted") else ""
    SOLVERS.add(
        _name, Solver(_name, _entry["title"], _entry["tests_validity"], _checks, _entry["omitted"], _reservation)
    )
