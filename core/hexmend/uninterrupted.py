"""Functions that no signal may leave by an exception, because a library below them would not stand it."""

from __future__ import annotations

TYPE_CHECKING = False  # `typing` would cost as much as `hexmend --version` does
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import CodeType
    from typing import TypeVar

    Function = TypeVar("Function", bound=Callable)

#: Their code, by which a signal's handler finds them among the frames that it has interrupted.
UNINTERRUPTED: set[CodeType] = set()


def uninterrupted(function: Function) -> Function:
    """Mark a function: `KeyboardInterrupt` waits for its end in the program `hexmend`.

    Parameters
    ----------
    function : callable
        A function of Python that does not take long.

    Returns
    -------
    callable
        The same function.
    """
    UNINTERRUPTED.add(function.__code__)
    return function
