"""Checks of OpenFOAM: those of checkMesh with its options, and the defaults of snappyHexMesh's meshQualityControls."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend.quality.finite_volume.geometry import dot
from hexmend.solver_checks.check import Check, Level
from hexmend.solver_checks.measures import Measures
from hexmend.solver_checks.solver import Solver

_CHECK_MESH = "OpenFOAM, primitiveMeshCheck.C: the thresholds of checkMesh"
_ALL_GEOMETRY = "OpenFOAM, checkGeometry.C: checkMesh -allGeometry"
_QUALITY_DICT = "OpenFOAM, etc/caseDicts/meshQualityDict: defaults of snappyHexMesh"
_ANGLE = "angle between d, from centre to centre of the two cells, and the face's area vector S"
_SKEWNESS = "distance from the face's centre to the point where d meets its plane, over the face's extent that way"


#: Volumes below it, in the cube of the size of the mesh, are rounding errors.
_ROUNDING = 1e-18


def _internal(field: str) -> Callable[[Measures], np.ndarray]:
    """Values of the internal faces."""
    return lambda measures: getattr(measures.faces, field)[measures.faces.internal]


def _boundary_skewness(measures: Measures) -> np.ndarray:
    return measures.faces.skewness[~measures.faces.internal]


def _pyramids(measures: Measures) -> np.ndarray:
    """Volumes of the pyramids over each face of each hex, with the hex's centre as apex, (6 m,), in mesh unit³.

    What differs from 0 by rounding only is 0.
    """
    cells = measures.cells
    volumes = dot(cells.face_areas, cells.face_centres - cells.centres[:, None]).ravel() / 3
    return np.where(np.abs(volumes) > _ROUNDING, volumes, 0.0) * cells.unit**3


def aspect_ratios(measures: Measures) -> np.ndarray:
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


OPENFOAM = Solver(
    name="openfoam",
    title="OpenFOAM",
    tests_validity=(
        "OpenFOAM tests volumes and the pyramids over the faces of a cell, not the Jacobian: it may run with hexes "
        "that are inverted at a corner, or invalid inside."
    ),
    own_checks=(
        Check(
            "non-orthogonality", _internal("non_orthogonality"), "internal faces", -1, 70.0, Level.WARNING, _ANGLE,
            _CHECK_MESH, unit="degrees",
        ),
        Check(
            "non-orthogonality, errors", _internal("non_orthogonality"), "internal faces", -1, 90.0, Level.ERROR,
            _ANGLE, "OpenFOAM, polyMeshCheck.C: checkFaceOrthogonality", inclusive=True, unit="degrees",
        ),
        Check(
            "skewness", lambda measures: measures.faces.skewness, "faces", -1, 4.0, Level.ERROR, _SKEWNESS,
            _CHECK_MESH,
        ),
        Check(
            "aspect ratio", aspect_ratios, "cells", -1, 1000.0, Level.ERROR,
            "greater of max/min of the sums of |S| by component, and a sixth of their total over volume^(2/3)",
            _CHECK_MESH,
        ),
        Check(
            "cell volume", lambda measures: measures.cells.volumes * measures.cells.unit**3, "cells", 1, 0.0,
            Level.ERROR, "sum of the volumes of the six pyramids", "OpenFOAM, primitiveMeshCheck.C: checkCellVolumes",
            inclusive=True, unit="mesh unit³",
        ),
        Check(
            "face pyramids", _pyramids, "faces of cells", 1, 0.0, Level.ERROR,
            "volume of the pyramid over a face with the cell's centre as apex",
            "OpenFOAM, primitiveMeshCheck.C: checkFacePyramids", unit="mesh unit³",
        ),
        Check(
            "face flatness", lambda measures: measures.faces.flatness, "faces", 1, 0.8, Level.WARNING,
            "|S| over the sum of the areas of the four triangles around the face's centre", _ALL_GEOMETRY,
        ),
        Check(
            "face weight", _internal("weight"), "internal faces", 1, 0.05, Level.ERROR,
            "min(a, b) / (a + b), a and b the distances of the two cells' centres from the face along S",
            _ALL_GEOMETRY,
        ),
        Check(
            "volume ratio", _internal("volume_ratio"), "internal faces", 1, 0.01, Level.ERROR,
            "smaller volume of the two cells over the larger", _ALL_GEOMETRY,
        ),
        Check(
            "maxNonOrtho of snappyHexMesh", _internal("non_orthogonality"), "internal faces", -1, 65.0, Level.WARNING,
            _ANGLE, _QUALITY_DICT, unit="degrees",
        ),
        Check(
            "maxInternalSkewness of snappyHexMesh", _internal("skewness"), "internal faces", -1, 4.0, Level.WARNING,
            _SKEWNESS, _QUALITY_DICT,
        ),
        Check(
            "maxBoundarySkewness of snappyHexMesh", _boundary_skewness, "boundary faces", -1, 20.0, Level.WARNING,
            _SKEWNESS, _QUALITY_DICT,
        ),
    ),
    omitted=(
        "Left out are checks of the topology, concave faces and cells, the quality of decomposed tetrahedra, and the "
        "cell determinant. Every case counts as three-dimensional."
    ),
).register()  # fmt: skip
