"""The options of commands that draw, which cut the mesh open."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from hexmend_app.cli.numbers import direction, numbers, wrong

if TYPE_CHECKING:
    from hexmend_app.state.scene import Box, Cut, Plane

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


def cut_of(args: argparse.Namespace) -> Cut | None:
    """The cut that the options ask for; None where they ask for none."""
    from dataclasses import replace

    from hexmend_app.state.scene import Cut, CutStyle

    style = CutStyle.SMOOTH if args.smooth else CutStyle.CRINKLE
    if args.clip_box:
        return Cut(box=box(args.clip_box), style=style, notch=args.notch)
    if not args.clip:
        return None
    planes = tuple(map(plane, args.clip))
    if args.flip:
        turned = ((tuple(-c for c in one.normal), 1 - one.position) for one in planes)
        planes = tuple(replace(one, normal=n, position=p) for one, (n, p) in zip(planes, turned, strict=True))
    return Cut(planes, style=style, notch=args.notch)


def plane(text: str) -> Plane:
    """The plane that `--clip` names: an axis or a normal, and how far through the mesh it stands."""
    from hexmend_app.state.scene import Plane

    axis, _, position = text.partition(":")
    normal = _AXES.get(axis.lower()) or direction(axis, "--clip")
    (share,) = numbers(position, 1, "--clip") if position else (0.5,)
    if not 0 <= share <= 1:
        raise wrong("--clip", text, "a position from 0 to 1, as in x:0.5")
    return Plane(normal, share)


def box(text: str) -> Box:
    """The box that `--clip-box` names."""
    from hexmend_app.state.scene import Box

    shares = numbers(text, 6, "--clip-box")
    low, high = shares[::2], shares[1::2]
    if min(shares) < 0 or max(shares) > 1 or any(a > b for a, b in zip(low, high, strict=True)):
        raise wrong("--clip-box", text, "for each axis two positions from 0 to 1, the lower first")
    return Box(low, high, shares=True)
