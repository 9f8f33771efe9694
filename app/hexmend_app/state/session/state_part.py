"""State parts: how each part of a session is saved and restored."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QObject, Signal

from hexmend.errors import ParameterError
from hexmend_app.codec.conversion import decode, encode


def _nothing(*_: object) -> None:
    """Do nothing."""


@dataclass(frozen=True, kw_only=True)
class StatePart:
    """Part of a session: its name in session files, and functions that save and restore it.

    Parameters
    ----------
    name : str
        Name in session files.
    to_data : callable
        Returns the data for a session file.
    restore : callable
        Takes the data of a session file.
    data : type, optional
        Declared type of the data, which `hexmend_app.codec.conversion` converts. Required for parts of features.
    check : callable, optional
        Raises `ValueError` if data of the type cannot be restored.
    changed : Signal, optional
        Emitted when the data have changed, so that the session is saved automatically.
    """

    name: str
    to_data: Callable[[], Any]
    restore: Callable[[Any], object]
    data: Any = None
    check: Callable[[Any], object] = _nothing
    changed: Any = None


class FeatureStates(QObject):
    """The state parts that features declare.

    Session files store their encoded data by name. Data of a part that is not declared yet is stored: it is restored
    when the part is declared, and written to the next session file.

    Signals
    -------
    changed
        The data of a part have changed.
    failed(name, Exception)
        The data of a part do not fit its type; the part is unchanged.
    """

    changed = Signal()
    failed = Signal(str, object)

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._parts: dict[str, StatePart] = {}
        self._unclaimed: dict[str, Any] = {}

    def add(self, part: StatePart) -> None:
        """Add a part; if the open session has data of it, restore them at once.

        Raises
        ------
        ValueError
            If another part has the name.
        """
        if part.name in self._parts:
            raise ValueError(f"two features declare the state {part.name!r}")
        self._parts[part.name] = part
        if part.changed is not None:
            part.changed.connect(self.changed)
        if part.name in self._unclaimed:
            self._restore(part, self._unclaimed.pop(part.name))

    def to_data(self) -> dict[str, Any]:
        """Return the encoded data of all parts, by name."""
        declared = {name: encode(part.to_data()) for name, part in self._parts.items()}
        return {**self._unclaimed, **declared}

    def restore(self, data: dict[str, Any]) -> None:
        """Restore the parts that are in a session file; the others are unchanged."""
        self._unclaimed = {name: encoded for name, encoded in data.items() if name not in self._parts}
        for name, part in self._parts.items():
            if name in data:
                self._restore(part, data[name])

    def forget_undeclared(self) -> None:
        """Drop the data of parts that are not declared: they belong to the mesh that was open."""
        self._unclaimed.clear()

    def _restore(self, part: StatePart, encoded: Any) -> None:
        try:
            data = decode(part.data, encoded, (part.name,))
            part.check(data)
            part.restore(data)
        except (ParameterError, ValueError) as error:
            self.failed.emit(part.name, error)
