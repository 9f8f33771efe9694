"""Appearance of a mesh as values without Qt and VTK, shared by the window and off-screen pictures."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from hexmend_app.codec.codec import since
from hexmend_app.picture.colour_map import DEFAULT_MAP
from hexmend_app.picture.cut_planes import Clip, CutLeft
from hexmend_app.picture.layer_switch import LAYERS


class RangeMode(StrEnum):
    """Definition of the colour range."""

    FULL = "full"
    """All values that the metric can have."""
    FITTED = "fitted"
    """From the smallest to the largest current value."""
    ACCEPTABLE = "acceptable"
    """Values that are usually acceptable for solvers."""
    PINNED = "pinned"
    """Two values set by the user."""


@dataclass(frozen=True)
class ColourScale:
    """Metric, map and range of the colours; `hexmend_app.scene.colour.colouring.resolve` computes the range.

    Parameters
    ----------
    metric : str
        A name of `hexmend.quality.METRICS`, or of `hexmend.boundary.displacement.DISPLACEMENT_QUANTITIES`.
    map : str
        A name of `hexmend_app.picture.colour_map.COLOUR_MAPS`.
    mode : RangeMode
        Definition of the range.
    pinned : (low, high)
        Range in the mode PINNED; ignored in other modes.
    reverse : bool
        Reverse the map, which begins with the worst value by default.
    """

    metric: str = "q"
    map: str = DEFAULT_MAP
    mode: RangeMode = RangeMode.FULL
    pinned: tuple[float, float] = (0.0, 1.0)
    reverse: bool = False

    def __post_init__(self) -> None:
        low, high = (float(end) for end in self.pinned)
        if not low < high or not np.isfinite([low, high]).all():
            raise ValueError(f"the colours' range is {self.pinned}: expected two numbers, the lower first")
        object.__setattr__(self, "mode", RangeMode(self.mode))
        object.__setattr__(self, "pinned", (low, high))


class Since(StrEnum):
    """Reference state of movements."""

    OPENED = "opened"
    """The mesh as opened."""
    RUN = "run"
    """The start of the run whose iteration is shown."""
    ITERATION = "iteration"
    """The previous recorded iteration."""


class Arrows(StrEnum):
    """Nodes with arrows from their previous to their current positions."""

    NONE = "none"
    SIGHT = "sight"
    """Nodes of visible faces."""
    ALL = "all"
    """Nodes of all shown hexes; arrows are not hidden by the mesh."""


@dataclass(frozen=True)
class Traces:
    """Drawing of the displacement since an earlier state, in addition to the colours.

    Parameters
    ----------
    since : Since
        Reference state of arrows and of colours of a movement.
    arrows : Arrows
        Nodes with arrows.
    factor : float
        Length of arrows as a multiple of the displacement.
    """

    since: Since = Since.OPENED
    arrows: Arrows = Arrows.NONE
    factor: float = 1.0


@dataclass(frozen=True)
class Isolation:
    """Hexes that are shown with their surroundings only.

    Parameters
    ----------
    hexes : tuple of int
    rings : int
        Number of rings of hexes around them; each ring adds the hexes that share a node.
    """

    hexes: tuple[int, ...]
    rings: int = 1


@dataclass(frozen=True)
class Structure:
    """Switches of the layers over the mesh.

    Parameters
    ----------
    irregular : bool
        Interior edges that are not shared by exactly four hexes, drawn through the mesh, and nodes where they end.
    boundary : bool
        Edges of a smooth boundary that are not shared by exactly two hexes.
    sharp : bool
        Sharp edges of the boundary.
    fixed, free : bool
        Visible nodes that no method moves, and visible nodes that methods may move.
    locked : bool
        Visible nodes of hexes that are inverted because of fixed nodes alone.
    kinds : bool
        Visible boundary nodes by their motion on a sliding boundary: corners, nodes on curves, nodes on patches.
    original : bool
        The boundary of the mesh as opened, translucent.
    others : bool
        Outer faces of tetrahedra, pyramids and wedges, translucent.
    extra : tuple of str
        Names of additional layers that are on.
    """

    irregular: bool = False
    boundary: bool = False
    sharp: bool = False
    fixed: bool = False
    free: bool = False
    locked: bool = False
    kinds: bool = False
    original: bool = False
    others: bool = True
    extra: tuple[str, ...] = field(default=(), metadata=since(5))

    def __post_init__(self) -> None:
        object.__setattr__(self, "extra", tuple(sorted({LAYERS[name].name for name in self.extra})))

    def is_on(self, name: str) -> bool:
        """Return True if the layer of a name is switched on."""
        return name in self.extra if name not in _FIELDS else getattr(self, name)

    def switched(self, name: str, on: bool) -> Structure:
        """Return a copy in which the layer of a name is on or off."""
        if name in _FIELDS:
            return dataclasses.replace(self, **{name: on})
        return dataclasses.replace(self, extra=(*self.extra, name) if on else tuple({*self.extra} - {name}))

    @property
    def edges(self) -> bool:
        """True if edges are drawn that depend on the structure of the mesh."""
        return self.irregular or self.boundary or self.sharp

    def without_edges(self) -> Structure:
        """Return a copy in which all layers of edges are off."""
        return dataclasses.replace(self, irregular=False, boundary=False, sharp=False)


#: Layers with a field in `Structure`.
_FIELDS = {field.name for field in dataclasses.fields(Structure)} - {"extra"}


@dataclass(frozen=True)
class ValueRange:
    """Range of a metric in which hexes are shown; the histogram counts the same hexes between these bounds.

    Parameters
    ----------
    metric : str
        A name of `hexmend.quality.METRICS`.
    low, high : float
        Bounds, inclusive; infinite for no bound. An end of the full range of the metric is no bound either, because
        rounding can make q slightly larger than 1. A range that ends at -inf contains no value.
    inverted : bool
        Show inverted hexes, independent of their value; the histogram has a separate bar for them.
    """

    metric: str
    low: float
    high: float
    inverted: bool = False

    def __post_init__(self) -> None:
        if not self.low <= self.high:
            raise ValueError(
                f"the range of {self.metric} is {self.low} to {self.high}: expected the lower number first"
            )


@dataclass(frozen=True)
class Look:
    """All settings of the drawing of a mesh.

    Parameters
    ----------
    clip : PlaneClip or BoxClip, optional
        None shows the mesh uncut.
    peel : int
        Number of layers of hexes that are hidden, from the boundary inwards.
    isolation : Isolation, optional
        None shows all hexes.
    dug : frozenset of int
        Hexes that are hidden individually.
    outline : bool
        Draw sharp edges, and the outline of the whole mesh while part of it is hidden.
    shrink : float
        Fraction by which each hex is shrunk towards its centre; ignored by smooth cuts.
    quality_range : ValueRange, optional
        Hexes with a value outside the range are hidden; None shows all hexes.
    scale : ColourScale
        Metric, map and range of the colours.
    edges : bool
        Draw the edges of hexes.
    shading : bool
        Apply ambient occlusion in fine frames.
    neutral : bool
        Draw the boundary white and exposed faces in one colour, instead of the colours of the scale.
    structure : Structure
        Switches of the layers over the mesh.
    traces : Traces
        Arrows and reference state of movements.
    left : CutLeft, optional
        Result of the cut by whole hexes; None cuts at the current positions of the nodes.
    """

    clip: Clip | None = None
    peel: int = 0
    isolation: Isolation | None = None
    dug: frozenset[int] = frozenset()
    outline: bool = True
    shrink: float = 0.0
    quality_range: ValueRange | None = None
    scale: ColourScale = ColourScale()
    edges: bool = True
    shading: bool = True
    neutral: bool = False
    structure: Structure = Structure()
    traces: Traces = Traces()
    left: CutLeft | None = field(default=None, metadata=since(3))

    def coloured_as(self, other: Look) -> bool:
        """Return True if the same hexes have the same colours."""
        return self.scale == other.scale and self.neutral == other.neutral
