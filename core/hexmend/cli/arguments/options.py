"""Declarations of the options that several commands share; quick to import.

The parser of a command's words, which reports a mistake in one line with the nearest name.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from hexmend.errors import ParameterError
from hexmend.parameters import suggestion

#: Rings of hexes around those of --only that are smoothed too.
DEFAULT_RINGS = 1


def add_mesh(parser: argparse.ArgumentParser) -> None:
    """Declare the mesh file, and the option that keeps its orientation."""
    parser.add_argument("mesh", metavar="MESH", help="the mesh file")
    text = "do not renumber hexes that are numbered left-handed; runs refuse them"
    parser.add_argument("--as-is", action="store_true", help=text)


def add_method(parser: argparse.ArgumentParser) -> None:
    """Declare the options of one run: a method with its parameters, or a recipe, and the limits."""
    parser.add_argument("--method", metavar="NAME", help="see `hexmend methods`")
    add_repeated(parser, "--set", "KEY=VALUE", "a parameter of the method")
    _add_parameters(parser)
    text = "run the methods of this recipe, a FILE.toml or a name such as gentle; limits hold for each of them"
    parser.add_argument("--recipe", metavar="RECIPE", help=text)
    _add_limits(parser)


def add_settings(parser: argparse.ArgumentParser) -> None:
    """Declare the options that hold for several methods: parameters, boundary, limits, memory."""
    text = "a parameter of the one method, or of every method that has it"
    add_repeated(parser, "--set", "[METHOD.]KEY=VALUE", text)
    _add_parameters(parser)
    _add_limits(parser)
    add_force(parser)


def add_repeated(parser: argparse.ArgumentParser, option: str, metavar: str, text: str) -> None:
    """Declare an option that may be given several times; its value is the list of all words."""
    parser.add_argument(option, metavar=metavar, action="append", default=[], help=text)


def add_surface(parser: argparse.ArgumentParser) -> None:
    """Declare the options for the surface on which the boundary slides, and for the distance it may leave it by."""
    text = "let the boundary slide on this surface: STL, OBJ, PLY, VTP or VTK; implies --boundary slide"
    parser.add_argument("--surface", metavar="FILE", help=text)
    text = "largest distance of the boundary from the surface, in mean edge lengths or such as 0.5%% of the "
    text += "diagonal, or auto (default) or unlimited"
    parser.add_argument("--surface-tolerance", metavar="X", help=text)


def add_motion(parser: argparse.ArgumentParser) -> None:
    """Declare the options for interfaces between materials and for the nodes of named sets."""
    text = "nodes between materials: keep them like the boundary (default), let them slide, or let them move freely"
    parser.add_argument("--interfaces", choices=("keep", "slide", "free"), help=text)
    add_repeated(parser, "--fix", "SET", "fix the nodes of this set")
    add_repeated(parser, "--slide", "SET", "let the nodes of this set slide even if the boundary is fixed")
    add_repeated(parser, "--free", "SET", "release the nodes of this set that are pinned or on an interface")
    add_repeated(parser, "--plane", "SET", "let the nodes of this flat set move in its plane")
    text = "move the nodes of two sets as one, such as opposite sides of a cell"
    parser.add_argument("--periodic", nargs=2, metavar=("SET", "OTHER"), action="append", default=[], help=text)


def add_curves(parser: argparse.ArgumentParser) -> None:
    """Declare the option for curves that are marked by hand."""
    text = "mark edges of the boundary as curves, which sliding keeps: a chain of node numbers from 0 in each line"
    parser.add_argument("--ridges", metavar="FILE", help=text)


def add_rewrite(parser: argparse.ArgumentParser) -> None:
    """Declare the option that writes a file anew where coordinates could be replaced in a copy of the given one."""
    text = "rewrite the whole file; by default, in the format of MESH, only coordinates change"
    parser.add_argument("--rewrite", action="store_true", help=text)


def add_force(parser: argparse.ArgumentParser) -> None:
    """Declare the option that runs a method in spite of a shortage of memory."""
    parser.add_argument("--force", action="store_true", help="run even if memory is probably insufficient")


def parse_settings(words: list[str]) -> dict[str, str]:
    """Parse the `key=value` words of --set.

    Raises
    ------
    ParameterError
        For a word without an equals sign.

    Examples
    --------
    >>> parse_settings(["p=4", "delta=0.1"])
    {'p': '4', 'delta': '0.1'}
    """
    for word in words:
        if "=" not in word:
            raise ParameterError(f"--set {word!r} is incomplete: expected key=value, as in --set p=4")
    return dict(word.split("=", 1) for word in words)


def _add_parameters(parser: argparse.ArgumentParser) -> None:
    """Declare the short forms of `--set boundary=...` and of the goal, the target and the layers."""
    text = "keep the nodes of the boundary fixed (default) or let them slide on the surface"
    parser.add_argument("--boundary", choices=("fixed", "slide"), help=text)
    text = "the best shape that lowers no key figure (default), the optimum of shape, the highest minimum scaled "
    text += "Jacobian, or the longest explicit time step"
    parser.add_argument("--goal", choices=("balanced", "shape", "scaled-jacobian", "time-step"), help=text)
    text = "target of the hexes: cubes, the given shape, size or both, or lengths from data or a formula in x, y, z "
    text += "(default: ideal, or given-shape with layers)"
    parser.add_argument("--target", metavar="ideal|given-shape|given-size|given|FIELD", help=text)
    text = "keep the heights of boundary layers (default unless --target is given), leave them free, or keep those on "
    text += "the walls given by sets"
    parser.add_argument("--layers", metavar="keep|free|SET[,SET]", help=text)


def _add_limits(parser: argparse.ArgumentParser) -> None:
    """Declare an option for each field of `StoppingCriteria`, such as --max-iterations."""
    from hexmend.iteration.stopping import StoppingCriteria  # loads NumPy, which `hexmend --help` does without
    from hexmend.parameters import declared

    for limit in declared(StoppingCriteria):
        option = f"--{limit.name.replace('_', '-')}"
        if limit.type is bool:
            parser.add_argument(option, action="store_const", const="true", help=limit.help)
        elif limit.choices is not None:
            parser.add_argument(option, choices=limit.choices, help=f"{limit.help} Default {limit.default}.")
        else:
            default = limit.default if limit.automatic else f"{limit.default:g}"
            unit = f" in {limit.unit}" if limit.unit else ""
            parser.add_argument(option, metavar="X", help=f"{limit.help} Default {default}{unit}.")


_MISSING = "the following arguments are required: "


class Parser(argparse.ArgumentParser):
    """Parser of a command: every mistake is one line on standard error, and the exit status is 2.

    Parameters
    ----------
    name, text : str
        Name of the command, and what it does.
    """

    def __init__(self, name: str, text: str):
        super().__init__(prog=f"hexmend {name}", description=text, allow_abbrev=False)
        self._words: Sequence[str] = ()

    def parse(self, words: Sequence[str]) -> argparse.Namespace:
        """Return the values of the arguments; `SystemExit` after the help or the report of a mistake."""
        self._words = words
        known, unknown = self.parse_known_args(words)
        if unknown:
            self.error(self._unknown(unknown[0]))
        for action in self._actions:
            value = getattr(known, action.dest, None)
            if value != action.default and (value == "" or (isinstance(value, list) and "" in value)):
                self.error(f"{_name(action)} is empty: expected a value")
        return known

    def error(self, message: str) -> NoReturn:
        """Report a mistake, and end the program."""
        if message.startswith(_MISSING):  # an option that is misspelt may be the one that is missing
            options = [word for word in self._words if word.startswith("--")]
            misspelt = [word for word in options if word.partition("=")[0] not in self._option_string_actions]
            message = self._unknown(misspelt[0]) if misspelt else message
        end = "" if message.endswith("?") else "."
        print(f"{self.prog}: {message}{end} {self.prog} --help lists the options.", file=sys.stderr)
        sys.exit(2)

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is None or value in action.choices:
            return
        known = [str(one) for one in action.choices]
        self.error(f"{_name(action)} {value} is unknown: {suggestion(str(value), known)}expected {' or '.join(known)}")

    def _unknown(self, word: str) -> str:
        """Return the sentence for a word that is neither an option nor the place of an argument."""
        if not word.startswith("-"):
            return f"{word!r} is one word too many"
        option = word.partition("=")[0]
        hint = suggestion(option, self._option_string_actions).rstrip()
        return f"there is no option {option}" + (f": {hint}" if hint else "")


def _name(one: argparse.Action) -> str:
    """Return the name of an option, or of an argument in upper case."""
    return one.option_strings[-1] if one.option_strings else one.dest.upper()
