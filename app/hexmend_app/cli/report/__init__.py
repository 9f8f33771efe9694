"""The command `hexmend report`: one page on meshes and the results of methods, to archive, send and print."""

from __future__ import annotations

import argparse

from hexmend_app.cli.picture_command import PictureCommand

_HELP = "Write a report on meshes before and after smoothing, with all measurements: one HTML page, or PDF."


def _arguments(parser: argparse.ArgumentParser) -> None:
    from hexmend_app.cli import run_options

    parser.add_argument("mesh", metavar="MESH", nargs="+", help="the mesh files")
    parser.add_argument("-o", "--output", metavar="FILE", required=True, help="the report: .html or .pdf")
    parser.add_argument("--title", metavar="TEXT", help="title of the page")
    run_options.add_arguments(parser)


command = PictureCommand("report", _HELP, _arguments, f"{__name__}.document")
