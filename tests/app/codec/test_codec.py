"""Values to plain data and back by their declared types; what does not fit is named with its place."""

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
    """Kinds of types that no look has."""

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
def test_a_value_is_the_same_again_and_is_plain_on_the_way(value):
    plain = Codec({})
    data = json.loads(json.dumps(plain.encode(value, type(value))))
    assert plain.decode(data, type(value)) == value


@pytest.mark.parametrize(("kind", "change", "said"), [
    (Look, {"colour": 1}, "look has an unknown field 'colour'"),
    (Look, {"edges": 1}, "look.edges is of another kind: expected bool"),
    (Look, {"peel": True}, "look.peel is of another kind: expected int"),
    (Look, {"peel": 1.5}, "look.peel is of another kind: expected int"),
    (Look, {"dug": {}}, "look.dug is of another kind: expected list"),
    (Look, {"dug": [1, "a"]}, r"look.dug\[1\] is of another kind"),
    (Look, {"clip": {"Sphere": {}}}, "look.clip is none of PlaneClip, BoxClip"),
    (Look, {"clip": {"PlaneClip": {"planes": [], "crinkle": True, "notch": False}}}, "look.clip: the cut has no plane"),
    (Pair, {"first": [1]}, "look.first has 1 entries: expected 2"),
    (Pair, {"table": {"b": "c"}}, "look.table.b is of another kind: expected float"),
    (StoppingCriteria, {"max_iterations": -1}, "max_iterations = -1 is out of range"),
])  # fmt: skip
def test_what_does_not_fit_is_named_with_its_place(kind, change, said):
    plain = Codec({})
    value = Pair((1, "a"), {}) if kind is Pair else kind()
    with pytest.raises(DecodeError, match=said):
        plain.decode(plain.encode(value, kind) | change, kind, "look")


def test_a_field_that_is_missing_is_named():
    data = Codec({}).encode(Look(), Look)
    del data["edges"]
    with pytest.raises(DecodeError, match="look has no field 'edges'"):
        Codec({}).decode(data, Look, "look")


def test_a_type_may_have_a_way_of_its_own():
    plain = Codec({Since: TypeAdapter(lambda since: since.name, lambda name: Since[name])})
    data = plain.encode(Traces(Since.RUN), Traces)
    assert data["since"] == "RUN"
    assert plain.decode(data, Traces) == Traces(Since.RUN)
    with pytest.raises(DecodeError, match="NEVER"):
        plain.decode(data | {"since": "NEVER"}, Traces)


def test_a_field_is_read_by_its_former_name_too():
    plain = Codec({}, former={Traces: {"since": "from"}})
    data = plain.encode(Traces(Since.RUN), Traces)
    assert plain.decode(data, Traces) == Traces(Since.RUN)
    earlier = {{"since": "from"}.get(name, name): one for name, one in data.items()}
    assert plain.decode(earlier, Traces) == Traces(Since.RUN)
    with pytest.raises(DecodeError, match="an unknown field 'from'"):
        plain.decode(data | earlier, Traces)
