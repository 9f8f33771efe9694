"""Viewer of Hexmend: the window, pictures, films and reports."""

from hexmend.aliases import MODULES as _OLD_NAMES
from hexmend.hooks import register_hooks
from hexmend_app.aliases import MODULES as _APP_OLD_NAMES

_OLD_NAMES |= _APP_OLD_NAMES

register_hooks(scene_layers="hexmend_app.scene.layers.optional_layer:load_layers")
