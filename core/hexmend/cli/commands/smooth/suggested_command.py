"""The shell command of a suggestion."""

from __future__ import annotations

import shlex

from hexmend.advice import Suggestion
from hexmend.parameters import Parametrised, declared
from hexmend.smoothers import DEFAULT_METHOD


def suggested_command(suggestion: Suggestion, source: str, output: str) -> str:
    """Write a suggestion as a line for the shell; values at their defaults are left out.

    Parameters
    ----------
    suggestion : Suggestion
    source, output : str
        The file that the run began with, and the file that it wrote. The suggested run begins with `output`, or with
        `source` if the run is to be undone.

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
    return shlex.join(words)


def _changed(values: Parametrised) -> dict[str, object]:
    return {one.name: value for one in declared(values) if (value := getattr(values, one.name)) != one.default}
