"""Functions that a signal must not interrupt by an exception, because they would leave work half done."""

from __future__ import annotations

from functools import wraps

TYPE_CHECKING = False  # `typing` would cost as much as `hexmend --version` does
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import CodeType, FrameType
    from typing import ParamSpec, TypeVar

    P = ParamSpec("P")
    T = TypeVar("T")

#: Code of these functions, by which a signal handler recognises them among the frames that it has interrupted.
UNINTERRUPTED_CODE: set[CodeType] = set()

#: Called after each of these functions, to raise an exception that has been deferred.
ON_RETURN: list[Callable[[], object]] = []


def uninterrupted(function: Callable[P, T]) -> Callable[P, T]:
    """Defer `KeyboardInterrupt` to the end of a function, in the program `hexmend`; a decorator.

    Parameters
    ----------
    function : callable
        Python function that takes little time.

    Returns
    -------
    callable
        Function with the same result; a deferred exception is raised when it returns.
    """
    UNINTERRUPTED_CODE.add(function.__code__)

    @wraps(function)
    def guarded(*args: P.args, **options: P.kwargs) -> T:
        result = function(*args, **options)
        for call in ON_RETURN:
            call()
        return result

    return guarded


def is_interruptible(frame: FrameType | None) -> bool:
    """Return True if an exception raised in a frame leaves no work half done: not in uninterrupted functions.

    Parameters
    ----------
    frame : frame or None
        Frame that a signal has interrupted.
    """
    while frame is not None:
        if frame.f_code in UNINTERRUPTED_CODE:
            return False
        frame = frame.f_back
    return True
