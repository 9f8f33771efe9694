"""Take the pictures of interfaces, boundary layers and an OpenFOAM case: boundary.md, targets.md, openfoam.md.

Use: HEXMEND_MESHES=folder python scripts/pictures/model.py FOLDER
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

import numpy as np
from screenshots import compress

from hexmend.cli.main import main as hexmend
from hexmend.gallery import make
from hexmend.io import read, write
from hexmend.layers import describe_layers, find_layers
from hexmend.quality import ElementQuality, measure

_KEYS = "axes.show=false", "show.outline=false", "page.figures=false", "page.font_size=10"
_PLAIN = "--no-bar", *(word for key in _KEYS for word in ("--key", key))

#: The mesh with layers: fewer and thicker ones than by default, since the picture has to show the first of them.
_LAYERED = {"size": 8000, "layers": 12, "first_height": 0.005}


def render(picture: Path, meshes: list[Path], captions: list[str], *options: str) -> None:
    """Draw meshes side by side with captions."""
    hexmend(["render", *map(str, meshes), "-o", str(picture), "--captions", ",".join(captions), *options])
    compress(picture)


def smooth(mesh: Path, output: Path, *options: str) -> Path:
    """Smooth a mesh with the default method, and return the path of the result."""
    hexmend(["smooth", str(mesh), "-o", str(output), *options])
    return output


def materials(folder: Path, scratch: Path) -> None:
    """The ball in a box cut in half: scrambled, mended with its interface kept, and with free interfaces."""
    scrambled = scratch / "ball.vtu"
    write(scrambled, make("materials", size=6000, scramble=0.4))
    kept = smooth(scrambled, scratch / "kept.vtu")
    free = smooth(scrambled, scratch / "free.vtu", "--interfaces", "free")
    mesh = read(kept)
    behind = np.flatnonzero(mesh.points[mesh.hexes, 1].mean(axis=1) > 0.04)  # half of the mesh without the scrambling
    render(
        folder / "interfaces-ball.png", [scrambled, kept, free],
        ["scrambled", "mended", "mended with --interfaces free"], "--clip", "y:0.5",
        "--key", f'cut.hexes="{ranges(behind)}"', "--view", "[-0.05, -1, 0.08]",
        "--metric", "material", "--size", "900x325", *_PLAIN,
    )  # fmt: skip


def grains(folder: Path, scratch: Path) -> None:
    """The ten grains cut open: as given, mended with sliding interfaces, and with free ones."""
    given = Path(os.environ["HEXMEND_MESHES"]) / "n10-id2_hex.msh"
    kept = smooth(given, scratch / "grains.msh", "--boundary", "slide")
    free = smooth(given, scratch / "free.msh", "--interfaces", "free")
    render(
        folder / "interfaces-grains.png", [given, kept, free],
        ["as given", "mended with --boundary slide", "mended with --interfaces free"], "--clip", "x:0.6",
        "--view", "[1, 0.25, 0.2]", "--metric", "material", "--size", "900x325", *_PLAIN,
    )  # fmt: skip


def layers(folder: Path, scratch: Path) -> None:
    """Layers at the wall of a cylinder: as made, scrambled, mended, and mended with cubes as target."""
    made, scrambled = scratch / "made.vtu", scratch / "scrambled.vtu"
    write(made, make("layered", **_LAYERED))
    write(scrambled, make("layered", **_LAYERED, scramble=0.5))
    kept = smooth(scrambled, scratch / "kept.vtu")
    ideal = smooth(scrambled, scratch / "ideal.vtu", "--target", "ideal")
    inverted = int(np.count_nonzero(quality(scrambled).inverted))
    captions = [
        f"as made: first height {first_height(made):.3g}",
        f"scrambled: {inverted} hexes inverted",
        f"mended: first height {first_height(kept):.3g}",
        f"--target ideal: first height {first_height(ideal):.3g}",
    ]
    render(
        folder / "targets-layers.png", [made, scrambled, kept, ideal], captions, "--clip", "z:0.53",
        "--camera", "{ position = [0, 0.585, 6], focal = [0, 0.585, 0.2], view_up = [0, 1, 0], parallel = true, "
        "scale = 0.125 }", "--neutral", "--size", "880x580", "--key", "page.columns=2", *_PLAIN,
    )  # fmt: skip


def piston(folder: Path, scratch: Path) -> None:
    """An engine's cylinder with two valves: as given, and with its minimum scaled Jacobian raised."""
    given = Path(os.environ["HEXMEND_MESHES"]) / "piston"
    options = ["--boundary", "slide", "--goal", "scaled-jacobian", "--surface-tolerance", "0.3"]
    mended = smooth(given, scratch / "piston-smooth", *options)
    least = [quality(case).scaled_jacobian.min() for case in (given, mended)]
    captions = [f"as given: least value {least[0]:.4f}", f"mended: least value {least[1]:.4f}"]
    render(
        folder / "openfoam-piston.png", [given, mended], captions, "--view", "iso", "--metric", "scaled-jacobian",
        "--size", "880x460", "--key", "axes.show=false", "--key", "page.figures=false", "--key", "page.font_size=9",
    )  # fmt: skip


def quality(path: Path) -> ElementQuality:
    """The quality of the file's hexes."""
    mesh = read(path)
    return measure(mesh.points, mesh.hexes)


def first_height(path: Path) -> float:
    """The mean height of the first layer at the wall of the file's mesh, in the mesh's unit of length."""
    (wall,) = describe_layers(find_layers(make("layered", **_LAYERED)), read(path))
    return wall["first_height_mean"]


def ranges(hexes: np.ndarray) -> str:
    """Numbers of hexes in ascending order as text, such as "0-120, 130-132"."""
    runs = np.split(hexes, np.flatnonzero(np.diff(hexes) > 1) + 1)
    return ", ".join(f"{run[0]}-{run[-1]}" for run in runs)


def main(folder: Path) -> None:
    """Take all pictures."""
    for picture in (materials, layers, grains, piston):
        with tempfile.TemporaryDirectory() as scratch:
            picture(folder, Path(scratch))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
