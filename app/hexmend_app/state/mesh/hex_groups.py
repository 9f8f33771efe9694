"""Named groups of hexes that can be isolated: inverted, invalid, locked, mended, ..."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, locked_hexes
from hexmend_app.picture.displacement import MENDED, NEWLY_INVALID, STILL_INVALID, Displacement

#: Groups that a displacement defines.
_OF_DISPLACEMENT = {"newly invalid": NEWLY_INVALID, "still invalid": STILL_INVALID, "mended": MENDED}

GROUPS = ("inverted", "invalid", "invalid inside", "locked", *_OF_DISPLACEMENT)


def invalid_counts(inverted: int, invalid: int) -> str:
    """Return the numbers of hexes that are inverted and of hexes that are invalid inside, for captions.

    >>> invalid_counts(0, 0), invalid_counts(1200, 1200), invalid_counts(1, 3)
    ('none invalid', '1,200 inverted', '1 inverted, 2 invalid inside')
    """
    counts = {"inverted": inverted, "invalid inside": invalid - inverted}
    return ", ".join(f"{count:,} {name}" for name, count in counts.items() if count) or "none invalid"


def hexes_of_group(
    group: str, mesh: Mesh, quality: ElementQuality, displacement: Displacement | None = None
) -> np.ndarray:
    """Return the hexes of a group, (k,) int64.

    Parameters
    ----------
    group : str
        One of `GROUPS`.
    mesh : Mesh
    quality : ElementQuality
        Quality of the mesh.
    displacement : Displacement, optional
        Defines the newly invalid, still invalid and mended hexes; without it these groups are empty.

    Raises
    ------
    KeyError
        If there is no such group.
    """
    if group not in GROUPS:
        raise KeyError(f"there is no group of hexes {group!r}: known are {', '.join(GROUPS)}")
    if group in ("inverted", "invalid"):
        return np.flatnonzero(getattr(quality, group))
    if group == "invalid inside":
        return np.flatnonzero(quality.invalid & ~quality.inverted)
    if group == "locked":
        return np.flatnonzero(locked_hexes(mesh.points, mesh.elements, mesh.fixed, quality.inverted))
    if displacement is None:
        return np.empty(0, np.int64)
    return np.flatnonzero(displacement.validity_changes == _OF_DISPLACEMENT[group])
