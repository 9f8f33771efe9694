"""Print every text of the window that goes through `tr`, by folder, so that all of them can be read in one go.

python scripts/list_texts.py [FOLDER...]
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

APP = Path(__file__).resolve().parents[1] / "app" / "hexmend_app"


def texts_of(path: Path) -> Iterator[str]:
    """Return the texts that a module passes to `tr`, in order: literals, and those of constants of the module."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    constants = {
        target.id: statement.value
        for statement in tree.body
        if isinstance(statement, ast.Assign)
        for target in statement.targets
        if isinstance(target, ast.Name)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "tr":
            text = node.args[0]
            if isinstance(text, ast.Name):
                text = constants.get(text.id, text)
            if isinstance(text, ast.Constant):
                yield text.value


def main(folders: list[str]) -> None:
    """Print the texts below some folders of the app, or below all."""
    roots = [APP / folder for folder in folders] or [APP]
    for folder in sorted({path.parent for root in roots for path in root.rglob("*.py")}):
        texts = [text for path in sorted(folder.glob("*.py")) for text in texts_of(path)]
        if texts:
            print(f"\n{folder.relative_to(APP)}")
            for text in dict.fromkeys(texts):
                print(f"    {text}")


if __name__ == "__main__":
    main(sys.argv[1:])
