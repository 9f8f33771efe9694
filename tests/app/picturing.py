"""Description of the visible content of a window and of its session, to compare two windows."""

from __future__ import annotations

from collections import Counter
from dataclasses import is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, QSettings
from PySide6.QtWidgets import QApplication, QComboBox, QMainWindow, QScrollBar, QTabBar, QWidget

from hexmend_app.shell.window import Window
from tests.app.resetting import unseen

#: Properties of widgets and actions that reflect user input.
_PROPERTIES = (
    "enabled", "text", "plainText", "checked", "value", "minimum", "maximum", "currentIndex", "currentText", "toolTip",
    "title", "windowTitle", "accessibleDescription", "placeholderText", "rowCount", "count",
)  # fmt: skip
#: Classes of widgets whose size is compared; the layout within panels depends on when they were first shown.
_SIZED = ("Tabs", "Drawer", "Canvas", "RenderWidget")
_PLAIN = (bool, int, float, str, bytes, type(None), Enum, Path)


def everything(window: QWidget) -> Counter[str]:
    """Return a line for each visible widget, with each panel in front in turn, and for each value of the session."""
    lines: Counter[str] = Counter()
    _widgets(window, "", lines)
    for widget in QApplication.topLevelWidgets():
        if widget.isVisible() and not isinstance(widget, Window):  # there are two while they are compared
            lines[f"open: {type(widget).__name__} {widget.windowTitle()}"] += 1
    focus = QApplication.focusWidget()
    lines[f"focus: {type(focus).__name__} {focus.accessibleName() if focus else ''}"] += 1
    for id, action in window.window_actions.items():
        lines[f"action {id}: {action.isEnabled()} {action.isChecked()} {action.text()} {action.toolTip()}"] += 1
    for name, part in vars(window.session).items():
        if not name.startswith("_"):
            _state(part, f"session.{name}", lines)
    camera = window.canvas.viewport.camera
    for name in ("Position", "FocalPoint", "ViewUp", "ParallelProjection", "ViewAngle"):
        lines[f"camera {name}: {np.round(getattr(camera, f'Get{name}')(), 6).tolist()}"] += 1
    lines[f"look that is drawn: {window.canvas.viewport.frame.look}"] += 1
    lines[f"hexes that are drawn: {window.canvas.viewport.shown}"] += 1
    lines[f"settings: {sorted(QSettings().allKeys())}"] += 1
    layout = window.docks.state()
    lines[f"layout: {layout}"] += 1
    with unseen(window):  # only properties are read
        for panel in window.docks.ids():
            window.show_panel(panel)
            window.refresh()
            while window.session.boundary_classifier.busy:  # started when a panel is shown
                QApplication.processEvents()
            window.refresh()
            QApplication.processEvents()
            _widgets(window, panel, lines)
        window.docks.restore(layout)
    return lines


def _widgets(widget: QWidget, parent_path: str, lines: Counter[str]) -> None:
    if not widget.isVisible() or _is_of_docks(widget) or isinstance(widget, QScrollBar):
        return
    path = f"{parent_path}/{type(widget).__name__} {widget.accessibleName()}".rstrip()
    meta = widget.metaObject()
    known = {meta.property(k).name() for k in range(meta.propertyCount())}
    shown = [f"{name}={widget.property(name)}" for name in _PROPERTIES if name in known]
    if type(widget).__name__ in _SIZED:
        shown.append(f"size={widget.width()} × {widget.height()}")
    if isinstance(widget, QComboBox | QTabBar):
        texts = widget.itemText if isinstance(widget, QComboBox) else widget.tabText
        shown.append(f"items={[texts(k) for k in range(widget.count())]}")
    lines[f"{path}: {' '.join(shown)}"] += 1
    for child in widget.children():
        if isinstance(child, QWidget):
            _widgets(child, path, lines)


def _is_of_docks(widget: QWidget) -> bool:
    """Return True for tab bars of docks: `Docks.state` contains the docks in front."""
    return isinstance(widget, QTabBar) and isinstance(widget.parent(), QMainWindow)


def _state(part: Any, name: str, lines: Counter[str]) -> None:
    kinds = [kind for kind in type(part).mro() if kind.__module__.startswith("hexmend")]
    attributes = set(getattr(part, "__dict__", ()))
    attributes |= {key for kind in kinds for key, value in vars(kind).items() if isinstance(value, property)}
    for attribute in sorted(attributes):
        if not attribute.startswith("_"):
            lines[f"{name}.{attribute}: {_plain(getattr(part, attribute))}"] += 1


def _plain(value: Any) -> Any:
    if isinstance(value, _PLAIN):
        return repr(value)
    if isinstance(value, set | frozenset):
        return sorted(_plain(one) for one in value)
    if isinstance(value, tuple | list):
        return [_plain(entry) for entry in value]
    if is_dataclass(value) and not any(isinstance(field, np.ndarray) for field in vars(value).values()):
        return {name: _plain(field) for name, field in vars(value).items() if not name.startswith("_")}
    return type(value).__name__ if not isinstance(value, QObject) else "part"
