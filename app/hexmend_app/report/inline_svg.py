"""Plots of Matplotlib as inline SVG, whose text can be searched and copied."""

from __future__ import annotations

import re
from collections.abc import Collection
from pathlib import Path
from xml.etree import ElementTree as ET

#: Reference to an id, or a colour.
_NAMED = re.compile(r"#(\w+)")

#: Style of all lines, which Matplotlib sets in a style sheet that would apply to the whole page.
_LINES = "stroke-linejoin: round; stroke-linecap: butt"

#: Attributes of other namespaces, and their names in HTML; None removes them.
_FOREIGN = {"{http://www.w3.org/1999/xlink}href": "xlink:href", "{http://www.w3.org/XML/1998/namespace}space": None}


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
