"""Order and texts of metrics in widgets."""

from __future__ import annotations

import math
from html import escape

from hexmend.quality import METRICS, HexQuantity, Metric
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import figure


def metrics_offered() -> list[Metric]:
    """Return all metrics, q first."""
    return sorted(METRICS.values(), key=lambda metric: metric.name != "q")


def described(metric: HexQuantity) -> str:
    """Return the tooltip of a quantity as rich text: formula, meaning, acceptable range and source."""
    lines = [f"<b>{escape(tr(metric.title))}</b>: {escape(tr(metric.formula))}.", escape(tr(metric.meaning))]
    low, high = metric.acceptable
    if math.isfinite(low) or math.isfinite(high):
        acceptable = tr("Acceptable from {low} to {high}", low=_bound(low), high=_bound(high))
        unit = f" {tr(metric.unit)}" if metric.unit else ""
        direction = {1: tr("Higher is better."), -1: tr("Lower is better."), 0: ""}[metric.better]
        lines.append(f"{acceptable}{unit}. {direction}")
    return "<br>".join([*lines, f"<i>{escape(metric.source)}</i>"])


def _bound(value: float) -> str:
    """Return the end of a range.

    >>> _bound(float("-inf")), _bound(0.25)
    ('−∞', '0.25')
    """
    return f"{value:g}".replace("inf", "∞").replace("-", "−")


def in_sentence(metric: HexQuantity) -> str:
    """Return the title of a metric as written within a sentence.

    >>> [in_sentence(METRICS[name]) for name in ("q", "jacobian", "scaled-jacobian", "min-angle")]
    ['q(H)', 'Jacobian', 'scaled Jacobian', 'smallest angle']
    """
    title = tr(metric.title)
    return title if metric.title == "Jacobian" or title != metric.title else title[:1].lower() + title[1:]


def value_text(metric: HexQuantity, value: float) -> str:
    """Return a value of a metric as text; of angles to a tenth of a degree.

    >>> value_text(METRICS["min-angle"], 80.0572), value_text(METRICS["q"], 0.25)
    ('80.1°', '0.2500')
    """
    return f"{value:.1f}°" if metric.unit == "degrees" else figure(value)
