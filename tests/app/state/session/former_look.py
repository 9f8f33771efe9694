"""The look of a view as sessions of the versions 1 to 5 have it, which differs from the tables of scenes."""

from __future__ import annotations

from typing import Any

LAYERS = ("irregular", "boundary", "sharp", "fixed", "free", "locked", "kinds", "original")


def former_look(**changed: Any) -> dict[str, Any]:
    """Return the data of the default look in version 1."""
    look = {
        "clip": None,
        "peel": 0,
        "isolation": None,
        "dug": [],
        "outline": True,
        "shrink": 0.0,
        "quality_range": None,
        "scale": {"metric": "q", "map": "viridis", "mode": "full", "pinned": [0.0, 1.0], "reverse": False},
        "edges": True,
        "shading": True,
        "neutral": False,
        "structure": {**dict.fromkeys(LAYERS, False), "others": True},
        "traces": {"since": "opened", "arrows": "none", "factor": 1.0},
    }
    return {**look, **changed}


def without_later_fields(data: Any) -> Any:
    """Return the data of a session without the fields of meshes and documents that later versions introduced."""
    if isinstance(data, dict):
        later = {"side_set_types", "periodic_pairs", "files", "rules", "measuring"}
        return {key: without_later_fields(value) for key, value in data.items() if key not in later}
    return [without_later_fields(value) for value in data] if isinstance(data, list) else data
