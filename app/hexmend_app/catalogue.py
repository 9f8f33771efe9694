"""Catalogues of texts and translations: files of gettext (`.po`) with a section for each feature.

A section is the context (`msgctxt`) of its texts. Translators' tools read these files: Qt Linguist, Poedit, Weblate.
"""

from __future__ import annotations

import ast
import gettext
import logging
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from string import Formatter

from PySide6.QtCore import QObject, QTranslator

from hexmend.errors import FileError
from hexmend_app.translation import PREFIX

log = logging.getLogger(__name__)

_LINE = re.compile(r'(msgctxt|msgid|msgid_plural|msgstr(?:\[\d\])?)?\s*("(?:[^"\\]|\\.)*")$')
_PLURAL = re.compile(r"Plural-Forms:.*?plural=([^;\\]+);")
_ENGLISH_PLURAL = "n != 1"


@dataclass(frozen=True)
class Entry:
    """Text of a catalogue with its translation.

    Parameters
    ----------
    section : str
    text : str
        The English text; of a text with plural forms that for one.
    plural : str
        The English text for other numbers; "" if the text has no plural forms.
    translations : tuple of str
        One for each plural form; empty texts if it is not translated.
    line : int
        Line of the entry in the file, counted from 1.
    """

    section: str
    text: str
    plural: str = ""
    translations: tuple[str, ...] = ("",)
    line: int = 0

    @property
    def source(self) -> str:
        """The text that the program asks for."""
        return self.plural or self.text

    @property
    def problem(self) -> str:
        """Reason why the translation cannot be used; "" if there is none."""
        try:
            known, *used = ({name for _, name, _, _ in Formatter().parse(text) if name is not None}
                            for text in (self.source, *self.translations))  # fmt: skip
        except ValueError as error:
            return f"its braces are wrong ({error})"
        unknown = sorted(set().union(*used) - known)
        return f"its field {{{unknown[0]}}} is not in the English text" if unknown else ""


def read_catalogue(path: Path) -> tuple[str, list[Entry]]:
    """Read a catalogue.

    Parameters
    ----------
    path : Path

    Returns
    -------
    header : str
        Header of the file, lines of `Name: value`.
    entries : list of Entry
        In the order of the file.

    Raises
    ------
    FileError
        If the file cannot be read, or a line is not one of a catalogue.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise FileError(path, f"cannot be read: {error}", "Choose a text file in UTF-8.") from None
    blocks = list(_blocks(path, lines))
    header = next((texts["msgstr"] for _, texts in blocks if texts.get("msgid") == ""), "")
    entries = []
    for line, texts in blocks:
        if not texts.get("msgid"):
            continue
        translations = tuple(text for key, text in texts.items() if key.startswith("msgstr"))
        entries.append(
            Entry(texts.get("msgctxt", ""), texts["msgid"], texts.get("msgid_plural", ""), translations, line)
        )
    return header, entries


def _blocks(path: Path, lines: list[str]) -> Iterator[tuple[int, dict[str, str]]]:
    """Return the entries of a file: the line in which each begins, and its texts by keyword."""
    texts: dict[str, str] = {}
    begin, key = 0, ""
    for number, line in enumerate([*lines, ""], start=1):
        line = line.strip()
        if not line or line.startswith("#"):
            if texts and not line:
                yield begin, texts
                texts, key = {}, ""
            continue
        found = _LINE.match(line)
        if found is None or not (found[1] or key):
            expected = "expected msgctxt, msgid or msgstr with a text in quotes"
            raise FileError(path, f"line {number} is {line[:60]!r}: {expected}", "Correct the line.")
        begin = begin if texts else number
        key = found[1] or key
        texts[key] = texts.get(key, "") + ast.literal_eval(found[2])


def quoted(text: str) -> str:
    """Return a text in the quotes of a catalogue.

    >>> print(quoted('Press "Run"'))
    "Press \\"Run\\""
    """
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "\\t")
    return f'"{escaped}"'


class Translation(QTranslator):
    """Translation of the texts of the window from a catalogue.

    A text without a translation in its section has that of another section, so that a text that several features show
    is translated once, and differently where a feature needs it.

    Parameters
    ----------
    path : Path
    parent : QObject, optional

    Raises
    ------
    FileError
        If the file is not a catalogue.
    """

    def __init__(self, path: Path, parent: QObject | None = None):
        super().__init__(parent)
        header, entries = read_catalogue(path)
        self._by_section: dict[tuple[str, str], tuple[str, ...]] = {}
        self._by_text: dict[str, tuple[str, ...]] = {}
        self._form = _plural_form(path, header)
        for entry in entries:
            if not all(entry.translations):
                continue
            if entry.problem:
                log.warning("%s: the translation in line %s is ignored: %s.", path.name, entry.line, entry.problem)
                continue
            self._by_section[entry.section, entry.source] = entry.translations
            self._by_text.setdefault(entry.source, entry.translations)

    def translate(self, context: str, text: str, disambiguation: str | None = None, n: int = -1) -> str | None:
        """Return the translation of a text of Hexmend; None for other texts and those that are not translated."""
        if not context.startswith(PREFIX):
            return None  # Qt would show an empty text
        forms = self._by_section.get((context.removeprefix(PREFIX), text)) or self._by_text.get(text)
        if forms is None:
            return None
        return forms[min(self._form(n), len(forms) - 1)] if n >= 0 else forms[0]

    def isEmpty(self) -> bool:
        """Return True if no text is translated."""
        return not self._by_text


def _plural_form(path: Path, header: str) -> Callable[[int], int]:
    """Return the function from a number to the plural form that the header of a catalogue declares."""
    found = _PLURAL.search(header)
    try:
        return gettext.c2py(found[1] if found else _ENGLISH_PLURAL)
    except ValueError as error:
        raise FileError(
            path, f"its header has Plural-Forms that are not valid: {error}", "Correct the header."
        ) from None
