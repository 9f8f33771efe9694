"""Plots of matplotlib as inline SVG, with sharp lines and with texts that can be searched and copied."""

from __future__ import annotations

import re
from collections.abc import Collection
from pathlib import Path
from xml.etree import ElementTree as ET

#: References to ids, and colours.
_NAMED = re.compile(r"#(\w+)")

#: The style that matplotlib sets for all lines in a style sheet, which would apply to the whole page.
_LINES = "stroke-linejoin: round; stroke-linecap: butt"

#: Attributes of foreign namespaces, and their names in HTML.
_FOREIGN = {"{http://www.w3.org/1999/xlink}href": "xlink:href", "{http://www.w3.org/XML/1998/namespace}space": None}


def inline(path: Path, prefix: str) -> str:
    """Return the SVG of a file as inline HTML.

    Parameters
    ----------
    path : Path
        A file of `hexmend.report.plots`.
    prefix : str
        For its ids, unique within the page.
    """
    root = ET.parse(path).getroot()
    for parent in list(root.iter()):
        for part in [one for one in parent if _simple(one.tag) in ("metadata", "style")]:
            parent.remove(part)
    names = {part.get("id") for part in root.iter()}
    named = names & {name for part in root.iter() for value in part.attrib.values() for name in _NAMED.findall(value)}
    for part in root.iter():
        part.tag = _simple(part.tag)
        part.attrib = {
            _FOREIGN.get(name, name): prefix + value if name == "id" else _renamed(value, named, prefix)
            for name, value in part.attrib.items()
            if _FOREIGN.get(name, name) is not None and (name != "id" or value in named)
        }
    root.set("style", _LINES)
    root.set("aria-hidden", "true")  # the caption describes it
    del root.attrib["version"]
    return ET.tostring(root, encoding="unicode")


def _simple(tag: str) -> str:
    return tag.rpartition("}")[2]


def _renamed(value: str, names: Collection[str], prefix: str) -> str:
    """Return an attribute's value with a prefix before known ids; colours are kept."""
    return _NAMED.sub(lambda found: f"#{prefix}{found[1]}" if found[1] in names else found[0], value)
