#!/usr/bin/env python3
"""Check the pages of docs: they are short, and their pictures are there, small and all shown. Part of make lint."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1] / "docs"
PICTURE = re.compile(r"!\[[^]]+\]\(([^)\s]+)\)")

#: Words of a page's prose, and bytes of a picture.
WORDS, BYTES = 1500, 300_000


def words(text: str) -> int:
    """Count the words of prose: not those of code, formulas, tables and generated parts.

    >>> words("# Two words\\nThree more [of *these*](page.md) - $x + y$.\\n| no | cell |\\n")
    7
    """
    text = re.sub(r"<!-- written by .*", "", text, flags=re.DOTALL)
    text = re.sub(r"<!-- table: .*?<!-- end -->|^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"\$\$.*?\$\$|\$[^$\n]*\$", " x ", text, flags=re.DOTALL)
    lines = "\n".join(line for line in text.splitlines() if not line.startswith("|"))
    return sum(bool(re.search(r"\w", word)) for word in re.sub(r"\]\([^)]*\)", "]", lines).split())


def faults() -> Iterator[str]:
    """List long pages, and pictures that are large, not there or not shown."""
    shown = set()
    for page in sorted(DOCS.rglob("*.md")):
        text = page.read_text(encoding="utf-8")
        if (count := words(text)) >= WORDS:
            yield f"{page}: {count} words; divide it"
        for file in PICTURE.findall(text):
            picture = (page.parent / file).resolve()
            shown.add(picture)
            if not picture.is_file():
                yield f"{page}: {file} is not there"
    for picture in sorted(path for path in DOCS.rglob("*") if path.suffix in (".gif", ".png", ".svg")):
        if picture.stat().st_size >= BYTES:
            yield f"{picture}: more than {BYTES:,} bytes"
        if picture not in shown:
            yield f"{picture}: no page shows it"


if __name__ == "__main__":
    found = list(faults())
    sys.exit("\n".join(found) or None)
