"""Quality of hexes and of meshes: one metric a file, and the summary."""

from hexmend.quality.element import Element, Node, element, node, worst
from hexmend.quality.measure import ElementQuality, corner_determinants, corner_qualities, locked, measure
from hexmend.quality.metric import METRICS, Metric
from hexmend.quality.scaled_jacobian import SCALED_JACOBIAN
from hexmend.quality.shape import Q
from hexmend.quality.summary import Summary, objective, summarise

__all__ = [
    "METRICS",
    "SCALED_JACOBIAN",
    "Element",
    "ElementQuality",
    "Metric",
    "Node",
    "Q",
    "Summary",
    "corner_determinants",
    "corner_qualities",
    "element",
    "locked",
    "measure",
    "node",
    "objective",
    "summarise",
    "worst",
]
