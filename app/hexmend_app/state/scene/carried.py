"""What a picture carries with it: the scene, which meshes it shows, what ran on them, and what drew it."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import numpy as np

import hexmend.run.recipe as recipes
from hexmend.errors import FileError, ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend.run.recipe import Recipe
from hexmend.toml_text import parse_toml
from hexmend_app.state.scene import png
from hexmend_app.state.scene.camera import MOST, Panel
from hexmend_app.state.scene.scene import Scene
from hexmend_app.state.scene.table import Table, key, made
from hexmend_app.state.scene.toml import from_toml, table_text, to_toml

#: Keywords of the texts in a PNG.
_SCENE, _ABOUT, _RECIPE = "hexmend scene", "hexmend meshes", "hexmend recipe"

#: Letters of a path.
_LONGEST = 1000


@dataclass(frozen=True)
class Pictured(Table):
    """A mesh that a picture shows.

    Parameters
    ----------
    file : str
        The mesh's file, as seen from the picture's folder.
    opened : str
        The digest of the mesh as it was opened.
    shown : str
        That of the mesh as it is shown.
    """

    file: str = key("", most=_LONGEST)
    opened: str = key("")
    shown: str = key("")

    def check(self) -> None:
        """A path that stays in the file system, and digests."""
        if "\\" in self.file or ":" in self.file or PurePosixPath(self.file).is_absolute():
            raise ParameterError(f"file = {self.file!r} is no path from the picture: expected one such as ../mesh.vtu")
        for one in (self.opened, self.shown):
            if not re.fullmatch("[0-9a-f]{64}", one):
                raise ParameterError(f"{one!r} is no digest: expected 64 digits")

    @classmethod
    def of(cls, opened: Mesh, shown: Mesh, file: Path | None, picture: Path) -> Pictured:
        """A mesh as it was opened from a file, and as it is shown."""
        return cls(_from(file, picture), digest(opened), digest(shown))

    def candidates(self, picture: Path) -> list[Path]:
        """Where its file may be: where it was, or beside the picture."""
        if not self.file:
            return []
        found = (picture.parent / self.file, picture.parent / PurePosixPath(self.file).name)
        return [path for path in found if path.is_file()]


@dataclass(frozen=True)
class _About(Table):
    """What stands beside the scene.

    Parameters
    ----------
    version : str
        Of Hexmend.
    meshes : tuple of Pictured
        By their numbers in the scene.
    """

    version: str = key("")
    meshes: tuple[Pictured, ...] = key((), most=MOST)


@dataclass(frozen=True)
class Carried:
    """What a picture carries.

    Parameters
    ----------
    scene : Scene
    meshes : tuple of Pictured
        At least one.
    recipe : Recipe, optional
        What ran on the mesh since it was opened.
    """

    scene: Scene
    meshes: tuple[Pictured, ...]
    recipe: Recipe | None = None

    @property
    def panels(self) -> tuple[Panel, ...]:
        """The pictures on its page."""
        return self.scene.panels_of(len(self.meshes))

    @property
    def first(self) -> Pictured:
        """The mesh of the first panel."""
        return self.meshes[self.panels[0].mesh - 1]


def carrying(scene: Scene, meshes: Sequence[Pictured], recipe: Recipe | None = None) -> dict[str, str]:
    """The texts that a picture of a scene carries, by keyword."""
    from hexmend import __version__

    texts = {_SCENE: to_toml(scene), _ABOUT: table_text(_About(__version__, tuple(meshes)))}
    return texts | ({} if recipe is None else {_RECIPE: recipes.to_toml(recipe)})


def read_carried(path: str | os.PathLike[str]) -> Carried:
    """What a picture carries.

    Raises
    ------
    FileError
        Where it carries no scene, or one that cannot be used: it names the key.
    """
    found = png.texts(path, (_SCENE, _ABOUT, _RECIPE))
    if _SCENE not in found or _ABOUT not in found:
        raise FileError(Path(path), "this picture carries no scene", "Open the mesh that it shows.")
    try:
        scene, about = from_toml(found[_SCENE]), made(_About, parse_toml(found[_ABOUT], "its meshes"))
        recipe = recipes.from_toml(found[_RECIPE]) if _RECIPE in found else None
        if not about.meshes:
            raise ParameterError("there is no mesh")
        scene.panels_of(len(about.meshes))
    except ParameterError as error:
        raise FileError(Path(path), f"the scene that it carries cannot be used: {error}", "Open the mesh.") from None
    return Carried(scene, about.meshes, recipe)


def digest(mesh: Mesh) -> str:
    """What is the same for meshes with the same hexes and the same places of their nodes alone, 64 digits."""
    answer = hashlib.sha256(f"{mesh.n_nodes} {mesh.n_hexes}".encode())
    answer.update(np.ascontiguousarray(mesh.points, dtype="<f8"))
    answer.update(np.ascontiguousarray(mesh.hexes, dtype="<i8"))
    return answer.hexdigest()


def _from(file: Path | None, picture: Path) -> str:
    """A file as seen from the folder of a picture, "" where that cannot be said."""
    if file is None:
        return ""
    try:
        text = Path(os.path.relpath(file.resolve(), picture.resolve().parent)).as_posix()
    except ValueError:  # on another drive
        text = file.name
    if len(text) > _LONGEST or not text.isprintable() or "\\" in text or ":" in text:
        return ""
    return text
