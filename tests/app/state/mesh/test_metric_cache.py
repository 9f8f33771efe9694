"""Values of metrics, worked out once."""

import gc
import weakref

import numpy as np
import pytest

from hexmend.quality import METRICS, measure
from hexmend_app.state.mesh import metric_cache
from hexmend_app.state.mesh.metric_cache import metric_values
from tests.core.grids import grid, scrambled

MESH = scrambled(grid(3), 0.4)


@pytest.mark.parametrize("name", METRICS)
def test_values_are_those_of_the_metric_and_worked_out_once(name):
    figures = measure(MESH.points, MESH.hexes)
    found = metric_values(name, MESH.points, MESH.hexes, figures)
    np.testing.assert_array_equal(found, METRICS[name].of(MESH.points, MESH.hexes, figures))
    assert metric_values(name, MESH.points, MESH.hexes, figures) is found


def test_figures_of_other_points_have_other_values():
    other = scrambled(grid(3), 0.1)
    first = metric_values("skew", MESH.points, MESH.hexes, measure(MESH.points, MESH.hexes))
    assert (metric_values("skew", other.points, other.hexes, measure(other.points, other.hexes)) != first).any()


def test_few_metrics_are_remembered_and_none_of_figures_that_are_gone():
    figures = measure(MESH.points, MESH.hexes)
    for name in METRICS:
        metric_values(name, MESH.points, MESH.hexes, figures)
    assert len(metric_cache.REMEMBERED[figures]) == 3
    held = weakref.ref(metric_values("volume", MESH.points, MESH.hexes, figures))
    del figures
    gc.collect()
    assert held() is None
