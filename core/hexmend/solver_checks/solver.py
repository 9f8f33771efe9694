"""Checks of each solver, read from `limits.toml`, and the report on a mesh."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality.measure import ElementQuality
from hexmend.quality.validity import jacobian_bounds
from hexmend.registry import Registry
from hexmend.solver_checks.check import Check, CheckResult, Level
from hexmend.solver_checks.measures import Measures
from hexmend.solver_checks.quantities import quantity
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


for _name, _entry in tomllib.loads(Path(__file__).with_name("limits.toml").read_text(encoding="utf-8")).items():
    _checks = tuple(_check(**check) for check in _entry["checks"])
    _reservation = QUOTED if _entry.get("quoted") else ""
    SOLVERS.add(
        _name, Solver(_name, _entry["title"], _entry["tests_validity"], _checks, _entry["omitted"], _reservation)
    )
