"""Assembles docs/study.md from the output of commands and the section that is written by hand.

Use: python scripts/write_study.py STUDY OFFSETS REMARKS

STUDY is the folder of `hexmend study thesis --max-seconds 60`, OFFSETS and REMARKS the output of `hexmend bench --only
offsets` and of `--only remarks`. The section "Where ours differs" of docs/study.md is kept.
"""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1] / "docs"
#: The section written by hand; links to files outside docs/.
OWN, FILES = "## Where ours differs, and why\n", re.compile(r"\n\[csv\]\([^\n]*\n")


def sections(text: str) -> dict[str, str]:
    """Split a page into parts by heading; the part before the first heading has the key ""."""
    found = re.split(r"^(## [^\n]*\n)", text, flags=re.MULTILINE)
    return {"": found[0], **dict(zip(found[1::2], found[2::2], strict=True))}


def table(output: Path) -> str:
    """Return the lines of a table in the output of a command, which are indented there."""
    return "\n".join(line.strip() for line in output.read_text("utf-8").splitlines() if line.startswith("  "))


def main() -> None:
    study, offsets, remarks = map(Path, sys.argv[1:])
    chapter = sections(FILES.sub("\n", (study / "study.md").read_text("utf-8")))
    own = sections((DOCS / "study.md").read_text("utf-8"))[OWN]
    head, preface = chapter[""].split("\n", 1)
    parts = [
        f"{head}\n{ORIGIN}",
        preface.strip() + "\n",
        "## Claims\n" + chapter["## Claims\n"],
        OWN + own,
        "## Compared with the thesis, cell by cell\n" + chapter["## Compared with the thesis, cell by cell\n"],
        '## The "-1" of (B.20)\n' + ABOUT_OFFSETS + "\n" + table(offsets) + "\n",
        "## Remarks of 4.1.2 and 4.1.3, measured\n" + ABOUT_REMARKS + "\n" + table(remarks) + "\n",
        "## Figures\n" + chapter["## Figures\n"],
        "## Tables\n" + ABOUT_OBJECTIVE + chapter["## Tables\n"],
        "## Sections 3.2.2 and 5.2, tried\n" + chapter["## Sections 3.2.2 and 5.2, tried\n"],
    ]
    text = "\n".join(part.rstrip() + "\n" for part in parts)
    (DOCS / "study.md").write_text(text, "utf-8")
    for old in DOCS.glob("figure-4.*.png"):
        old.unlink()
    for picture in sorted(study.glob("figure-*.png")):
        shutil.copy(picture, DOCS / picture.name)


ORIGIN = """
The tables come from `hexmend study thesis --max-seconds 60`, the comparison of `offset` and the measured remarks from
`hexmend bench --only offsets --only remarks`; `scripts/write_study.py` assembles this page. The section *Where ours
differs* is written by hand.
"""

ABOUT_OFFSETS = """
(B.20) subtracts 1 from the mean eta of a hex before (3.3) raises it to the power p. Section 4.1.1 calls q norm
"equivalent to the global objective", and in every table of the thesis the optimum has a higher q mean than Laplacian
smoothing and GETMe. Both are true only without this subtraction. The parameter `offset` takes values from 0 to 1. The
table compares the optima of `mend` for offset 1 · offset 0, with the optimum of the thesis in brackets and the higher
value in bold. With offset 0 the mean and the norm are higher; with offset 1 the worst elements are better. As analysts
judge a mesh by its worst elements, 1 is the default.
"""

ABOUT_REMARKS = """
What sections 4.1.2 and 4.1.3 say about the methods without figures of their own.
"""

ABOUT_OBJECTIVE = """
The row *objective* of each table shows the sum that its label names, with offset 1 unless it names another. It is the
objective that the methods of the table minimise only if they have the same p and offset.
"""

if __name__ == "__main__":
    main()
