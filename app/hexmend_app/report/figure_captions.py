"""Captions of a figure set, and the commands that draw it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hexmend.report.documents import write_text
from hexmend.report.markdown import escape
from hexmend.terminal_text import printable
from hexmend_app.report.figure_set import Figure

#: First comment of commands.sh.
_HEAD = "# Each line draws a figure again. Paths are relative to the folder in which Hexmend was run."

#: Suffixes of pictures that Markdown can show.
_MARKDOWN_PICTURES = (".png", ".svg")


def write_captions(folder: Path, title: str, figures: Sequence[tuple[Figure, str]]) -> list[Path]:
    """Write captions.md and commands.sh.

    Parameters
    ----------
    folder : Path
        The folder of the figures.
    title : str
    figures : sequence of (Figure, command)
    """
    texts, lines = [f"# {escape(title)}"], ["#!/bin/sh", _HEAD]
    written: set[str] = set()
    for figure, command in figures:
        names = ", ".join(f"[{path.name}]({path.name})" for path in figure.paths)
        shown = next((path for path in figure.paths if path.suffix in _MARKDOWN_PICTURES), None)
        picture = [f"![{escape(figure.part)}]({shown.name})\n"] if shown is not None else []
        texts += ["\n".join([f"## {figure.part}\n", *picture, f"{escape(figure.caption)} ({names})"])]
        lines.append(f"\n# {printable(figure.part)}: {printable(figure.caption)}")
        if command not in written:
            lines.append(command)
        written.add(command)
    captions, script = folder / "captions.md", folder / "commands.sh"
    write_text(captions, "\n\n".join(texts) + "\n")
    write_text(script, "\n".join(lines) + "\n")
    script.chmod(script.stat().st_mode | 0o111)
    return [captions, script]
