"""Checks of MSC Nastran: the tests of CHEXA elements with the default tolerances of the command GEOMCHECK."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.second_order import jacobian_range
from hexmend.quality.finite_volume.geometry import chunks, cross, dot
from hexmend.solver_checks.check import Check, Level
from hexmend.solver_checks.measures import Measures
from hexmend.solver_checks.solver import QUOTED, Solver

_SOURCE = f"MSC Nastran Quick Reference Guide, case control command GEOMCHECK: default of {{}} ({QUOTED})"
#: Abscissae of the two-point Gauss rule on [0, 1].
_GAUSS = 0.5 - np.sqrt(1 / 12), 0.5 + np.sqrt(1 / 12)


def least_determinants(measures: Measures) -> np.ndarray:
    """Least Jacobian determinant at the Gauss points, (m,) float64, in mesh unit³.

    These are 2 x 2 x 2 points of a hex of eight nodes, 3 x 3 x 3 of one of second order.
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
    return least


def _gradients(place: np.ndarray) -> np.ndarray:
    """Derivatives of the trilinear functions at a place of the unit cube, (8, 3)."""
    factors = np.where(UNIT_CUBE == 1, place, 1 - place)
    slopes = 2 * UNIT_CUBE - 1
    return np.column_stack([slopes[:, i] * np.delete(factors, i, axis=1).prod(axis=1) for i in range(3)])


NASTRAN = Solver(
    name="nastran",
    title="MSC Nastran",
    tests_validity=(
        "MSC Nastran tests the Jacobian at the Gauss points: it may run with hexes that are inverted at a corner, or "
        "invalid inside."
    ),
    own_checks=(
        Check(
            "aspect ratio (HEX_AR)", lambda measures: measures.edge_ratios, "hexes", -1, 100.0, Level.WARNING,
            "longest / shortest edge", _SOURCE.format("HEX_AR"),
        ),
        Check(
            "Jacobian (HEX_DETJ)", least_determinants, "hexes", 1, 0.0, Level.ERROR,
            "least determinant at the Gauss points", _SOURCE.format("HEX_DETJ"), inclusive=True, unit="mesh unit³",
        ),
        Check(
            "face warp coefficient (HEX_WARP)", lambda measures: measures.quads.corner_cosine, "hexes", 1, 0.707,
            Level.WARNING, "least cosine of the angle of the normals at diagonally opposite corners of a face",
            _SOURCE.format("HEX_WARP"),
        ),
    ),
    omitted=(
        "Left out are the tests of the positions of mid-nodes, such as HEX_EPLR; the metric mid-node-offset gives "
        "these positions."
    ),
    reservation=QUOTED,
).register()  # fmt: skip
