"""Checks of LS-DYNA: negative volumes, and the values that determine the time step of solids."""

from __future__ import annotations

from hexmend.solver_checks.check import Check, Level
from hexmend.solver_checks.solver import QUOTED, Solver

#: Default of TSSFAC in *CONTROL_TIMESTEP.
TIME_STEP_FACTOR = 0.9

_THEORY = "LS-DYNA Theory Manual, time step calculations for solid elements"

LSDYNA = Solver(
    name="lsdyna",
    title="LS-DYNA",
    tests_validity=(
        "LS-DYNA tests the volume of an element, at its integration points: it may run with hexes that are inverted at "
        "a corner, or invalid inside."
    ),
    own_checks=(
        Check(
            "volume", lambda measures: measures.volumes, "hexes", 1, 0.0, Level.ERROR,
            "volume inside the bilinear faces",
            "LS-DYNA support, Negative volumes in brick elements: the calculation terminates", inclusive=True,
            unit="mesh unit³",
        ),
        Check(
            "characteristic length", lambda measures: measures.characteristic_lengths, "hexes", 1, None,
            Level.INFORMATION, "volume over the area of the largest face", _THEORY, unit="mesh unit",
        ),
        Check(
            "time step at wave speed 1", lambda measures: TIME_STEP_FACTOR * measures.characteristic_lengths, "hexes",
            1, None, Level.INFORMATION, "0.9 (TSSFAC) times the characteristic length, without bulk viscosity",
            f"{_THEORY}; *CONTROL_TIMESTEP ({QUOTED})", unit="mesh unit",
        ),
    ),
    omitted=(
        "No documented limits of aspect ratio, warpage or Jacobian are known for LS-DYNA's solids, so none is judged "
        "here: hexmend info --metrics prints these values."
    ),
    reservation=QUOTED,
).register()  # fmt: skip
