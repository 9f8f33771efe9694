"""Solvers' own checks of hexes: their documented limits, and how many faces or hexes of a mesh are beyond each.

One solver a file; each registers itself in SOLVERS. A limit that no documentation of the solver states is left out.

>>> from hexmend import gallery
>>> report = check_mesh(gallery.make("cube", size=27), "openfoam")
>>> report.verdict
'passed'
"""

import importlib
import pkgutil

from hexmend.solver_checks.check import Check, CheckResult, Level
from hexmend.solver_checks.solver import QUOTED, SOLVERS, Report, Solver, check_mesh

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")

__all__ = ["QUOTED", "SOLVERS", "Check", "CheckResult", "Level", "Report", "Solver", "check_mesh"]
