"""Which elements are shown: several reasons to hide one, each worked out anew only when it changes."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import reduce

import numpy as np

from hexmend.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.scene import sides
from hexmend_app.state.clip import Clip
from hexmend_app.state.look import Look


class Filters:
    """The elements of one mesh that a look leaves.

    Parameters
    ----------
    mesh : Mesh
    """

    def __init__(self, mesh: Mesh):
        self._mesh = mesh
        self._known: dict[str, tuple[Hashable, np.ndarray | None]] = {}

    def kept(self, look: Look, points: np.ndarray, figures: ElementQuality) -> np.ndarray | None:
        """The hexes that are shown whole or in part, (m,) bool; None for all.

        A cut by whole elements is made where the nodes are as a plane comes, so that none flickers as they move.

        Parameters
        ----------
        look : Look
        points : (n, 3) float64
        figures : ElementQuality
            Of the mesh at these points.
        """
        clip, chosen, topology = look.clip, look.quality_range, self._mesh.topology
        parts = (
            self._part(
                "clip",
                clip if clip is not None and clip.crinkle else None,
                lambda: _uncut(points, self._mesh.hexes, clip),
            ),
            self._part("peel", look.peel or None, lambda: topology.layers >= look.peel),
            self._part(
                "isolation",
                look.isolation,
                lambda: topology.ring_of(look.isolation.hexes, look.isolation.rings),
            ),
            self._part("dug", look.dug or None, lambda: _all_but(look.dug, self._mesh.n_hexes)),
            self._part("quality", chosen and (chosen, figures), lambda: _within(figures.q, *chosen)),
        )
        masks = [mask for mask in parts if mask is not None]
        return reduce(np.logical_and, masks) if masks else None

    def _part(self, name: str, reason: Hashable | None, find: Callable[[], np.ndarray]) -> np.ndarray | None:
        if reason is None:
            self._known.pop(name, None)
            return None
        if name not in self._known or self._known[name][0] != reason:
            self._known[name] = reason, find()
        return self._known[name][1]


def _uncut(points: np.ndarray, hexes: np.ndarray, clip: Clip) -> np.ndarray:
    normals, offsets = zip(*(plane.equation for plane in clip.planes), strict=True)
    return sides.centres_kept(points, hexes, np.array(normals), np.array(offsets), clip.notch)


def _all_but(dug: frozenset[int], m: int) -> np.ndarray:
    answer = np.ones(m, dtype=bool)
    answer[list(dug)] = False
    return answer


def _within(q: np.ndarray, low: float, high: float) -> np.ndarray:
    # The best hex has q = 1 but for rounding.
    return (q >= low) & ((q <= high) | (high >= 1))
