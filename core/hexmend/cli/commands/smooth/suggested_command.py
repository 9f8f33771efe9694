"""Shell commands of runs: of a suggestion, and of a method with its values, limits and rules of motion."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from hexmend.advice import Suggestion
from hexmend.cli.arguments.options import DEFAULT_RINGS
from hexmend.mesh.rules import MotionRules
from hexmend.parameters import Parametrised, declared
from hexmend.run.recipe import Stage
from hexmend.smoothers import DEFAULT_METHOD

#: Rings that a larger part has in addition to twice those of the last run.
_MORE_RINGS = 2


@dataclass(frozen=True)
class RunOptions:
    """Options of the run that ended, which a suggested one keeps.

    Parameters
    ----------
    rules : MotionRules
        Rules of motion.
    as_is : bool
        Keep the orientation of the file.
    surface : str, optional
        File of the surface on which the boundary slides; for methods that let it slide.
    only : str, optional
        Set of hexes to which the run is limited.
    rings : int
        Rings of hexes around them.
    """

    rules: MotionRules = field(default_factory=MotionRules)
    as_is: bool = False
    surface: str | None = None
    only: str | None = None
    rings: int = DEFAULT_RINGS


def suggested_command(suggestion: Suggestion, source: str, output: str, options: RunOptions | None = None) -> str:
    """Write a suggestion as a line for the shell; values at their defaults are left out.

    Parameters
    ----------
    suggestion : Suggestion
    source, output : str
        The file that the run began with, and the file that it wrote. The suggested run begins with `output`, or with
        `source` if the run is to be undone.
    options : RunOptions, optional

    Returns
    -------
    str
        Empty if nodes are to be unpinned first, for which there is no option.
    """
    if suggestion.unpin.size:
        return ""
    options = options or RunOptions()
    rings = _MORE_RINGS + 2 * options.rings if suggestion.widen else options.rings
    rules = options.rules if suggestion.rules is None else suggestion.rules
    begin, stage = source if suggestion.undo else output, Stage(suggestion.smoother, suggestion.stop)
    return smooth_command(stage, begin, "OUT", replace(options, rings=rings, rules=rules))


def smooth_command(stage: Stage, source: str, output: str, options: RunOptions | None = None) -> str:
    """Write a run as a line for the shell; values at their defaults are left out.

    Parameters
    ----------
    stage : Stage
    source, output : str
        Files to read and to write.
    options : RunOptions, optional

    Examples
    --------
    >>> from hexmend.smoothers import METHODS
    >>> rules = MotionRules(interfaces="slide", periodic=(("left", "right"),))
    >>> smooth_command(Stage(METHODS["getme"]()), "in.msh", "out.msh", RunOptions(rules))
    'hexmend smooth in.msh -o out.msh --method getme --interfaces slide --periodic left right'
    """
    options, smoother = options or RunOptions(), stage.smoother
    words = ["hexmend", "smooth", source, "-o", output]
    words += ["--as-is"] * options.as_is
    if smoother.name != DEFAULT_METHOD:
        words += _option("method", smoother.name)
    for key, value in _changed(smoother).items():
        words += _option(key, value) if key in ("boundary", "target", "layers") else ["--set", f"{key}={value}"]
    for key, value in _changed(stage.stop).items():
        words += [f"--{key.replace('_', '-')}"] if value is True else _option(key, value)
    if options.surface and smoother.slides:
        words += _option("surface", options.surface)
    if options.only:
        words += _option("only", options.only)
        words += _option("rings", options.rings) if options.rings != DEFAULT_RINGS else []
    return shlex.join([*words, *_rules(options.rules)])


def _option(key: str, value: object) -> list[str]:
    """Return the words of an option; a value that begins with a hyphen is joined to its name."""
    name, text = f"--{key.replace('_', '-')}", str(value)
    return [f"{name}={text}"] if text.startswith("-") else [name, text]


def _rules(rules: MotionRules) -> Iterator[str]:
    """Yield the words of the options of rules of motion."""
    for key, value in rules.values().items():
        for names in [value] if isinstance(value, str) else value:
            yield from _option(key, names) if isinstance(names, str) else (f"--{key}", *names)


def _changed(values: Parametrised) -> dict[str, object]:
    return {one.name: value for one in declared(values) if (value := getattr(values, one.name)) != one.default}
