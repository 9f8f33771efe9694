"""The command `hexmend pad`: a layer of hexes under the boundary."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_mesh
from hexmend.cli.command import CoreCommand

_HELP = (
    "Insert a layer of hexes under the boundary, so that inverted hexes can be repaired without moving the boundary."
)


def _arguments(parser: argparse.ArgumentParser) -> None:
    add_mesh(parser)
    parser.add_argument("-o", "--output", metavar="OUT", required=True, help="the padded mesh to write")
    text = "a layer only under the faces of this set: boundary sides, quads or nodes, or all faces of a set of hexes"
    parser.add_argument("--set", dest="set_name", metavar="NAME", help=text)
    text = "a layer only around the hexes that fixed nodes keep inverted, or around all inverted ones"
    parser.add_argument("--around", choices=("locked", "inverted"), help=text)
    text = "rings of hexes that the layer encloses with --around (default: 1)"
    parser.add_argument("--rings", type=int, default=1, metavar="N", help=text)
    text = "thickness of the layer in the unit of the mesh (default: by the lengths of the edges behind it)"
    parser.add_argument("--thickness", type=float, metavar="X", help=text)
    parser.add_argument("--no-mend", action="store_true", help="write the mesh as it is before it is mended")
    parser.add_argument("--json", metavar="FILE", help="write counts, quality before and after, and the run as JSON")


command = CoreCommand("pad", _HELP, _arguments, f"{__name__}.mesh_padding")
