"""Metadata of pictures: the scene, its meshes, the recipe that was run, and the version of the program."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import numpy as np
from PIL import Image

import hexmend.run.recipe as recipes
from hexmend.errors import FileError, ParameterError
from hexmend.io.format_lookup import format_by_place
from hexmend.mesh.mesh import Mesh
from hexmend.run.recipe import Recipe
from hexmend.toml_text import parse_toml
from hexmend_app.codec.conversion import ConfigTable, decode, option
from hexmend_app.picture.camera import MAX_PANELS, PicturePanel
from hexmend_app.picture.scene import Scene
from hexmend_app.picture.scene_files import from_toml, table_text, to_toml

#: Keywords of the PNG texts.
_SCENE, _ABOUT, _RECIPE = "hexmend scene", "hexmend meshes", "hexmend recipe"

_SIGNATURE = b"\x89PNG\r\n\x1a\n"

#: Maximum length of a path.
_MAX_PATH = 1000


@dataclass(frozen=True)
class PicturedMesh(ConfigTable):
    """Mesh that a picture shows.

    Parameters
    ----------
    file : str
        Path of the file of the mesh, relative to the folder of the picture.
    opened : str
        Digest of the mesh as opened.
    shown : str
        Digest of the mesh as shown.
    """

    file: str = option("", most=_MAX_PATH)
    opened: str = option("")
    shown: str = option("")

    def check(self) -> None:
        """Raise `ParameterError` for an invalid path or digest."""
        if "\\" in self.file or ":" in self.file or PurePosixPath(self.file).is_absolute():
            raise ParameterError(
                f"file = {self.file!r} is not a path relative to the picture: expected, for example, ../mesh.vtu"
            )
        for value in (self.opened, self.shown):
            if not re.fullmatch("[0-9a-f]{64}", value):
                raise ParameterError(f"{value!r} is no digest: expected 64 hexadecimal digits")

    @classmethod
    def of(cls, opened: Mesh, shown: Mesh, file: Path | None, picture: Path) -> PicturedMesh:
        """Return the entry of a mesh that was opened from a file."""
        return cls(_relative_path(file, picture), digest(opened), digest(shown))

    def candidates(self, picture: Path) -> list[Path]:
        """List existing paths of the file of the mesh: the original path, then the folder of the picture."""
        if not self.file:
            return []
        paths = (picture.parent / self.file, picture.parent / PurePosixPath(self.file).name)
        return [path for path in paths if path.is_file() or format_by_place(path)]


@dataclass(frozen=True)
class _About(ConfigTable):
    """Entries of the metadata other than the scene.

    Parameters
    ----------
    version : str
        Version of Hexmend.
    meshes : tuple of PicturedMesh
        Meshes in the order of their numbers in the scene.
    """

    version: str = option("")
    meshes: tuple[PicturedMesh, ...] = option((), most=MAX_PANELS)


@dataclass(frozen=True)
class PictureMetadata:
    """Metadata of a picture.

    Parameters
    ----------
    scene : Scene
    meshes : tuple of PicturedMesh
        At least one mesh.
    recipe : Recipe, optional
        Methods that were run on the mesh since it was opened.
    """

    scene: Scene
    meshes: tuple[PicturedMesh, ...]
    recipe: Recipe | None = None

    @property
    def panels(self) -> tuple[PicturePanel, ...]:
        """Panels of the page."""
        return self.scene.panels_of(len(self.meshes))

    @property
    def first(self) -> PicturedMesh:
        """Mesh of the first panel."""
        return self.meshes[self.panels[0].mesh - 1]


def with_metadata(scene: Scene, meshes: Sequence[PicturedMesh], recipe: Recipe | None = None) -> dict[str, str]:
    """Return the metadata of a picture of a scene, as texts by keyword."""
    from hexmend import __version__

    texts = {_SCENE: to_toml(scene), _ABOUT: table_text(_About(__version__, tuple(meshes)))}
    return texts | ({} if recipe is None else {_RECIPE: recipes.to_toml(recipe)})


def read_metadata(path: str | os.PathLike[str]) -> PictureMetadata:
    """Read the metadata of a picture.

    Raises
    ------
    FileError
        If the picture contains no scene, or an invalid one; the message names the key.
    """
    found = _texts(Path(path))
    if _SCENE not in found or _ABOUT not in found:
        raise FileError(Path(path), "this picture contains no scene", "Open the mesh that it shows.")
    try:
        scene, about = from_toml(found[_SCENE]), decode(_About, parse_toml(found[_ABOUT], "its meshes"))
        recipe = recipes.from_toml(found[_RECIPE]) if _RECIPE in found else None
        if not about.meshes:
            raise ParameterError("no mesh is listed")
        scene.panels_of(len(about.meshes))
    except ParameterError as error:
        raise FileError(
            Path(path), f"the scene in this picture is invalid: {error}", "Open the mesh that it shows."
        ) from None
    return PictureMetadata(scene, about.meshes, recipe)


def is_png(path: str | os.PathLike[str]) -> bool:
    """Return True if a file begins with the PNG signature."""
    try:
        with open(path, "rb") as file:
            return file.read(len(_SIGNATURE)) == _SIGNATURE
    except (OSError, ValueError):  # the error is reported when the file is read
        return False


def _texts(path: Path) -> dict[str, str]:
    """Return the texts of a PNG by keyword; its pixels are not decoded."""
    try:
        with Image.open(path, formats=["PNG"]) as image:
            return {str(keyword): text for keyword, text in image.info.items() if isinstance(text, str)}
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        problem = getattr(error, "strerror", None) or "the picture is damaged"
        raise FileError(path, f"cannot be read: {problem}", "Copy the picture again.") from None


def digest(mesh: Mesh) -> str:
    """Return a digest of 64 hexadecimal digits, equal only for meshes with the same hexes and node positions."""
    sha = hashlib.sha256(f"{mesh.n_nodes} {mesh.n_elements}".encode())
    sha.update(np.ascontiguousarray(mesh.points, dtype="<f8").data)
    sha.update(np.ascontiguousarray(mesh.elements, dtype="<i8").data)
    return sha.hexdigest()


def _relative_path(file: Path | None, picture: Path) -> str:
    """Return the path of a file relative to the folder of a picture, "" if there is none that can be stored."""
    if file is None:
        return ""
    try:
        text = Path(os.path.relpath(file.resolve(), picture.resolve().parent)).as_posix()
    except ValueError:  # on another drive
        text = file.name
    if len(text) > _MAX_PATH or not text.isprintable() or "\\" in text or ":" in text:
        return ""
    return text
