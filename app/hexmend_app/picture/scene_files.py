"""Scenes, and cameras alone, as TOML that people read and write. Only data is read."""

from __future__ import annotations

import json
import math
import os
import re
from typing import Any

from hexmend.errors import ParameterError
from hexmend.io.storage.toml_files import read_toml, write_toml
from hexmend.toml_text import parse_toml
from hexmend_app.codec.config_table import ConfigTable, decode, encode, options_of
from hexmend_app.picture.camera import Camera
from hexmend_app.picture.scene import Scene

#: Letters of a scene, which may name hexes one by one.
LARGEST = 4_000_000

_HEAD = "# hexmend scene\n"


def to_toml(scene: Scene, whole: bool = True) -> str:
    """The scene as TOML text that names every value, so that it means the same when defaults change.

    Without `whole`, what is as in any scene is left out, for people to read.
    """
    lines, usual = [_HEAD + f"format = {scene.format}"], Scene()
    for one in options_of(Scene):
        value = getattr(scene, one.field)
        if one.name == "format":
            continue
        if one.name == "cameras":
            for name, camera in value.items():
                lines += ["", f"[cameras.{_key(name)}]", *_rows(camera)]
        elif one.name == "panels":
            for panel in value:
                lines += ["", "[[panels]]", *_rows(panel)]
        elif rows := _rows(value, None if whole else getattr(usual, one.field)):
            lines += ["", f"[{one.name}]", *rows]
    return "\n".join(lines) + "\n"


def table_text(table: ConfigTable) -> str:
    """A table alone as TOML text."""
    return "\n".join(_rows(table)) + "\n"


def from_toml(text: str) -> Scene:
    """The scene that TOML text describes.

    Raises
    ------
    ParameterError
        Naming line and column where it is no TOML, else the table, the key and what was expected there.
    """
    return decode(Scene, parse_toml(text, "a scene", LARGEST))


def camera_text(camera: Camera) -> str:
    """A camera in one line, as `hexmend render --camera` takes it."""
    return _value(encode(camera))


def camera_from(text: str) -> Camera:
    """The camera that one line describes.

    Raises
    ------
    ParameterError
    """
    text = text.strip().removeprefix("camera").lstrip(" =")
    if not text.startswith("{") or "\n" in text:
        raise ParameterError('a camera is no line of braces: expected one such as { from = "iso", up = "z" }')
    return decode(Camera, parse_toml(f"camera = {text}", "a camera").get("camera"), ("camera",))


def read_scene(path: str | os.PathLike[str]) -> Scene:
    """Read a scene from a TOML file.

    Raises
    ------
    FileError
        Where the file cannot be read or is no scene: it names the line, or the table and the key.
    """
    return read_toml(path, "a scene", from_toml, LARGEST)


def write_scene(path: str | os.PathLike[str], scene: Scene) -> None:
    """Write a scene as a whole or, where that fails, leave what was there.

    Raises
    ------
    FileError
        For a suffix other than .toml, or where the place cannot be written to.
    """
    write_toml(path, "a scene", to_toml(scene))


def _rows(table: Any, usual: Any = None) -> list[str]:
    """A line a key, but for those that are as usual."""
    known = {} if usual is None else encode(usual)
    return [f"{_key(k)} = {_value(v)}" for k, v in encode(table).items() if k not in known or known[k] != v]


def _key(name: str) -> str:
    return name if re.fullmatch("[A-Za-z0-9_-]+", name) else _value(name)


def _value(value: Any) -> str:
    """A value in one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(str(value), ensure_ascii=False)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else "inf" if value > 0 else "-inf"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(name)} = {_value(one)}" for name, one in value.items()) + " }"
    return repr(value)
