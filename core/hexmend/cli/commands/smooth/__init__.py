"""`hexmend smooth`: smooth or untangle a mesh from file to file."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.iteration import Result
    from hexmend.mesh.mesh import Mesh


class Smooth:
    """One method, or a recipe of several, on one mesh."""

    name = "smooth"
    help = "Smooth or untangle a mesh and write the result. Ctrl-C ends the run; what was reached is written."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        from hexmend.cli.arguments.files import add_mesh
        from hexmend.cli.arguments.memory_check import add_force
        from hexmend.cli.arguments.method import add_method, add_surface

        add_mesh(parser)
        parser.add_argument("-o", "--output", metavar="OUT", required=True, help="where to write the smoothed mesh")
        add_method(parser)
        add_surface(parser)
        parser.add_argument(
            "--fix", metavar="SET", action="append", default=[], help="keep the nodes of this set; may be repeated"
        )
        parser.add_argument("--only", metavar="SET", help="move nothing but the hexes of this set, or 'inverted' ones")
        parser.add_argument(
            "--rings", metavar="K", type=int, default=1, help="with --only: and K rings of hexes around"
        )
        add_force(parser)
        parser.add_argument("--save-recipe", metavar="FILE.toml", help="write what is run as a recipe")
        parser.add_argument("--json", metavar="FILE", help="write a report")
        parser.add_argument("--history", metavar="FILE.csv", help="write a row an iteration")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.cli.arguments.files import check_targets, say_diagnosis, say_left_out, say_notes
        from hexmend.cli.arguments.memory_check import check_memory
        from hexmend.cli.arguments.method import chosen, on_surface
        from hexmend.cli.output.progress import follow
        from hexmend.cli.process.interrupts import FinishesWriting
        from hexmend.io import read, writer_for
        from hexmend.mesh.fixing import with_region_free, with_sets_fixed
        from hexmend.quality.selection import hexes_in_set
        from hexmend.run import iterate
        from hexmend.run.recipe_files import write_recipe

        what, stop = chosen(args)
        write = writer_for(args.output)  # what cannot be written is said before the work, not after
        check_targets(args.mesh, args.output, args.json, args.history, args.save_recipe)
        mesh = read(args.mesh, as_is=args.as_is)
        say_notes(mesh)
        say_diagnosis(args.mesh, mesh)
        say_left_out(args.output, mesh)
        pins = mesh.pinned  # what the file says; options are for this run alone
        if args.fix:
            mesh = with_sets_fixed(mesh, *args.fix)
        if args.only:
            mesh = with_region_free(mesh, hexes_in_set(mesh, args.only), max(args.rings, 0))
        check_memory(args, [what], mesh, *([] if args.only else ["smooth a part of it (--only)"]))
        run = iterate(on_surface(args, mesh, what), what, stop)
        if args.save_recipe:
            write_recipe(args.save_recipe, run.recipe)
        with FinishesWriting():
            follow(run)
            result = run.result()
            write(args.output, result.mesh.replace(pinned=pins))
            _report(args, mesh, what.title, result)
        return 4 if result.after.inverted else 0


def _report(args: argparse.Namespace, mesh: Mesh, title: str, result: Result) -> None:
    """Write the reports that are asked for, and print what has become of the mesh."""
    from hexmend.advice import advise
    from hexmend.cli.commands.smooth.suggested_command import command_of
    from hexmend.cli.output.text_tables import print_summaries
    from hexmend.quality import summarise_second_order
    from hexmend.report import record, write_history, write_json

    curved = {"before": summarise_second_order(mesh), "after": summarise_second_order(result.mesh)}
    if args.json:
        report = record(result)
        for when, one in curved.items():
            if one is not None:
                report[when]["second_order"] = one.to_dict()
        write_json(args.json, report)
    if args.history:
        write_history(args.history, result)
    advice = advise(result) if result.after.inverted else None
    print_summaries(f"{args.mesh}: {title}", ["before", "after"], [result.before, result.after])
    print(result.message)
    for when, one in curved.items():
        if one is not None:
            print(f"Second order, {when}: {one.words}.")
    if result.surface is not None:
        print(result.surface.words)
    print(f"Written to {args.output}.")
    if advice is not None:
        print(advice.left)
        for one in advice.suggestions:
            print(f"To try next: {one.text}")
            if line := command_of(one, args.mesh, args.output):
                print(f"      {line}")


command = Smooth()
