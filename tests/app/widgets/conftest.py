"""What the widgets' tests share."""

import pytest

from hexmend_app.widgets.style import apply_style


@pytest.fixture(scope="session")
def qapp(qapp):
    """The application in the program's own look."""
    apply_style(qapp, dark=False)
    return qapp


@pytest.fixture
def shown(qtbot):
    """Shows a widget in a window of its own that has the keyboard focus."""

    def show(widget, width=360, height=0):
        qtbot.addWidget(widget)
        widget.resize(width, height or widget.sizeHint().height())
        with qtbot.waitActive(widget):
            widget.show()
            widget.activateWindow()
        return widget

    return show
