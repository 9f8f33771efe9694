"""Texts of the window in the language of the program."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication


def tr(text: str, /, **values: object) -> str:
    """Return a text of the window in the language of the program.

    Parameters
    ----------
    text : str
        The English text; with values, a format with their names in braces.
    **values : object
        The values of the fields.

    Examples
    --------
    >>> tr("{count:,} hexes are inverted", count=12345)
    '12,345 hexes are inverted'
    """
    translated = QCoreApplication.translate("", text)  # the context of functions outside classes in Qt Linguist's files
    return translated.format(**values) if values else translated
