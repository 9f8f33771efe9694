"""Functions that no signal may leave by an exception, because what they began would stay half done."""

from __future__ import annotations

TYPE_CHECKING = False  # `typing` would cost as much as `hexmend --version` does
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import CodeType, FrameType
    from typing import Any, TypeVar

    Function = TypeVar("Function", bound=Callable)

#: Their code, by which a signal's handler finds them among the frames that it has interrupted.
UNINTERRUPTED_CODE: set[CodeType] = set()

#: Called after each of them, in order to raise what has waited.
ON_RETURN: list[Callable[[], object]] = []


def uninterrupted(function: Function) -> Function:
    """Let `KeyboardInterrupt` wait for the end of a function in the program `hexmend`.

    Parameters
    ----------
    function : callable
        A function of Python that does not take long.

    Returns
    -------
    callable
        The function; the exception is raised when it returns.
    """
    UNINTERRUPTED_CODE.add(function.__code__)

    def guarded(*args: Any, **options: Any) -> Any:
        answer = function(*args, **options)
        for call in ON_RETURN:
            call()
        return answer

    for name in ("__module__", "__name__", "__qualname__", "__doc__"):  # `functools` would have to be loaded
        setattr(guarded, name, getattr(function, name))
    guarded.__wrapped__ = function
    return guarded


def is_interruptible(frame: FrameType | None) -> bool:
    """Return True if an exception that is raised in this frame reaches the frames below it.

    Parameters
    ----------
    frame : frame or None
        Where a signal has come. In an import and in a function that is `uninterrupted` the exception would be lost.
    """
    while frame is not None:
        code = frame.f_code
        if code in UNINTERRUPTED_CODE or code.co_filename.startswith("<frozen importlib"):
            return False
        frame = frame.f_back
    return True
