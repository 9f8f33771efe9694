"""Widgets whose values are a part of the session."""

from __future__ import annotations

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QCheckBox, QComboBox, QSpinBox

from hexmend_app.state.session.state_part import StatePart

Saved = QAction | QCheckBox | QComboBox | QSpinBox
Value = bool | int | str


def saved_values(name: str, **widgets: Saved) -> StatePart:
    """Return the part of a session that stores the values of widgets.

    Parameters
    ----------
    name : str
        Name of the part in session files.
    **widgets : QAction, QCheckBox, QComboBox or QSpinBox
        By the names of their values: checked or not, the data of the chosen entry, or the number.
    """

    def check(values: dict[str, Value]) -> None:
        for key, value in values.items():
            if key not in widgets:
                raise ValueError(f"{key!r} is unknown: expected {', '.join(widgets)}")
            if not _fits(widgets[key], value):
                raise ValueError(f"{key} = {value!r:.80} is not among its values")

    def restore(values: dict[str, Value]) -> None:
        for key, value in values.items():
            _set(widgets[key], value)

    def to_data() -> dict[str, Value]:
        return {key: _value(widget) for key, widget in widgets.items()}

    return StatePart(name=name, data=dict[str, Value], to_data=to_data, restore=restore, check=check)


def _fits(widget: Saved, value: Value) -> bool:
    """Return True if a widget can have a value."""
    if type(value) is not type(_value(widget)):
        return False
    if isinstance(widget, QComboBox):
        return widget.findData(value) >= 0
    return not isinstance(widget, QSpinBox) or widget.minimum() <= int(value) <= widget.maximum()


def _value(widget: Saved) -> Value:
    if isinstance(widget, QComboBox):
        return widget.currentData()
    return widget.value() if isinstance(widget, QSpinBox) else widget.isChecked()


def _set(widget: Saved, value: Value) -> None:
    if isinstance(widget, QComboBox):
        widget.setCurrentIndex(widget.findData(value))
    elif isinstance(widget, QSpinBox):
        widget.setValue(int(value))
    else:
        widget.setChecked(bool(value))
