"""From where a picture of a scene sees the mesh, and which pictures stand on its page."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.errors import ParameterError
from hexmend_app.codec.config_table import ConfigTable, option
from hexmend_app.picture.camera_pose import CameraPose, Vector

#: Names of directions to look from.
DIRECTIONS = ("iso", "+x", "-x", "+y", "-y", "+z", "-z")

#: Meshes and panels of a scene.
MOST = 12


@dataclass(frozen=True)
class Camera(ConfigTable):
    """Camera of a scene: a direction, from which the whole mesh is visible, or an exact pose.

    Parameters
    ----------
    from_ : str or Vector, optional
        iso, +x, -x, +y, -y, +z, -z, or a direction [x, y, z]; iso, from a corner, where nothing is said.
    up : str
        The axis that points upwards: x, y or z.
    parallel : bool
        Parallel projection instead of perspective.
    position, focal, view_up : Vector, optional
        Of an exact stand: where the camera is, what it looks at, and what is up in the picture.
    scale : float, optional
        Of an exact stand: half the height of what is seen in parallel projection, in the mesh's unit.
    """

    from_: str | Vector | None = option()
    up: str = option("z")
    parallel: bool = option(False)
    position: Vector | None = option()
    focal: Vector | None = option()
    view_up: Vector | None = option()
    scale: float | None = option()

    def check(self) -> None:
        """A direction, or all of a stand."""
        if isinstance(self.from_, str):
            if self.from_ not in DIRECTIONS:
                known = ", ".join(DIRECTIONS)
                raise ParameterError(f"from = {self.from_!r} is unknown: expected {known}, or a direction [x, y, z]")
        elif self.from_ is not None and not any(self.from_):
            raise ParameterError("from = [0, 0, 0] is no direction: expected one that is not zero")
        if self.up not in ("x", "y", "z"):
            raise ParameterError(f"up = {self.up!r} is unknown: expected x, y or z")
        given = [one is not None for one in (self.position, self.focal, self.view_up, self.scale)]
        if any(given):
            if self.from_ is not None:
                raise ParameterError("the camera has a direction and a stand: expected one of them")
            if not all(given):
                raise ParameterError("an exact stand lacks a part: expected position, focal, view_up and scale")
            self._stand()

    def _stand(self) -> CameraPose:
        try:
            return CameraPose(self.position, self.focal, self.view_up, self.parallel, self.scale, self.up)
        except ValueError as error:
            raise ParameterError(str(error)) from None

    @property
    def direction(self) -> str | Vector:
        """From where all is seen, where there is no exact stand."""
        return DIRECTIONS[0] if self.from_ is None else self.from_

    @property
    def stand(self) -> CameraPose | None:
        """The exact stand; None where a direction is named."""
        return None if self.position is None else self._stand()

    @classmethod
    def at(cls, stand: CameraPose) -> Camera:
        """The camera that stands so."""
        return cls(
            up=stand.axis,
            parallel=stand.parallel,
            position=stand.position,
            focal=stand.focal,
            view_up=stand.up,
            scale=stand.scale,
        )


@dataclass(frozen=True)
class WipeLayout(ConfigTable):
    """A mesh that is wiped over that of a panel.

    Parameters
    ----------
    mesh : int
        Its number on the command line.
    at : float
        Where the edge is, as a share of the width: on its right the other mesh is seen.
    caption : str
        What is written above that; without it, the name of the mesh's file.
    """

    mesh: int = option(2, low=1, high=MOST)
    at: float = option(0.5, low=0, high=1)
    caption: str = option("")


@dataclass(frozen=True)
class PicturePanel(ConfigTable):
    """One of several pictures on a page.

    Parameters
    ----------
    camera : str
        The name of one of [cameras]; without it, [camera].
    mesh : int
        The number of the mesh on the command line, from 1.
    caption : str
        What is written above it; without it, the name of the mesh's file.
    wipe : Wiped, optional
        Another mesh, seen on the right of an edge.
    """

    camera: str = option("")
    mesh: int = option(1, low=1, high=MOST)
    caption: str = option("")
    wipe: WipeLayout | None = option()
