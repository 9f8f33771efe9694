"""Conversion of the data of session files that earlier versions wrote."""

from __future__ import annotations

from typing import Any

import numpy as np

from hexmend.advice import Advice
from hexmend.aliases import former_attributes
from hexmend.errors import ParameterError
from hexmend.run.recipe import migrate_surface_tolerance
from hexmend_app.codec.codec import DecodeError
from hexmend_app.codec.config_table import encode
from hexmend_app.picture.appearance import with_material_colours
from hexmend_app.picture.cut import CutKind, proposed_cuts
from hexmend_app.state.mesh.run_record import NodeOffsets
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_setup import RunSetupData

#: Former names of fields, by class and current name.
FORMER: dict[type, dict[str, str]] = {
    kind: {now: old for old, now in former_attributes(kind).items()} for kind in (Advice, Breakpoints)
}
FORMER[Advice]["limiting"] = "holding"
FORMER[NodeOffsets] = {"displacements": "ways"}
FORMER[RunSetupData] = {"reason": "why"}

#: The last version in which a surface tolerance of 0 meant that there is no limit.
_ZERO_FOR_NO_LIMIT = 3
#: The last version in which the camera and the settings of panels were fields of their own.
_WITHOUT_FEATURES = 4
#: The last version in which the look of the view differed from the tables of scenes.
_WITHOUT_TABLES = 5
#: The last version in which a layer coloured by material.
_WITH_MATERIAL_LAYER = 6
#: The last version whose files may lack fields that were added within a version.
_WITH_MISSING_FIELDS = 7

#: The last version in which only planes and a box could cut.
_WITH_PLANES_AND_BOX = 8


def migrate(window: Any, version: int) -> Any:
    """Return the data of a window of some version as the current version writes them.

    Raises
    ------
    DecodeError
        If converted data are not of their type.
    """
    if version <= _ZERO_FOR_NO_LIMIT:
        window = migrate_surface_tolerance(window)
    if version <= _WITH_MISSING_FIELDS:
        _add_missing_fields(window, version)
    if version <= _WITHOUT_FEATURES:
        window = _with_features(window)
    if version <= _WITHOUT_TABLES:
        try:
            window = _with_tables(window)
        except (LookupError, TypeError, ValueError, AttributeError) as error:
            raise DecodeError(f"the window's view or cut is not of its type: {error!r}"[:200]) from None
    if version <= _WITH_MATERIAL_LAYER:
        window = _with_material_colours(window)
    if version <= _WITH_PLANES_AND_BOX:
        window = _with_other_cuts(window)
    return window


def _with_other_cuts(window: dict[str, Any]) -> dict[str, Any]:
    """Add proposed cuts by a slab, a sphere and depth, in the middle of the box, to those by planes and by a box."""
    features = window.get("features") if isinstance(window, dict) else None
    former = features.get("cut") if isinstance(features, dict) else None
    if not isinstance(former, dict):
        return window
    try:
        planes, box, kind = former["planes"], former["box"], "box" if former["boxed"] else "planes"
        proposed = proposed_cuts(np.array([box["box"]["low"], box["box"]["high"]], dtype=float))
    except (LookupError, TypeError, ValueError, ParameterError) as error:
        raise DecodeError(f"the window's proposed cuts are not of their type: {error!r}"[:200]) from None
    others = [encode(proposed[kind]) for kind in (CutKind.SLAB, CutKind.SPHERE, CutKind.DEPTH)]
    return {**window, "features": {**features, "cut": {"cuts": [planes, box, *others], "kind": kind}}}


def _with_material_colours(window: dict[str, Any]) -> dict[str, Any]:
    """Convert the layer that coloured by material to a metric of the colours."""
    view = window.get("view") if isinstance(window, dict) else None
    if not isinstance(view, dict) or not isinstance(view.get("look"), dict):  # which is reported where it is decoded
        return window
    return {**window, "view": {**view, "look": with_material_colours(view["look"])}}


def _with_features(window: dict[str, Any]) -> dict[str, Any]:
    """Move the camera and the settings of panels to the data of features."""
    if not isinstance(window, dict) or not isinstance(window.get("choices", {}), dict):
        raise DecodeError("the window or its choices are not a table")
    window = dict(window)
    history = window.pop("journey", {"before": [], "after": [], "left": None})
    camera = {"pose": window.pop("eye", None), "history": history}
    panels = {name: data for name, data in window.pop("choices", {}).items() if data is not None}
    return {**window, "features": {**panels, "camera": camera}}


def _with_tables(window: dict[str, Any]) -> dict[str, Any]:
    """Convert the look of the view and the proposed cuts to tables of scenes."""
    view, features = window["view"], dict(window["features"])
    if "cut" in features:
        planes, box, boxed = (features["cut"][name] for name in ("planes", "box", "boxed"))
        features["cut"] = {"planes": _cut({"PlaneClip": planes}), "box": _cut({"BoxClip": box}), "boxed": boxed}
    return {**window, "view": {**view, "look": _look(view["look"])}, "features": features}


def _look(look: dict[str, Any]) -> dict[str, Any]:
    """Return a look as tables of scenes."""
    clip, left, show = look.get("clip"), look.get("left"), {}
    cut = _cut(clip)
    if left is not None and left.get("clip") == clip:
        cut["hexes"] = ", ".join(f"{first}-{last}" for first, last in left["hexes"])
    if look["quality_range"] is not None:
        show = {name: look["quality_range"][name] for name in ("metric", "inverted")}
        show["quality"] = [look["quality_range"][end] for end in ("low", "high")]
    if look["isolation"] is not None:
        show["isolate"] = look["isolation"]
    scale = look["scale"]
    return {
        "cut": cut,
        "show": {
            **show,
            "hidden": look["dug"],
            **{name: look[name] for name in ("peel", "shrink", "outline")},
        },
        "structure": look["structure"],
        "movement": look["traces"],
        "colours": {
            **{name: scale[name] for name in ("metric", "map", "reverse")},
            "range": scale["pinned"] if scale["mode"] == "pinned" else scale["mode"],
            "neutral": look["neutral"],
        },
        "lines": {} if look["edges"] else {"edges": 0.0},
        "page": {"shading": look["shading"]},
    }


def _cut(clip: dict[str, Any] | None) -> dict[str, Any]:
    """Return a cut, named by its former class, as a table of scenes."""
    if clip is None:
        return {}
    ((name, former),) = clip.items()
    cut = {"style": "crinkle" if former["crinkle"] else "smooth", "notch": former["notch"]}
    if name == "BoxClip":
        return {**cut, "box": {end: former[end] for end in ("low", "high")}}
    planes = [{"normal": plane["normal"], "point": plane["origin"]} for plane in former["planes"]]
    return {**cut, "planes": planes}


def _add_missing_fields(window: Any, version: int) -> None:
    """Give runs, their suggestions and the document the fields that they may lack; the codec reports damaged data."""
    _add_limits(window)
    try:
        if version > _WITHOUT_TABLES:
            window["document"].setdefault("files", None)
        for record in window["history"]["records"]:
            if version > _WITHOUT_TABLES:
                record.setdefault("settings", "")
            for suggestion in record["advice"]["suggestions"] if record["advice"] is not None else ():
                suggestion.setdefault("rules", None)
                suggestion.setdefault("widen", False)
    except (LookupError, TypeError, AttributeError):
        pass


def _add_limits(data: Any) -> None:
    """Give the limits of runs, wherever they are, those that they may lack."""
    if isinstance(data, dict):
        if data.keys() >= {"tolerance", "move", "keep_last"}:
            data.setdefault("moves_only", False)
        for value in data.values():
            _add_limits(value)
    elif isinstance(data, list):
        for value in data:
            if isinstance(value, dict | list):
                _add_limits(value)
