"""Filters of hexes: each reason to hide one is evaluated only when it changes."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import reduce

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.picture.appearance import ValueRange
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

    def suit(self, mesh: Mesh) -> bool:
        """Return True if the filters apply to a mesh: it has the same hexes."""
        return same_hexes(mesh, self._mesh)

    def kept(self, frame: Frame) -> np.ndarray | None:
        """Return the hexes that are shown whole or in part, (m,) bool; None for all.

        A cut by whole elements is made where the nodes are as a plane comes, so that none flickers as they move; or it
        is as the look says.
        """
        look, points, figures = frame.look, frame.mesh.points, frame.figures
        clip, chosen, topology = look.clip, look.quality_range, self._mesh.topology
        crinkled = clip is not None and clip.crinkle
        left = look.left if look.left is not None and look.left.clip == clip else None
        parts = (
            self._part(
                "clip",
                (clip, left) if crinkled else None,
                lambda: self.uncut(points, clip) if left is None else left.mask(self._mesh.n_hexes),
            ),
            self._part("peel", look.peel or None, lambda: topology.layers >= look.peel),
            self._part(
                "isolation",
                look.isolation,
                lambda: topology.hexes_around(look.isolation.hexes, 0),
            ),
            self._part("dug", look.dug or None, lambda: _all_but(look.dug, self._mesh.n_hexes)),
            self._part("quality", chosen and (chosen, figures), lambda: self._within(chosen, points, figures)),
        )
        masks = [mask for mask in parts if mask is not None]
        return reduce(np.logical_and, masks) if masks else None

    def uncut(self, points: np.ndarray, clip: Clip) -> np.ndarray:
        """Return the hexes that a cut by whole hexes leaves at present positions, (m,) bool."""
        normals, offsets = zip(*(plane.equation for plane in clip.planes), strict=True)
        return plane_sides.centres_kept(points, self._mesh.hexes, np.array(normals), np.array(offsets), clip.notch)

    def cut_left(self, frame: Frame) -> CutLeft | None:
        """The hexes that the cut by whole hexes has left, if a cut at present positions would differ; else None."""
        clip = frame.look.clip
        if clip is None or not clip.crinkle:
            return None
        self.kept(frame)
        left = self._known["clip"][1]
        return None if np.array_equal(left, self.uncut(frame.mesh.points, clip)) else CutLeft.of(clip, left)

    def copied(self) -> Filters:
        """Return a copy for a view that may get another look."""
        copy = Filters(self._mesh)
        copy._known = dict(self._known)
        return copy

    def ghosts(self, frame: Frame) -> np.ndarray | None:
        """Return the rings of hexes around the isolated ones, (m,) bool; None for none.

        They are none of those that are kept, whatever else is hidden; what is cut or dug away is no ghost either.
        """
        around = frame.look.isolation
        if around is None or not around.rings:
            self._known.pop("ghosts", None)
            return None
        topology = self._mesh.topology
        near = self._part("ghosts", around, lambda: topology.hexes_around(around.hexes, around.rings))
        isolated, others = (
            self._known["isolation"][1],
            [self._known[name][1] for name in ("clip", "dug") if name in self._known],
        )
        clip = frame.look.clip
        if clip is not None and not clip.crinkle:
            others.append(cut.left(frame.mesh.points, frame.mesh.hexes, clip))
        return reduce(np.logical_and, [near, ~isolated, *others])

    def left(self, frame: Frame) -> np.ndarray | None:
        """Return the hexes that remain visible after a smooth cut, (m,) bool; None for all."""
        keep, clip, mesh = self.kept(frame), frame.look.clip, frame.mesh
        if clip is None or clip.crinkle:
            return keep
        left = cut.left(mesh.points, mesh.hexes, clip)
        return left if keep is None else left & keep

    def _within(self, chosen: ValueRange, points: np.ndarray, figures: ElementQuality) -> np.ndarray:
        return within(metric_values(chosen.metric, points, self._mesh.hexes, figures), figures.inverted, chosen)

    def _part(self, name: str, reason: Hashable | None, find: Callable[[], np.ndarray]) -> np.ndarray | None:
        if reason is None:
            self._known.pop(name, None)
            return None
        if name not in self._known or self._known[name][0] != reason:
            self._known[name] = reason, find()
        return self._known[name][1]


def _all_but(dug: frozenset[int], m: int) -> np.ndarray:
    answer = np.ones(m, dtype=bool)
    answer[list(dug)] = False
    return answer


def same_mask(one: np.ndarray | None, other: np.ndarray | None) -> bool:
    """Return True if two masks select the same hexes."""
    return one is other or (one is not None and other is not None and np.array_equal(one, other))
