"""Entries of the command palette: commands, panels and their controls, methods, and metrics to colour by."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox, QLineEdit, QSlider, QWidget

from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.feature import Panel
from hexmend_app.picture.colours import colour_quantities
from hexmend_app.shell.palette.ranking import PaletteEntry
from hexmend_app.shell.panels.docks import Docks
from hexmend_app.translation import tr
from hexmend_app.widgets.section import Section

if TYPE_CHECKING:
    from hexmend_app.state.session.session import Session

#: Types of widgets in panels that have an entry.
_CONTROLS = (QAbstractButton, QAbstractSpinBox, QComboBox, QLineEdit, QSlider)


def command_entries(actions: Mapping[str, QAction]) -> Iterator[PaletteEntry]:
    """Yield an entry for each action, except those that open a panel, which has an entry itself.

    Parameters
    ----------
    actions : mapping
        By id.
    """
    for id, action in actions.items():
        if id.startswith("panel_"):
            continue
        name = action.text().replace("&", "")
        if action.isCheckable():
            name = f"{name}: {tr('on') if action.isChecked() else tr('off')}"
        yield PaletteEntry(
            name=name,
            run=action.trigger,
            help=action.statusTip(),
            kind=action.property("within") or "",
            keys=action.shortcut().toString(QKeySequence.SequenceFormat.NativeText),
            icon=action.icon(),
            enabled=action.isEnabled(),
        )


def panel_entries(docks: Docks, panels: Iterable[Panel]) -> Iterator[PaletteEntry]:
    """Yield entries that show a panel, then entries that focus a control of a panel."""
    shown = [panel for panel in panels if panel.id in docks.ids()]
    for panel in shown:
        yield PaletteEntry(name=panel.title, run=partial(docks.show_panel, panel.id), help=panel.help, kind=tr("Panel"))
    for panel in shown:
        for control in _controls(panel.widget):
            yield PaletteEntry(
                name=control.accessibleName(),
                run=partial(_focus_control, docks, panel, control),
                help=control.accessibleDescription(),
                kind=tr("In {panel}", panel=panel.title),
            )


def choice_entries(session: Session) -> Iterator[PaletteEntry]:
    """Yield entries that choose a method, with its last parameters, or a metric to colour by."""
    run_setup = session.run_setup
    stop = run_setup.stage.stop if run_setup.stage is not None else StoppingCriteria()
    if session.editable:
        for method in METHODS.values():
            stage = Stage(run_setup.smoother_of(method.name), stop)
            choose = partial(run_setup.choose, stage, tr("{title} selected: press Run.", title=tr(method.title)))
            yield PaletteEntry(name=tr(method.title), run=choose, help=tr(method.help), kind=tr("Method"))
    if session.document.is_open:
        for metric in colour_quantities().values():
            colour = partial(session.view.colour_by, metric.name)
            yield PaletteEntry(name=tr(metric.title), run=colour, help=tr(metric.meaning), kind=tr("Colour by"))


def _controls(panel: QWidget) -> Iterator[QWidget]:
    """Yield the named, enabled controls of a panel, including those in collapsed sections."""
    for widget in panel.findChildren(QWidget):
        if not isinstance(widget, _CONTROLS) or isinstance(
            widget.parentWidget(), (QAbstractSpinBox, QComboBox, Section)
        ):
            continue
        if widget.accessibleName() and widget.isEnabledTo(panel) and _is_reachable(widget, panel):
            yield widget


def _is_reachable(widget: QWidget, panel: QWidget) -> bool:
    """Return True if a widget is hidden by collapsed sections only, or not at all."""
    collapsed = [section.content() for section in _sections_around(widget)]
    while widget is not panel:
        if widget.isHidden() and widget not in collapsed:
            return False
        widget = widget.parentWidget()
    return True


def _sections_around(widget: QWidget) -> Iterator[Section]:
    """Yield the sections that contain a widget, innermost first."""
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, Section):
            yield parent
        parent = parent.parentWidget()


def _focus_control(docks: Docks, panel: Panel, control: QWidget) -> None:
    docks.show_panel(panel.id)
    for section in _sections_around(control):
        section.expand()
    control.setFocus(Qt.FocusReason.ShortcutFocusReason)
