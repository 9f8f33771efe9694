"""Proxies of GUI objects for other threads: every access happens in the GUI thread."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

#: Modules whose objects are used in the GUI thread only.
_GUI_MODULES = ("hexmend_app.canvas", "hexmend_app.scene", "vtkmodules.vtkRendering")


class GuiCaller(QObject):
    """Calls functions in the GUI thread from other threads, and waits for their results."""

    _requested = Signal(object)

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._owner = threading.get_ident()
        self._closed = False
        self._requested.connect(self._perform, Qt.ConnectionType.QueuedConnection)

    def call(self, function: Callable[[], Any]) -> Any:
        """Call a function in the GUI thread; return its result or raise its exception."""
        if threading.get_ident() == self._owner:
            return function()
        if self._closed:
            raise RuntimeError("the window is closed")
        call = _Call(function)
        self._requested.emit(call)
        try:
            while not call.over.wait(0.1):  # KeyboardInterrupt is raised between two waits
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
        """Raise `RuntimeError` in threads that wait for a call."""
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
        except BaseException as error:  # raised in the calling thread
            self.error = error
        finally:
            self.over.set()


class GuiProxy:
    """Proxy of a GUI object; GUI objects that it returns are proxies too.

    Parameters
    ----------
    target : callable
        Returns the object; called in the GUI thread at each access.
    caller : GuiCaller
    """

    __slots__ = ("_GuiProxy__caller", "_GuiProxy__target")

    def __init__(self, target: Callable[[], Any], caller: GuiCaller):
        object.__setattr__(self, "_GuiProxy__target", target)
        object.__setattr__(self, "_GuiProxy__caller", caller)

    def __access(self, operation: Callable[[Any], Any]) -> Any:
        target, caller = self.__target, self.__caller
        return caller.call(lambda: _wrapped(operation(target()), caller))

    def __getattr__(self, name: str) -> Any:
        return self.__access(lambda target: getattr(target, name))

    def __setattr__(self, name: str, value: Any) -> None:
        self.__access(lambda target: setattr(target, name, unwrapped(value)))

    def __call__(self, *values: Any, **options: Any) -> Any:
        def call(target: Any) -> Any:
            return target(*map(unwrapped, values), **{name: unwrapped(value) for name, value in options.items()})

        return self.__access(call)

    def __getitem__(self, key: Any) -> Any:
        return self.__access(lambda target: target[unwrapped(key)])

    def __iter__(self) -> Any:
        caller = self.__caller
        return iter(self.__access(lambda target: [_wrapped(value, caller) for value in target]))

    def __len__(self) -> int:
        return self.__access(len)

    def __eq__(self, other: object) -> bool:
        return self.__access(lambda target: target == unwrapped(other))

    def __hash__(self) -> int:
        return self.__access(hash)

    def __dir__(self) -> list[str]:
        return self.__access(dir)

    def __repr__(self) -> str:
        return self.__access(repr)


def unwrapped(value: Any) -> Any:
    """Return the object of a proxy; other values unchanged."""
    return value._GuiProxy__target() if isinstance(value, GuiProxy) else value


def _wrapped(value: Any, caller: GuiCaller) -> Any:
    owner = getattr(value, "__self__", None) if callable(value) else None
    if _is_gui_object(value) or (owner is not None and _is_gui_object(owner)):
        return GuiProxy(lambda: value, caller)
    return value


def _is_gui_object(value: Any) -> bool:
    return isinstance(value, QObject) or type(value).__module__.startswith(_GUI_MODULES)
