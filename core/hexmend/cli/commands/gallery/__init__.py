"""The command `hexmend gallery`: generated meshes."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_repeated
from hexmend.cli.command import CoreCommand

_HELP = "Generate a mesh of the gallery; without a name, list the gallery."


def _arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("mesh", metavar="NAME", nargs="?", help="bridge-sharp, five-side, ...")
    parser.add_argument("--size", metavar="N", help="approximate number of hexes")
    add_repeated(parser, "--set", "KEY=VALUE", "a parameter of the mesh")
    parser.add_argument("-o", "--output", metavar="MESH", help="the mesh file to write")


command = CoreCommand("gallery", _HELP, _arguments, f"{__name__}.generated_mesh")
