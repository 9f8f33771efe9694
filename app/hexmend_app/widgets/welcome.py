"""What the window shows while no mesh is open."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from hexmend_app.widgets.style import MUTED, icon, tint


class Welcome(QWidget):
    """Says what can be done first.

    Signals
    -------
    open_requested, demo_requested
    """

    open_requested = Signal()
    demo_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._title = QLabel("Open a hexahedral mesh")
        font = self._title.font()
        font.setPointSizeF(font.pointSizeF() * 1.8)
        self._title.setFont(font)
        self._hint = QLabel("Drop a file here, or choose one. VTK, VTU and Medit meshes are read.")
        tint(self._hint, MUTED)
        self._open = QPushButton(icon("folder-open-outline"), "Open…")
        self._demo = QPushButton("Demo mesh")
        self._open.clicked.connect(self.open_requested)
        self._demo.clicked.connect(self.demo_requested)
        buttons = QHBoxLayout()
        buttons.addStretch()
        buttons.addWidget(self._open)
        buttons.addWidget(self._demo)
        buttons.addStretch()
        layout = QVBoxLayout(self)
        layout.setSpacing(14)
        layout.addStretch()
        for label in (self._title, self._hint):
            label.setAlignment(Qt.AlignmentFlag.AlignCenter)
            layout.addWidget(label)
        layout.addLayout(buttons)
        layout.addStretch()
