"""HTML elements of a report; texts are escaped here."""

from __future__ import annotations

import base64
import re
from collections.abc import Collection, Iterable, Mapping
from html import escape
from io import BytesIO
from pathlib import Path
from xml.etree import ElementTree as ET

from PIL import Image

from hexmend.report.tables import Table
from hexmend.terminal_text import WorsenedText

#: Options of embedded pictures: half the size of PNG without visible differences.
_WEBP = {"quality": 90, "method": 4}

#: Maximum number of columns of a printed table, without the first one.
_COLUMNS = 7


#: Reference to an id, or a colour.
_NAMED = re.compile(r"#(\w+)")

#: Style of all lines, which Matplotlib sets in a style sheet that would apply to the whole page.
_LINES = "stroke-linejoin: round; stroke-linecap: butt"

#: Attributes of other namespaces, and their names in HTML; None removes them.
_FOREIGN = {"{http://www.w3.org/1999/xlink}href": "xlink:href", "{http://www.w3.org/XML/1998/namespace}space": None}


def heading(level: int, text: str, **attributes: str) -> str:
    """Return a heading.

    >>> heading(2, "a < b", id="mesh-1")
    '<h2 id="mesh-1">a &lt; b</h2>'
    """
    attribute_text = "".join(f' {name.rstrip("_")}="{escape(value)}"' for name, value in attributes.items())
    return f"<h{level}{attribute_text}>{escape(text)}</h{level}>"


def paragraph(text: str) -> str:
    """Return a paragraph; "" for an empty text."""
    return f"<p>{escape(text)}</p>" if text else ""


def listed(texts: Iterable[str]) -> str:
    """Return a list; "" without texts."""
    rows = "".join(f"<li>{escape(text)}</li>" for text in texts)
    return f"<ul>{rows}</ul>" if rows else ""


def commands(lines: Iterable[str]) -> str:
    """Return a block of shell commands."""
    return f"<pre>{escape(chr(10).join(lines))}</pre>"


def picture(path: Path, caption: str, prefix: str) -> str:
    """Return an embedded picture with its caption; `prefix` is added to the ids of an SVG."""
    if path.suffix == ".svg":
        element = inline_svg(path, prefix)
    else:
        element = f'<img src="data:image/webp;base64,{_webp(path)}" alt="">'  # the caption describes it
    return f"<figure>{element}<figcaption>{escape(caption)}</figcaption></figure>"


def contents(chapters: Iterable[tuple[str, str, Iterable[tuple[str, str]]]]) -> str:
    """Return a table of contents.

    Parameters
    ----------
    chapters : iterable of (id, name, sections)
        Sections are pairs of id and name.
    """

    def link(place: str, name: str) -> str:
        return f'<a href="#{escape(place)}">{escape(name)}</a>'

    rows = "".join(
        f"<li>{link(place, name)}<p>{' '.join(link(*section) for section in sections)}</p></li>"
        for place, name, sections in chapters
    )
    return f'<nav aria-label="Contents"><ol>{rows}</ol></nav>'


def _webp(path: Path) -> str:
    """Return a picture as WebP in base64."""
    with Image.open(path) as image, BytesIO() as file:
        image.save(file, "WEBP", **_WEBP)
        return base64.b64encode(file.getvalue()).decode("ascii")


def table(table: Table, words: int = 0) -> str:
    """Return a table; the last `words` columns contain sentences."""
    width = len(table.head)

    def cell(text: str, column: int) -> str:
        classes = ["worse"] * isinstance(text, WorsenedText) + ["words"] * (column >= width - words)
        return f'<td class="{" ".join(classes)}">{escape(text)}</td>' if classes else f"<td>{escape(text)}</td>"

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
    """Return a table, split by columns into tables that fit on paper; each repeats the first column."""
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
    """Return names and texts as a table with two columns and without a head."""
    rows = "".join(
        f'<tr><th scope="row">{escape(name)}</th><td class="words hash">{escape(text)}</td></tr>'
        for name, text in pairs.items()
    )
    return f"<table><tbody>{rows}</tbody></table>"


def inline_svg(path: Path, prefix: str) -> str:
    """Return the SVG of a file as inline HTML.

    Parameters
    ----------
    path : Path
        SVG file of a plot.
    prefix : str
        Prefix of its ids, unique within the page.
    """
    root = ET.parse(path).getroot()
    for parent in list(root.iter()):
        for part in [one for one in parent if _local_name(one.tag) in ("metadata", "style")]:
            parent.remove(part)
    names = {part.get("id") for part in root.iter()}
    named = names & {name for part in root.iter() for value in part.attrib.values() for name in _NAMED.findall(value)}
    for part in root.iter():
        part.tag = _local_name(part.tag)
        part.attrib = {
            _FOREIGN.get(name, name): prefix + value if name == "id" else _renamed(value, named, prefix)
            for name, value in part.attrib.items()
            if _FOREIGN.get(name, name) is not None and (name != "id" or value in named)
        }
    root.set("style", _LINES)
    root.set("aria-hidden", "true")  # the caption describes it
    del root.attrib["version"]
    return ET.tostring(root, encoding="unicode")


def _local_name(tag: str) -> str:
    return tag.rpartition("}")[2]


def _renamed(value: str, names: Collection[str], prefix: str) -> str:
    """Return the value of an attribute with a prefix before known ids; colours do not change."""
    return _NAMED.sub(lambda found: f"#{prefix}{found[1]}" if found[1] in names else found[0], value)
