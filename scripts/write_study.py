"""Assembles docs/study.md from the output of commands and the section that is written by hand.

Use: python scripts/write_study.py STUDY OUTLOOKS OFFSETS

STUDY is the folder of `hexmend study thesis --max-seconds 100` with the tables of Chapter 4, OUTLOOKS that of
`hexmend study thesis --quick --only 5.2.5 --only 5.2.6`, OFFSETS the output of `hexmend bench --only offsets`. The
section "Where ours differs" of docs/study.md is kept.
"""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1] / "docs"
#: The section that is written by hand; links to files that are not in docs/.
OWN, FILES = "## Where ours differs, and why\n", re.compile(r"\n\[csv\]\([^\n]*\n")


def sections(text: str) -> dict[str, str]:
    """Split a page into parts by heading; the part before the first heading has the key ""."""
    found = re.split(r"^(## [^\n]*\n)", text, flags=re.MULTILINE)
    return {"": found[0], **dict(zip(found[1::2], found[2::2], strict=True))}


def main() -> None:
    study, outlooks, offsets = map(Path, sys.argv[1:])
    chapter = sections(FILES.sub("\n", (study / "study.md").read_text("utf-8")))
    outlook = sections(FILES.sub("\n", (outlooks / "study.md").read_text("utf-8")))
    own = sections((DOCS / "study.md").read_text("utf-8"))[OWN]
    claims = [line for line in chapter["## Claims\n"].splitlines() if line.startswith("- ") and "(5.2." not in line]
    claims += [line for line in outlook["## Claims\n"].splitlines() if "(5.2." in line]
    table = "\n".join(line.strip() for line in offsets.read_text("utf-8").splitlines() if line.startswith("  "))
    head, preface = chapter[""].split("\n", 1)
    parts = [
        f"{head}\n{ORIGIN}",
        preface.strip() + "\n",
        "## Claims\n\n" + "\n".join(claims) + "\n",
        OWN + own,
        "## Compared with the thesis, cell by cell\n" + chapter["## Compared with the thesis, cell by cell\n"],
        '## The "-1" of (B.20)\n' + ABOUT_OFFSETS + "\n" + table + "\n",
        "## Figures\n" + chapter["## Figures\n"],
        "## Tables\n" + ABOUT_OBJECTIVE + chapter["## Tables\n"],
        "## What section 5.2 hopes for\n" + outlook["## What section 5.2 hopes for\n"],
    ]
    text = "\n".join(part.rstrip() + "\n" for part in parts)
    (DOCS / "study.md").write_text(text, "utf-8")
    for old in DOCS.glob("figure-4.*.png"):
        old.unlink()
    for picture in sorted(study.glob("figure-*.png")):
        shutil.copy(picture, DOCS / picture.name)


ORIGIN = """
Printed by `hexmend study thesis --max-seconds 100`, what 5.2 hopes for by `make study` (`--quick`), the comparison of
`offset` by `hexmend bench --only offsets`, but for the section *Where ours differs*; put together by
`scripts/write_study.py`.
"""

ABOUT_OFFSETS = """
(B.20) takes 1 off the mean of a hex's eta before (3.3) raises it to its power. 4.1.1 calls q norm "equivalent to the
global objective", and in every table of the thesis the optimum beats Laplacian smoothing and GETMe in q mean: both hold
only without the 1. `offset` is 1 or 0 (or anything between); here `mend` goes to either optimum, offset 1 · offset 0,
the thesis's optimum in brackets, the higher in bold. Without it mean and norm are higher, with it the worst elements:
that is what analysts look at, and so 1 stays what methods begin with.
"""

ABOUT_OBJECTIVE = """
The row *objective* of each table shows the sum that its label names, with offset 1 where it names no other: it is what
the methods of the table minimise only where they have that p and that offset.
"""

if __name__ == "__main__":
    main()
