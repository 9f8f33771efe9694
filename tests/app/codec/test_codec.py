"""Conversion of values to codec data and back by declared types; errors name the place of invalid data."""

from __future__ import annotations

import json
from dataclasses import dataclass, field

import pytest

from hexmend.run import StoppingCriteria
from hexmend.run.breakpoints import Breakpoints
from hexmend_app.codec.codec import Codec, DecodeError, TypeAdapter
from hexmend_app.picture.appearance import (
    Arrows,
    ColourScale,
    Isolation,
    Look,
    RangeMode,
    Since,
    Structure,
    Traces,
    ValueRange,
)
from hexmend_app.picture.cut_planes import BoxClip, ClipPlane, PlaneClip


@dataclass(frozen=True)
class Pair:
    """Types that a `Look` does not contain."""

    first: tuple[int, str]
    table: dict[str, float]
    later: int = field(default=3, init=False)


LOOKS = [
    Look(),
    Look(clip=PlaneClip((ClipPlane((1, 2, 3), (0.1, 0.2, 0.3)), ClipPlane()), crinkle=False, notch=True)),
    Look(clip=BoxClip((0, 0, 0), (1, 2, 3)), isolation=Isolation((3, 1), 2), dug=frozenset({5, 2})),
    Look(
        scale=ColourScale("shape", "plasma", RangeMode.PINNED, (0.1, 0.9), True),
        quality_range=ValueRange("q", -float("inf"), 0.5),
        structure=Structure(sharp=True),
        traces=Traces(Since.RUN, Arrows.ALL, 3),
    ),
]


@pytest.mark.parametrize("value", [*LOOKS, Breakpoints(node=3, backtracks=1), Pair((1, "a"), {"b": 2.0})])
def test_decoding_encoded_values_returns_equal_values(value):
    codec = Codec({})
    data = json.loads(json.dumps(codec.encode(value, type(value))))
    assert codec.decode(data, type(value)) == value


@pytest.mark.parametrize(("kind", "change", "message"), [
    (Look, {"colour": 1}, "look has an unknown field 'colour'"),
    (Look, {"edges": 1}, "look.edges is of another type: expected bool"),
    (Look, {"peel": True}, "look.peel is of another type: expected int"),
    (Look, {"peel": 1.5}, "look.peel is of another type: expected int"),
    (Look, {"dug": {}}, "look.dug is of another type: expected list"),
    (Look, {"dug": [1, "a"]}, r"look.dug\[1\] is of another type"),
    (Look, {"clip": {"Sphere": {}}}, "look.clip is none of PlaneClip, BoxClip"),
    (Look, {"clip": {"PlaneClip": {"planes": [], "crinkle": True, "notch": False}}}, "look.clip: the cut has no plane"),
    (Pair, {"first": [1]}, "look.first has 1 entries: expected 2"),
    (Pair, {"table": {"b": "c"}}, "look.table.b is of another type: expected float"),
    (StoppingCriteria, {"max_iterations": -1}, "max_iterations = -1 is out of range"),
])  # fmt: skip
def test_errors_name_the_place_of_invalid_data(kind, change, message):
    codec = Codec({})
    value = Pair((1, "a"), {}) if kind is Pair else kind()
    with pytest.raises(DecodeError, match=message):
        codec.decode(codec.encode(value, kind) | change, kind, "look")


def test_a_missing_field_is_an_error():
    data = Codec({}).encode(Look(), Look)
    del data["edges"]
    with pytest.raises(DecodeError, match="look has no field 'edges'"):
        Codec({}).decode(data, Look, "look")


def test_a_type_can_have_an_adapter():
    codec = Codec({Since: TypeAdapter(lambda since: since.name, lambda name: Since[name])})
    data = codec.encode(Traces(Since.RUN), Traces)
    assert data["since"] == "RUN"
    assert codec.decode(data, Traces) == Traces(Since.RUN)
    with pytest.raises(DecodeError, match="NEVER"):
        codec.decode(data | {"since": "NEVER"}, Traces)


def test_a_field_is_read_under_its_former_name():
    codec = Codec({}, former={Traces: {"since": "from"}})
    data = codec.encode(Traces(Since.RUN), Traces)
    assert codec.decode(data, Traces) == Traces(Since.RUN)
    earlier = {{"since": "from"}.get(name, name): one for name, one in data.items()}
    assert codec.decode(earlier, Traces) == Traces(Since.RUN)
    with pytest.raises(DecodeError, match="an unknown field 'from'"):
        codec.decode(data | earlier, Traces)
