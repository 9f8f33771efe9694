"""Quality of hexes and of meshes: the metrics, measuring, and the summary of a mesh.

Every module of `hexmend.quality.metrics` is imported here and registers its metric in METRICS: the command line, the
viewer, the docs and the tests take it from there.
"""

import importlib
import pkgutil

from hexmend.aliases import exports
from hexmend.quality import metrics
from hexmend.quality.element import Element, Node, element, node, worst
from hexmend.quality.measure import ElementQuality, corner_determinants, corner_qualities, locked, measure
from hexmend.quality.mesh_quality import values, worst_hexes
from hexmend.quality.metric import METRICS, ElementFigure, Metric
from hexmend.quality.metrics.q import Q
from hexmend.quality.metrics.scaled_jacobian import SCALED_JACOBIAN
from hexmend.quality.regressions import JUDGED, regressions, worse_in_words
from hexmend.quality.second_order import SecondOrder, summarise_second_order
from hexmend.quality.statistics import Spread, spreads
from hexmend.quality.summary import FIGURES, Summary, objective, summarise

for _module in pkgutil.iter_modules(metrics.__path__):
    importlib.import_module(f"{metrics.__name__}.{_module.name}")

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
    "regressions",
    "spreads",
    "summarise",
    "summarise_second_order",
    "values",
    "worse_in_words",
    "worst",
    "worst_hexes",
]

__getattr__ = exports(__name__)
