"""Filters of hexes; each filter is evaluated only when it changes."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import reduce

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.cut import Cut
from hexmend_app.scene.colour.value_range import within
from hexmend_app.scene.cutting.cut import remaining_hexes
from hexmend_app.scene.cutting.hex_depths import HexDepths
from hexmend_app.scene.geometry.frame import Frame, same_hexes
from hexmend_app.state.mesh.metric_cache import metric_values


class Filters:
    """Selects the hexes of one mesh that a look shows.

    Parameters
    ----------
    mesh : Mesh
    """

    def __init__(self, mesh: Mesh):
        self._mesh = mesh
        self._known: dict[str, tuple[Hashable, np.ndarray | None]] = {}
        self._depths = HexDepths(mesh)

    def matches(self, mesh: Mesh) -> bool:
        """Return True if the filters apply to a mesh, which is the case if it has the same hexes."""
        return same_hexes(mesh, self._mesh)

    def kept(self, frame: Frame) -> np.ndarray | None:
        """Return True for hexes shown whole or in part, (m,) bool; None for all.

        A cut by whole hexes is evaluated when its planes change, not when nodes move, so that hexes do not flicker; a
        result stored in the look takes precedence.
        """
        points, figures, topology, m = frame.mesh.points, frame.quality, self._mesh.topology, self._mesh.n_elements
        cut, show, quality = frame.look.cut, frame.look.show, frame.look.show.by_quality
        filters = (
            self._mask(
                "cut",
                cut if cut.crinkled else None,
                lambda: cut.listed(m) if cut.hexes else self.hexes_kept_by_cut(points, cut),
            ),
            self._mask("peel", show.peel or None, lambda: topology.layers >= show.peel),
            self._mask("isolate", show.isolate, lambda: topology.hexes_around(show.isolate.hexes, 0)),
            self._mask("hidden", show.hidden or None, lambda: _all_but(show.hidden, m)),
            self._mask(
                "quality",
                quality and (quality, figures),
                lambda: within(metric_values(quality.metric, frame.mesh, figures), figures.inverted, quality),
            ),
        )
        masks = [mask for mask in filters if mask is not None]
        return reduce(np.logical_and, masks) if masks else None

    def hexes_kept_by_cut(self, points: np.ndarray, cut: Cut) -> np.ndarray:
        """Return True for hexes that a cut by whole hexes leaves at the given positions, (m,) bool."""
        if cut.depth is not None:
            return self._depths.in_range(points, cut.depth) != cut.notch
        return ~cut.hidden(self._depths.centres(points))

    def cut_left(self, frame: Frame) -> np.ndarray | None:
        """Return True for the hexes that the cut by whole hexes has left, (m,) bool.

        None if a cut at current positions would leave the same hexes.
        """
        cut = frame.look.cut
        if not cut.crinkled:
            return None
        self.kept(frame)
        left = self._known["cut"][1]
        return None if np.array_equal(left, self.hexes_kept_by_cut(frame.mesh.points, cut)) else left

    def ghosts(self, frame: Frame) -> np.ndarray | None:
        """Return True for the rings of hexes around the isolated hexes, (m,) bool; None if there are none.

        Ghosts exclude the isolated hexes and hexes that are cut away or dug out.
        """
        around = frame.look.show.isolate
        if around is None or not around.rings:
            self._known.pop("ghosts", None)
            return None
        topology = self._mesh.topology
        near = self._mask("ghosts", around, lambda: topology.hexes_around(around.hexes, around.rings))
        masks = [near, ~self._known["isolate"][1]]
        masks += [self._known[name][1] for name in ("cut", "hidden") if name in self._known]
        cut = frame.look.cut
        if cut.smooth:
            masks.append(remaining_hexes(frame.mesh.points, frame.mesh.elements, cut))
        return reduce(np.logical_and, masks)

    def remaining_after_cut(self, frame: Frame) -> np.ndarray | None:
        """Return True for shown hexes that a smooth cut leaves at least in part, (m,) bool; None for all."""
        keep, cut, mesh = self.kept(frame), frame.look.cut, frame.mesh
        if not cut.smooth:
            return keep
        left = remaining_hexes(mesh.points, mesh.elements, cut)
        return left if keep is None else left & keep

    def _mask(self, name: str, key: Hashable | None, compute: Callable[[], np.ndarray]) -> np.ndarray | None:
        """Return the mask of a filter, computed again if its key has changed; None if the filter is off."""
        if key is None:
            self._known.pop(name, None)
            return None
        if name not in self._known or self._known[name][0] != key:
            self._known[name] = key, compute()
        return self._known[name][1]


def _all_but(hidden: frozenset[int], m: int) -> np.ndarray:
    mask = np.ones(m, dtype=bool)
    mask[np.fromiter(hidden, np.int64, len(hidden))] = False
    return mask


def same_mask(mask: np.ndarray | None, other: np.ndarray | None) -> bool:
    """Return True if two masks, (m,) bool or None for all, are equal."""
    return mask is other or (mask is not None and other is not None and np.array_equal(mask, other))
