"""Metrics against VTK's build of the Verdict library, on random, bent, flat and inverted hexes."""

import numpy as np
import pytest
import vtk
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality

from hexmend.mesh.hexahedron import EDGES, UNIT_CUBE
from hexmend.quality import METRICS, measure

#: Functions of VTK by the metrics that have the same finite values.
THEIRS = {
    "shape": "HexShape",
    "condition": "HexCondition",
    "stretch": "HexStretch",
    "diagonal": "HexDiagonal",
    "aspect-ratio": "HexMaxEdgeRatio",
    "skew": "HexSkew",
    "taper": "HexTaper",
    "volume": "HexVolume",
    "jacobian": "HexJacobian",
}

#: Verdict returns 1e30 for infinity, and a third of it for condition numbers.
HUGE = 1e29


#: The edges, of twelve, among which Verdict looks for the longest.
SEEN = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6]])


def cells(x):
    """Return hexes with corners x (m, 8, 3) as a VTK grid."""
    grid, points = vtk.vtkUnstructuredGrid(), vtk.vtkPoints()
    points.SetDataTypeToDouble()
    for row in x.reshape(-1, 3):
        points.InsertNextPoint(row)
    grid.SetPoints(points)
    grid.Allocate(len(x))
    for i in range(len(x)):
        grid.InsertNextCell(vtk.VTK_HEXAHEDRON, 8, list(range(8 * i, 8 * i + 8)))
    return grid


def values(name, x):
    """Return a metric of hexes with corners x (m, 8, 3)."""
    points, hexes = x.reshape(-1, 3).copy(), np.arange(8 * len(x), dtype=np.int32).reshape(-1, 8)
    return METRICS[name].of(points, hexes, measure(points, hexes))


def of_cells(function, x):
    grid = cells(x)
    return np.array([function(grid.GetCell(i)) for i in range(len(x))])


def of_faces(function, x):
    """Return the values of the six faces of each hex, (m, 6)."""
    return of_cells(lambda cell: [function(cell.GetFace(f)) for f in range(6)], x)


def hexes(kind):
    random = np.random.default_rng(7)
    x = np.repeat(UNIT_CUBE[None], 60, axis=0)
    if kind == "nearly cubes":
        return x + random.uniform(-0.1, 0.1, x.shape)
    if kind == "parallelepipeds":
        return x @ (np.eye(3) + random.uniform(-0.4, 0.4, (60, 3, 3)))
    if kind == "bent":
        return x + 0.4 * np.sin(2 * x[..., [1, 2, 0]] * random.uniform(0.5, 2, (60, 1, 3)))
    if kind == "flat":
        return x * [3, 2, 1e-3] + random.uniform(-1e-4, 1e-4, x.shape)
    if kind == "inside out":
        return x * [-1, 1, 2] + random.uniform(-0.2, 0.2, x.shape)
    return random.uniform(-1, 1, x.shape)  # tangled


KINDS = ["nearly cubes", "parallelepipeds", "bent", "flat", "inside out", "tangled"]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", THEIRS)
def test_values_are_those_of_verdict(name, kind):
    x = hexes(kind)
    theirs = of_cells(getattr(vtkMeshQuality, THEIRS[name]), x)
    np.testing.assert_allclose(values(name, x), np.where(theirs > HUGE, np.inf, theirs), rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_angles_are_those_of_the_faces(kind):
    x = hexes(kind)
    least, greatest = values("min-angle", x), values("max-angle", x)
    np.testing.assert_allclose(least, of_faces(vtkMeshQuality.QuadMinAngle, x).min(axis=1), atol=1e-5)
    theirs = of_faces(vtkMeshQuality.QuadMaxAngle, x).max(axis=1)
    convex = theirs <= 180  # for a concave face Verdict uses the interior angle, Hexmend the angle between the edges
    np.testing.assert_allclose(greatest[convex], theirs[convex], atol=1e-5)
    assert convex.any() or kind == "tangled"


@pytest.mark.parametrize("kind", KINDS)
def test_warpage_is_that_of_the_worst_face(kind):
    x = hexes(kind)
    theirs = 1 - of_faces(vtkMeshQuality.QuadWarpage, x).min(axis=1)  # VTK's is 1 for a flat face
    np.testing.assert_allclose(values("warpage", x), theirs, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_edge_ratio_is_that_of_verdict_where_verdict_examines_the_longest_edge(kind):
    x = hexes(kind)
    ours, theirs = values("edge-ratio", x), of_cells(vtkMeshQuality.HexEdgeRatio, x)
    edges = np.linalg.norm(x[:, SEEN[:, 0]] - x[:, SEEN[:, 1]], axis=2)
    longest = np.linalg.norm(x[:, EDGES[:, 0]] - x[:, EDGES[:, 1]], axis=2).max(axis=1)
    seen = np.isclose(edges.max(axis=1), longest, rtol=1e-12)
    np.testing.assert_allclose(ours[seen], theirs[seen], rtol=1e-12)
    assert (theirs <= ours * (1 + 1e-12)).all()


@pytest.mark.parametrize("name", sorted({*THEIRS} - {"volume", "jacobian"}))
@pytest.mark.parametrize("collapsed", [UNIT_CUBE * 0, UNIT_CUBE * [1, 0, 0], UNIT_CUBE * [1, 1, 0]])
def test_a_collapsed_hex_has_the_value_of_verdict_or_the_worse_end_of_the_range(name, collapsed):
    ours, theirs = values(name, collapsed[None])[0], of_cells(getattr(vtkMeshQuality, THEIRS[name]), collapsed[None])[0]
    metric = METRICS[name]
    worst = metric.full_range[0] if metric.better > 0 else metric.full_range[1]
    assert ours == worst if theirs > HUGE else ours == pytest.approx(theirs)
