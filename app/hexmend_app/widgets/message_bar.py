"""Line above the view with errors, warnings and results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

from PySide6.QtCore import QSize, Qt, QTimer, QUrl, Signal
from PySide6.QtGui import QAccessible, QAccessibleEvent, QDesktopServices, QGuiApplication, QKeySequence, QShortcut
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QSizePolicy, QWidget

from hexmend_app.theme.palette import AMBER, BLUE, WORSE
from hexmend_app.theme.spacing import clear, fill
from hexmend_app.theme.style import icon, on_theme_change, set_help, set_variant, tool_button
from hexmend_app.translation import tr

#: Maximum number of letters of a text that are shown, and of messages that are stored.
_MAX_SHOWN, _MAX_STORED = 400, 100

Choices = Sequence[tuple[str, Callable[[], object]]]


@dataclass
class _Message:
    kind: str
    title: str
    text: str
    choices: Choices = ()
    timeout_ms: int = 0
    is_card: bool = False
    report: str = ""


# Icon and its colour; sorted by priority. The style sheet has the other colours.
_KINDS = {
    "error": ("alert-circle", WORSE),
    "warning": ("alert", AMBER),
    "info": ("information", BLUE),
}
_PRIORITIES = list(_KINDS)


class MessageBar(QFrame):
    """Bar that shows one message at a time, and is hidden without messages.

    Errors are shown first, then warnings and results, each with the newest first; the others wait until the message
    shown is dismissed. Esc dismisses a message that does not go by itself.

    Attributes
    ----------
    title, text : str
        Title and text of the message shown, which flow in one paragraph.

    Signals
    -------
    changed
        The message shown has changed, or the last one has been dismissed.
    """

    changed = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._messages: list[_Message] = []  # oldest first
        self.setObjectName("message_bar")
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        self.title = self.text = ""
        self._icon, self._sentences = QLabel(), QLabel()
        self._sentences.setTextFormat(Qt.TextFormat.RichText)
        self._sentences.setTextInteractionFlags(
            Qt.TextInteractionFlag.TextSelectableByMouse | Qt.TextInteractionFlag.TextSelectableByKeyboard
        )
        self._sentences.setMinimumWidth(160)
        self._sentences.setWordWrap(True)
        self._copy, self._dismiss = tool_button("content-copy"), tool_button("close")
        self._copy.clicked.connect(self._copy_message)
        self._dismiss.clicked.connect(self.dismiss)
        set_help(self._copy, tr("Copy message"), tr("Copy the whole message to the clipboard."))
        self._escape = QShortcut(QKeySequence(Qt.Key.Key_Escape), self, self.dismiss)
        self._timer = QTimer(self, singleShot=True)
        self._timer.timeout.connect(self.dismiss)
        self._choices = fill(QHBoxLayout())
        parts = (self._icon, (self._sentences, 1), self._choices, self._copy, self._dismiss)
        fill(QHBoxLayout(self), *parts, margins=(8, 2, 4, 2))
        self._refresh()
        on_theme_change(self, self._paint)

    def show_error(self, title: str, text: str = "", report: str = "") -> None:
        """Show an error until it is dismissed; Copy adds `report`, which is for developers."""
        self._add(_Message("error", title, text, report=report))

    def show_warning(self, title: str, text: str = "", choices: Choices = ()) -> None:
        """Show a warning until it is dismissed.

        It has a button for each choice (text, function), which dismisses it and calls the function.
        """
        self._add(_Message("warning", title, text, choices))

    def show_info(self, text: str, timeout_ms: int = 6000) -> None:
        """Show a result for `timeout_ms` milliseconds (0: until dismissed)."""
        self._add(_Message("info", text, "", timeout_ms=timeout_ms))

    def show_result(self, title: str, text: str, choices: Choices, timeout_ms: int = 12_000) -> None:
        """Show a result for `timeout_ms` milliseconds with a button for each choice, as `show_warning`."""
        self._add(_Message("info", title, text, choices, timeout_ms))

    def show_written(self, text: str, path: Path) -> None:
        """Show that a file or a folder was written, with buttons that open it and its folder."""
        folder = (tr("Show folder"), lambda: self._open(path if path.is_dir() else path.parent))
        file = (tr("Open"), lambda: self._open(path))
        self.show_result(text, "", (folder,) if path.is_dir() else (file, folder))

    def _open(self, path: Path) -> None:
        if not QDesktopServices.openUrl(QUrl.fromLocalFile(str(path.absolute()))):
            self.show_error(tr("{name} was not opened", name=path.name), tr("The desktop has no program for it."))

    def show_card(self, title: str, text: str, choices: Choices, timeout_ms: int) -> None:
        """Show a result as `show_result`, at most until the first action of the user."""
        self._add(_Message("info", title, text, choices, timeout_ms, is_card=True))

    def _add(self, message: _Message) -> None:
        key = message.kind, message.title, message.text
        if key in self.messages() and message.kind != "info":
            return  # for example, of a view that cannot be drawn
        # A result replaces the previous one, which is out of date.
        self._messages = [other for other in self._messages if not (other.kind == message.kind == "info")]
        self._messages = [*self._messages[1 - _MAX_STORED :], message]
        self._refresh()

    @property
    def _shown(self) -> _Message | None:
        newest_first = reversed(self._messages)
        return min(newest_first, key=lambda message: _PRIORITIES.index(message.kind), default=None)

    def dismiss(self) -> None:
        """Remove the message shown, and show the next one if there is one."""
        shown = self._shown
        self._keep(lambda message: message is not shown)

    def remove(self, title: str, text: str) -> None:
        """Remove the messages with a title and text, which are no longer true."""
        self._keep(lambda message: (message.title, message.text) != (title, text))

    def leave_card(self, *_: object) -> None:
        """Remove a card: the user has done something."""
        self._keep(lambda message: not message.is_card)

    def clear(self) -> None:
        """Remove all messages."""
        self._keep(lambda message: False)

    def _keep(self, wanted: Callable[[_Message], bool]) -> None:
        left = list(filter(wanted, self._messages))
        if len(left) < len(self._messages):
            self._messages = left
            self._refresh()

    @property
    def takes_escape(self) -> bool:
        """True if Esc dismisses the message shown."""
        return self._escape.isEnabled()

    def messages(self) -> list[tuple[str, str, str]]:
        """Return kind, title and text of all stored messages, oldest first."""
        return [(message.kind, message.title, message.text) for message in self._messages]

    def _choose(self, choice: Callable[[], object]) -> None:
        self.dismiss()
        choice()

    def _copy_message(self) -> None:
        message = self._shown
        QGuiApplication.clipboard().setText("\n".join(filter(None, (message.title, message.text, message.report))))

    def _paint(self) -> None:
        if self._shown is not None:
            icon_name, colour = _KINDS[self._shown.kind]
            set_variant(self, self._shown.kind, "kind")
            self._icon.setPixmap(icon(icon_name, colour).pixmap(QSize(18, 18), self.devicePixelRatioF()))

    def _refresh(self) -> None:
        message = self._shown
        self._timer.stop()
        goes = message is None or bool(message.timeout_ms) or message.is_card
        self._escape.setEnabled(not goes)  # what goes by itself leaves Esc to others
        self.setVisible(message is not None)
        if message is not None:
            self._show(message)
        self.changed.emit()

    def _show(self, message: _Message) -> None:
        help = tr("Dismiss this message (Esc).") if self.takes_escape else tr("Dismiss this message.")
        set_help(self._dismiss, tr("Dismiss message"), help)
        self._paint()
        self._icon.setAccessibleName(tr(message.kind))
        long = len(message.text) > _MAX_SHOWN
        self.title = message.title
        self.text = tr("{text}… (Copy copies the full text.)", text=message.text[:_MAX_SHOWN]) if long else message.text
        title, text = (escape(part).replace("\n", "<br>") for part in (self.title, self.text))
        self._sentences.setText(f"<b>{title}</b>&ensp;{text}" if text else title)
        clear(self._choices)
        for text, choice in message.choices:
            button = QPushButton(text)
            button.clicked.connect(lambda _=False, choice=choice: self._choose(choice))
            self._choices.addWidget(button)
            button.show()
        if message.timeout_ms:
            self._timer.start(message.timeout_ms)
        self.setAccessibleName(f"{tr(message.kind)}: {message.title}")
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))
