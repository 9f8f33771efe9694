"""Scenes and cameras as TOML text."""

from __future__ import annotations

import json
import os
import re
from typing import Any

from hexmend.errors import ParameterError
from hexmend.io.storage.toml_files import read_toml, write_toml
from hexmend.toml_text import parse_toml
from hexmend_app.codec.conversion import ConfigTable, decode, encode
from hexmend_app.codec.option import options_of
from hexmend_app.picture.camera import Camera
from hexmend_app.picture.scene import Scene

#: Maximum length of the text of a scene, which may list hexes.
LARGEST = 4_000_000

_HEADER = "# hexmend scene\n"


def to_toml(scene: Scene, whole: bool = True) -> str:
    """Return a scene as TOML text.

    Parameters
    ----------
    scene : Scene
    whole : bool
        Write all values, so that the file does not depend on defaults; otherwise omit default values.
    """
    lines, defaults = [_HEADER + f"format = {scene.format}"], Scene()
    for option in options_of(Scene):
        value = getattr(scene, option.field)
        if option.name == "format":
            continue
        if option.name == "cameras":
            for name, camera in value.items():
                lines += ["", f"[cameras.{_key(name)}]", *_rows(camera)]
        elif option.name == "panels":
            for panel in value:
                lines += ["", "[[panels]]", *_rows(panel)]
        elif rows := _rows(value, None if whole else getattr(defaults, option.field)):
            lines += ["", f"[{option.name}]", *rows]
    return "\n".join(lines) + "\n"


def table_text(table: ConfigTable) -> str:
    """Return a single table as TOML text."""
    return "\n".join(_rows(table)) + "\n"


def from_toml(text: str) -> Scene:
    """Parse a scene from TOML text.

    Raises
    ------
    ParameterError
        If the text is no valid scene; the message names line and column, or table, key and expected value.
    """
    return decode(Scene, parse_toml(text, "a scene", LARGEST))


def camera_text(camera: Camera) -> str:
    """Return a camera as one line of text, as accepted by `hexmend render --camera`."""
    return _value(encode(camera))


def camera_from(text: str) -> Camera:
    """Parse a camera from one line of text.

    Raises
    ------
    ParameterError
        If the text is no valid camera.
    """
    text = text.strip().removeprefix("camera").lstrip(" =")
    if not text.startswith("{") or "\n" in text:
        raise ParameterError('the text is no camera: expected one line, for example { from = "iso", up = "z" }')
    return decode(Camera, parse_toml(f"camera = {text}", "a camera").get("camera"), ("camera",))


def read_scene(path: str | os.PathLike[str]) -> Scene:
    """Read a scene from a TOML file.

    Raises
    ------
    FileError
        If the file cannot be read or is no scene; the message names the line, or the table and the key.
    """
    return read_toml(path, "a scene", from_toml, LARGEST)


def write_scene(path: str | os.PathLike[str], scene: Scene) -> None:
    """Write a scene to a TOML file atomically; if writing fails, an existing file is left unchanged.

    Raises
    ------
    FileError
        For a suffix other than .toml, or if the file cannot be written.
    """
    write_toml(path, "a scene", to_toml(scene))


def _rows(table: Any, defaults: Any = None) -> list[str]:
    """Return a line for each key, except keys with the same value as in another table."""
    omitted = {} if defaults is None else encode(defaults)
    return [f"{_key(k)} = {_value(v)}" for k, v in encode(table).items() if k not in omitted or omitted[k] != v]


def _key(name: str) -> str:
    return name if re.fullmatch("[A-Za-z0-9_-]+", name) else _value(name)


def _value(value: Any) -> str:
    """Return a value as one line of TOML."""
    if isinstance(value, bool | str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(name)} = {_value(item)}" for name, item in value.items()) + " }"
    return repr(value)
