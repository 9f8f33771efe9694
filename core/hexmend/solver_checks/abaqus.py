"""Checks of Abaqus: volumes and angles by the input file processor, and the shape metrics of Abaqus/CAE."""

from __future__ import annotations

from hexmend.solver_checks.check import Check, Level
from hexmend.solver_checks.solver import QUOTED, Solver

_PROCESSOR = "Abaqus, messages of the input file processor"
_DISTORTED = f"{_PROCESSOR}: distorted elements, angles of isoparametric lines below 45 or above 135 degrees ({QUOTED})"
_VERIFY = f"Abaqus/CAE User's Guide, Verifying element quality: default limits of hexahedra ({QUOTED})"
_ANGLE = "of two adjacent edges over the 24 corners of the faces"

ABAQUS = Solver(
    name="abaqus",
    title="Abaqus",
    tests_validity=(
        "Abaqus tests volumes and angles, and the Jacobian at integration points during the analysis: it may run with "
        "hexes that are inverted at a corner, or invalid inside."
    ),
    own_checks=(
        Check(
            "volume", lambda measures: measures.volumes, "hexes", 1, 0.0, Level.ERROR,
            "volume inside the bilinear faces", f"{_PROCESSOR}: zero, small or negative volumes", inclusive=True,
            unit="mesh unit³",
        ),
        Check(
            "isoparametric angle, least", lambda measures: measures.quads.min_angle, "hexes", 1, 45.0, Level.WARNING,
            f"least angle {_ANGLE}", _DISTORTED, unit="degrees",
        ),
        Check(
            "isoparametric angle, greatest", lambda measures: measures.quads.max_face_angle, "hexes", -1, 135.0,
            Level.WARNING, f"greatest angle {_ANGLE}", _DISTORTED,
            unit="degrees",
        ),
        Check(
            "face corner angle, least", lambda measures: measures.quads.min_angle, "hexes", 1, 10.0, Level.WARNING,
            f"least angle {_ANGLE}", _VERIFY, unit="degrees",
        ),
        Check(
            "face corner angle, greatest", lambda measures: measures.quads.max_face_angle, "hexes", -1, 160.0,
            Level.WARNING, f"greatest angle {_ANGLE}", _VERIFY, unit="degrees",
        ),
        Check(
            "aspect ratio", lambda measures: measures.edge_ratios, "hexes", -1, 10.0, Level.WARNING,
            "longest / shortest edge", _VERIFY,
        ),
    ),
    omitted=(
        "Left out is the geometric deviation factor, which needs the CAD geometry, and what needs a material: the "
        "stable time increment and the maximum frequency. For small positive volumes no documented limit is known."
    ),
    reservation=QUOTED,
).register()  # fmt: skip
