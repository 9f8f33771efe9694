"""Boundary layers: stacks of thin hexes on a wall, found from their heights, kept by targets, and reported."""

from hexmend.layers.detection import find_layers, layers_on_sets
from hexmend.layers.report import (
    LayerReport,
    LayerState,
    describe_layers,
    describe_losses,
    grading_message,
    layer_report,
)
from hexmend.layers.targets import KEEP_LAYERS, keeps_layers, named_walls, run_target
from hexmend.layers.walls import Layers, Wall

__all__ = [
    "KEEP_LAYERS",
    "LayerReport",
    "LayerState",
    "Layers",
    "Wall",
    "describe_layers",
    "describe_losses",
    "find_layers",
    "grading_message",
    "keeps_layers",
    "layer_report",
    "layers_on_sets",
    "named_walls",
    "run_target",
]
