"""Values of metrics, worked out once."""

import gc
import weakref

import numpy as np
import pytest

from hexmend.quality import METRICS, measure
from hexmend_app.state import measured
from hexmend_app.state.measured import values
from tests.core.grids import grid, scrambled

MESH = scrambled(grid(3), 0.4)


@pytest.mark.parametrize("name", METRICS)
def test_values_are_those_of_the_metric_and_worked_out_once(name):
    figures = measure(MESH.points, MESH.hexes)
    found = values(name, MESH.points, MESH.hexes, figures)
    np.testing.assert_array_equal(found, METRICS[name].of(MESH.points, MESH.hexes, figures))
    assert values(name, MESH.points, MESH.hexes, figures) is found


def test_figures_of_other_points_have_other_values():
    other = scrambled(grid(3), 0.1)
    first = values("skew", MESH.points, MESH.hexes, measure(MESH.points, MESH.hexes))
    assert (values("skew", other.points, other.hexes, measure(other.points, other.hexes)) != first).any()


def test_few_metrics_are_remembered_and_none_of_figures_that_are_gone():
    figures = measure(MESH.points, MESH.hexes)
    for name in METRICS:
        values(name, MESH.points, MESH.hexes, figures)
    assert len(measured.REMEMBERED[figures]) == 3
    held = weakref.ref(values("volume", MESH.points, MESH.hexes, figures))
    del figures
    gc.collect()
    assert held() is None
