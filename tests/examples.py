"""The examples of docs/extending.md."""

import re
from pathlib import Path

_TEXT = (Path(__file__).resolve().parents[1] / "docs/extending.md").read_text(encoding="utf-8")


def example(title):
    """The program below a heading, which has one."""
    (_, section) = _TEXT.split(f"\n## {title}\n")
    (program,) = re.findall(r"```python\n(.*?)```", section.split("\n## ")[0], re.DOTALL)
    return program
