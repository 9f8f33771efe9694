"""Solvers' own checks of hexes: their documented limits, and how many faces or hexes of a mesh are beyond each.

The limits are in `limits.toml`. A limit that no documentation of the solver states is left out.

>>> from hexmend import gallery
>>> report = check_mesh(gallery.make("cube", size=27), "openfoam")
>>> report.verdict
'passed'
"""

from hexmend.solver_checks.check import Check, CheckResult, Level
from hexmend.solver_checks.solver import QUOTED, SOLVERS, Report, Solver, check_mesh

__all__ = ["QUOTED", "SOLVERS", "Check", "CheckResult", "Level", "Report", "Solver", "check_mesh"]
