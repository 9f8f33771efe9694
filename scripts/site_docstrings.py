"""Extension of griffe for `make site`: prepares docstrings for the parser of NumPy-style sections.

Docstrings of few lines show doctests without the heading Examples, and the fields of a NamedTuple are documented as
Parameters; the pages of docs/api need the heading, and call these fields attributes. Parameters that share a
description would all get the type of the first: each gets a description of its own.
"""

from __future__ import annotations

import re
from typing import Any

import griffe

_DOCTEST = re.compile(r"^>>> ", re.MULTILINE)
_EXAMPLES = "Examples\n--------\n"
#: Several parameters with one description and without types: `mesh, stop`.
_TOGETHER = re.compile(r"^([*\w]+(?:, [*\w]+)+)\n((?: {4}[^\n]*(?:\n|$))+)", re.MULTILINE)


class DocstringSections(griffe.Extension):
    """Completes the headings of docstrings."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Change the docstring of an object after it was collected."""
        if obj.docstring is None:
            return
        text = obj.docstring.value
        found = _DOCTEST.search(text)
        if found and _EXAMPLES not in text:
            text = text[: found.start()] + _EXAMPLES + text[found.start() :]
        if obj.is_class and any(str(base) == "NamedTuple" for base in obj.bases):
            text = text.replace("Parameters\n----------\n", "Attributes\n----------\n")
        obj.docstring.value = _TOGETHER.sub(_separate, text)


def _separate(found: re.Match[str]) -> str:
    return "".join(f"{name}\n{found[2].rstrip()}\n" for name in found[1].split(", "))
