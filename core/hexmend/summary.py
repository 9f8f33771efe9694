"""Summary of the quality of a mesh as a record; `hexmend.quality.summarise` measures it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from hexmend.quantity import Quantity, format_count, format_objective, format_quality
from hexmend.terminal_text import count_phrase


def _figure(label: str, help: str, text: Callable[[Any], str], better: int = 0, part_of: str = "") -> Any:
    return dataclasses.field(
        metadata={"label": label, "help": help, "text": text, "better": better, "part_of": part_of}
    )


@dataclass(frozen=True, repr=False)
class Summary:
    """Counts and quality of a mesh, (2.11), (2.12); every field is described by its entry in `SUMMARY_QUANTITIES`.

    All but `hexes` is over all solid cells. `nodes` counts nodes used by a cell; `locked_inverted` inverted cells that
    fixed nodes alone keep inverted; `q_norm` is 1/sqrt(mean(1/q^2)), 0 if any q is 0; `objective` is the sum of
    eta(H)^2 at delta = 0, None if any cell is inverted; `min_jacobian` is a lower bound; `cells` has for each kind of
    the mesh (hexahedron, wedge, pyramid, tetrahedron) its count, inverted, invalid, q_min, q_mean and
    scaled_jacobian_min.
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
        "A solver cannot use them. They are among the invalid ones.",
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
    invalid: int = _figure(
        "invalid",
        "Elements whose Jacobian determinant is not positive everywhere: the inverted ones, and those that are folded "
        "between their corners. Certified by bounds; elements of second order by their own curved map.",
        format_count,
        -1,
    )
    min_jacobian: float = _figure(
        "Jacobian min / max",
        "Certified lower bound of the least Jacobian determinant in an element over the greatest in the same element: "
        "1 for a parallelepiped, 0 or less for an invalid element.",
        format_quality,
        1,
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
        format_objective,
        -1,
    )

    cells: Mapping[str, Mapping[str, float | int]] = dataclasses.field(default_factory=dict, hash=False)

    def __repr__(self) -> str:
        hexes, nodes = count_phrase(self.hexes, "hex", "hexes"), count_phrase(self.nodes, "node")
        keys = ("q_min", "q_mean", "scaled_jacobian_min")
        qualities = ", ".join(f"{SUMMARY_QUANTITIES[key].label} {format_quality(getattr(self, key))}" for key in keys)
        return f"<Summary: {hexes}, {nodes}, {self.inverted:,} inverted, {self.invalid:,} invalid; {qualities}>"

    def to_dict(self) -> dict[str, Any]:
        """Return the values by name."""
        return dataclasses.asdict(self)


#: Quantities of a summary by the names of its fields, in order.
SUMMARY_QUANTITIES: dict[str, Quantity] = {
    field.name: Quantity(field.name, **field.metadata) for field in dataclasses.fields(Summary) if field.metadata
}
