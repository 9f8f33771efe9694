"""Pieces of a page: every text that comes from outside passes through here, and is text there."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Mapping
from html import escape
from io import BytesIO
from pathlib import Path

from hexmend.report.tables import Table
from hexmend.terminal_text import WorsenedText
from hexmend_app.report.vectors import inline

#: Of pictures in pixels: half the size of PNG, and nobody sees the difference.
_WEBP = {"quality": 90, "method": 4}

#: Columns of a table of figures beside its first for which paper has room.
_COLUMNS = 7


def heading(level: int, text: str, **attributes: str) -> str:
    """
    >>> heading(2, "a < b", id="mesh-1")
    '<h2 id="mesh-1">a &lt; b</h2>'
    """
    own = "".join(f' {name.rstrip("_")}="{escape(value)}"' for name, value in attributes.items())
    return f"<h{level}{own}>{escape(text)}</h{level}>"


def paragraph(text: str) -> str:
    """A paragraph; nothing where there is no text."""
    return f"<p>{escape(text)}</p>" if text else ""


def listed(texts: Iterable[str]) -> str:
    """A list; nothing where there is no text."""
    rows = "".join(f"<li>{escape(text)}</li>" for text in texts)
    return f"<ul>{rows}</ul>" if rows else ""


def commands(lines: Iterable[str]) -> str:
    """Lines of a shell."""
    return f"<pre>{escape(chr(10).join(lines))}</pre>"


def picture(path: Path, caption: str, prefix: str) -> str:
    """A picture within the page with its caption: of pixels, or an SVG, whose names get a prefix."""
    if path.suffix == ".svg":
        drawn = inline(path, prefix)
    else:
        drawn = f'<img src="data:image/webp;base64,{_webp(path)}" alt="">'  # its caption tells
    return f"<figure>{drawn}<figcaption>{escape(caption)}</figcaption></figure>"


def contents(chapters: Iterable[tuple[str, str, Iterable[tuple[str, str]]]]) -> str:
    """A table of contents: of each chapter its place in the page, its name, and places and names of its sections."""

    def link(place: str, name: str) -> str:
        return f'<a href="#{escape(place)}">{escape(name)}</a>'

    rows = "".join(
        f"<li>{link(place, name)}<p>{' '.join(link(*section) for section in sections)}</p></li>"
        for place, name, sections in chapters
    )
    return f'<nav aria-label="Contents"><ol>{rows}</ol></nav>'


def _webp(path: Path) -> str:
    """A picture in pixels, in base64."""
    from PIL import Image

    with Image.open(path) as image, BytesIO() as file:
        image.save(file, "WEBP", **_WEBP)
        return base64.b64encode(file.getvalue()).decode("ascii")


def table(table: Table, words: int = 0) -> str:
    """A table; the last `words` columns hold sentences."""
    width = len(table.head)

    def cell(text: str, column: int) -> str:
        kinds = ["worse"] * isinstance(text, WorsenedText) + ["words"] * (column >= width - words)
        return f'<td class="{" ".join(kinds)}">{escape(text)}</td>' if kinds else f"<td>{escape(text)}</td>"

    head = "".join(
        f'<th scope="col"{kind}>{escape(text)}</th>'
        for column, text in enumerate(table.head)
        for kind in [' class="words"' if column >= width - words else ""]
    )
    rows = "".join(f"<tr>{''.join(cell(text, column) for column, text in enumerate(row))}</tr>" for row in table.rows)
    title = f"<caption>{escape(table.title)}</caption>" if table.title else ""
    notes = "".join(f'<p class="soft">{escape(note)}</p>' for note in table.notes)
    return f'<div class="wide"><table>{title}<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>{notes}'


def tables(whole: Table) -> str:
    """A table that is laid across as many as have room on paper, each with its first column."""
    last = max(2, len(whole.head))
    parts = [slice(k, k + _COLUMNS) for k in range(1, last, _COLUMNS)]
    return "".join(
        table(
            Table(
                whole.title if part is parts[0] else "",
                [whole.head[0], *whole.head[part]],
                [[row[0], *row[part]] for row in whole.rows],
                whole.notes if part is parts[-1] else [],
            )
        )
        for part in parts
    )


def facts(pairs: Mapping[str, str]) -> str:
    """Names and what belongs to them, as a table without a head."""
    rows = "".join(
        f'<tr><th scope="row">{escape(name)}</th><td class="words hash">{escape(text)}</td></tr>'
        for name, text in pairs.items()
    )
    return f"<table><tbody>{rows}</tbody></table>"
