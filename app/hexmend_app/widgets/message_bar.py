"""Bar over the view with errors, warnings and results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QAccessible, QAccessibleEvent, QGuiApplication, QKeySequence, QShortcut
from PySide6.QtWidgets import QFrame, QGridLayout, QHBoxLayout, QLabel, QPushButton, QSizePolicy, QToolButton, QWidget

from hexmend_app.theme.palette import AMBER, BLUE, WORSE
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import bold, icon, on_theme_change, set_help, set_variant, tool_button
from hexmend_app.translation import tr

#: Maximum number of letters of a text that are shown, and of messages that are stored.
_MAX_SHOWN, _MAX_STORED = 700, 100


@dataclass
class _Message:
    """Message, with the number of its repetitions and its sequence number."""

    kind: str
    title: str
    text: str
    timeout_ms: int = 0
    choices: tuple[tuple[str, Callable[[], object]], ...] = ()
    times: int = 1
    number: int = 0
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

    Errors are shown first, then warnings and results, each with the newest first. A message with lower priority than
    the message shown waits behind it. Esc dismisses a message that does not go by itself. A message that repeats the
    last one of its kind is counted, not queued.

    Attributes
    ----------
    title, text : QLabel
        Title and text of the message shown.

    Signals
    -------
    emptied
        The last message has been dismissed.
    filled
        A message is shown that takes Esc, or a first one.
    """

    emptied = Signal()
    filled = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._messages: list[_Message] = []  # in the order of showing
        self._at = 0
        self.setObjectName("message_bar")
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        self._icon = QLabel()
        self.title, self.text = QLabel(), QLabel()
        for label in (self.title, self.text):
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setTextInteractionFlags(
                Qt.TextInteractionFlag.TextSelectableByMouse | Qt.TextInteractionFlag.TextSelectableByKeyboard
            )
            label.setMinimumWidth(80)
        self.title.setFont(bold(self.title.font()))
        self._next = QToolButton()
        self._next.setAutoRaise(True)
        self._next.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        set_help(self._next, tr("Next message"), tr("Show the next message."))
        self._next.clicked.connect(self._show_next)
        self._copy, self._dismiss = tool_button("content-copy"), tool_button("close")
        self._copy.clicked.connect(self._copy_message)
        self._dismiss.clicked.connect(self.dismiss)
        set_help(self._copy, tr("Copy message"), tr("Copy the whole message to the clipboard."))
        self._escape = QShortcut(QKeySequence(Qt.Key.Key_Escape), self, self.dismiss)
        self._escape.setEnabled(False)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.dismiss)

        buttons = QHBoxLayout()
        buttons.setSpacing(4)
        for button in (self._next, self._copy, self._dismiss):
            buttons.addWidget(button, 0, Qt.AlignmentFlag.AlignTop)
        layout = QGridLayout(self)
        layout.setContentsMargins(12, 8, 8, 8)
        layout.setHorizontalSpacing(8)
        layout.setVerticalSpacing(4)
        layout.setColumnStretch(1, 1)
        layout.addWidget(self._icon, 0, 0, Qt.AlignmentFlag.AlignTop)
        layout.addWidget(self.title, 0, 1)
        layout.addLayout(buttons, 0, 2, Qt.AlignmentFlag.AlignTop)
        layout.addWidget(self.text, 1, 1, 1, 2)
        self._choices = fill(QHBoxLayout(), None)
        layout.addLayout(self._choices, 2, 1, 1, 2)
        self.hide()
        on_theme_change(self, self._paint)

    def show_error(self, title: str, text: str = "", report: str = "") -> None:
        """Show an error until it is dismissed; Copy adds `report`, which is for developers."""
        self._add(_Message("error", title, text, report=report))

    def show_warning(self, title: str, text: str = "") -> None:
        """Show a warning until it is dismissed."""
        self._add(_Message("warning", title, text))

    def show_offer(self, title: str, text: str, choices: Sequence[tuple[str, Callable[[], object]]]) -> None:
        """Show a warning with a button for each choice (text, function), which dismisses it and calls the function."""
        self._add(_Message("warning", title, text, choices=tuple(choices)))

    def show_info(self, text: str, timeout_ms: int = 6000) -> None:
        """Show a result for `timeout_ms` milliseconds (0: until dismissed)."""
        self._add(_Message("info", text, "", timeout_ms))

    def show_result(
        self, title: str, text: str, choices: Sequence[tuple[str, Callable[[], object]]], timeout_ms: int = 12_000
    ) -> None:
        """Show a result for `timeout_ms` milliseconds with a button for each choice, as `show_offer`."""
        self._add(_Message("info", title, text, timeout_ms, tuple(choices)))

    def _add(self, message: _Message) -> None:
        rank = _rank(message)
        shown = self._messages[self._at] if self._messages else None
        at = next((at for at, other in enumerate(self._messages) if _rank(other) >= rank), len(self._messages))
        last = self._messages[at] if at < len(self._messages) else None
        if last is not None and (last.kind, last.title, last.text) == (message.kind, message.title, message.text):
            last.times += 1
        else:
            # A result replaces the previous one, which is out of date.
            if last is not None and last.kind == message.kind == "info":
                self._messages.pop(at)
            message.number = max((other.number for other in self._messages), default=0) + 1
            self._messages.insert(at, message)
            del self._messages[_MAX_STORED:]
        if shown is None or rank <= _rank(shown):
            self._at = at
        self._refresh()

    def dismiss(self) -> None:
        """Remove the message shown, and show the next one if there is one."""
        if self._messages:
            self._messages.pop(self._at)
            self._refresh()
            if not self._messages:
                self.emptied.emit()

    def remove(self, title: str, text: str) -> None:
        """Remove the messages with a title and text, which are no longer true."""
        shown = self._messages[self._at] if self._messages else None
        left = [message for message in self._messages if (message.title, message.text) != (title, text)]
        if len(left) < len(self._messages):
            self._messages = left
            self._at = left.index(shown) if shown in left else 0
            self._refresh()
            if not left:
                self.emptied.emit()

    def clear(self) -> None:
        """Remove all messages."""
        while self._messages:
            self.dismiss()

    @property
    def takes_escape(self) -> bool:
        """True if Esc dismisses the message shown."""
        return self._escape.isEnabled()

    def messages(self) -> list[tuple[str, str, str]]:
        """Return kind, title and text of all stored messages, oldest first."""
        messages = sorted(self._messages, key=lambda message: message.number)
        return [(message.kind, message.title, message.text) for message in messages]

    def _choose(self, choice: Callable[[], object]) -> None:
        self.dismiss()
        choice()

    def _show_choices(self, message: _Message) -> None:
        while self._choices.count() > 1:
            button = self._choices.takeAt(1).widget()
            button.hide()
            button.deleteLater()
        for text, choice in message.choices:
            button = QPushButton(text)
            button.clicked.connect(lambda _=False, choice=choice: self._choose(choice))
            self._choices.addWidget(button)
            button.show()

    def _show_next(self) -> None:
        self._at += 1
        self._refresh()

    def _copy_message(self) -> None:
        message = self._messages[self._at]
        QGuiApplication.clipboard().setText("\n".join(filter(None, (message.title, message.text, message.report))))

    def _paint(self) -> None:
        if self._messages:
            kind = self._messages[self._at].kind
            icon_name, colour = _KINDS[kind]
            set_variant(self, kind, "kind")
            self._icon.setPixmap(icon(icon_name, colour).pixmap(QSize(20, 20), self.devicePixelRatioF()))

    def _refresh(self) -> None:
        self._timer.stop()
        before = self._escape.isEnabled()
        self._escape.setEnabled(False)
        filled = bool(self._messages) and self.isHidden()
        self.setVisible(bool(self._messages))
        if not self._messages:
            self._at = 0
            return
        self._at %= len(self._messages)
        message = self._messages[self._at]
        self._escape.setEnabled(not message.timeout_ms)  # what goes by itself leaves Esc to others
        help = tr("Dismiss this message (Esc).") if self.takes_escape else tr("Dismiss this message.")
        set_help(self._dismiss, tr("Dismiss message"), help)
        if filled or self.takes_escape is not before:
            self.filled.emit()
        self._paint()
        self._icon.setAccessibleName(tr(message.kind))
        self.title.setText(message.title + (f"  (×{message.times})" if message.times > 1 else ""))
        long = len(message.text) > _MAX_SHOWN
        self.text.setText(
            tr("{text}… (Copy copies the full text.)", text=message.text[:_MAX_SHOWN]) if long else message.text
        )
        self.text.setVisible(bool(message.text))
        self._show_choices(message)
        self._next.setVisible(len(self._messages) > 1)
        self._next.setText(tr("{number} of {count}  ›", number=self._at + 1, count=len(self._messages)))
        if message.timeout_ms:
            self._timer.start(message.timeout_ms)
        self.setAccessibleName(f"{tr(message.kind)}: {message.title}")
        QAccessible.updateAccessibility(QAccessibleEvent(self, QAccessible.Event.Alert))


def _rank(message: _Message) -> int:
    """Return the rank of the priority of a message; 0 is the highest."""
    return _PRIORITIES.index(message.kind)
