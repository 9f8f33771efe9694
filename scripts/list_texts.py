"""Print every text of the window that goes through `tr`, by folder, so that all of them can be read in one go.

Texts that stand in tables of a module which passes their entries to `tr` are printed too.

python scripts/list_texts.py [FOLDER...]
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

APP = Path(__file__).resolve().parents[1] / "app" / "hexmend_app"


def texts_of(path: Path) -> Iterator[str]:
    """Return the texts that a module passes to `tr`, in order: literals, those of constants, then those of tables."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    constants = {
        target.id: statement.value
        for statement in tree.body
        if isinstance(statement, ast.Assign)
        for target in statement.targets
        if isinstance(target, ast.Name)
    }
    from_tables = False
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "tr":
            text = node.args[0]
            if isinstance(text, ast.Name):
                text = constants.get(text.id, text)
            if isinstance(text, ast.Constant):
                yield text.value
            else:
                from_tables = True
    if from_tables:
        for value in constants.values():
            yield from (part.value for part in ast.walk(value) if _is_text(part))


def _is_text(node: ast.AST) -> bool:
    """Return True for a literal that reads like a text: a capital first, or several words; not a path or a key."""
    if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
        return False
    text = node.value.lstrip("&")
    return len(text) > 1 and (text[0].isupper() or " " in text)


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
