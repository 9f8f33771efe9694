"""Translation of the texts of the window."""

from __future__ import annotations

import sys
from functools import cache

from PySide6.QtCore import QCoreApplication

#: Beginning of the Qt contexts of Hexmend; the name of a section follows.
PREFIX = "Hexmend."


@cache
def section_of(module: str) -> str:
    """Return the section of the catalogue that has the texts of a module: its feature, or its package.

    >>> section_of("hexmend_app.features.cut.cut_panel"), section_of("hexmend_app.shell.window")
    ('cut', 'shell')
    """
    names = [*module.split(".")[1:], ""]
    return names[1] if names[0] == "features" else names[0]


def tr(text: str, /, **values: object) -> str:
    """Return a text of the window in the language of the program.

    The context in translation files is the feature that calls.

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
    section = section_of(sys._getframe(1).f_globals["__name__"])
    translated = QCoreApplication.translate(PREFIX + section, text)
    return translated.format(**values) if values else translated


def marked(text: str) -> str:
    """Return a text unchanged: it marks a text of a table for the catalogue, which `tr` translates where it is shown.

    >>> marked("start")
    'start'
    """
    return text


def tr_count(number: int, one: str, several: str) -> str:
    """Return a text with a number in the language of the program, which may have other plural forms than English.

    Parameters
    ----------
    number : int
    one, several : str
        The English text for 1 and for other numbers: formats with the field `number`.

    Examples
    --------
    >>> tr_count(1, "{number:,} node", "{number:,} nodes"), tr_count(1234, "{number:,} node", "{number:,} nodes")
    ('1 node', '1,234 nodes')
    """
    section = section_of(sys._getframe(1).f_globals["__name__"])
    translated = QCoreApplication.translate(PREFIX + section, several, None, number)
    return (one if number == 1 and translated == several else translated).format(number=number)
