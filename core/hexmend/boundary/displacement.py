"""How far nodes have moved and elements have changed since an earlier moment: what colours, arrows and counts show."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from hexmend.aliases import exports
from hexmend.boundary import SkinSurface
from hexmend.kernels import corner_values
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import points_like
from hexmend.quality import METRICS, ElementQuality, HexQuantity

#: Changes of q, and ways in mean edge lengths, that are rounding.
NOTHING = 1e-9

_MOVED = "of where each node is and where it was, in mean edge lengths of the mesh as it was opened"


@dataclass(frozen=True, kw_only=True)
class Change(HexQuantity):
    """A figure of every hex between two moments of one mesh.

    Parameters
    ----------
    label : str
        A word for a button.
    since : str
        What it is called before "since" and the earlier moment.
    of : callable
        Gives the values, (m,) float64, of a `Displacement`.
    """

    label: str
    since: str
    of: Callable[[Displacement], np.ndarray]


def _moved(movement: Displacement, of_corners: Callable[..., None]) -> np.ndarray:
    return _of_nodes(movement, movement.distances, of_corners)


def _of_nodes(movement: Displacement, distances: np.ndarray, of_corners: Callable[..., None]) -> np.ndarray:
    """What becomes of distances of nodes, (n,) in the unit of the mesh, in each hex, (m,) in mean edge lengths."""
    values = np.empty(movement.mesh.n_hexes)
    of_corners(movement.mesh.hexes, distances / movement.unit, values)
    return values


#: What colours can show of a movement, beside `METRICS`.
MOVEMENTS: dict[str, Change] = {
    one.name: one
    for one in (
        Change(
            name="moved-most",
            title="Largest displacement",
            label="Displacement",
            since="mean edge lengths moved",
            formula=f"greatest distance, over the nodes of a hex, {_MOVED}",
            source="Hexmend",
            full_range=(0.0, np.inf),
            acceptable=(0.0, np.inf),
            better=0,
            meaning="Where the mesh has changed.",
            unit="mean edge lengths",
            of=lambda movement: _moved(movement, corner_values.largest),
        ),
        Change(
            name="moved-mean",
            title="Mean displacement",
            label="Mean displacement",
            since="mean edge lengths moved on average",
            formula=f"mean distance, over the nodes of a hex, {_MOVED}",
            source="Hexmend",
            full_range=(0.0, np.inf),
            acceptable=(0.0, np.inf),
            better=0,
            meaning="Where the mesh has changed.",
            unit="mean edge lengths",
            of=lambda movement: _moved(movement, corner_values.mean),
        ),
        Change(
            name="q-change",
            title="Change of q(H)",
            label="Δq",
            since="change of q(H)",
            formula="q(H) now, less q(H) then",
            source="Hexmend",
            full_range=(-1.0, 1.0),
            acceptable=(-np.inf, np.inf),
            better=1,
            meaning="Which hexes have paid for what others have gained.",
            of=lambda movement: movement.figures.q - movement.before.figures.q,
        ),
        Change(
            name="surface-distance",
            title="Distance from the surface",
            label="Off surface",
            since="mean edge lengths off the surface",
            formula="greatest distance, over the boundary nodes of a hex, from the boundary as it was, in mean edge "
            "lengths of the mesh as it was opened",
            source="Hexmend",
            full_range=(0.0, np.inf),
            acceptable=(0.0, np.inf),
            better=0,
            meaning="Where a boundary that slides has left the surface.",
            unit="mean edge lengths",
            of=lambda movement: _of_nodes(movement, movement.off_surface, corner_values.largest),
        ),
    )
}

#: What the colours of `q-change` set apart, in this order: numbers of `Displacement.kinds`.
NEWLY_INVERTED, STILL_INVERTED, MENDED = 1, 2, 3


def named(name: str) -> HexQuantity:
    """What colours show under a name: a metric, or a change."""
    return MOVEMENTS.get(name) or METRICS[name]


@dataclass(frozen=True, eq=False)
class Moment:
    """The open mesh as it was, that it is compared with.

    Parameters
    ----------
    points : (n, 3) float64
    figures : ElementQuality
    name : str
        What to call it behind "since".
    """

    points: np.ndarray
    figures: ElementQuality
    name: str
    _skins: dict[str, SkinSurface] = field(default_factory=dict)

    def skin(self, mesh: Mesh) -> SkinSurface:
        """The boundary of the mesh as it was; found once."""
        if "whole" not in self._skins:
            self._skins["whole"] = SkinSurface(self.points, mesh.topology.boundary_faces)
        return self._skins["whole"]


@dataclass(frozen=True, eq=False)
class Displacement:
    """What lies between two moments of one mesh; each figure is worked out once, when it is asked for.

    Parameters
    ----------
    mesh : Mesh
        For its hexes and its mean edge length, which is the unit.
    before : Moment
    points : (n, 3) float64
        Where its nodes are now.
    figures : ElementQuality
        Of it now.
    """

    mesh: Mesh
    before: Moment
    points: np.ndarray
    figures: ElementQuality
    _known: dict[str, np.ndarray] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for points in (self.before.points, self.points):
            points_like(points, self.mesh.points.shape)

    def until(self, points: np.ndarray, figures: ElementQuality) -> Displacement:
        """From the same moment to where the nodes are elsewhere, (n, 3) float64."""
        return Displacement(self.mesh, self.before, points, figures)

    def title(self, name: str) -> str:
        """What colours show under one of the names of `MOVEMENTS`, in short."""
        return f"{MOVEMENTS[name].since} since {self.before.name}"

    @cached_property
    def distances(self) -> np.ndarray:
        """How far each node is from where it was, (n,) float64 in the unit of the mesh."""
        return np.sqrt(np.square(self.points - self.before.points).sum(axis=1))

    @cached_property
    def off_surface(self) -> np.ndarray:
        """How far each boundary node is from the boundary as it was, (n,) float64 in the unit of the mesh; others 0."""
        off = np.zeros(len(self.points))
        moved = np.flatnonzero(self.mesh.topology.boundary & (self.distances > 0))
        if moved.size:
            off[moved] = self.before.skin(self.mesh).distances(self.points[moved])
        return off

    @cached_property
    def unit(self) -> float:
        """The mean edge length of the mesh."""
        return self.mesh.mean_edge_length or 1.0

    def values(self, name: str) -> np.ndarray:
        """What colours show, (m,) float64; one of `MOVEMENTS`."""
        if name not in self._known:
            self._known[name] = MOVEMENTS[name].of(self)
        return self._known[name]

    @cached_property
    def kinds(self) -> np.ndarray:
        """0, or `NEWLY_INVERTED`, `STILL_INVERTED` or `MENDED`, of each element, (m,) uint8."""
        then, now = self.before.figures.inverted, self.figures.inverted
        return np.array([0, MENDED, NEWLY_INVERTED, STILL_INVERTED], np.uint8)[2 * now.astype(np.uint8) + then]

    @cached_property
    def counts(self) -> Counts:
        """Its figures in short."""
        distances = self.distances / self.unit
        moved = distances > NOTHING
        change = self.values("q-change")
        return Counts(
            int(np.count_nonzero(moved)),
            int(np.count_nonzero(moved & self.mesh.topology.boundary)),
            float(distances[moved].mean()) if moved.any() else 0.0,
            float(distances.max(initial=0.0)),
            int(np.count_nonzero(change > NOTHING)),
            int(np.count_nonzero(change < -NOTHING)),
            int(np.count_nonzero(self.kinds == NEWLY_INVERTED)),
            int(np.count_nonzero(self.kinds == MENDED)),
        )


@dataclass(frozen=True)
class Counts:
    """Of a movement.

    Parameters
    ----------
    moved : int
        Nodes that are elsewhere.
    slid : int
        Those of the boundary among them.
    mean, largest : float
        How far they are, in mean edge lengths.
    better, worse : int
        Elements whose q(H) has risen or fallen.
    newly_inverted, mended : int
        Elements that were not inverted and are, and the other way round.
    """

    moved: int
    slid: int
    mean: float
    largest: float
    better: int
    worse: int
    newly_inverted: int
    mended: int


__getattr__ = exports(__name__)
