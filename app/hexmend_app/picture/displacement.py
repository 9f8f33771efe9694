"""Displacement of nodes and change of hexes between two states of one mesh, as colours, arrows and counts show it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from hexmend.boundary import SkinSurface
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import points_like
from hexmend.quality import METRICS, ElementQuality, HexQuantity

#: Changes of q, and displacements in mean edge lengths, up to this are rounding errors.
ROUNDING = 1e-9

_UNIT = "mean edge lengths"
_MOVED = f"of where each node is and where it was, in {_UNIT} of the mesh as it was opened"


@dataclass(frozen=True, kw_only=True)
class DisplacementQuantity(HexQuantity):
    """Quantity of every hex that compares two states of one mesh; by default a distance.

    Parameters
    ----------
    label : str
        Short name for a button.
    since : str
        Name that a caption puts before "since" and the name of the reference state.
    of : callable
        Computes the values, (m,) float64, from a `Displacement`.
    """

    label: str
    since: str
    of: Callable[[Displacement], np.ndarray]
    source: str = "Hexmend"
    full_range: tuple[float, float] = (0.0, np.inf)
    acceptable: tuple[float, float] = (0.0, np.inf)
    better: int = 0
    meaning: str = "Amount by which the nodes of a hex have moved."
    unit: str = _UNIT


def _of_nodes(movement: Displacement, distances: np.ndarray, combine: Callable[..., np.ndarray]) -> np.ndarray:
    """Combine node distances (n,), in the mesh's unit, into one value a hex (m,), in mean edge lengths."""
    return combine((distances / movement.unit).take(movement.mesh.elements), axis=1)


_QUANTITIES = (
    DisplacementQuantity(
        name="moved-most",
        title="Largest displacement",
        label="Displacement",
        since=f"{_UNIT} moved",
        formula=f"greatest distance, over the nodes of a hex, {_MOVED}",
        of=lambda movement: _of_nodes(movement, movement.distances, np.max),
    ),
    DisplacementQuantity(
        name="moved-mean",
        title="Mean displacement",
        label="Mean displacement",
        since=f"{_UNIT} moved on average",
        formula=f"mean distance, over the nodes of a hex, {_MOVED}",
        of=lambda movement: _of_nodes(movement, movement.distances, np.mean),
    ),
    DisplacementQuantity(
        name="q-change",
        title="Change of q(H)",
        label="Δq",
        since="change of q(H)",
        formula="q(H) now minus q(H) of the reference state",
        full_range=(-1.0, 1.0),
        acceptable=(-np.inf, np.inf),
        better=1,
        meaning="Hexes that became worse while others improved.",
        unit="",
        of=lambda movement: movement.quality.q - movement.before.quality.q,
    ),
    DisplacementQuantity(
        name="surface-distance",
        title="Distance from the surface",
        label="Off surface",
        since=f"{_UNIT} off the surface",
        formula="greatest distance, over the boundary nodes of a hex, from the boundary as it was, "
        f"in {_UNIT} of the mesh as it was opened",
        meaning="Distance by which a sliding boundary has left the surface.",
        of=lambda movement: _of_nodes(movement, movement.off_surface, np.max),
    ),
)
#: Displacement quantities by name.
DISPLACEMENT_QUANTITIES = {one.name: one for one in _QUANTITIES}

#: Values of `Displacement.validity_changes`, in the order of the legend of `q-change`.
NEWLY_INVALID, STILL_INVALID, MENDED = 1, 2, 3


def hex_quantity(name: str) -> HexQuantity:
    """Return the displacement quantity or the metric of a name; raises `ParameterError` for an unknown one."""
    return DISPLACEMENT_QUANTITIES.get(name) or METRICS[name]


@dataclass(frozen=True, eq=False)
class ReferenceState:
    """Earlier state of a mesh, to which displacements refer.

    Parameters
    ----------
    points : (n, 3) float64
        Node positions.
    quality : ElementQuality
        Quality of the hexes.
    name : str
        Name that a caption puts after "since".
    """

    points: np.ndarray
    quality: ElementQuality
    name: str
    _skins: list[SkinSurface] = field(default_factory=list)

    def skin(self, mesh: Mesh) -> SkinSurface:
        """Return the boundary of the mesh in this state; it is built once."""
        if not self._skins:
            self._skins.append(SkinSurface(self.points, mesh.topology.boundary_faces))
        return self._skins[0]


@dataclass(frozen=True, eq=False)
class Displacement:
    """Difference between two states of one mesh; every quantity is computed once, on demand.

    Parameters
    ----------
    mesh : Mesh
        Mesh that gives the hexes and the mean edge length.
    before : ReferenceState
    points : (n, 3) float64
        Present node positions.
    quality : ElementQuality
        Present quality of the hexes.

    Raises
    ------
    MeshError
        For points of another shape or type.
    """

    mesh: Mesh
    before: ReferenceState
    points: np.ndarray
    quality: ElementQuality
    _known: dict[str, np.ndarray] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for points in (self.before.points, self.points):
            points_like(points, self.mesh.points.shape)

    def updated(self, points: np.ndarray, quality: ElementQuality) -> Displacement:
        """Return the displacement from the same reference state to other points (n, 3) float64."""
        return Displacement(self.mesh, self.before, points, quality)

    def title(self, name: str) -> str:
        """Return the caption of a quantity of `DISPLACEMENT_QUANTITIES`."""
        return f"{DISPLACEMENT_QUANTITIES[name].since} since {self.before.name}"

    @cached_property
    def distances(self) -> np.ndarray:
        """Distance of each node from its reference position, (n,) float64, in the mesh's unit."""
        return np.sqrt(np.square(self.points - self.before.points).sum(axis=1))

    @cached_property
    def off_surface(self) -> np.ndarray:
        """Distance of boundary nodes from the reference boundary, (n,) float64, in the mesh's unit; 0 inside."""
        distance = np.zeros(len(self.points))
        moved = np.flatnonzero(self.mesh.topology.boundary & (self.distances > 0))
        if moved.size:
            distance[moved] = self.before.skin(self.mesh).distances(self.points[moved])
        return distance

    @cached_property
    def unit(self) -> float:
        """Mean edge length of the mesh, 1 if it is 0."""
        return self.mesh.mean_edge_length or 1.0

    def values(self, name: str) -> np.ndarray:
        """Return the values of a quantity of `DISPLACEMENT_QUANTITIES`, (m,) float64; they are computed once."""
        if name not in self._known:
            self._known[name] = DISPLACEMENT_QUANTITIES[name].of(self)
        return self._known[name]

    @cached_property
    def validity_changes(self) -> np.ndarray:
        """`NEWLY_INVALID`, `STILL_INVALID` or `MENDED` for each hex, 0 for one always valid; (m,) uint8."""
        then, now = self.before.quality.invalid, self.quality.invalid
        return np.array([0, MENDED, NEWLY_INVALID, STILL_INVALID], np.uint8)[2 * now.astype(np.uint8) + then]

    @cached_property
    def counts(self) -> DisplacementCounts:
        """Counts of moved nodes and changed hexes."""
        distances, change, validity = self.distances / self.unit, self.values("q-change"), self.validity_changes
        moved = distances > ROUNDING
        mean, largest = float(distances[moved].mean()) if moved.any() else 0.0, float(distances.max(initial=0.0))
        counts = {
            "moved": moved,
            "slid": moved & self.mesh.topology.boundary,
            "better": change > ROUNDING,
            "worse": change < -ROUNDING,
            "newly_invalid": validity == NEWLY_INVALID,
            "mended": validity == MENDED,
        }
        counts = {name: int(np.count_nonzero(marks)) for name, marks in counts.items()}
        return DisplacementCounts(mean=mean, largest=largest, **counts)


@dataclass(frozen=True)
class DisplacementCounts:
    """Counts of moved nodes and changed hexes of a displacement.

    Parameters
    ----------
    moved : int
        Number of moved nodes.
    slid : int
        Number of moved boundary nodes.
    mean, largest : float
        Mean and largest displacement of the moved nodes, in mean edge lengths.
    better, worse : int
        Number of hexes whose q(H) has risen or fallen.
    newly_invalid, mended : int
        Number of hexes that have become invalid, and that are invalid no longer.
    """

    moved: int
    slid: int
    mean: float
    largest: float
    better: int
    worse: int
    newly_invalid: int
    mended: int
