"""Viewer of Hexmend: the window, pictures, films and reports."""

from hexmend.hooks import register_hooks

register_hooks(scene_layers="hexmend_app.scene.layers.optional_layer:load_layers")
