"""Where the mesh is looked at from, as a value that outlives the 3D view."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import astuple, dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal

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


class Eye(QObject):
    """Knows where the camera stands, and where it is to stand.

    Attributes
    ----------
    now : callable
        Gives where the camera stands, a Stand, or None where there is no view; who has the camera sets it.
    wanted : Stand or None
        Where it is to stand as soon as there is a view of the open mesh.

    Signals
    -------
    called
        It is to stand elsewhere.
    """

    called = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.now: Callable[[], Stand | None] = lambda: None
        self.wanted: Stand | None = None

    def given(self) -> Stand | None:
        """What a session keeps."""
        return self.wanted or self.now()

    def take(self, stand: Stand | None) -> None:
        """Have the camera stand where a session has kept it."""
        self.wanted = stand
        self.called.emit()
