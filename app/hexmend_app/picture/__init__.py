"""Description of still pictures and their pages, shared by the window, the command line and files.

A `Scene` consists of tables (`Camera`, `Cut`, `Show`, `Colours`, `Page`, ...); its files are TOML, see scene.md.
"""

from hexmend_app.codec.conversion import ConfigTable
from hexmend_app.picture.camera import Camera, PicturePanel, WipeLayout
from hexmend_app.picture.colours import Colours, Range
from hexmend_app.picture.cut import Cut, CutKind, CutStyle
from hexmend_app.picture.cut_shapes import Box, Depth, DepthUnit, Plane, Slab, Sphere
from hexmend_app.picture.page import AxesStyle, Captions, ColourBarStyle, Corner, LineStyle, Page, TextPlace
from hexmend_app.picture.scene import FORMAT, Scene
from hexmend_app.picture.scene_files import camera_from, camera_text, from_toml, read_scene, to_toml, write_scene
from hexmend_app.picture.visibility import Isolate, Show

__all__ = [
    "FORMAT",
    "AxesStyle",
    "Box",
    "Camera",
    "Captions",
    "ColourBarStyle",
    "Colours",
    "ConfigTable",
    "Corner",
    "Cut",
    "CutKind",
    "CutStyle",
    "Depth",
    "DepthUnit",
    "Isolate",
    "LineStyle",
    "Page",
    "PicturePanel",
    "Plane",
    "Range",
    "Scene",
    "Show",
    "Slab",
    "Sphere",
    "TextPlace",
    "WipeLayout",
    "camera_from",
    "camera_text",
    "from_toml",
    "read_scene",
    "to_toml",
    "write_scene",
]
