"""Elements that have a name of their own, to be shown alone: the inverted, the locked, the mended..."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.displacement import MENDED, NEWLY_INVERTED, STILL_INVERTED, Displacement
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, locked_hexes

#: Those that a movement tells apart.
_MOVED = {"newly inverted": NEWLY_INVERTED, "still inverted": STILL_INVERTED, "mended": MENDED}

KINDS = ("inverted", "locked", *_MOVED)


def hexes_of_group(kind: str, mesh: Mesh, figures: ElementQuality, movement: Displacement | None = None) -> np.ndarray:
    """The hexes of a kind, (k,) int64.

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    mesh : Mesh
    figures : ElementQuality
        Of this mesh.
    movement : Displacement, optional
        What tells apart the newly inverted, the still inverted and the mended; without it there are none.

    Raises
    ------
    KeyError
        For another kind.
    """
    if kind not in KINDS:
        raise KeyError(f"there is no kind of hexes {kind!r}: known are {', '.join(KINDS)}")
    if kind == "inverted":
        return np.flatnonzero(figures.inverted)
    if kind == "locked":
        return np.flatnonzero(locked_hexes(mesh.points, mesh.hexes, mesh.fixed, figures.inverted))
    return np.empty(0, np.int64) if movement is None else np.flatnonzero(movement.inversion_changes == _MOVED[kind])
