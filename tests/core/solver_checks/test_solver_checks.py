"""Solvers' checks: declarations, hand-computed values, counts and verdicts, for every solver."""

import json
import math

import numpy as np
import pytest

from hexmend import Mesh, ParameterError
from hexmend.gallery import GALLERY, make
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.quality.validity import least_jacobian
from hexmend.report.records import to_json
from hexmend.solver_checks import SOLVERS, check_mesh
from tests.core.grids import grid
from tests.core.quality.test_metrics import second_order

every = pytest.mark.parametrize("solver", SOLVERS)
ONE = np.arange(8)[None]


def results(mesh, solver):
    return {result.check.name: result for result in check_mesh(mesh, solver).results}


@every
@pytest.mark.parametrize("name", GALLERY)
def test_gallery_meshes_have_a_verdict(solver, name):
    report = check_mesh(make(name, size=500), solver)
    assert report.verdict in ("passed", "warning", "failed")
    for result in report.results:
        assert 0 <= result.count <= result.total
        assert not math.isnan(result.value)
        assert (result.count > 0) == (result.verdict in ("warning", "failed"))
    entries = json.loads(to_json([result.to_dict() for result in report.results]))
    assert {"name", "value", "limit", "count", "verdict"} <= entries[0].keys()


@every
def test_cubes_pass_and_inverted_hexes_fail(solver):
    good = check_mesh(grid(3), solver)
    assert good.verdict == "passed"
    assert "every value is within its limit" in good.sentence
    inside_out = Mesh(UNIT_CUBE * [-1, 1, 1], ONE)
    assert check_mesh(inside_out, solver).verdict == "failed"
    assert "fail" in check_mesh(inside_out, solver).sentence


@every
@pytest.mark.parametrize("corner", [[0.3, 0.3, 0.3], [0.5, 0.5, 1.0]])
def test_a_hex_with_one_inverted_or_flat_corner_fails_though_its_volume_is_positive(solver, corner):
    x = UNIT_CUBE.copy()
    x[6] = corner
    mesh = Mesh(x, ONE)
    assert mesh.quality("volume")[0] > 0
    found = results(mesh, solver)["invalid hexes"]
    assert (found.verdict, found.count) == ("failed", 1)
    assert found.value == least_jacobian(mesh.points, mesh.hexes) <= 0
    assert check_mesh(mesh, solver).verdict == "failed"


def test_an_unknown_solver_is_named_with_those_that_are_known():
    with pytest.raises(ParameterError, match=r"there is no solver 'foam'.*known: .*nastran"):
        check_mesh(grid(1), "foam")


def test_a_sheared_lattice_is_beyond_the_limit_of_its_angle():
    mesh = grid(3)
    lean = math.tan(math.radians(72))
    found = results(mesh.with_points(mesh.points @ [[1, 0, 0], [0, 1, 0], [lean, 0, 1]]), "openfoam")
    checked = found["non-orthogonality"]
    assert (checked.value, checked.count, checked.total) == (pytest.approx(72), 36, 54)
    assert checked.verdict == "warning"
    assert found["non-orthogonality, errors"].count == 0
    assert "non-orthogonality" not in results(grid(1), "openfoam")  # no internal face, no value


def test_openfoams_aspect_ratio_of_a_box():
    found = results(Mesh(UNIT_CUBE * [10, 1, 1], ONE), "openfoam")["aspect ratio"]
    # Components of S: 2 * 1, 2 * 10, 2 * 10; a sixth of 42 over 10^(2/3).
    assert found.value == pytest.approx(max(10, 42 / 6 / 10 ** (2 / 3)))


@pytest.mark.parametrize(("stretch", "count"), [(9.9, 0), (10.1, 1)])
def test_abaqus_counts_long_hexes(stretch, count):
    found = results(Mesh(UNIT_CUBE * [stretch, 1, 1], ONE), "abaqus")["aspect ratio"]
    assert found.value == pytest.approx(stretch)
    assert found.count == count


@pytest.mark.parametrize(("degrees", "count"), [(46, 0), (44, 1)])
def test_abaqus_counts_isoparametric_angles(degrees, count):
    lean = 1 / math.tan(math.radians(degrees))
    found = results(Mesh(UNIT_CUBE @ [[1, 0, 0], [lean, 1, 0], [0, 0, 1]], ONE), "abaqus")
    assert found["isoparametric angle, least"].value == pytest.approx(degrees)
    assert found["isoparametric angle, greatest"].value == pytest.approx(180 - degrees)
    assert found["isoparametric angle, least"].count == found["isoparametric angle, greatest"].count == count


def trapezoid(top):
    """A hex whose section by x and z is a trapezoid with a shorter upper side."""
    x = UNIT_CUBE.copy()
    x[4:, 0] = 0.5 + top * (x[4:, 0] - 0.5)
    return Mesh(x, ONE)


def test_ansys_measures_parallel_deviation_and_corners_of_a_trapezoid():
    found = results(trapezoid(0.5), "ansys")
    lean = math.degrees(math.atan(0.25))
    assert found["parallel deviation"].value == pytest.approx(2 * lean)
    assert found["maximum corner angle"].value == pytest.approx(90 + lean)
    assert found["Jacobian ratio"].value == pytest.approx(2)


def test_ansys_measures_the_warping_of_a_face():
    x = UNIT_CUBE.copy()
    x[6, 2] += 0.4  # one corner of the upper face is lifted: heights along the diagonals' normal differ by h
    found = results(Mesh(x, ONE), "ansys")["warping factor"]
    d1, d2 = x[6] - x[4], x[7] - x[5]
    normal = np.cross(d1, d2)
    height = abs((x[5] - x[4]) @ normal) / np.linalg.norm(normal)
    assert found.value == pytest.approx(height / math.sqrt(np.linalg.norm(normal) / 2))
    assert found.value > 0.15


def test_ansys_has_wider_limits_of_angles_for_hexes_with_mid_nodes():
    linear, quadratic = results(trapezoid(0.5), "ansys"), results(second_order(20), "ansys")
    assert "parallel deviation" in linear
    assert "parallel deviation with mid-nodes" not in linear
    assert "parallel deviation" not in quadratic
    assert quadratic["parallel deviation with mid-nodes"].check.limit == 100


def test_nastrans_warp_coefficient_is_the_cosine_of_opposite_corners():
    found = results(trapezoid(0.5), "nastran")
    assert found["face warp coefficient (HEX_WARP)"].value == pytest.approx(1)
    x = UNIT_CUBE.copy()
    x[6, 2] += 1.0
    cosine = results(Mesh(x, ONE), "nastran")["face warp coefficient (HEX_WARP)"]
    # Normals of the upper face: z at 4 and (-1, -1, 1) at 6, (0, -1, 1) at 5 and (-1, 0, 1) at 7.
    assert cosine.value == pytest.approx(min(1 / math.sqrt(3), 1 / 2))
    assert cosine.verdict == "warning"


def test_nastrans_jacobian_is_positive_where_gauss_points_are_though_a_corner_is_inverted():
    x = UNIT_CUBE.copy()
    x[6] = [0.62, 0.62, 0.62]
    mesh = Mesh(x, ONE)
    assert mesh.quality("jacobian")[0] < 0
    assert results(mesh, "nastran")["Jacobian (HEX_DETJ)"].verdict == "passed"
    assert results(Mesh(UNIT_CUBE * [2, 3, 4], ONE), "nastran")["Jacobian (HEX_DETJ)"].value == pytest.approx(24)
    assert results(second_order(27), "nastran")["Jacobian (HEX_DETJ)"].value == pytest.approx(1)


def test_ls_dynas_length_of_a_box_is_its_shortest_edge():
    found = results(Mesh(UNIT_CUBE * [4, 2, 0.5], ONE), "lsdyna")
    assert found["characteristic length"].value == pytest.approx(0.5)
    assert found["time step at wave speed 1"].value == pytest.approx(0.45)
    assert found["characteristic length"].verdict == "value"
