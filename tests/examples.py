"""The Python of the pages: blocks by their headings, and whole pages run as a reader would run them.

`python -m tests.examples PAGE` runs the blocks of a page one after another in the working folder.
"""

import os
import re
import sys
import types
from importlib.util import find_spec
from pathlib import Path

from tests.programs import run_python

ROOT = Path(__file__).resolve().parents[1]
#: The folder in which pages show files of the reader.
HOME = "/home/me"

#: A block that holds one of these words needs a library, and is left out where that is not installed.
NEEDS = {
    "hx.view(": "trame_pyvista",
    "hexmend_app": "PySide6",
    ".plot(": "PySide6",
    "_pyvista(": "pyvista",
    "meshio": "meshio",
}

_BLOCK = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)


def blocks(page):
    """The Python blocks of a page as programs, each with as many empty lines before it as stand before it there."""
    text = Path(page).read_text(encoding="utf-8")
    return ["\n" * text.count("\n", 0, found.start(1)) + found[1] for found in _BLOCK.finditer(text)]


def example(title):
    """The program below a heading of docs/development/extending.md or docs/development/extending-window.md, which has one."""
    text = "\n".join(
        path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs/development").glob("extending*.md"))
    )
    (_, section) = text.split(f"\n## {title}\n")
    (program,) = _BLOCK.findall(section.split("\n## ")[0])
    return program


def run_page(page, folder):
    """Run the blocks of a page in a process of its own, beside the meshes that they read; what it printed."""
    words = ["-W", "error", "-m", "tests.examples"]
    done = run_python(*words, page, paths=[ROOT], cwd=folder, encoding="utf-8")
    assert done.returncode == 0, f"{page.name}: {done.stderr}"
    return done.stdout


def _run(page):
    import hexmend as hx

    module = types.ModuleType("example")
    sys.modules["example"] = module
    for block in blocks(page):
        if any(word in block and find_spec(library) is None for word, library in NEEDS.items()):
            continue
        program = block.replace(HOME, os.getcwd())
        for name in re.findall(r"(?<=hx\.read\(\")[^\"]+(?=\"\))|(?<=hx\.smooth\(\")[^\"]+\.[a-z]+(?=\")", program):
            if not Path(name).exists():
                hx.write(name, hx.gallery.make("bridge-sharp", size=500, scramble=0.4, seed=1))
        exec(compile(program, str(page), "exec"), module.__dict__)


if __name__ == "__main__":
    _run(sys.argv[1])
