"""Host for tests of features without a window."""

from PySide6.QtWidgets import QWidget

from hexmend_app.feature import Action, Feature
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.session.session import Session
from hexmend_app.widgets.busy import Busy
from hexmend_app.widgets.dialogs.questions import wait_until
from hexmend_app.widgets.message_bar import MessageBar


class PlainHost:
    """Host without a window, which records the panels that were shown."""

    def __init__(self, mesh, path=None):
        self.dialog_parent = QWidget()
        self.session = Session(self.dialog_parent)
        self.canvas = None
        self.messages, self.busy = MessageBar(self.dialog_parent), Busy(self.dialog_parent)
        self.default_file_stem = "mesh"
        self.fronted: list[str] = []
        self.session.document.replace(MeasuredMesh.of(mesh), path)

    def show_panel(self, id):
        self.fronted.append(id)

    def is_visible(self, id):
        return id in self.fronted[-1:]

    def confirm_close(self):
        return True

    def wait_until(self, text, over, leave=""):
        return wait_until(self.dialog_parent, text, over, leave)

    def refresh_soon(self):
        pass


def action(feature: Feature, id: str) -> Action:
    """Return the action that a feature declares with an id."""
    return next(action for action in feature.actions() if action.id == id)
