"""Settings that are kept from one start to the next: keys, types and defaults."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from PySide6.QtCore import QByteArray, QSettings

T = TypeVar("T")


def _same(value: Any) -> Any:
    return value


@dataclass(frozen=True)
class Setting(Generic[T]):
    """One thing that is remembered.

    Parameters
    ----------
    key : str
    default
        What it is as long as nothing was kept, or what was kept cannot be read.
    read : callable
        Makes a value of what was kept; raises ValueError or TypeError where that cannot be.
    written : callable
        The reverse.
    """

    key: str
    default: T
    read: Callable[[Any], T] = _same
    written: Callable[[T], Any] = _same

    def get(self) -> T:
        """Return the stored value."""
        settings = QSettings()
        if not settings.contains(self.key):
            return self.default
        try:
            return self.read(settings.value(self.key))
        except (TypeError, ValueError):  # by hand, or by another version
            return self.default

    def forget(self) -> None:
        """Keep nothing."""
        QSettings().remove(self.key)

    def set(self, value: T) -> None:
        """Keep a value."""
        QSettings().setValue(self.key, self.written(value))


def write_all() -> None:
    """Write what Qt would write at the end of the process."""
    QSettings().sync()


def _bytes(value: Any) -> QByteArray:
    if not isinstance(value, QByteArray):
        raise TypeError(value)
    return value


def _map(value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise TypeError(value)
    return value


def _share(value: Any) -> tuple[float, float]:
    x, y = (float(share) for share in str(value).split())
    if not all(0 <= share <= 1 for share in (x, y)):
        raise ValueError(value)
    return x, y


def _positive(value: Any) -> int:
    if int(value) <= 0:
        raise ValueError(value)
    return int(value)


def _paths(value: Any) -> tuple[Path, ...]:
    return tuple(Path(path) for path in json.loads(value))


#: The window's place and size, and how its panels stand.
GEOMETRY = Setting("geometry", QByteArray(), _bytes)
PANELS: Setting[dict[str, Any]] = Setting("panels", {}, _map)
#: One of `hexmend_app.theme.theme_choice.ThemeChoice`.
THEME = Setting("theme", "desktop", str)
#: Files that were opened, the newest first.
RECENT: Setting[tuple[Path, ...]] = Setting("recent", (), _paths, lambda paths: json.dumps([str(one) for one in paths]))
#: Where dialogs begin.
FOLDER = Setting("folder", Path.home(), Path, str)
#: How much memory positions of iterations take, in MB, and how many of these are played a second.
HISTORY_MEGABYTES = Setting("history_megabytes", 512, _positive)
ITERATIONS_PLAYED = Setting("iterations_played", 10, _positive)


def place_of(key: str, home: tuple[float, float]) -> Setting[tuple[float, float]]:
    """Position of an overlay over the view, as shares of the free space; the default position at first."""
    return Setting(f"overlay/{key}", home, _share, lambda place: " ".join(f"{share:.4f}" for share in place))
