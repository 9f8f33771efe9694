"""Metric values are computed once and cached."""

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
def test_values_are_those_of_the_metric_and_cached(name):
    figures = measure(MESH.points, MESH.hexes)
    values = metric_values(name, MESH, figures)
    np.testing.assert_array_equal(values, METRICS[name].of(MESH.points, MESH.hexes, figures))
    assert metric_values(name, MESH, figures) is values


def test_other_points_have_other_values():
    other = scrambled(grid(3), 0.1)
    first = metric_values("skew", MESH, measure(MESH.points, MESH.hexes))
    assert (metric_values("skew", other, measure(other.points, other.hexes)) != first).any()


def test_three_metrics_are_cached_as_long_as_the_quality_lives():
    figures = measure(MESH.points, MESH.hexes)
    for name in METRICS:
        metric_values(name, MESH, figures)
    assert len(metric_cache.CACHE[figures]) == 3
    values = weakref.ref(metric_values("volume", MESH, figures))
    del figures
    gc.collect()
    assert values() is None
