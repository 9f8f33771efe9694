"""Base class of the layers that users switch on and off, and their registration."""

from __future__ import annotations

import pkgutil
from abc import ABC, abstractmethod
from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend.mesh.mesh import Mesh
from hexmend.registry import load_entry_points
from hexmend_app.picture.layer_switch import LAYERS, LayerSwitch
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.theme.palette import Role

#: Legend entry in the panel: colour of its mark (None for a remark), True for a line instead of a point, text.
LegendEntry = tuple[str | Role | None, bool, str]


class OptionalLayer(ABC):
    """Layer that users switch on and off.

    Subclasses are registered by `@layer(...)` in the modules of `hexmend_app.scene.layers.optional`.

    Parameters
    ----------
    pane : Pane
        Pane whose renderer draws the layer.
    pixel_ratio : float
        Width of a thin line, in pixels.
    """

    @abstractmethod
    def __init__(self, pane: Pane, pixel_ratio: float = 1.0): ...

    @abstractmethod
    def draw(self, frame: Frame, keep: np.ndarray | None) -> None:
        """Draw a frame; called for every frame while the layer is on.

        Parameters
        ----------
        frame : Frame
        keep : (m,) bool, optional
            True for hexes shown whole or in part; None for all.
        """

    @abstractmethod
    def hide(self) -> None:
        """Hide the layer."""

    def set_dark(self, dark: bool) -> None:  # noqa: B027 -- most layers look the same in both themes
        """Use the colours of the dark or of the light theme."""

    @property
    def places(self) -> np.ndarray:
        """Points that a fitted camera includes, (k, 3)."""
        return np.empty((0, 3))

    @property
    def renderers(self) -> tuple[vtkRenderer, ...]:
        """Additional renderers, created by `Pane.overlay`."""
        return ()

    @classmethod
    def legend(cls, mesh: Mesh) -> list[LegendEntry]:
        """Return the legend of a mesh in the panel; empty if there is nothing to draw."""
        return [(None, False, "")]


def layer(name: str, **texts: Any) -> Callable[[type[OptionalLayer]], type[OptionalLayer]]:
    """Return a decorator that registers a layer under a name; `texts` are fields of its `LayerSwitch`."""

    def register(drawn_by: type[OptionalLayer]) -> type[OptionalLayer]:
        LAYERS.add(name, LayerSwitch(name, drawn_by=drawn_by, **texts))
        return drawn_by

    return register


def load_layers() -> None:
    """Import all modules of `hexmend_app.scene.layers.optional` and entry points, which registers their layers."""
    package = import_module("hexmend_app.scene.layers.optional")
    for module in pkgutil.iter_modules(package.__path__):
        import_module(f"{package.__name__}.{module.name}")
    load_entry_points("hexmend.layers", "layer", LAYERS.expect)
