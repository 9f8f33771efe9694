"""Lists the public names of `hexmend` for docs/api/index.md, with the page that documents each of them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType

import hexmend
from hexmend.registry import Registry

API = Path(__file__).resolve().parents[1] / "docs/api"
_DIRECTIVE = re.compile(r"^::: (\S+)", re.MULTILINE)


def directives() -> dict[str, str]:
    """Return the pages by the object or module that they document: `hexmend.io` to `io.md`, and so on."""
    pages = sorted(page for page in API.glob("*.md") if page.name != "index.md")
    return {path: page.name for page in pages for path in _DIRECTIVE.findall(page.read_text(encoding="utf-8"))}


def names() -> Iterator[tuple[str, str, str]]:
    """List the public names of `hexmend`: page, name as a link, and how their docstrings begin.

    Raises
    ------
    LookupError
        For a name that no page documents.
    """
    pages = directives()
    for name in hexmend.__all__:
        value = getattr(hexmend, name)
        anchor, page = _place(name, pages)
        link = page if isinstance(value, ModuleType) else f"{page}#{anchor}"
        yield page, f"[`{name}`]({link})", _summary(name, value)


def _place(name: str, pages: dict[str, str]) -> tuple[str, str]:
    for path, page in pages.items():
        if path.endswith(f".{name}"):
            return path, page
        if path.rpartition(".")[2].islower() and name in _exports(path):
            return f"{path}.{name}", page
    raise LookupError(f"no page of docs/api documents hexmend.{name}: add a directive '::: PATH' for it")


def _exports(path: str) -> list[str]:
    try:
        module = import_module(path)
    except ModuleNotFoundError:  # a function
        return []
    own = [name for name, value in vars(module).items() if getattr(value, "__module__", None) == path]
    return getattr(module, "__all__", own)


def _summary(name: str, value: object) -> str:
    if isinstance(value, Registry):
        return f"Registered {name.lower()} by name"
    return re.split(r"[.:;](?:\s|$)", " ".join((value.__doc__ or "").split()))[0]
