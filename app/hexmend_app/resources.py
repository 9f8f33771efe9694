"""Location of the program's own files: in the installed package, or next to the sources."""

from __future__ import annotations

from pathlib import Path


def resource(name: str) -> Path:
    """The path of a file of `resources/`."""
    here = Path(__file__).resolve().parent
    for folder in (here / "resources", here.parents[1] / "resources"):
        if (folder / name).exists():
            return folder / name
    raise FileNotFoundError(f"resource {name!r} is missing from the installation: install Hexmend again")


def recipes() -> list[Path]:
    """The recipes that come with Hexmend."""
    return sorted(resource("recipes").glob("*.toml"))


def demo_mesh() -> Path:
    """The mesh that the viewer opens where none is named."""
    return resource("demo.vtu")
