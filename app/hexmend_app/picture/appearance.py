"""Appearance of a mesh as values without Qt and VTK, shared by the window and off-screen pictures."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from enum import StrEnum

from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.config_table import ConfigTable, option
from hexmend_app.picture.colours import Colours
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.layer_switch import LAYERS
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
    extra: tuple[str, ...] = ()

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
class Look(ConfigTable):
    """All settings of the drawing of a mesh: the tables of a scene except the cameras, the panels and their labels.

    Parameters
    ----------
    cut : Cut
        Cut of the mesh by planes or by a box.
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
    """

    cut: Cut = option(Cut)
    show: Show = option(Show)
    structure: Structure = option(Structure)
    movement: Traces = option(Traces)
    colours: Colours = option(Colours)
    lines: LineStyle = option(LineStyle)
    page: Page = option(Page)

    def on(self, mesh: Mesh) -> Look:
        """Return the look with the coordinates of the cut in a mesh.

        Raises
        ------
        ParameterError
            If a listed hex does not exist in the mesh.
        """
        self.show.check_numbers(mesh.n_hexes)
        return dataclasses.replace(self, cut=self.cut.on(mesh))
