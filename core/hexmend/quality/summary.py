"""Summary of the quality of a mesh."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from hexmend.aliases import old_keywords
from hexmend.mesh.mesh import Mesh
from hexmend.quality.measure import ElementQuality, locked_hexes, measure
from hexmend.quantity import Quantity, format_count, format_quality
from hexmend.quantity import format_objective as energy


def _figure(label: str, help: str, text: Callable[[Any], str], better: int = 0, part_of: str = "") -> Any:
    return dataclasses.field(
        metadata={"label": label, "help": help, "text": text, "better": better, "part_of": part_of}
    )


@dataclass(frozen=True)
class Summary:
    """Counts and quality of a mesh, (2.11), (2.12); every field is described by its entry in `SUMMARY_QUANTITIES`.

    `nodes` counts nodes used by a hex; `locked_inverted` inverted hexes that fixed nodes alone keep inverted; `q_norm`
    is 1/sqrt(mean(1/q^2)), 0 if any q is 0; `objective` is the sum of eta(H)^2 at delta = 0, None if any hex is
    inverted.
    """

    hexes: int = _figure("hexes", "Number of hexahedral elements.", format_count)
    nodes: int = _figure("nodes", "Number of nodes that an element uses.", format_count)
    free_nodes: int = _figure(
        "free nodes",
        "Nodes that smoothing may move; the others, such as those of the surface, are fixed.",
        format_count,
    )
    inverted: int = _figure(
        "inverted",
        "Elements turned inside out at a corner: one of their eight corner tetrahedra has a determinant σ ≤ 0 (2.9). "
        "A solver cannot use them.",
        format_count,
        -1,
    )
    locked_inverted: int = _figure(
        "of these locked",
        "Inverted elements with a corner tetrahedron of σ ≤ 0 whose four nodes are all fixed. No method that keeps "
        "those nodes can mend them.",
        format_count,
        -1,
        part_of="inverted",
    )
    q_min: float = _figure(
        "q min",
        "Quality of the worst element. q(H) is the mean over the eight corner tetrahedra of 3 σ^⅔ / |S|², and 0 for "
        "those with σ ≤ 0 (2.8, 2.10): 1 for a cube, 0 for a flat element.",
        format_quality,
        1,
    )
    q_mean: float = _figure("q mean", "Mean quality over all elements (2.11).", format_quality, 1)
    q_max: float = _figure("q max", "Quality of the best element.", format_quality)
    q_std: float = _figure(
        "q std", "Standard deviation of the elements' quality: how widely it spreads.", format_quality
    )
    q_norm: float = _figure(
        "q norm",
        "1 / √(mean of 1/q²) (2.12): a mean in which bad elements count most; 0 as soon as one q is 0.",
        format_quality,
        1,
    )
    scaled_jacobian_min: float = _figure(
        "scaled Jacobian min",
        "The least σ / (|e₁| |e₂| |e₃|) over all corners: 1 for right angles, 0 for a flat corner, negative for an "
        "inverted one. Other programs print it.",
        format_quality,
        1,
    )
    objective: float | None = _figure(
        "objective Σ η²",
        "Sum of η(H)² over all elements, what smoothing minimises (3.3): 0 for cubes, infinite while any element is "
        "inverted.",
        energy,
        -1,
    )

    def to_dict(self) -> dict[str, float | int | None]:
        """Return the values by name."""
        return dataclasses.asdict(self)


#: Quantities of a summary by the names of its fields, in order.
SUMMARY_QUANTITIES: dict[str, Quantity] = {
    field.name: Quantity(field.name, **field.metadata) for field in dataclasses.fields(Summary)
}


@old_keywords("summarise")
def summarise(mesh: Mesh, quality: ElementQuality | None = None) -> Summary:
    """Summarise the quality of a mesh.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality, optional
        Quality of the hexes, if it is measured already.

    Returns
    -------
    Summary

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> summarise(Mesh(UNIT_CUBE, [range(8)])).q_norm
    1.0
    """
    quality = quality or measure(mesh.points, mesh.hexes)
    q = quality.q
    return Summary(
        hexes=mesh.n_hexes,
        nodes=int(np.count_nonzero(mesh.topology.used)),
        free_nodes=int(np.count_nonzero(mesh.free)),
        inverted=quality.n_inverted,
        locked_inverted=int(np.count_nonzero(locked_hexes(mesh.points, mesh.hexes, mesh.fixed, quality.inverted))),
        q_min=float(q.min()),
        q_mean=float(q.mean()),
        q_max=float(q.max()),
        q_std=float(q.std()),
        q_norm=float(1 / np.sqrt(np.mean(1 / np.square(q)))) if q.min() > 0 else 0.0,
        scaled_jacobian_min=float(quality.scaled_jacobian.min()),
        objective=objective(quality),
    )


def objective(quality: ElementQuality, p: float = 2.0, offset: float = 1.0) -> float | None:
    """Compute the objective of a mesh at delta = 0: the sum of eta(H)^p, the p-th power of (3.3).

    Parameters
    ----------
    quality : ElementQuality
    p, offset : float
        Exponent and offset of `hexmend.energy.ObjectiveNorm`; the defaults are those of `Summary.objective`.

    Returns
    -------
    float or None
        None if any hex is inverted or the sum overflows.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> quality = measure(UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    >>> objective(quality), objective(quality, p=4.0, offset=0.0)
    (0.0, 1.0)
    """
    if quality.n_inverted:
        return None
    with np.errstate(over="ignore"):
        total = float(((quality.eta + (1 - offset)) ** p).sum())
    return total if np.isfinite(total) else None
