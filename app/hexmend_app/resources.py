"""Paths of the files that come with Hexmend: in the installed package, or next to the sources."""

from __future__ import annotations

from pathlib import Path


def resource(name: str) -> Path:
    """Return the path of a file or folder in `resources/`."""
    here = Path(__file__).resolve().parent
    for folder in (here / "resources", here.parents[1] / "resources"):
        if (folder / name).exists():
            return folder / name
    raise FileNotFoundError(f"resource {name!r} is missing from the installation. Reinstall Hexmend.")


def recipes() -> list[Path]:
    """Return the paths of the recipes that come with Hexmend."""
    return sorted(resource("recipes").glob("*.toml"))


def demo_mesh() -> Path:
    """Return the path of the mesh that the viewer opens by default."""
    return resource("demo.vtu")
