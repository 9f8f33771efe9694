"""Settings that are stored between starts: keys, types and defaults."""

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
    """Stored setting.

    Parameters
    ----------
    key : str
    default
        Value if none is stored, or the stored one is invalid.
    decode : callable
        Converts the stored value; raises ValueError or TypeError if it is invalid.
    encode : callable
        Converts a value to store it.
    """

    key: str
    default: T
    decode: Callable[[Any], T] = _same
    encode: Callable[[T], Any] = _same

    def get(self) -> T:
        """Return the stored value."""
        settings = QSettings()
        if not settings.contains(self.key):
            return self.default
        try:
            return self.decode(settings.value(self.key))
        except (TypeError, ValueError):  # written by hand
            return self.default

    def clear(self) -> None:
        """Remove the stored value."""
        QSettings().remove(self.key)

    def set(self, value: T) -> None:
        """Store a value."""
        QSettings().setValue(self.key, self.encode(value))


def write_all() -> None:
    """Write all settings to disk, which Qt would otherwise do at exit."""
    QSettings().sync()


def store_in(folder: str) -> None:
    """Read and write the settings of this process in a folder, and leave the user's settings alone."""
    for form in (QSettings.Format.NativeFormat, QSettings.Format.IniFormat):
        QSettings.setPath(form, QSettings.Scope.UserScope, folder)


def _bytes(value: Any) -> QByteArray:
    if not isinstance(value, QByteArray):
        raise TypeError(value)
    return value


def _map(value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise TypeError(value)
    return value


def _shares(value: Any) -> tuple[float, float]:
    x, y = (float(share) for share in str(value).split())
    if not all(0 <= share <= 1 for share in (x, y)):
        raise ValueError(value)
    return x, y


def _positive(value: Any) -> int:
    if int(value) <= 0:
        raise ValueError(value)
    return int(value)


def _switch(value: Any) -> bool:
    if str(value) not in ("true", "false"):  # as files of settings have it
        raise ValueError(value)
    return str(value) == "true"


def _paths(value: Any) -> tuple[Path, ...]:
    return tuple(Path(path) for path in json.loads(value))


#: Position and size of the window, and the layout of its panels.
GEOMETRY = Setting("geometry", QByteArray(), _bytes)
PANELS: Setting[dict[str, Any]] = Setting("panels", {}, _map)
#: One of `hexmend_app.theme.theme_choice.ThemeChoice`.
THEME = Setting("theme", "desktop", str)
#: Recently opened files, newest first.
RECENT: Setting[tuple[Path, ...]] = Setting("recent", (), _paths, lambda paths: json.dumps([str(one) for one in paths]))
#: Folder of the last opened or saved file, in which file dialogs start; the default if there was none.
FOLDER = Setting("folder", Path(), Path, str)
#: Memory limit of the positions of iterations in MB, and iterations played per second.
HISTORY_MEGABYTES = Setting("history_megabytes", 512, _positive)
ITERATIONS_PLAYED = Setting("iterations_played", 10, _positive)
#: Runs wait until each iteration is shown.
EVERY_ITERATION = Setting("every_iteration", False, _switch, lambda on: "true" if on else "false")
#: Key figures are shown in the view.
KEY_FIGURES = Setting("key_figures", True, _switch, lambda on: "true" if on else "false")


def overlay_position(key: str, default: tuple[float, float]) -> Setting[tuple[float, float]]:
    """Return the setting of the position of an overlay over the view, as shares of the free width and height."""
    return Setting(f"overlay/{key}", default, _shares, lambda position: " ".join(f"{share:.4f}" for share in position))
