"""Quantities that one solver alone checks, computed from the measures of a mesh."""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter, methodcaller

import numpy as np

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.second_order import jacobian_range
from hexmend.quality.finite_volume.geometry import chunks, cross, divide, dot
from hexmend.quality.measure import corner_determinants
from hexmend.solver_checks.measures import Measures

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
