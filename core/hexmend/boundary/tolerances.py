"""Distances up to which places on a boundary count as the same."""

from __future__ import annotations

import math

#: Rounding error of a place, in mean edge lengths: files may hold seven digits.
ROUNDING = 1e-7
#: Largest distance of a node that moves along a plane or line from a patch or curve that is flat within `ROUNDING`, in
#: mean edge lengths: node and surface may lie on either side, of a line in two directions.
FLAT_DISTANCE = 2 * math.sqrt(2) * ROUNDING
