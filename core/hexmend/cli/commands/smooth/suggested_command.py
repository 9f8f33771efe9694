"""The shell command of a suggestion."""

from __future__ import annotations

import shlex
from collections.abc import Iterator

from hexmend.advice import Suggestion
from hexmend.mesh.rules import MotionRules
from hexmend.parameters import Parametrised, declared
from hexmend.smoothers import DEFAULT_METHOD


def suggested_command(suggestion: Suggestion, source: str, output: str, rules: MotionRules | None = None) -> str:
    """Write a suggestion as a line for the shell; values at their defaults are left out.

    Parameters
    ----------
    suggestion : Suggestion
    source, output : str
        The file that the run began with, and the file that it wrote. The suggested run begins with `output`, or with
        `source` if the run is to be undone.
    rules : MotionRules, optional
        Rules of motion of the run, which the suggested one keeps.

    Returns
    -------
    str
        Empty if nodes are to be unpinned first, for which there is no option.
    """
    if suggestion.unpin.size:
        return ""
    smoother = suggestion.smoother
    words = ["hexmend", "smooth", source if suggestion.undo else output, "-o", "OUT"]
    if smoother.name != DEFAULT_METHOD:
        words += ["--method", smoother.name]
    for key, value in _changed(smoother).items():
        words += [f"--{key}", value] if key in ("boundary", "target", "layers") else ["--set", f"{key}={value}"]
    for key, value in _changed(suggestion.stop).items():
        words += [f"--{key.replace('_', '-')}", *([] if value is True else [str(value)])]
    return shlex.join([*words, *_options(rules or MotionRules())])


def _options(rules: MotionRules) -> Iterator[str]:
    """Yield the words of the options of rules of motion."""
    for key, value in rules.values().items():
        for names in [value] if isinstance(value, str) else value:
            yield from (f"--{key}", *([names] if isinstance(names, str) else names))


def _changed(values: Parametrised) -> dict[str, object]:
    return {one.name: value for one in declared(values) if (value := getattr(values, one.name)) != one.default}
