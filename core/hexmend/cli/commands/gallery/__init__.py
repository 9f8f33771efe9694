"""`hexmend gallery`: make a mesh of the gallery."""

from __future__ import annotations

import argparse


class Gallery:
    """Generated meshes."""

    name = "gallery"
    help = "Make one of the gallery's meshes; without a name, list them."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("mesh", metavar="NAME", nargs="?", help="bridge-sharp, five-side, ...")
        parser.add_argument("--size", metavar="N", help="about how many hexes")
        parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="another parameter")
        parser.add_argument("-o", "--output", metavar="MESH", help="where to write it")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.cli.command import settings
        from hexmend.errors import ParameterError
        from hexmend.gallery import GALLERY
        from hexmend.io import write
        from hexmend.parameters import declared, from_strings

        if args.mesh is None:
            for name, kind in GALLERY.items():
                print(f"{name}: {kind.title} ({kind.source})\n    {kind.help}")
                for one in declared(kind):
                    print(f"      {one.name} = {one.default}  ({one.range})  {one.help}")
                print()
            return 0
        kind = GALLERY[args.mesh]
        words = settings(args.set) | ({"size": args.size} if args.size is not None else {})
        recipe = from_strings(kind, words, owner=args.mesh)
        if args.output is None:
            raise ParameterError("no output is named: expected -o MESH, as in -o five-side.vtu")
        mesh = recipe.build()
        write(args.output, mesh)
        print(f"{args.output}: {mesh.n_hexes:,} hexes, {mesh.n_nodes:,} nodes")
        return 0


command = Gallery()
