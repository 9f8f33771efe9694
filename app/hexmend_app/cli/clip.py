"""The options of `hexmend render` that cut the mesh open."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from hexmend_app.cli.numbers import direction, numbers, wrong

if TYPE_CHECKING:
    from hexmend.mesh import Mesh
    from hexmend_app.state.clip import BoxClip, Clip, ClipPlane

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--clip",
        metavar="PLANE",
        action="append",
        help="x, y, z or nx,ny,nz, and :position from 0 to 1 through the mesh (x:0.5); again for another plane",
    )
    where.add_argument(
        "--clip-box",
        metavar="X0,X1,Y0,Y1,Z0,Z1",
        help="show the inside of a box, from 0 to 1 through the mesh along each axis",
    )
    parser.add_argument("--flip", action="store_true", help="hide the other side of each plane")
    parser.add_argument(
        "--notch", action="store_true", help="hide only what lies beyond all planes; of a box, its inside"
    )
    cut = parser.add_mutually_exclusive_group()
    cut.add_argument("--crinkle", action="store_true", help="show hexes whole (the default)")
    cut.add_argument("--smooth", action="store_true", help="cut through the hexes")


def clip_of(args: argparse.Namespace, mesh: Mesh) -> Clip | None:
    """The cut that the options ask for; None for none."""
    from hexmend_app.state.clip import PlaneClip

    if args.clip_box:
        return box(args.clip_box, mesh, crinkle=not args.smooth, notch=args.notch)
    if not args.clip:
        return None
    planes = (plane(text, mesh) for text in args.clip)
    return PlaneClip(tuple(one.flipped() if args.flip else one for one in planes), not args.smooth, args.notch)


def plane(text: str, mesh: Mesh) -> ClipPlane:
    """The plane that `--clip` names: an axis or a normal, and how far through the mesh it stands."""
    from hexmend_app.state.clip import ClipPlane

    axis, _, position = text.partition(":")
    normal = _AXES.get(axis.lower()) or direction(axis, "--clip")
    (share,) = numbers(position, 1, "--clip") if position else (0.5,)
    if not 0 <= share <= 1:
        raise wrong("--clip", text, "a position from 0 to 1, as in x:0.5")
    along = mesh.points[mesh.topology.used] @ normal
    place = along.min() + share * (along.max() - along.min())
    return ClipPlane(normal, tuple(c * place / sum(n * n for n in normal) for c in normal))


def box(text: str, mesh: Mesh, *, crinkle: bool, notch: bool) -> BoxClip:
    """The box that `--clip-box` names."""
    import numpy as np

    from hexmend_app.state.clip import BoxClip

    shares = np.array(numbers(text, 6, "--clip-box")).reshape(3, 2)
    if shares.min() < 0 or shares.max() > 1 or (shares[:, 0] > shares[:, 1]).any():
        raise wrong("--clip-box", text, "for each axis two positions from 0 to 1, the lower first")
    points = mesh.points[mesh.topology.used]
    low, high = points.min(axis=0), points.max(axis=0)
    return BoxClip(*(tuple(low + (high - low) * share) for share in shares.T), crinkle, notch)
