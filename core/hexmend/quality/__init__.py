"""Quality of hexes and of meshes: metrics, measurement, statistics and summary.

Every module of `hexmend.quality.metrics` is imported here and registers its metrics in METRICS, which the command line,
the viewer, the documentation and the tests read.
"""

import importlib
import pkgutil

from hexmend.quality import metrics
from hexmend.quality.measure import ElementQuality, corner_determinants, corner_qualities, locked_hexes, measure
from hexmend.quality.mesh_quality import measure_against_target, metric_values, rank_worst, target_quality, worst_hexes
from hexmend.quality.metric import METRICS, HexQuantity, Metric
from hexmend.quality.metrics.table import SCALED_JACOBIAN, Q
from hexmend.quality.regressions import REGRESSION_KEYS, describe_regressions, regressions
from hexmend.quality.summary import (
    SUMMARY_QUANTITIES,
    MetricStatistics,
    Summary,
    metric_statistics,
    objective,
    summarise,
)

for _module in pkgutil.iter_modules(metrics.__path__):
    importlib.import_module(f"{metrics.__name__}.{_module.name}")

__all__ = [
    "METRICS",
    "REGRESSION_KEYS",
    "SCALED_JACOBIAN",
    "SUMMARY_QUANTITIES",
    "ElementQuality",
    "HexQuantity",
    "Metric",
    "MetricStatistics",
    "Q",
    "Summary",
    "corner_determinants",
    "corner_qualities",
    "describe_regressions",
    "locked_hexes",
    "measure",
    "measure_against_target",
    "metric_statistics",
    "metric_values",
    "objective",
    "rank_worst",
    "regressions",
    "summarise",
    "target_quality",
    "worst_hexes",
]
