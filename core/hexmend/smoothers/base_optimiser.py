"""Bases of the optimisers of (3.3): the objective, the barrier that untangles, and the line search.

Base of methods whose hexes have a target: the lengths that each is to have, and the layers that are kept.
"""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.boundary import SlidingBoundary
from hexmend.energy import ObjectiveNorm
from hexmend.energy.quads import SurfaceQuads
from hexmend.errors import MeshError, ParameterError
from hexmend.kernels.line_search import LineSearch
from hexmend.layers import KEEP_LAYERS, Layers, keeps_layers, layers_on_sets, named_walls, run_target
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import AUTO, parameter
from hexmend.quality import ElementQuality
from hexmend.smoothers.sliding_smoother import SlidingSmoother
from hexmend.target import SPECIFICATIONS
from hexmend.target.builders import SIZE_WEIGHT, WITHOUT_SIZES


@dataclass(frozen=True)
class TargetedSmoother(SlidingSmoother):
    """Method that takes the target of the hexes from the mesh, which a run sets as the parameters say."""

    target: str = parameter(
        AUTO,
        suggestions=(AUTO, *SPECIFICATIONS),
        help="Target of the hexes: cubes, the given shape, size or both, or lengths from data or a formula in x, y, z; "
        "auto: ideal, or given-shape with layers.",
    )
    size_weight: float = parameter(
        SIZE_WEIGHT,
        low=0,
        high=1000,
        help="Weight of the size relative to the shape, where the target has sizes.",
        advanced=True,
    )
    layers: str = parameter(
        "auto",
        suggestions=KEEP_LAYERS,
        sets=True,
        help="Boundary layers: keep their heights, leave them free, or keep those on the walls given by sets; "
        "auto: keep them unless a target is named.",
    )

    @property
    def keeps_layers(self) -> bool:
        return keeps_layers(self.target, self.layers)

    def layers_of(self, mesh: Mesh, found: Layers, quality: ElementQuality | None = None) -> Layers:
        names = named_walls(self.layers)
        if not names:
            return found
        try:
            return layers_on_sets(mesh, names, quality)
        except MeshError as error:
            expected = f"expected {', '.join(KEEP_LAYERS)}, or names of sets with commas between them"
            raise ParameterError(f"layers = {self.layers}: {error} ({expected})") from None

    @property
    def weighs_sizes(self) -> bool:
        """True if the target that the parameters name may have sizes, which `size_weight` weighs."""
        return self.target not in (AUTO, *WITHOUT_SIZES)

    @property
    def ignored_parameters(self) -> str:
        ignored = not self.weighs_sizes and self.size_weight != SIZE_WEIGHT
        return f"size_weight has no effect with target = {self.target}, which has no sizes." if ignored else ""

    def with_target(self, mesh: Mesh, layers: Layers, quality: ElementQuality | None = None) -> Mesh:
        kept = layers if self.keeps_layers else Layers()
        return mesh.with_element_target(run_target(mesh, self.target, kept, self.size_weight, quality))


#: Greatest exponent of the objective: higher powers of eta overflow.
MAX_P = 32


@dataclass(frozen=True)
class ObjectiveSmoother(TargetedSmoother):
    """Method that lowers (3.3)."""

    optimises = True

    p: float = parameter(
        2.0, low=1, high=MAX_P, help="Exponent of the objective (3.3): the higher, the more the worst hexes count."
    )
    offset: float = parameter(
        1.0,
        low=0,
        high=1,
        help="Subtracted from a hex's mean η before the power: 1 as in (B.20), 0 as in chapter 4.",
        advanced=True,
    )

    @property
    def norm(self) -> ObjectiveNorm:
        """p and offset of the objective that it minimises."""
        return ObjectiveNorm(self.p, self.offset)


@dataclass(frozen=True)
class Optimiser(ObjectiveSmoother):
    """Method that untangles by a barrier softened by delta, with a line search along its directions."""

    delta: float = parameter(
        0.01,
        low=0,
        high=10,
        unit="mean edge length³",
        help="Regularisation of the barrier (3.2) while any hex is inverted; then zero. Large values move the optimum.",
    )
    delta_unit: str = parameter(
        "edge",
        choices=("edge", "mesh"),
        help="Unit of length for delta: the mean edge length of the mesh, or the unit of its points (Table 4.3).",
        advanced=True,
    )
    initial_step: float = parameter(
        1.0, low=1e-6, high=1e6, help="First trial step α of the line search (A.5).", advanced=True
    )
    backtrack_factor: float = parameter(
        0.7, low=0.01, high=0.99, help="Factor λ by which a rejected step is shortened (A.5).", advanced=True
    )
    c1: float = parameter(
        1e-4, low=0, high=0.5, help="Fraction c₁ of the slope required of a step (Armijo, A.5).", advanced=True
    )
    max_backtracks: int = parameter(
        100, low=1, high=500, help="Backtracks after which a step is given up.", advanced=True
    )

    surface_weight: float = parameter(
        0.0,
        low=0,
        high=1e6,
        help="Weight of the shape of a sliding boundary's quads in the objective, relative to a hex (5.2.1).",
        advanced=True,
    )

    @property
    def ignored_parameters(self) -> str:
        ignored = self.surface_weight > 0 and not self.slides
        own = f"surface_weight has no effect with boundary = {self.boundary}." if ignored else ""
        return " ".join(filter(None, [super().ignored_parameters, own]))

    def surface_quads(self, sliding: SlidingBoundary | None) -> SurfaceQuads | None:
        """The boundary's quads as a term of the objective; None where they do not count."""
        if sliding is None or not self.slides or self.surface_weight == 0:
            return None
        return SurfaceQuads(sliding, self.norm, self.surface_weight)

    @property
    def line_search(self) -> LineSearch:
        """The line search with the method's parameters."""
        return LineSearch(self.initial_step, self.backtrack_factor, self.c1, self.max_backtracks)
