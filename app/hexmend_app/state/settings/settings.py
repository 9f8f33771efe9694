"""Settings that are stored between starts: keys, types and defaults; and the recent files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Generic, TypeVar

import msgspec
from msgspec import Meta
from PySide6.QtCore import QByteArray, QObject, QSettings, Signal

T = TypeVar("T")
#: Maximum number of files.
MAX_RECENT_FILES = 10


@dataclass(frozen=True)
class Setting(Generic[T]):
    """Stored setting.

    Parameters
    ----------
    key : str
    default
        Value if none is stored, or the stored one is invalid.
    type
        Type of the value, for msgspec; a value of a type that settings do not have is stored as JSON.
    is_json : bool
    """

    key: str
    default: T
    type: Any
    is_json: bool = False

    def get(self) -> T:
        """Return the stored value."""
        settings = QSettings()
        if not settings.contains(self.key):
            return self.default
        value = settings.value(self.key)
        if type(value) is self.type:
            return value
        try:
            if self.is_json:
                return msgspec.json.decode(value, type=self.type, dec_hook=_convert)
            return msgspec.convert(value, self.type, strict=False, dec_hook=_convert)
        except (TypeError, ValueError, msgspec.MsgspecError):  # written by hand
            return self.default

    def set(self, value: T) -> None:
        """Store a value."""
        QSettings().setValue(self.key, msgspec.json.encode(value, enc_hook=str).decode() if self.is_json else value)


def _convert(kind: type, value: Any) -> Any:
    """Convert a value to a type that msgspec does not know."""
    if kind is Path:
        return Path(value)
    raise TypeError(value)


def write_all() -> None:
    """Write all settings to disk, which Qt would otherwise do at exit."""
    QSettings().sync()


def store_in(folder: str) -> None:
    """Read and write the settings of this process in a folder, and leave the user's settings alone."""
    for form in (QSettings.Format.NativeFormat, QSettings.Format.IniFormat):
        QSettings.setPath(form, QSettings.Scope.UserScope, folder)


#: Numbers from 1.
_Positive = Annotated[int, Meta(ge=1)]

#: Position and size of the window, and the layout of its panels.
GEOMETRY = Setting("geometry", QByteArray(), QByteArray)

PANELS: Setting[dict[str, Any]] = Setting("panels", {}, dict[str, Any])

#: One of `hexmend_app.theme.theme_choice.ThemeChoice`.
THEME = Setting("theme", "desktop", str)

#: Size of the letters of the window in per cent.
LETTERS = Setting("letters", 100, Annotated[int, Meta(ge=80, le=200)])

#: The last mesh is opened at the start of the program.
REOPEN = Setting("reopen", False, bool)

#: Recently opened files, newest first.
RECENT: Setting[tuple[Path, ...]] = Setting("recent", (), tuple[Path, ...], is_json=True)

#: Folder of the last opened or saved file, in which file dialogs start; the default if there was none.
FOLDER = Setting("folder", Path(), Path, is_json=True)

#: Memory limit of the positions of iterations in MB, and iterations played per second.
HISTORY_MEGABYTES = Setting("history_megabytes", 512, _Positive)

ITERATIONS_PLAYED = Setting("iterations_played", 10, _Positive)

#: Runs wait until each iteration is shown.
EVERY_ITERATION = Setting("every_iteration", False, bool)

#: Key figures are shown in the view.
KEY_FIGURES = Setting("key_figures", True, bool)


class RecentFiles(QObject):
    """Recently opened files, newest first.

    Signals
    -------
    changed
    """

    changed = Signal()

    def files(self) -> list[Path]:
        """Return the files, whether they still exist or not."""
        return list(RECENT.get())

    def add(self, path: Path) -> None:
        """Add a file that was opened."""
        path = path.resolve()
        self._store([path, *(other for other in self.files() if other != path)][:MAX_RECENT_FILES])

    def clear(self) -> None:
        """Clear the list."""
        self._store([])

    def _store(self, files: list[Path]) -> None:
        RECENT.set(tuple(files))
        self.changed.emit()
