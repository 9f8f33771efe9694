"""The command `hexmend gallery`: generated meshes."""

from __future__ import annotations

import argparse

from hexmend.cli.command import action


class Gallery:
    """Generate a mesh, or list those that there are."""

    name = "gallery"
    help = "Make one of the gallery's meshes; without a name, list them."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("mesh", metavar="NAME", nargs="?", help="bridge-sharp, five-side, ...")
        parser.add_argument("--size", metavar="N", help="about how many hexes")
        parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="another parameter")
        parser.add_argument("-o", "--output", metavar="MESH", help="where to write it")

    def run(self, args: argparse.Namespace) -> int:
        return action("hexmend.cli.commands.gallery.generated_mesh")(args)


command = Gallery()
