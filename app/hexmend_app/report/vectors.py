"""A drawing of matplotlib as a part of a page, whose lines stay sharp and whose texts can be found and copied."""

from __future__ import annotations

import re
from collections.abc import Collection
from pathlib import Path
from xml.etree import ElementTree as ET

#: Where a part of a drawing is named, or a colour is.
_NAMED = re.compile(r"#(\w+)")

#: What matplotlib says of all its lines in a style sheet, which would be one of the page.
_LINES = "stroke-linejoin: round; stroke-linecap: butt"

#: Names of attributes in another namespace than the drawing's, as a page has them.
_FOREIGN = {"{http://www.w3.org/1999/xlink}href": "xlink:href", "{http://www.w3.org/XML/1998/namespace}space": None}


def inline(path: Path, prefix: str) -> str:
    """The SVG of a file, to stand in HTML.

    Parameters
    ----------
    path : Path
        What `hexmend.report.plots` has written.
    prefix : str
        Of the names in it, which are the page's: no two drawings of a page have the same.
    """
    root = ET.parse(path).getroot()
    for parent in list(root.iter()):
        for part in [one for one in parent if _plain(one.tag) in ("metadata", "style")]:
            parent.remove(part)
    names = {part.get("id") for part in root.iter()}
    named = names & {name for part in root.iter() for value in part.attrib.values() for name in _NAMED.findall(value)}
    for part in root.iter():
        part.tag = _plain(part.tag)
        part.attrib = {
            _FOREIGN.get(name, name): prefix + value if name == "id" else _renamed(value, named, prefix)
            for name, value in part.attrib.items()
            if _FOREIGN.get(name, name) is not None and (name != "id" or value in named)
        }
    root.set("style", _LINES)
    root.set("aria-hidden", "true")  # its caption tells
    del root.attrib["version"]
    return ET.tostring(root, encoding="unicode")


def _plain(tag: str) -> str:
    return tag.rpartition("}")[2]


def _renamed(value: str, names: Collection[str], prefix: str) -> str:
    """A value of an attribute; a colour is no name."""
    return _NAMED.sub(lambda found: f"#{prefix}{found[1]}" if found[1] in names else found[0], value)
