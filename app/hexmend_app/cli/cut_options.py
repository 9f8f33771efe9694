"""Options that cut the mesh, in a short notation for its planes or another shape."""

from __future__ import annotations

import argparse
from dataclasses import replace
from math import isfinite
from typing import Any

from hexmend_app.cli.numbers import direction, invalid_value, numbers
from hexmend_app.picture import Box, CutKind, CutStyle, Depth, DepthUnit, Plane, Slab, Sphere

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}

#: Keys of the table `cut` that have these options.
KEYS = frozenset({*CutKind, "style"})


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
    shape.add_argument(
        "--clip-slab",
        metavar="SLAB",
        help="show the inside of a slab: x, y, z or nx,ny,nz, then :position of its middle and :thickness, both from 0 "
        "to 1 through the mesh (x:0.5:0.1)",
    )
    shape.add_argument(
        "--clip-sphere",
        metavar="X,Y,Z,R",
        help="show the inside of a sphere: its centre, from 0 to 1 through the mesh along each axis, and its radius as "
        "a fraction of the diagonal",
    )
    shape.add_argument(
        "--clip-depth",
        metavar="RANGE",
        help="show the hexes with a depth in a range: FROM:TO in layers of hexes below the boundary (1:2), or in mean "
        "edge lengths (0.5:3e)",
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
    elif args.clip_slab:
        keys["slab"] = parse_slab(args.clip_slab)
    elif args.clip_sphere:
        keys["sphere"] = parse_sphere(args.clip_sphere)
    elif args.clip_depth:
        keys["depth"] = parse_depth(args.clip_depth)
    elif args.clip:
        planes = tuple(map(parse_plane, args.clip))
        keys["planes"] = tuple(map(_flipped, planes)) if args.flip else planes
    return keys


def cuts(args: argparse.Namespace) -> bool:
    """Return True if the options cut the mesh."""
    return bool(args.clip or args.clip_box or args.clip_slab or args.clip_sphere or args.clip_depth)


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


def parse_slab(text: str) -> Slab:
    """Parse the value of `--clip-slab`: an axis or a normal, a position and a thickness, from 0 to 1."""
    axis, *shares = text.split(":")
    expected = "an axis, a position and a thickness from 0 to 1, as in x:0.5:0.1"
    if len(shares) != 2:
        raise invalid_value("--clip-slab", text, expected)
    normal = _AXES.get(axis.lower()) or direction(axis, "--clip-slab")
    position, thickness = (numbers(share, 1, "--clip-slab")[0] for share in shares)
    if not (0 <= position <= 1 and 0 <= thickness <= 1):
        raise invalid_value("--clip-slab", text, expected)
    return Slab(normal, position, thickness=thickness)


def parse_sphere(text: str) -> Sphere:
    """Parse the value of `--clip-sphere`: a centre from 0 to 1 through the mesh, and a radius."""
    *centre, radius = numbers(text, 4, "--clip-sphere")
    if not (min(centre) >= 0 and max(centre) <= 1 and radius >= 0):
        raise invalid_value("--clip-sphere", text, "three positions from 0 to 1 and a radius, as in 0.5,0.5,0.5,0.2")
    return Sphere(tuple(centre), radius, shares=True)


def parse_depth(text: str) -> Depth:
    """Parse the value of `--clip-depth`: two depths in layers, or with an e after them in mean edge lengths."""
    unit = DepthUnit.EDGES if text.endswith("e") else DepthUnit.LAYERS
    try:
        ends = [float(end) for end in text.removesuffix("e").split(":")]
    except ValueError:
        ends = []
    if len(ends) not in (1, 2) or not all(map(isfinite, ends)) or not 0 <= ends[0] <= ends[-1]:
        raise invalid_value("--clip-depth", text, "two depths, the lower first, as in 1:2 or 0.5:3e")
    return Depth(ends[0], ends[-1], unit)
