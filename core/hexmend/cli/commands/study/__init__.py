"""`hexmend study`: the thesis's experiments, done again; or methods on many meshes, as a recipe says."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.study.thesis.experiment_result import ExperimentResult

_OF_THE_THESIS = ("--quick", "--max-seconds", "--only", "--force")
_OF_A_RECIPE = ("--jobs", "--scheduler", "--again", "--write-meshes")


class StudyCommand:
    """Chapter 4, and what 5.2 hopes for, on the gallery's meshes; or any methods on any meshes."""

    name = "study"
    help = "Run methods and lists of their values on many meshes, as a recipe says; or the thesis's experiments again."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        from hexmend.cli.arguments.memory_check import add_force

        parser.add_argument(
            "study",
            metavar="RECIPE.toml|thesis",
            help="the recipe of a study of meshes; thesis: the tables of Chapter 4 and outlooks of 5.2",
        )
        parser.add_argument("meshes", metavar="MESH", nargs="*", help="recipe: the meshes")
        parser.add_argument(
            "-o", "--output", metavar="DIR", help="folder of the report (recipe: its name if not given)"
        )
        parser.add_argument(
            "--quick",
            action="store_true",
            help="thesis: small meshes and a few seconds a run: minutes in place of hours",
        )
        parser.add_argument(
            "--max-seconds",
            metavar="S",
            help="thesis: most seconds of a run, in place of 4 hours, or of 5 s and for local-sd 60 s with --quick",
        )
        parser.add_argument(
            "--only",
            metavar="TABLE",
            action="append",
            default=[],
            help="thesis: one of the tables, as 4.1, or of the sections, as 5.2.5; may be repeated",
        )
        add_force(parser)
        parser.add_argument("--jobs", metavar="N", type=int, help="recipe: tasks at a time (default: as many as cores)")
        parser.add_argument(
            "--scheduler",
            metavar="ADDRESS",
            help="recipe: do tasks on the workers of this Dask scheduler, as tcp://host:8786",
        )
        parser.add_argument("--again", action="store_true", help="recipe: do again what is done")
        parser.add_argument(
            "--write-meshes", action="store_true", help="recipe: write the meshes that result into DIR/meshes"
        )

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.errors import ParameterError

        others = _OF_A_RECIPE if args.study == "thesis" else _OF_THE_THESIS
        for option in others:
            if getattr(args, option.strip("-").replace("-", "_")):
                of = "a recipe's study" if args.study == "thesis" else "the thesis's"
                raise ParameterError(f"{option} is an option of {of}: leave it out")
        if args.study != "thesis":
            if not args.study.endswith(".toml"):
                raise ParameterError(
                    f"{args.study!r} is no study: expected a recipe, as RECIPE.toml MESH..., or the word thesis"
                )
            from hexmend.cli.commands.study.batch_study import study_meshes

            return study_meshes(args)
        if args.meshes:
            raise ParameterError(f"{args.meshes[0]!r}: the thesis's study makes its meshes itself: name none")
        if not args.output:
            raise ParameterError("the thesis's study needs a folder for its report: add  -o DIR")
        return self._thesis(args)

    def _thesis(self, args: argparse.Namespace) -> int:
        from hexmend.cli.arguments.memory_check import check_memory
        from hexmend.cli.output.progress import Progress
        from hexmend.cli.process.interrupts import FinishesWriting
        from hexmend.parameters import from_strings
        from hexmend.report import made_folder, write_experiment, write_outlook, write_study
        from hexmend.report.thesis import VERDICTS
        from hexmend.run import StoppingCriteria
        from hexmend.study.bench.sections import machine
        from hexmend.study.outlook.experiments import TrialResult
        from hexmend.study.thesis.experiments import load
        from hexmend.study.thesis.mesh_figures import draw_figures
        from hexmend.study.thesis.runner import chosen_tables, planned, run_experiments

        thesis = chosen_tables(load(), args.only) if args.only else load()
        if args.max_seconds is not None:
            limit = from_strings(StoppingCriteria, {"max_seconds": args.max_seconds}, owner="the run")
            thesis = thesis.limited(limit.max_seconds)
        for works, hexes in planned(thesis, args.quick):
            check_memory(args, works, hexes, "do fewer tables (--only)", "do it in small (--quick)")
        folder = made_folder(args.output)

        def done(one: ExperimentResult | TrialResult) -> None:
            if isinstance(one, TrialResult):
                said, paths = f"Section {one.outlook.section}, {one.outlook.mesh}", write_outlook(folder, one.record())
            else:
                said = f"Table {one.experiment.table}, {one.experiment.thesis_mesh}"
                paths = write_experiment(folder, one.record())
            print(f"{said}: {paths[1].name}", flush=True)

        with FinishesWriting():
            with Progress() as progress:
                study = run_experiments(thesis, quick=args.quick, watch=progress.show, done=done)
            figures, missing = draw_figures(folder, study.measured)
            record = {"machine": machine()} | study.record() | {"figures": figures, "missing": missing}
            write_study(folder, record)
            for claim in record["claims"]:
                print(f"\n{claim['claim']} ({claim['section']}) {VERDICTS[claim['reproduced']]} {claim['figures']}")
            if study.interrupted:
                print("Interrupted: the report holds what was done so far.", file=sys.stderr)
            if missing:
                print(missing, file=sys.stderr)
            print(f"\nWritten to {folder / 'study.md'}.")
        return progress.signals.status if study.interrupted else 0


command = StudyCommand()
