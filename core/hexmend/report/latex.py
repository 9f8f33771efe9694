"""Tables as LaTeX: a plain tabular that needs no package. tabulate leaves δ and × as they are, which needs one."""

from __future__ import annotations

from hexmend.report.tables import Table
from hexmend.terminal_text import FailedText, ShortestText

#: Characters that are commands in LaTeX, or that it does not have without packages.
_ESCAPES = {
    "\\": r"\textbackslash{}",
    **{letter: f"\\{letter}" for letter in "{}$&%#_"},
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    **{letter: f"${letter}$" for letter in "<>|"},
    "–": "--",
    "×": r"$\times$",
    "µ": r"$\mu$",
    "δ": r"$\delta$",
    "η": r"$\eta$",
    "Σ": r"$\sum$",
    "²": r"\textsuperscript{2}",
}


def latex(table: Table) -> str:
    """Write a table as a LaTeX `table` with caption, for `\\input`.

    >>> print(latex(Table("Cube", ["", "local-sd"], [["q min", "1.0000"]])), end="")
    \\begin{table}[htbp]
    \\centering\\footnotesize\\setlength{\\tabcolsep}{3pt}
    \\begin{tabular}{l|r}
     & local-sd \\\\
    \\hline
    q min & 1.0000 \\\\
    \\end{tabular}
    \\caption{Cube}
    \\end{table}
    """
    head, *rows = (" & ".join(_emphasised(cell) for cell in line) + r" \\" for line in [table.head, *table.rows])
    title = f"{table.title}." if table.title and table.notes else table.title
    caption = " ".join(escape(sentence) for sentence in (title, *table.notes) if sentence)
    lines = [
        r"\begin{table}[htbp]",
        r"\centering\footnotesize\setlength{\tabcolsep}{3pt}",
        r"\begin{tabular}{l|" + "r" * (len(table.head) - 1) + "}",
        head,
        r"\hline",
        *rows,
        r"\end{tabular}",
        *([rf"\caption{{{caption}}}"] if caption else []),
        r"\end{table}",
    ]
    return "\n".join(lines) + "\n"


def _emphasised(cell: str) -> str:
    """Escape the text of a cell, with commands for what it stands for."""
    command = "textbf" if isinstance(cell, ShortestText) else "textit" if isinstance(cell, FailedText) else ""
    return rf"\{command}{{{escape(cell)}}}" if command else escape(cell)


def escape(text: str) -> str:
    """Escape a text, so that LaTeX finds no command in it.

    >>> escape("50 % of mesh_1 & more")
    '50 \\\\% of mesh\\\\_1 \\\\& more'
    """
    return "".join(_ESCAPES.get(letter, letter) for letter in text)
