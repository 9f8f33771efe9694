"""Writes docs/measurements/thesis.md and the pages of results beside this file from the output of commands.

Use: python -m benchmarks pages STUDY OFFSETS REMARKS

STUDY is the folder of `python -m benchmarks thesis --max-seconds 60`, OFFSETS and REMARKS the outputs of `python -m
benchmarks bench offsets` and `bench remarks`. The section "Where ours differs" is written by hand, and kept.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path

from benchmarks.prose import wrapped

DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGE, PICTURES = DOCS / "measurements/thesis.md", DOCS / "pictures"
RESULTS = Path(__file__).with_name("results")
#: The section written by hand; links to files outside docs/.
OWN, FILES = "## Where ours differs, and why\n", re.compile(r"\n\[csv\]\([^\n]*\n")


def sections(text: str) -> dict[str, str]:
    """Split a page into parts by heading; the part before the first heading has the key ""."""
    found = re.split(r"^(## [^\n]*\n)", text, flags=re.MULTILINE)
    return {"": found[0], **dict(zip(found[1::2], found[2::2], strict=True))}


def table(output: Path) -> str:
    """Return the lines of a table in the output of a command, which are indented there."""
    return "\n".join(line.strip() for line in output.read_text("utf-8").splitlines() if line.startswith("  "))


def claims(text: str) -> str:
    """Arrange the claims, a list, under headings of the sections of the thesis that state them."""
    groups: dict[str, list[str]] = {}
    before, *items = re.split(r"^- ", text, flags=re.MULTILINE)
    for item in items:
        named = re.search(r"\((?:by )?(Tables? )?([\d.]+)[^)]*\) \*\*", item)
        groups.setdefault("Tables" if not named or named[1] else f"Section {named[2]}", []).append(f"- {item.strip()}")
    parts = (f"## {name}\n" + "\n".join(groups[name]) for name in sorted(groups))
    return "\n\n".join(filter(None, [before.strip(), *parts]))


def pages(chapter: dict[str, str], own: str, offsets: str, remarks: str) -> dict[str, str]:
    """Arrange the sections of a study, the section written by hand and two tables as pages.

    Returns
    -------
    dict of str to str
        Text by file name.
    """
    head, preface = chapter[""].split("\n", 1)
    compared, tried = "## Compared with the thesis, cell by cell\n", "## Sections 3.2.2 and 5.2, tried\n"
    parts = {
        PAGE.name: [
            f"{head}\n{ORIGIN}",
            preface.strip() + "\n",
            compared + chapter[compared],
            OWN + own,
            "## Figures\n" + chapter["## Figures\n"],
        ],
        "claims.md": ["# Claims of the thesis, tested\n" + GENERATED, claims(chapter["## Claims\n"])],
        "offset.md": [
            "# Offset, remarks and order of sweeps, measured\n" + GENERATED,
            '## The "-1" of (B.20)\n' + ABOUT_OFFSETS + "\n" + offsets + "\n",
            "## Remarks of 4.1.2 and 4.1.3, measured\n" + ABOUT_REMARKS + "\n" + remarks + "\n",
            tried + chapter[tried],
        ],
        "tables.md": [
            "# Tables of Chapter 4, measured\n" + GENERATED,
            "## Tables\n" + ABOUT_OBJECTIVE + chapter["## Tables\n"],
        ],
    }
    written = {name: "\n".join(part.rstrip() + "\n" for part in some) for name, some in parts.items()}
    return {**written, PAGE.name: wrapped(written[PAGE.name])}


def write(study: Path, offsets: Path, remarks: Path) -> None:
    """Write the pages, and replace the figures of docs.

    Parameters
    ----------
    study : Path
        Folder of the experiments' report.
    offsets, remarks : Path
        Outputs of the two sections.
    """
    chapter = sections(FILES.sub("\n", (study / "study.md").read_text("utf-8")))
    own = sections(PAGE.read_text("utf-8"))[OWN]
    for name, text in pages(chapter, own, table(offsets), table(remarks)).items():
        (PAGE if name == PAGE.name else RESULTS / name).write_text(text, "utf-8")
    for old in PICTURES.glob("figure-4.*.png"):
        old.unlink()
    for picture in sorted(study.glob("figure-*.png")):
        shutil.copy(picture, PICTURES / picture.name)


GENERATED = """
<!-- written by python -m benchmarks pages from here on -->

[The thesis's experiments repeated](../../../docs/measurements/thesis.md) says how this was measured.
"""

ORIGIN = """
The figures come from `python -m benchmarks thesis --max-seconds 60`; `python -m benchmarks pages` arranges them. The
folder `benchmarks/thesis/results` has all tables of Chapter 4, the claims of the thesis as tested, and the
comparison of `offset`, remarks and orders of sweeps.
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
