"""Shapes of hexes in a run: targets of its stages, layers before and after, and what is said of them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from hexmend.iteration import Iteration
from hexmend.layers import LayerReport, Layers, describe_losses, find_layers, grading_message, layer_report
from hexmend.mesh.element_target import Target
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, measure_against_target
from hexmend.smoothers import Smoother
from hexmend.target import recovered_lengths


class ShapeWatch:
    """Layers of the mesh of a run, from which targets of stages are made and with which its result is compared.

    Parameters
    ----------
    mesh : Mesh
        As given to the run.
    quality : ElementQuality
        Of its hexes.

    """

    def __init__(self, mesh: Mesh, quality: ElementQuality):
        self._mesh, self._quality = mesh, quality
        self._layers: dict[str, Layers] = {}  # by the treatment of layers that names their walls

    @cached_property
    def _found(self) -> Layers:
        return find_layers(self._mesh, self._quality)

    def layers_of(self, smoother: Smoother) -> Layers:
        """Return the layers of the mesh as given that count for a stage: on walls that it names, or those found."""
        key = getattr(smoother, "layers", "")
        if key not in self._layers:
            self._layers[key] = smoother.layers_of(self._mesh, self._found, self._quality)
        return self._layers[key]

    def with_target(self, smoother: Smoother) -> Mesh:
        """Return the mesh as given with the target of a stage, whatever earlier stages have done."""
        return smoother.with_target(self._mesh, self.layers_of(smoother), self._quality)

    def reports(self, smoother: Smoother, points: np.ndarray) -> tuple[LayerReport, ...]:
        """Compare the layers of the mesh as given and with the points (n, 3) that a method has reached."""
        layers = self.layers_of(smoother)
        if not layers:
            return ()
        after, kept = self._mesh.with_points(points), smoother.keeps_layers
        return layer_report(layers, self._mesh, after, self._given_lengths, kept)

    def target_q(self, target: Target | None, start: Iteration, best: Iteration) -> tuple[float, float] | None:
        """Least q of target of the hexes at two iterations; None without a target."""
        if target is None:
            return None
        mesh = self._mesh.with_element_target(target)
        before, after = (measure_against_target(mesh, one.points, one.quality).q for one in (start, best))
        return float(before.min()), float(after.min())

    def layers_message(self, smoothers: Sequence[Smoother]) -> str:
        """The layers that were found and whether the methods of a run keep them, as a sentence; "" without layers."""
        layers = self.layers_of(smoothers[0])
        keep = [smoother.keeps_layers for smoother in smoothers]
        kept = "kept" if all(keep) else "kept in some stages only" if any(keep) else "not kept"
        return f"Boundary layers at {layers.names} are {kept}." if layers else ""

    def message(self, smoother: Smoother, walls: tuple[LayerReport, ...], result: Mesh | None) -> str:
        """Tell what has become of layers, or of the lengths of hexes in a mesh without layers; "" for nothing.

        Parameters
        ----------
        smoother : Smoother
            Of the last stage.
        walls : tuple of LayerReport
            Of `reports`.
        result : Mesh or None
            With the target of the last stage; None while the run goes on: lengths are not compared then.
        """
        losses = describe_losses(walls)
        if losses or (smoother.keeps_layers and walls):
            return losses or self.layers_message([smoother])
        if result is None or result.element_target is not None:
            return ""
        return grading_message(self._mesh, result, self._quality)

    @cached_property
    def _given_lengths(self) -> np.ndarray:
        """Lengths of the hexes as given, recovered where the mesh is noisy, (m, 3)."""
        return recovered_lengths(self._mesh, self._quality)
