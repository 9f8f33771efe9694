"""Appearance of a mesh: values without Qt and without VTK, shared by the window and by off-screen pictures."""

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
    """Origin of the two ends of the colour range."""

    FULL = "full"
    """The values that the metric can take."""
    FITTED = "fitted"
    """The least and the greatest value at the moment."""
    ACCEPTABLE = "acceptable"
    """The values that solvers are usually content with."""
    PINNED = "pinned"
    """Two values that the user has set."""


@dataclass(frozen=True)
class ColourScale:
    """Meaning of the colours; `hexmend_app.scene.colour.colouring.resolve` finds the ends of the range.

    Parameters
    ----------
    metric : str
        A name of `hexmend.quality.METRICS`, or of `hexmend.boundary.displacement.DISPLACEMENT_QUANTITIES`.
    map : str
        A name of `hexmend_app.picture.colour_map.COLOUR_MAPS`.
    mode : RangeMode
        Where the ends of the range come from.
    pinned : (low, high)
        The ends in the mode PINNED; the others leave it alone.
    reverse : bool
        Run through the map from its other end. Without it, the map begins with the worst.
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
    """The moment that the mesh is compared with."""

    OPENED = "opened"
    """As it was opened."""
    RUN = "run"
    """As the run began of which an iteration is shown."""
    ITERATION = "iteration"
    """As it was an iteration ago, or at the nearest one before that is kept."""


class Arrows(StrEnum):
    """Nodes that have arrows from their earlier to their present positions."""

    NONE = "none"
    SIGHT = "sight"
    """Those of the faces that are seen."""
    ALL = "all"
    """Those of all hexes that are shown, through whatever is before them."""


@dataclass(frozen=True)
class Traces:
    """Drawing of the displacement since an earlier state, in addition to the colours.

    Parameters
    ----------
    since : Since
        The moment that arrows, and colours of a movement, compare with.
    arrows : Arrows
        Which nodes have them.
    factor : float
        How many times as long as the way of their nodes arrows are.
    """

    since: Since = Since.OPENED
    arrows: Arrows = Arrows.NONE
    factor: float = 1.0


@dataclass(frozen=True)
class Isolation:
    """Some elements that are shown with what is around them, and nothing else.

    Parameters
    ----------
    hexes : tuple of int
    rings : int
        How often neighbours that share a node are taken in.
    """

    hexes: tuple[int, ...]
    rings: int = 1


@dataclass(frozen=True)
class Structure:
    """Layers over the elements that are switched on.

    Parameters
    ----------
    irregular : bool
        Interior edges that not four elements are around, through the mesh, and the nodes where they end or fork.
    boundary : bool
        Edges of a smooth boundary that not two elements are around.
    sharp : bool
        Sharp edges of the boundary.
    fixed, free : bool
        Nodes that no method moves, and those that methods may move, of the elements in sight.
    locked : bool
        The nodes in sight of elements that fixed nodes alone keep inverted.
    kinds : bool
        What the nodes of the boundary in sight may do where it slides: corners, those of curves, those of patches.
    original : bool
        The boundary as it was when the mesh was opened, see-through.
    others : bool
        Cells beside the hexes that fill space, where the mesh has any: their outer skin, see-through.
    extra : tuple of str
        Names of further layers that are on.
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
        """True if any edges are drawn that need the structure of the mesh."""
        return self.irregular or self.boundary or self.sharp

    def without_edges(self) -> Structure:
        """The same but for edges."""
        return dataclasses.replace(self, irregular=False, boundary=False, sharp=False)


#: The layers that have a field of their own.
_FIELDS = {one.name for one in dataclasses.fields(Structure)} - {"extra"}


@dataclass(frozen=True)
class ValueRange:
    """Bounds of a metric, within which elements are shown: those that a histogram counts between them.

    Parameters
    ----------
    metric : str
        A name of `hexmend.quality.METRICS`.
    low, high : float
        Infinite where there is no bound. An end of the metric's full range bounds nothing either: the best hex has
        q = 1 but for rounding. Both bounds are within; of a range that ends at -inf, no value is.
    inverted : bool
        Whether inverted elements are shown, whatever their value: the histogram has a bar of their own for them.
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
    """Everything that decides what is drawn of a mesh and how.

    Parameters
    ----------
    clip : PlaneClip or BoxClip, optional
        None shows the mesh uncut.
    peel : int
        Elements with fewer than so many others between them and the boundary are hidden.
    isolation : Isolation, optional
        None shows all.
    dug : frozenset of int
        Elements that are hidden one by one.
    outline : bool
        Draw sharp edges, and the outline of the whole where a part is hidden.
    shrink : float
        The share of its size by which each element is drawn smaller, about its centre; not where a cut is smooth.
    quality_range : ValueRange, optional
        Elements whose value lies outside are hidden; None shows all.
    scale : ColourScale
        What the colours show.
    edges : bool
        Draw the elements' edges.
    shading : bool
        Draw what light from all around hardly reaches darker, in fine frames.
    neutral : bool
        Draw the outside white and what is opened in one colour, instead of the colours of the scale.
    structure : Structure
        What is drawn of the mesh's structure.
    traces : Traces
        What is drawn of how the mesh has moved.
    left : CutLeft, optional
        What the cut by whole elements has left; without it, it is made where the nodes are.
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
