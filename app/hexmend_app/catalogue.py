"""Catalogues of texts and translations: files of gettext (`.po`) with a section for each feature.

A section is the context (`msgctxt`) of its texts. Translators' tools read these files: Qt Linguist, Poedit, Weblate.
"""

from __future__ import annotations

import gettext
import logging
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from string import Formatter

from PySide6.QtCore import QObject, QTranslator

from hexmend.errors import FileError
from hexmend_app.translation import PREFIX

log = logging.getLogger(__name__)

_LINE = re.compile(r'(msgctxt|msgid|msgid_plural|msgstr(?:\[\d\])?)?\s*("(?:[^"\\]|\\.)*")$')
_PLURAL = re.compile(r"Plural-Forms:.*?plural=([^;\n]+)")
_ENGLISH_PLURAL = "n != 1"
_FUZZY = re.compile(r"#,.*\bfuzzy\b")
#: Characters that a letter after a backslash stands for; others stand for themselves.
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r"}


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
            known, *used = map(_fields, (self.source, *self.translations))
        except ValueError as error:
            return f"its braces are wrong ({error})"
        unknown = sorted(set().union(*used) - known)
        return f"its field {unknown[0]} is not in the English text" if unknown else ""


def _fields(text: str) -> set[str]:
    """Return the fields of a format as they are written.

    >>> sorted(_fields("{count:,} of {name!r}"))
    ['{count:,}', '{name!r}']
    """
    parts = [part for part in Formatter().parse(text) if part[1] is not None]
    return {
        f"{{{name}{'!' + conversion if conversion else ''}{':' + spec if spec else ''}}}"
        for _, name, spec, conversion in parts
    }


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
        lines = path.read_text(encoding="utf-8-sig").split("\n")  # some editors write a byte order mark
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}", "Choose another file.") from None
    except UnicodeDecodeError as error:
        raise FileError(
            path, f"is not text in UTF-8: {error.reason} at byte {error.start}", "Save it in UTF-8."
        ) from None
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
    """Return the entries of a file: the line in which each begins, and its texts by keyword.

    An entry that is marked as fuzzy has to be checked by the translator: it has no translation yet.
    """
    texts: dict[str, str] = {}
    begin, key, fuzzy = 0, "", False
    for number, line in enumerate([*lines, ""], start=1):
        line = line.strip()
        found = _LINE.match(line)
        begins = line.startswith("#") or (found is not None and found[1] in ("msgctxt", "msgid"))
        if not line or (begins and _translated(texts)):  # entries need no empty line between them
            if texts:
                yield begin, {**texts, "msgstr": ""} if fuzzy and texts.get("msgid") else texts
            texts, key, fuzzy = {}, "", False
        if not line or line.startswith("#"):
            fuzzy = fuzzy or _FUZZY.match(line) is not None
            continue
        if found is None or not (found[1] or key):
            expected = "expected msgctxt, msgid or msgstr with a text in quotes"
            raise FileError(path, f"line {number} is {line[:60]!r}: {expected}", "Correct the line.")
        begin = begin if texts else number
        key = found[1] or key
        texts[key] = texts.get(key, "") + _unquoted(found[2])


def _translated(texts: Mapping[str, str]) -> bool:
    return any(key.startswith("msgstr") for key in texts)


def _unquoted(text: str) -> str:
    """Return the text in the quotes of a catalogue.

    >>> _unquoted(quoted('Press "Run"'))
    'Press "Run"'
    """
    return re.sub(r"\\(.)", lambda found: _ESCAPED.get(found[1], found[1]), text[1:-1])


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
            if not entry.translations or not all(entry.translations):
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
