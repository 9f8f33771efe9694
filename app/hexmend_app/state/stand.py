"""Where a camera stands, as a value."""

from __future__ import annotations

from dataclasses import astuple, dataclass

import numpy as np

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Stand:
    """Where the camera stands.

    Parameters
    ----------
    position, focal, up : (x, y, z)
        Where it is, what it looks at and turns about, and what is up in the picture.
    parallel : bool
        Parallel projection instead of perspective.
    scale : float
        Half the height of the picture in parallel projection, in the mesh's unit.
    axis : str
        The axis that is up where the mesh is looked at from a direction: x, y or z.
    """

    position: Vector
    focal: Vector
    up: Vector
    parallel: bool
    scale: float
    axis: str

    def __post_init__(self) -> None:
        position, focal, up, _, scale, axis = astuple(self)
        if not np.isfinite([*position, *focal, *up, scale]).all() or position == focal or not any(up) or scale <= 0:
            raise ValueError("the camera stands nowhere")
        if axis not in ("x", "y", "z"):
            raise ValueError(f"the axis {axis!r} is up: expected x, y or z")
