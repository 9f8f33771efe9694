"""Metrics as the widgets offer them."""

from __future__ import annotations

from hexmend.quality import METRICS, Metric


def metrics_offered() -> list[Metric]:
    """Every metric, the thesis's own first."""
    return sorted(METRICS.values(), key=lambda metric: metric.name != "q")
