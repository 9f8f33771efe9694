"""Appearance of a mesh as values without Qt and VTK, shared by the window and off-screen pictures."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.conversion import ConfigTable, option
from hexmend_app.picture.camera import Vector
from hexmend_app.picture.colours import Colours
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.picture.layer_switch import LAYERS, ON_BY_DEFAULT
from hexmend_app.picture.page import LineStyle, Page
from hexmend_app.picture.visibility import Show


class Since(StrEnum):
    """Reference state of movements."""

    OPENED = "opened"
    """The mesh as opened."""
    RUN = "run"
    """The start of the run whose iteration is shown."""
    ITERATION = "iteration"
    """The previous recorded iteration."""


#: The event of `Since.OPENED`, in sentences.
FILE_OPENED = "the file was opened"


class Arrows(StrEnum):
    """Nodes with arrows from their previous to their current positions."""

    NONE = "none"
    SIGHT = "sight"
    """Nodes of visible faces."""
    ALL = "all"
    """Nodes of all shown hexes; arrows are not hidden by the mesh."""


@dataclass(frozen=True)
class Traces(ConfigTable):
    """Drawing of the displacement since an earlier state, in addition to the colours.

    Parameters
    ----------
    since : Since
        Reference state of arrows, of counts and of colours of a movement.
    arrows : Arrows
        Nodes with arrows to their positions: those of visible faces, paler where they are hidden, or those of all shown
        hexes, drawn through the faces before them. Nodes of the boundary move only if they slide.
    factor : float
        Length of arrows as a multiple of the displacement.
    """

    since: Since = option(Since.OPENED, titles=("file opened", "run started", "last iteration"))
    arrows: Arrows = option(Arrows.NONE, titles=("none", "at visible faces", "at all shown hexes"))
    factor: float = option(1.0, low=0.01, high=100_000)


@dataclass(frozen=True)
class Structure:
    """Layers over the mesh that are on.

    Parameters
    ----------
    on : frozenset of str
        Names: irregular, boundary, sharp, fixed, free, locked, kinds, original, curved, or additional layers.
    """

    on: frozenset[str] = ON_BY_DEFAULT

    def __post_init__(self) -> None:
        if self.on != ON_BY_DEFAULT:  # otherwise the names are known before all layers are loaded
            object.__setattr__(self, "on", frozenset(LAYERS[name].name for name in self.on))

    def __repr__(self) -> str:
        return f"Structure(on={sorted(self.on)})"

    @classmethod
    def of(cls, *names: str) -> Structure:
        """Return the structure in which layers are on, in addition to those that are on by default."""
        return cls(ON_BY_DEFAULT.union(names))

    def is_on(self, name: str) -> bool:
        """Return True if the layer of a name is on."""
        return name in self.on

    def switched(self, name: str, on: bool) -> Structure:
        """Return a copy in which the layer of a name is on or off."""
        return Structure(self.on | {name} if on else self.on - {name})

    def without(self, *names: str) -> Structure:
        """Return a copy in which layers are off."""
        return Structure(self.on.difference(names))


@dataclass(frozen=True)
class Measurement(ConfigTable):
    """Points between which distances and an angle are measured and drawn.

    Parameters
    ----------
    points : tuple of Vector
        Up to three points: two have a distance, three also an angle at the second.
    """

    points: tuple[Vector, ...] = option((), most=3)

    def with_point(self, point: Vector) -> Measurement:
        """Return a copy with another point; the one after the third begins a new measurement."""
        return Measurement((*(self.points if len(self.points) < 3 else ()), point))

    @property
    def distances(self) -> list[float]:
        """Distances between consecutive points."""
        return [math.dist(*ends) for ends in pairwise(self.points)]

    @property
    def angle(self) -> float | None:
        """Angle at the second of three points in degrees; None for fewer or coinciding points."""
        if len(self.points) < 3 or not all(self.distances):
            return None
        first, corner, last = self.points
        arms = [[a - b for a, b in zip(end, corner, strict=True)] for end in (first, last)]
        u, v = ([c / math.hypot(*arm) for c in arm] for arm in arms)
        # Exact for small angles too, unlike the arc cosine.
        return math.degrees(2 * math.atan2(math.dist(u, v), math.hypot(*(a + b for a, b in zip(u, v, strict=True)))))


@dataclass(frozen=True)
class Look(ConfigTable):
    """All settings of the drawing of a mesh: the tables of a scene except the cameras, the panels and their labels.

    Parameters
    ----------
    cut : Cut
        Cut of the mesh by planes, a box, a slab, a sphere or the depth of hexes.
    show : Show
        Filters of the shown hexes.
    structure : Structure
        Layers over the mesh.
    movement : Traces
        Arrows and reference state of movements.
    colours : Colours
        Colours of the hexes.
    lines : LineStyle
        Widths of lines.
    page : Page
        Page of pictures; views use its shading alone.
    measurement : Measurement
        Points that are measured.
    """

    cut: Cut = option(Cut)
    show: Show = option(Show)
    structure: Structure = option(Structure)
    movement: Traces = option(Traces)
    colours: Colours = option(Colours)
    lines: LineStyle = option(LineStyle)
    page: Page = option(Page)
    measurement: Measurement = option(Measurement)

    @property
    def shows_movement(self) -> bool:
        """True if colours or arrows show a displacement."""
        return self.colours.metric in DISPLACEMENT_QUANTITIES or self.movement.arrows is not Arrows.NONE

    def on(self, mesh: Mesh) -> Look:
        """Return the look with the coordinates of the cut in a mesh.

        Raises
        ------
        ParameterError
            If a listed hex does not exist in the mesh.
        """
        self.show.check_numbers(mesh.n_elements)
        return dataclasses.replace(self, cut=self.cut.on(mesh))
