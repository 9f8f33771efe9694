"""The window's widgets and where they stand; what they do is drawn elsewhere."""

from __future__ import annotations

from PySide6.QtWidgets import QLabel, QMainWindow, QVBoxLayout, QWidget

from hexmend.parameters import declared
from hexmend.run import Stop
from hexmend.smoothers import DEFAULT_METHOD
from hexmend_app.features.compare.compare_panel import ComparePanel
from hexmend_app.features.compare.feature import TICKED
from hexmend_app.features.convergence.panel import ConvergencePanel
from hexmend_app.features.cut.clip_panel import ClipPanel
from hexmend_app.features.cut.inside_panel import InsidePanel
from hexmend_app.features.help.hint import Hint
from hexmend_app.features.histogram.panel import QualityHistogram
from hexmend_app.features.inspect.element_panel import ElementPanel
from hexmend_app.features.inspect.worst_list import WorstList
from hexmend_app.features.look.colour_panel import ColourPanel
from hexmend_app.features.movement.movement_panel import MovementPanel
from hexmend_app.features.node.panel import NodePanel
from hexmend_app.features.open.recent_menu import RecentMenu
from hexmend_app.features.open.welcome import Welcome
from hexmend_app.features.outcome.outcome_panel import OutcomePanel
from hexmend_app.features.quality.statistics import StatisticsTable
from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel
from hexmend_app.features.structure.structure_panel import StructurePanel
from hexmend_app.features.tags.tag_panel import TagPanel
from hexmend_app.features.timeline.timeline_bar import TimelineBar
from hexmend_app.shell.docks import add_docks, column
from hexmend_app.state.commands import methods_offered
from hexmend_app.state.recent import Recent
from hexmend_app.widgets.busy import Busy
from hexmend_app.widgets.message_bar import MessageBar
from hexmend_app.widgets.overlay import Overlay


class Shell(QMainWindow):
    """A main window with all its panels in it, none of which does anything yet.

    Attributes
    ----------
    docks : dict
        By name.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setWindowTitle("Hexmend")
        self.setAcceptDrops(True)
        self.messages = MessageBar()
        self.recent = Recent(self)
        self.recent_menu = RecentMenu(self.recent, self)
        self.welcome = Welcome(self.recent)
        self.histogram = QualityHistogram()
        self.statistics = StatisticsTable()
        self.worst_list = WorstList()
        self.element_panel = ElementPanel()
        self.node_panel = NodePanel()
        self.tag_panel = TagPanel()
        self.outcome_panel = OutcomePanel()
        self.compare_panel = ComparePanel(TICKED)
        self.smoothing_panel = SmoothingPanel(declared(Stop))
        self.smoothing_panel.set_methods(methods_offered())
        self.smoothing_panel.set_method(DEFAULT_METHOD)
        self.clip_panel = ClipPanel()
        self.inside_panel = InsidePanel()
        self.structure_panel = StructurePanel()
        self.colour_panel = ColourPanel()
        self.convergence_panel = ConvergencePanel()
        self.movement_panel = MovementPanel()
        self.timeline_bar = TimelineBar()
        self.busy = Busy()
        self.hint = Hint()
        self.counts = QLabel()
        self._lay_out()

    def _lay_out(self) -> None:
        self._centre = QVBoxLayout()
        self._centre.setContentsMargins(0, 0, 0, 0)
        self._centre.setSpacing(0)
        self._centre.addWidget(self.hint)
        self._centre.addWidget(self.welcome, 1)
        self._centre.addWidget(self.timeline_bar)
        centre = QWidget()
        centre.setLayout(self._centre)
        self.setCentralWidget(centre)
        Overlay(self.messages, centre, (0.5, 0.0), width=560)
        tools = column(
            self.smoothing_panel, self.colour_panel, self.clip_panel, self.inside_panel, self.structure_panel
        )
        tabs = [
            ("quality", "Quality", self.statistics),
            ("worst", "Worst", self.worst_list),
            ("element", "Element", self.element_panel),
            ("tags", "Tags", self.tag_panel),
            ("outcome", "Outcome", self.outcome_panel),
            ("compare", "Compare", self.compare_panel),
        ]
        behind = [
            ("convergence", "Convergence", self.convergence_panel),
            ("movement", "Movement", column(self.movement_panel)),
            ("node", "Node", self.node_panel),
        ]
        self.docks = add_docks(self, tools, self.histogram, tabs, behind)
        self.statusBar().addWidget(self.counts, 1)
        self.statusBar().addPermanentWidget(self.busy)
        self.busy.done()
