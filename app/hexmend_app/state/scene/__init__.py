"""What a still picture shows and on what page: one description for the window, the command line and files.

A `Scene` is made of tables (`Camera`, `Cut`, `Show`, `Colours`, `Page`, ...); as a file it is TOML: docs/figures.md.
"""

from hexmend_app.state.scene.camera import Camera, Panel, Wiped
from hexmend_app.state.scene.cut import Box, Cut, CutStyle, Plane
from hexmend_app.state.scene.page import Axes, Bar, Captions, Corner, Lines, Page, Place
from hexmend_app.state.scene.scene import FORMAT, Scene
from hexmend_app.state.scene.show import Colours, Isolate, Range, Show
from hexmend_app.state.scene.table import Table
from hexmend_app.state.scene.toml import camera_from, camera_text, from_toml, read_scene, to_toml, write_scene

__all__ = [
    "FORMAT",
    "Axes",
    "Bar",
    "Box",
    "Camera",
    "Captions",
    "Colours",
    "Corner",
    "Cut",
    "CutStyle",
    "Isolate",
    "Lines",
    "Page",
    "Panel",
    "Place",
    "Plane",
    "Range",
    "Scene",
    "Show",
    "Table",
    "Wiped",
    "camera_from",
    "camera_text",
    "from_toml",
    "read_scene",
    "to_toml",
    "write_scene",
]
