"""Options that cut the mesh, in a short notation for planes and boxes."""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import Any

from hexmend_app.cli.numbers import direction, invalid_value, numbers
from hexmend_app.picture import Box, CutStyle, Plane

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}

#: Keys of the table `cut` that have these options.
KEYS = frozenset({"planes", "box", "style"})


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options to a parser."""
    shape = parser.add_mutually_exclusive_group()
    shape.add_argument(
        "--clip",
        metavar="PLANE",
        action="append",
        help="x, y, z or nx,ny,nz, and :position from 0 to 1 through the mesh (x:0.5); repeat for more planes",
    )
    shape.add_argument(
        "--clip-box",
        metavar="X0,X1,Y0,Y1,Z0,Z1",
        help="show the inside of a box, from 0 to 1 through the mesh along each axis",
    )
    parser.add_argument("--flip", action="store_true", help="hide the other side of each plane")
    style = parser.add_mutually_exclusive_group()
    style.add_argument("--crinkle", action="store_true", help="show hexes whole (the default)")
    style.add_argument("--smooth", action="store_true", help="cut through the hexes")


def cut_keys(args: argparse.Namespace) -> dict[str, Any]:
    """Return the keys of the table `cut` that the options set."""
    keys: dict[str, Any] = {}
    if args.crinkle or args.smooth:
        keys["style"] = CutStyle.SMOOTH if args.smooth else CutStyle.CRINKLE
    if args.clip_box:
        keys["box"] = parse_box(args.clip_box)
    elif args.clip:
        planes = tuple(map(parse_plane, args.clip))
        keys["planes"] = tuple(map(_flipped, planes)) if args.flip else planes
    return keys


def _flipped(plane: Plane) -> Plane:
    return replace(plane, normal=tuple(-c for c in plane.normal), position=1 - plane.position)


def parse_plane(text: str) -> Plane:
    """Parse the value of `--clip`: an axis or a normal, and a position from 0 to 1 through the mesh."""
    axis, _, position = text.partition(":")
    normal = _AXES.get(axis.lower()) or direction(axis, "--clip")
    (share,) = numbers(position, 1, "--clip") if position else (0.5,)
    if not 0 <= share <= 1:
        raise invalid_value("--clip", text, "a position from 0 to 1, as in x:0.5")
    return Plane(normal, share)


def parse_box(text: str) -> Box:
    """Parse the value of `--clip-box`: for each axis two positions from 0 to 1 through the mesh."""
    shares = numbers(text, 6, "--clip-box")
    low, high = shares[::2], shares[1::2]
    if min(shares) < 0 or max(shares) > 1 or any(a > b for a, b in zip(low, high, strict=True)):
        raise invalid_value("--clip-box", text, "for each axis two positions from 0 to 1, the lower first")
    return Box(low, high, shares=True)
