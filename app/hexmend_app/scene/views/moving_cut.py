"""Cuts that move: faster drawings of them, until they rest."""

from __future__ import annotations

from dataclasses import replace

from hexmend_app.scene.cutting.moving_planes import MOST_PLANES
from hexmend_app.scene.views.frame import Frame

#: Number of hexes from which on a cut whose planes move is drawn coarsely.
COARSE_CUT_HEXES = 1_000_000

#: Number of hexes from which on a cut through curved hexes is drawn with flat faces while it moves.
CURVED_CUT_HEXES = 4_000


def is_moving_cut(last: Frame, frame: Frame) -> bool:
    """Return True if the looks of two frames differ in the cut alone."""
    return last.look.cut != frame.look.cut and replace(last.look, cut=frame.look.cut) == frame.look


def can_be_coarse(frame: Frame) -> bool:
    """Return True if planes alone cut a large mesh, so that the cut can be drawn coarsely."""
    cut, show = frame.look.cut, frame.look.show
    filtered = show.quality or show.peel or show.isolate or show.hidden or show.shrink
    return (
        frame.mesh.n_hexes >= COARSE_CUT_HEXES
        and 0 < len(cut.sides) <= MOST_PLANES
        and not (cut.notch or cut.hexes or filtered)
    )


def can_be_flat(frame: Frame) -> bool:
    """Return True if a cut takes noticeable time because many hexes are curved: up to ten times that of flat ones."""
    return frame.curved and frame.mesh.n_hexes >= CURVED_CUT_HEXES


def flattened(frame: Frame) -> Frame:
    """Return the frame with flat faces."""
    return replace(frame, look=replace(frame.look, structure=frame.look.structure.without("curved")))
