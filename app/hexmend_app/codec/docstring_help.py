"""Help texts of the keys of a scene, extracted from the docstrings of their tables for forms and the reference."""

from __future__ import annotations

import inspect
import re
from functools import cache


@cache
def helps(kind: type) -> dict[str, str]:
    """Return the descriptions of the parameters of a class by name, from its NumPy docstring.

    >>> from hexmend_app.picture import WipeLayout
    >>> helps(WipeLayout)["mesh"]
    'Number of the mesh on the command line, from 1.'
    """
    lines = inspect.getdoc(kind).splitlines()
    texts: dict[str, str] = {}
    names: list[str] = []
    for line in lines[lines.index("Parameters") + 2 :] if "Parameters" in lines else ():
        head = re.fullmatch(r"(\w[\w,\s]*?)(?:\s:\s.*)?", line)
        if head and not line.startswith(" "):
            names = head[1].split(", ")
        elif line.startswith("    "):
            for name in names:
                texts[name] = f"{texts.get(name, '')} {line.strip()}".strip()
    return texts
