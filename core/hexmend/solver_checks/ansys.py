"""Checks of ANSYS Mechanical APDL: element shape testing of solids with the default limits of the command SHPP."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend.mesh.second_order import jacobian_range
from hexmend.quality.finite_volume.geometry import divide
from hexmend.quality.measure import corner_determinants
from hexmend.solver_checks.check import Check, Level
from hexmend.solver_checks.measures import Measures
from hexmend.solver_checks.solver import QUOTED, Solver

_SOURCE = f"ANSYS Mechanical APDL Theory Reference, Element Shape Testing: default limits of SHPP ({QUOTED})"
_QUADS = "over the six faces and the three cross-sections through the middles of edges"
_ASPECT = (
    f"greatest {_QUADS}: each line between middles of opposite edges has a rectangle through the ends of the other; "
    "ratio of sides of the more stretched"
)
_PARALLEL = f"greatest {_QUADS} of the angle between opposite edges"
_CORNER = f"greatest {_QUADS} of the angle between adjacent edges"
_WARPING = "greatest over the faces of the difference of height of an edge's ends along the normal, over √area"
_JACOBIAN = "greatest / least determinant at the corners; of second order at the nodes"


def _of(field: str, *, second_order: bool) -> Callable[[Measures], np.ndarray]:
    """Values of the hexes with mid-nodes, or of those without."""
    return lambda measures: getattr(measures.quads, field)[measures.second_order == second_order]


def jacobian_ratios(measures: Measures) -> np.ndarray:
    """ANSYS's Jacobian ratio, (m,) float64; +inf where the least determinant is not positive."""
    mesh = measures.mesh
    sigma = corner_determinants(mesh.points, mesh.hexes)
    least, greatest = sigma.min(axis=1), sigma.max(axis=1)
    if mesh.mid_nodes is not None:
        of_nodes = jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes, gauss=False)
        known = ~np.isnan(of_nodes[:, 0])
        least, greatest = np.where(known, of_nodes[:, 0], least), np.where(known, of_nodes[:, 1], greatest)
    return np.where(least > 0, divide(greatest, least, np.inf), np.inf)


def _pair(
    name: str,
    of: Callable[[Measures], np.ndarray],
    warning: float,
    error: float,
    definition: str,
    unit: str = "",
    hexes: str = "hexes",
) -> tuple[Check, Check]:
    """A check with the limit of the warning, and one with that of the error."""
    return (
        Check(name, of, hexes, -1, warning, Level.WARNING, definition, _SOURCE, unit=unit),
        Check(f"{name}, errors", of, hexes, -1, error, Level.ERROR, definition, _SOURCE, unit=unit),
    )


_SECOND = "hexes with mid-nodes"

ANSYS = Solver(
    name="ansys",
    title="ANSYS",
    tests_validity=(
        "ANSYS tests the Jacobian at the corners, of second order at the nodes: it refuses inverted hexes, and does "
        "not see those that are invalid inside."
    ),
    own_checks=(
        *_pair("aspect ratio", lambda measures: measures.quads.aspect_ratio, 20.0, 1e6, _ASPECT),
        *_pair("parallel deviation", _of("parallel_deviation", second_order=False), 70.0, 150.0, _PARALLEL, "degrees"),
        *_pair("maximum corner angle", _of("max_angle", second_order=False), 155.0, 179.9, _CORNER, "degrees"),
        *_pair(
            "parallel deviation with mid-nodes", _of("parallel_deviation", second_order=True), 100.0, 170.0, _PARALLEL,
            "degrees", _SECOND,
        ),
        *_pair(
            "maximum corner angle with mid-nodes", _of("max_angle", second_order=True), 165.0, 179.9, _CORNER,
            "degrees", _SECOND,
        ),
        *_pair("Jacobian ratio", jacobian_ratios, 30.0, 1000.0, _JACOBIAN),
        *_pair("warping factor", lambda measures: measures.quads.warping_factor, 0.2, 0.4, _WARPING),
    ),
    omitted="Cross-sections of hexes of second order use the middles of edges in place of mid-nodes.",
    reservation=QUOTED,
).register()  # fmt: skip
