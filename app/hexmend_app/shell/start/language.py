"""Language of the window: a catalogue of translations, if there is one for the language of the system."""

from __future__ import annotations

import logging
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from hexmend.errors import FileError, ParameterError
from hexmend_app.catalogue import Translation
from hexmend_app.resources import resource

log = logging.getLogger(__name__)

#: Suffix of translations; the file of a language is named after it: `de.po`, `pt_BR.po`.
SUFFIX = ".po"


def install_language(app: QCoreApplication, language: str | None = None) -> None:
    """Translate the texts of the window.

    Parameters
    ----------
    app : QCoreApplication
    language : str, optional
        Code of a language, such as "de", or the path of a catalogue; by default the language of the system, or English
        if its catalogue is damaged. Texts without a translation are English.

    Raises
    ------
    ParameterError
        If there is no translation into the language that was asked for.
    FileError
        If the catalogue that was asked for is damaged.
    """
    path = _of_system() if language is None else _named(language)
    if path is None:
        return
    try:
        translation = Translation(path, app)
    except FileError as error:
        if language is not None:
            raise
        log.warning("The window is in English: %s", error)
        return
    of_qt = QTranslator(app)
    if of_qt.load(f"qtbase_{path.stem}", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)):
        app.installTranslator(of_qt)
    app.installTranslator(translation)


def languages() -> dict[str, Path]:
    """Return the catalogues that come with Hexmend by language."""
    try:
        folder = resource("translations")
    except FileNotFoundError:  # an installation without translations
        return {}
    return {path.stem: path for path in sorted(folder.glob(f"*{SUFFIX}"))}


def system_languages() -> list[str]:
    """Return the codes of the languages of the user, the preferred one first."""
    return QLocale.system().uiLanguages()


def _of_system() -> Path | None:
    """Return the catalogue of the first language of the user that has one; None for English."""
    known: dict[str, Path] | None = None
    for code in system_languages():
        code = code.replace("-", "_")
        if code.partition("_")[0] in ("en", "C"):
            return None
        known = languages() if known is None else known
        if code in known:
            return known[code]
    return None


def _named(language: str) -> Path | None:
    if language == "en":
        return None
    if language.endswith(SUFFIX):
        return Path(language)
    known = languages()
    if language not in known:
        expected = ", ".join(["en", *known])
        raise ParameterError(f"there is no translation {language!r}: expected {expected}, or a {SUFFIX} file")
    return known[language]
