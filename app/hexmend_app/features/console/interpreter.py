"""Interpreter of the console, which runs each command in a thread so that it can be interrupted.

qtconsole's in-process kernel runs code in the GUI thread: an endless loop freezes the window and cannot be stopped.
Here `interrupt` raises KeyboardInterrupt in the thread of the command at the next line of Python.
"""

from __future__ import annotations

import ast
import ctypes
import io
import linecache
import sys
import threading
import time
import traceback
from codeop import compile_command
from collections import deque
from contextlib import redirect_stderr, redirect_stdout
from typing import Any

#: Largest number of characters of output to be shown; beyond it, a command waits before it prints more.
_MAX_PENDING = 200_000


class Interpreter:
    """Executes commands in one namespace, one at a time.

    Attributes
    ----------
    namespace : dict
        Global names of the commands.
    """

    def __init__(self) -> None:
        self.namespace: dict[str, Any] = {"__name__": "__console__"}
        self._output: deque[tuple[str, bool]] = deque()
        self._pending = 0
        self._lock = threading.Lock()  # an interrupt reaches no thread whose command has ended
        self._thread: int | None = None
        self._count = 0

    def execute(self, source: str) -> None:
        """Execute source code and print the values of its expressions, in the thread of the caller.

        `output` returns printed text; exceptions of any kind are raised.
        """
        self._count += 1
        name = f"<console {self._count}>"
        linecache.cache[name] = len(source), None, source.splitlines(keepends=True), name
        streams = _Stream(self, False, sys.stdout), _Stream(self, True, sys.stderr)
        with redirect_stdout(streams[0]), redirect_stderr(streams[1]):
            with self._lock:
                self._thread = threading.get_ident()
            try:
                for statement in ast.parse(source, name).body:
                    exec(compile(ast.Interactive([statement]), name, "single"), self.namespace)
            finally:
                with self._lock:
                    self._thread = None

    def interrupt(self) -> None:
        """Raise KeyboardInterrupt in the running command, if any."""
        with self._lock:
            if self._thread is not None:
                thread = ctypes.c_ulong(self._thread)
                ctypes.pythonapi.PyThreadState_SetAsyncExc(thread, ctypes.py_object(KeyboardInterrupt))

    @property
    def thread(self) -> int | None:
        """Identifier of the thread of the running command; None if no command runs."""
        return self._thread

    def write(self, text: str, error: bool) -> None:
        """Add to the output; waits if a command prints faster than the output is read."""
        while self._pending > _MAX_PENDING:
            time.sleep(0.01)
        self._output.append((text, error))
        self._pending += len(text)

    def output(self) -> list[tuple[str, bool]]:
        """Return the pieces of text since the last call, as (text, is_error)."""
        pieces = []
        while self._output:
            pieces.append(self._output.popleft())
        self._pending = 0
        return pieces

    def completions(self, text: str) -> list[str]:
        """Return the names that begin with a text, such as `mesh.qu`, sorted."""
        from rlcompleter import Completer  # loads readline

        completer, names = Completer(self.namespace), list[str]()
        while (name := completer.complete(text, len(names))) is not None:
            names.append(name)
        return sorted({name.rstrip("(): ") for name in names})


class _Stream(io.TextIOBase):
    """Stream that sends text of the interpreter's thread to its output, and of other threads to `other`."""

    def __init__(self, interpreter: Interpreter, error: bool, other: Any):
        self._interpreter, self._error, self._other = interpreter, error, other

    def write(self, text: str) -> int:
        if threading.get_ident() == self._interpreter.thread:
            self._interpreter.write(text, self._error)
            return len(text)
        return 0 if self._other is None else self._other.write(text)

    def flush(self) -> None:
        if self._other is not None:
            self._other.flush()


def error_text(error: BaseException) -> str:
    """Return the traceback of an exception, without the frames of the window."""
    if isinstance(error, KeyboardInterrupt):
        return "KeyboardInterrupt\n"
    frames = error.__traceback__
    while frames is not None and not frames.tb_frame.f_code.co_filename.startswith("<console"):
        frames = frames.tb_next
    return "".join(traceback.format_exception(type(error), error, frames))


def is_complete(source: str) -> bool:
    """Return True if Enter runs the source code, False if it begins a new line.

    >>> is_complete("1 + 1"), is_complete("for i in range(3):"), is_complete("for i in range(3):\\n    print(i)\\n")
    (True, False, True)
    """
    try:
        if compile_command(source, symbol="exec") is None:
            return False
    except (SyntaxError, ValueError, OverflowError):
        return True  # run it to show the error
    last = source.split("\n")[-1]
    return "\n" not in source or not last.strip() or not last[0].isspace()
