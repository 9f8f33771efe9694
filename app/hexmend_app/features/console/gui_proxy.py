"""Objects of the window as a thread may use them: every access happens in the window's thread."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

#: Modules whose objects are used in the window's thread alone.
_GUI_MODULES = ("hexmend_app.canvas", "hexmend_app.scene", "pyvista.plotting", "pyvistaqt", "vtkmodules.vtkRendering")


class GuiCaller(QObject):
    """Calls functions in the thread that it belongs to, and waits for what they return."""

    _asked = Signal(object)

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._owner = threading.get_ident()
        self._closed = False
        self._asked.connect(self._perform, Qt.ConnectionType.QueuedConnection)

    def call(self, function: Callable[[], Any]) -> Any:
        """Call a function in the window's thread; return or raise what it does."""
        if threading.get_ident() == self._owner:
            return function()
        if self._closed:
            raise RuntimeError("the window is closed")
        call = _Call(function)
        self._asked.emit(call)
        try:
            while not call.over.wait(0.1):  # an interruption comes between two waits
                if self._closed:
                    raise RuntimeError("the window is closed")
        finally:
            call.cancelled = True
        if call.error is not None:
            raise call.error
        return call.result

    def _perform(self, call: _Call) -> None:
        call.perform()

    def close(self) -> None:
        """Let threads that wait go on with an error."""
        self._closed = True


class _Call:
    def __init__(self, function: Callable[[], Any]):
        self.function = function
        self.over = threading.Event()
        self.cancelled = False
        self.result: Any = None
        self.error: BaseException | None = None

    def perform(self) -> None:
        if self.cancelled:
            return
        try:
            self.result = self.function()
        except BaseException as error:  # raised where it was called for
            self.error = error
        finally:
            self.over.set()


class GuiProxy:
    """An object of the window. What it returns is a proxy too where it belongs to the window.

    Parameters
    ----------
    target : callable
        Returns the object; called in the window's thread at each use.
    caller : GuiCaller
    """

    __slots__ = ("_GuiProxy__caller", "_GuiProxy__target")

    def __init__(self, target: Callable[[], Any], caller: GuiCaller):
        object.__setattr__(self, "_GuiProxy__target", target)
        object.__setattr__(self, "_GuiProxy__caller", caller)

    def __use(self, use: Callable[[Any], Any]) -> Any:
        target, caller = self.__target, self.__caller
        return caller.call(lambda: _wrapped(use(target()), caller))

    def __getattr__(self, name: str) -> Any:
        return self.__use(lambda target: getattr(target, name))

    def __setattr__(self, name: str, value: Any) -> None:
        self.__use(lambda target: setattr(target, name, unwrapped(value)))

    def __call__(self, *values: Any, **options: Any) -> Any:
        def use(target: Any) -> Any:
            return target(*map(unwrapped, values), **{name: unwrapped(value) for name, value in options.items()})

        return self.__use(use)

    def __getitem__(self, key: Any) -> Any:
        return self.__use(lambda target: target[unwrapped(key)])

    def __iter__(self) -> Any:
        caller = self.__caller
        return iter(self.__use(lambda target: [_wrapped(value, caller) for value in target]))

    def __len__(self) -> int:
        return self.__use(len)

    def __eq__(self, other: object) -> bool:
        return self.__use(lambda target: target == unwrapped(other))

    def __hash__(self) -> int:
        return self.__use(hash)

    def __dir__(self) -> list[str]:
        return self.__use(dir)

    def __repr__(self) -> str:
        return self.__use(repr)


def unwrapped(value: Any) -> Any:
    """Return the object behind a proxy, and anything else as it is."""
    return value._GuiProxy__target() if isinstance(value, GuiProxy) else value


def _wrapped(value: Any, caller: GuiCaller) -> Any:
    owner = getattr(value, "__self__", None) if callable(value) else None
    if _is_of_window(value) or (owner is not None and _is_of_window(owner)):
        return GuiProxy(lambda: value, caller)
    return value


def _is_of_window(value: Any) -> bool:
    return isinstance(value, QObject) or type(value).__module__.startswith(_GUI_MODULES)
