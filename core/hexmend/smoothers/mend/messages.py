"""What mend says of its result, in sentences."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners


def what_is_left(left_out: np.ndarray, locked: np.ndarray) -> str:
    """Which hexes the energy leaves corners of out, by the bits of these corners: all, and the locked; (m,) uint8."""
    held, rest = int(np.count_nonzero(locked)), int(np.count_nonzero(left_out & ~locked))
    said = f"{held:,} hex{'es have' if held != 1 else ' has'} corners that fixed nodes lock in inversion"
    more = f"{rest:,} more resist{'s' * (rest == 1)}"
    return f"Left out of the energy: {'; '.join(filter(None, [said * bool(held), more * bool(rest)]))}."


def what_sliding_freed(mesh: Mesh, points: np.ndarray) -> str:
    """What has become of the hexes that a mesh's fixed nodes locked, its boundary having slid; "" where there was none.

    Parameters
    ----------
    mesh : Mesh
        As given.
    points : (n, 3) float64
        Where the nodes are now.
    """
    locked = locked_corners(mesh)
    count = np.count_nonzero(locked)
    if not count:
        return ""
    left = np.count_nonzero(locked & inverted_corners(points, mesh.hexes))
    rest = "none is left" if not left else f"{left:,} {'is' if left == 1 else 'are'} left"
    held = f"{count:,} hex{'es had' if count != 1 else ' had'} corners that fixed nodes lock in inversion"
    return f"{held}: sliding freed {count - left:,}, {rest}."
