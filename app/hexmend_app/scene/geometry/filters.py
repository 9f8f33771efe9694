"""Filters of hexes; each filter is evaluated only when it changes."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import reduce

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.cut_planes import Clip, CutLeft
from hexmend_app.scene.colour.value_range import within
from hexmend_app.scene.cutting import cut
from hexmend_app.scene.geometry import plane_sides
from hexmend_app.scene.views.frame import Frame, same_hexes
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

    def matches(self, mesh: Mesh) -> bool:
        """Return True if the filters apply to a mesh, which is the case if it has the same hexes."""
        return same_hexes(mesh, self._mesh)

    def kept(self, frame: Frame) -> np.ndarray | None:
        """Return True for hexes shown whole or in part, (m,) bool; None for all.

        A cut by whole hexes is evaluated when its planes change, not when nodes move, so that hexes do not flicker; a
        result stored in the look takes precedence.
        """
        look, points, figures = frame.look, frame.mesh.points, frame.figures
        clip, quality_range, topology = look.clip, look.quality_range, self._mesh.topology
        crinkled = clip is not None and clip.crinkle
        left = look.left if look.left is not None and look.left.clip == clip else None
        filters = (
            self._mask(
                "clip",
                (clip, left) if crinkled else None,
                lambda: self.hexes_kept_by_cut(points, clip) if left is None else left.mask(self._mesh.n_hexes),
            ),
            self._mask("peel", look.peel or None, lambda: topology.layers >= look.peel),
            self._mask("isolation", look.isolation, lambda: topology.hexes_around(look.isolation.hexes, 0)),
            self._mask("dug", look.dug or None, lambda: _all_but(look.dug, self._mesh.n_hexes)),
            self._mask(
                "quality",
                quality_range and (quality_range, figures),
                lambda: within(
                    metric_values(quality_range.metric, frame.mesh, figures),
                    figures.inverted,
                    quality_range,
                ),
            ),
        )
        masks = [mask for mask in filters if mask is not None]
        return reduce(np.logical_and, masks) if masks else None

    def hexes_kept_by_cut(self, points: np.ndarray, clip: Clip) -> np.ndarray:
        """Return True for hexes that a cut by whole hexes leaves at the given positions, (m,) bool."""
        normals, offsets = zip(*(plane.equation for plane in clip.planes), strict=True)
        return plane_sides.centres_kept(points, self._mesh.hexes, np.array(normals), np.array(offsets), clip.notch)

    def cut_left(self, frame: Frame) -> CutLeft | None:
        """Return the result of the cut by whole hexes if a cut at current positions would differ; else None."""
        clip = frame.look.clip
        if clip is None or not clip.crinkle:
            return None
        self.kept(frame)
        left = self._known["clip"][1]
        return None if np.array_equal(left, self.hexes_kept_by_cut(frame.mesh.points, clip)) else CutLeft.of(clip, left)

    def copied(self) -> Filters:
        """Return a copy for a view with another look."""
        copy = Filters(self._mesh)
        copy._known = dict(self._known)
        return copy

    def ghosts(self, frame: Frame) -> np.ndarray | None:
        """Return True for the rings of hexes around the isolated hexes, (m,) bool; None if there are none.

        Ghosts exclude the isolated hexes and hexes that are cut away or dug out.
        """
        around = frame.look.isolation
        if around is None or not around.rings:
            self._known.pop("ghosts", None)
            return None
        topology = self._mesh.topology
        near = self._mask("ghosts", around, lambda: topology.hexes_around(around.hexes, around.rings))
        masks = [near, ~self._known["isolation"][1]]
        masks += [self._known[name][1] for name in ("clip", "dug") if name in self._known]
        clip = frame.look.clip
        if clip is not None and not clip.crinkle:
            masks.append(cut.remaining_hexes(frame.mesh.points, frame.mesh.hexes, clip))
        return reduce(np.logical_and, masks)

    def remaining_after_cut(self, frame: Frame) -> np.ndarray | None:
        """Return True for shown hexes that a smooth cut leaves at least in part, (m,) bool; None for all."""
        keep, clip, mesh = self.kept(frame), frame.look.clip, frame.mesh
        if clip is None or clip.crinkle:
            return keep
        left = cut.remaining_hexes(mesh.points, mesh.hexes, clip)
        return left if keep is None else left & keep

    def _mask(self, name: str, key: Hashable | None, compute: Callable[[], np.ndarray]) -> np.ndarray | None:
        """Return the mask of a filter, computed again if its key has changed; None if the filter is off."""
        if key is None:
            self._known.pop(name, None)
            return None
        if name not in self._known or self._known[name][0] != key:
            self._known[name] = key, compute()
        return self._known[name][1]


def _all_but(dug: frozenset[int], m: int) -> np.ndarray:
    mask = np.ones(m, dtype=bool)
    mask[list(dug)] = False
    return mask


def same_mask(mask: np.ndarray | None, other: np.ndarray | None) -> bool:
    """Return True if two masks, (m,) bool or None for all, are equal."""
    return mask is other or (mask is not None and other is not None and np.array_equal(mask, other))
