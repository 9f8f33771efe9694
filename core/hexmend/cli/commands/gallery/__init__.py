"""The command `hexmend gallery`: generated meshes."""

from __future__ import annotations

import argparse

from hexmend.cli.command import action


class Gallery:
    """Generate a mesh, or list those that there are."""

    name = "gallery"
    help = "Generate a mesh of the gallery; without a name, list the gallery."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("mesh", metavar="NAME", nargs="?", help="bridge-sharp, five-side, ...")
        parser.add_argument("--size", metavar="N", help="approximate number of hexes")
        parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="a parameter of the mesh")
        parser.add_argument("-o", "--output", metavar="MESH", help="the mesh file to write")

    def run(self, args: argparse.Namespace) -> int:
        return action("hexmend.cli.commands.gallery.generated_mesh")(args)


command = Gallery()
