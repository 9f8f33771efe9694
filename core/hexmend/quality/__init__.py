"""Quality of hexes and of meshes: one metric a file, each announcing itself in METRICS, and the summary.

A file added to this folder is imported here, and its metric is with that in the command line, the viewer and the tests.
"""

import importlib
import pkgutil

from hexmend.quality.element import Element, Node, element, node, worst
from hexmend.quality.measure import ElementQuality, corner_determinants, corner_qualities, locked, measure
from hexmend.quality.metric import METRICS, ElementFigure, Metric
from hexmend.quality.of_mesh import values, worst_hexes
from hexmend.quality.q import Q
from hexmend.quality.scaled_jacobian import SCALED_JACOBIAN
from hexmend.quality.second_order import SecondOrder, summarise_second_order
from hexmend.quality.spread import Spread, spreads
from hexmend.quality.summary import FIGURES, Summary, objective, summarise
from hexmend.quality.worse import JUDGED, worse, worse_in_words

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")

__all__ = [
    "FIGURES",
    "JUDGED",
    "METRICS",
    "SCALED_JACOBIAN",
    "Element",
    "ElementFigure",
    "ElementQuality",
    "Metric",
    "Node",
    "Q",
    "SecondOrder",
    "Spread",
    "Summary",
    "corner_determinants",
    "corner_qualities",
    "element",
    "locked",
    "measure",
    "node",
    "objective",
    "spreads",
    "summarise",
    "summarise_second_order",
    "values",
    "worse",
    "worse_in_words",
    "worst",
    "worst_hexes",
]
