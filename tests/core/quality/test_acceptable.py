"""Unacceptable values of a metric, also at the ends of its range, and left-handed hexes."""

import dataclasses

import numpy as np
import pytest

from hexmend.mesh.orientation import MIRRORED_CORNERS, left_handed_hexes
from hexmend.quality.metric import METRICS
from tests.core.grids import displaced, grid

VALUES = np.array([-1.0, 0.2, 0.5, 0.8, 2.0, np.nan])


@pytest.mark.parametrize(
    ("better", "unacceptable"),
    [
        (1, [True, False, False, False, False, True]),
        (-1, [False, False, False, False, True, True]),
        (0, [True, False, False, False, True, True]),
    ],
)
def test_what_is_worse_than_the_acceptable_range_is_unacceptable_and_its_ends_are_not(better, unacceptable):
    metric = dataclasses.replace(METRICS["scaled-jacobian"], acceptable=(0.2, 0.8), better=better)
    assert metric.unacceptable(VALUES).tolist() == unacceptable


def folded(shift):
    """Make two stacked left-handed cubes with the top lowered."""
    mesh = grid(1, 1, 2)
    points = mesh.points.copy()
    points[points[:, 2] == 2, 2] -= shift
    return mesh.rebuilt(hexes=mesh.hexes[:, MIRRORED_CORNERS]).with_points(points)


@pytest.mark.parametrize(
    ("shift", "mirrored"),
    [(0.0, True), (1 - 1e-6, True), (1 - 1e-17, True), (1.0, True), (1 + 1e-15, True), (1 + 1e-6, False), (2, False)],
)
def test_a_part_of_which_a_hex_is_flat_but_for_rounding_is_wound_as_the_others_are(shift, mirrored):
    assert left_handed_hexes(folded(shift)).tolist() == [mirrored] * 2


def test_rounding_grows_with_the_distance_from_the_origin_and_the_size():
    mesh = folded(1.0)
    far = mesh.with_points(1e3 * mesh.points + 1e9)
    assert left_handed_hexes(displaced(far, np.s_[-1, 2], 2e-7)).all()  # a bit of such coordinates
