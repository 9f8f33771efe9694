"""The mesh that `hexmend gallery` generates, and the list of all of them."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import parse_settings
from hexmend.cli.output.text_tables import print_parameters
from hexmend.errors import ParameterError
from hexmend.gallery import GALLERY
from hexmend.io import write
from hexmend.mesh.solid_cells import count_cells
from hexmend.parameters import from_strings
from hexmend.terminal_text import count_phrase


def run(args: argparse.Namespace) -> int:
    """Generate the mesh and write it; without a name, print the list."""
    if args.mesh is None:
        for name, generator in GALLERY.items():
            print_parameters(name, generator)
        return 0
    generator = GALLERY[args.mesh]
    words = parse_settings(args.set) | ({"size": args.size} if args.size is not None else {})
    recipe = from_strings(generator, words, owner=args.mesh)
    if args.output is None:
        raise ParameterError("no output file is given: expected -o MESH, as in -o five-side.vtu")
    mesh = recipe.build()
    write(args.output, mesh)
    print(f"{args.output}: {count_cells(mesh.elements)}, {count_phrase(mesh.n_nodes, 'node')}")
    return 0
