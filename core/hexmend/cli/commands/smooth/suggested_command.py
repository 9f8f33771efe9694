"""The command that does what a suggestion says."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.advice import Suggestion
    from hexmend.parameters import Parametrised


def command_of(suggestion: Suggestion, given: str, made: str) -> str:
    """What a shell takes to run what is suggested; values that are the defaults are left out.

    Parameters
    ----------
    suggestion : Suggestion
    given, made : str
        The file that the run began from, and that which it wrote: the method goes on from this one unless the run is
        to be taken back.

    Returns
    -------
    str
        Empty where nodes are to be unpinned first: no option does that.
    """
    from hexmend.smoothers import DEFAULT_METHOD

    if suggestion.unpin.size:
        return ""
    smoother = suggestion.smoother
    words = ["hexmend", "smooth", given if suggestion.undo else made, "-o", "OUT"]
    if smoother.name != DEFAULT_METHOD:
        words += ["--method", smoother.name]
    for key, value in _changed(smoother).items():
        words += ["--boundary", value] if key == "boundary" else ["--set", f"{key}={value}"]
    for key, value in _changed(suggestion.stop).items():
        words += [f"--{key.replace('_', '-')}", *([] if value is True else [str(value)])]
    return shlex.join(words)


def _changed(values: Parametrised) -> dict[str, object]:
    from hexmend.parameters import declared

    return {one.name: value for one in declared(values) if (value := getattr(values, one.name)) != one.default}
