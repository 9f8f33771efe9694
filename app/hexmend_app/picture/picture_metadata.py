"""Metadata in a picture: the scene, its meshes, the runs on them, and the program."""

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
from hexmend_app.codec.config_table import ConfigTable, decode, option
from hexmend_app.picture import png_text
from hexmend_app.picture.camera import MOST, PicturePanel
from hexmend_app.picture.scene import Scene
from hexmend_app.picture.scene_files import from_toml, table_text, to_toml

#: Keywords of the texts in a PNG.
_SCENE, _ABOUT, _RECIPE = "hexmend scene", "hexmend meshes", "hexmend recipe"

#: Letters of a path.
_LONGEST = 1000


@dataclass(frozen=True)
class PicturedMesh(ConfigTable):
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

    file: str = option("", most=_LONGEST)
    opened: str = option("")
    shown: str = option("")

    def check(self) -> None:
        """A path that stays in the file system, and digests."""
        if "\\" in self.file or ":" in self.file or PurePosixPath(self.file).is_absolute():
            raise ParameterError(f"file = {self.file!r} is no path from the picture: expected one such as ../mesh.vtu")
        for one in (self.opened, self.shown):
            if not re.fullmatch("[0-9a-f]{64}", one):
                raise ParameterError(f"{one!r} is no digest: expected 64 digits")

    @classmethod
    def of(cls, opened: Mesh, shown: Mesh, file: Path | None, picture: Path) -> PicturedMesh:
        """A mesh as it was opened from a file, and as it is shown."""
        return cls(_from(file, picture), digest(opened), digest(shown))

    def candidates(self, picture: Path) -> list[Path]:
        """List the paths at which its file may be: the original one, then the picture's folder."""
        if not self.file:
            return []
        found = (picture.parent / self.file, picture.parent / PurePosixPath(self.file).name)
        return [path for path in found if path.is_file()]


@dataclass(frozen=True)
class _About(ConfigTable):
    """Entries of the metadata other than the scene.

    Parameters
    ----------
    version : str
        Of Hexmend.
    meshes : tuple of Pictured
        By their numbers in the scene.
    """

    version: str = option("")
    meshes: tuple[PicturedMesh, ...] = option((), most=MOST)


@dataclass(frozen=True)
class PictureMetadata:
    """Metadata in a picture.

    Parameters
    ----------
    scene : Scene
    meshes : tuple of Pictured
        At least one.
    recipe : Recipe, optional
        What ran on the mesh since it was opened.
    """

    scene: Scene
    meshes: tuple[PicturedMesh, ...]
    recipe: Recipe | None = None

    @property
    def panels(self) -> tuple[PicturePanel, ...]:
        """The pictures on its page."""
        return self.scene.panels_of(len(self.meshes))

    @property
    def first(self) -> PicturedMesh:
        """The mesh of the first panel."""
        return self.meshes[self.panels[0].mesh - 1]


def with_metadata(scene: Scene, meshes: Sequence[PicturedMesh], recipe: Recipe | None = None) -> dict[str, str]:
    """The texts that a picture of a scene carries, by keyword."""
    from hexmend import __version__

    texts = {_SCENE: to_toml(scene), _ABOUT: table_text(_About(__version__, tuple(meshes)))}
    return texts | ({} if recipe is None else {_RECIPE: recipes.to_toml(recipe)})


def read_metadata(path: str | os.PathLike[str]) -> PictureMetadata:
    """Read the metadata in a picture.

    Raises
    ------
    FileError
        Where it carries no scene, or one that cannot be used: it names the key.
    """
    found = png_text.texts(path, (_SCENE, _ABOUT, _RECIPE))
    if _SCENE not in found or _ABOUT not in found:
        raise FileError(Path(path), "this picture carries no scene", "Open the mesh that it shows.")
    try:
        scene, about = from_toml(found[_SCENE]), decode(_About, parse_toml(found[_ABOUT], "its meshes"))
        recipe = recipes.from_toml(found[_RECIPE]) if _RECIPE in found else None
        if not about.meshes:
            raise ParameterError("there is no mesh")
        scene.panels_of(len(about.meshes))
    except ParameterError as error:
        raise FileError(Path(path), f"the scene that it carries cannot be used: {error}", "Open the mesh.") from None
    return PictureMetadata(scene, about.meshes, recipe)


def digest(mesh: Mesh) -> str:
    """Compute a digest of 64 digits that is equal only for meshes with the same hexes and node positions."""
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
