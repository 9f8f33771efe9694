"""Order and texts of metrics in widgets."""

from __future__ import annotations

from hexmend.quality import METRICS, HexQuantity, Metric
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import figure


def metrics_offered() -> list[Metric]:
    """Return all metrics, q first."""
    return sorted(METRICS.values(), key=lambda metric: metric.name != "q")


def described(metric: HexQuantity) -> str:
    """Return the tooltip of a metric: formula, meaning, acceptable range and source."""
    low, high = metric.acceptable
    return tr(
        "<qt><b>{title}</b>: {formula}.<br>{meaning}<br>Acceptable from {low:g} to {high:g} {unit}. "
        "<i>{source}</i></qt>",
        title=metric.title,
        formula=metric.formula,
        meaning=metric.meaning,
        low=low,
        high=high,
        unit=metric.unit,
        source=metric.source,
    )


def in_sentence(metric: HexQuantity) -> str:
    """Return the title of a metric as written within a sentence.

    >>> from hexmend.quality import METRICS
    >>> [in_sentence(METRICS[name]) for name in ("q", "jacobian", "scaled-jacobian", "min-angle")]
    ['q(H)', 'Jacobian', 'scaled Jacobian', 'smallest angle']
    """
    return metric.title if metric.title == "Jacobian" else metric.title[:1].lower() + metric.title[1:]


def value_text(metric: HexQuantity, value: float) -> str:
    """Return a value of a metric as text; of angles to a tenth of a degree.

    >>> from hexmend.quality import METRICS
    >>> value_text(METRICS["min-angle"], 80.0572), value_text(METRICS["q"], 0.25)
    ('80.1°', '0.2500')
    """
    return f"{value:.1f}°" if metric.unit == "degrees" else figure(value)
