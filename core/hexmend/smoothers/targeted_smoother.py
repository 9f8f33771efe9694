"""Base of methods whose hexes have a target: the lengths that each is to have, and the layers that are kept."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.errors import MeshError, ParameterError
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
