"""Registry of the layers that users switch on and off: names, texts and defaults, without Qt and VTK."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.hooks import hook
from hexmend.registry import Registry


@dataclass(frozen=True)
class LayerSwitch:
    """Declaration of a layer that users switch on and off.

    Parameters
    ----------
    name : str
        Name in sessions, scenes and on the command line.
    title, help : str
        Text and tooltip of its check box in the panel.
    empty : str
        Tooltip of the check box while the mesh has nothing to draw.
    action, action_help : str
        Text and help of its menu entry; by default title and help.
    keys : str
        Shortcut.
    order : int
        Position in panel and menu.
    hidden_when_empty : bool
        Hide the row in the panel if the mesh has nothing to draw.
    drawn_by : type, optional
        Subclass of `hexmend_app.scene.layers.optional_layer.OptionalLayer`; None if `StructureLayers` draws the layer.
    """

    name: str
    title: str
    help: str
    empty: str = "None in this mesh."
    action: str = ""
    action_help: str = ""
    keys: str = ""
    order: int = 100
    hidden_when_empty: bool = False
    drawn_by: type | None = None


def _load() -> None:
    hook("scene_layers")()


LAYERS: Registry[LayerSwitch] = Registry("layer", _load)

#: Layers that are on until the user switches them off.
ON_BY_DEFAULT = frozenset({"curved"})

#: Layers that draw edges found by the structure of the mesh.
EDGE_LAYERS = ("irregular", "boundary", "sharp")


def ordered_layers() -> list[LayerSwitch]:
    """Return all switches in the order of panel and menu."""
    return sorted(LAYERS.values(), key=lambda switch: switch.order)
