"""Conversion of values to plain data and back by declared types; errors name the place of invalid data."""

import json
from dataclasses import dataclass, field

import pytest

from hexmend import ParameterError, StoppingCriteria
from hexmend_app.codec.conversion import DecodeError, decode, encode
from hexmend_app.picture import Box, Colours, Cut, CutStyle, Isolate, Plane, Show
from hexmend_app.picture.appearance import Arrows, Look, Since, Structure, Traces
from hexmend_app.state.run.breakpoints import Breakpoints


@dataclass(frozen=True)
class Pair:
    """Types that a `Look` does not contain."""

    first: tuple[int, str]
    table: dict[str, float]
    later: int = field(default=3, init=False)


@dataclass(frozen=True)
class Ring:
    """Fields of types that have errors of their own."""

    edges: bool = True
    peel: int = 0
    hexes: frozenset[int] = frozenset({3, 1})
    part: Pair | None = None


LOOKS = [
    Look(),
    Look(cut=Cut((Plane((1, 2, 3), point=(0.1, 0.2, 0.3)), Plane(point=(0, 0, 0))), style=CutStyle.SMOOTH, notch=True)),
    Look(cut=Cut(box=Box((0, 0, 0), (1, 2, 3))), show=Show(isolate=Isolate((3, 1), 2), hidden=frozenset({5, 2}))),
    Look(
        structure=Structure.of("sharp"),
        movement=Traces(Since.RUN, Arrows.ALL, 3),
        colours=Colours(metric="shape", map="plasma", range=(0.1, 0.9), reverse=True),
        show=Show(quality=(-float("inf"), 0.5)),
    ),
]


@pytest.mark.parametrize(
    "value", [*LOOKS, Ring(part=Pair((1, "a"), {})), Breakpoints(node=3, backtracks=1), Pair((1, "a"), {"b": 2.0})]
)
def test_decoding_encoded_values_returns_equal_values(value):
    data = json.loads(json.dumps(encode(value)))
    assert decode(type(value), data) == value


@pytest.mark.parametrize(("kind", "change", "message"), [
    (Look, {"colour": 1}, r"\[look\] has an unknown key 'colour'"),
    (Look, {"show": {"peel": True}}, r"\[look\] show peel = True is not a whole number"),
    (Look, {"show": {"peel": -1}}, r"peel = -1 is out of range: expected a whole number from 0 to 100,000"),
    (Look, {"show": {"hidden": {}}}, r"\[look\] show hidden = {} is not a list"),
    (Look, {"show": {"hidden": [1, "a"]}}, r"\[look\] show hidden = 'a' is not a whole number"),
    (Look, {"show": {"quality": [0.5]}}, r"quality = \[0.5\] has 1 entries: expected 2"),
    (Look, {"show": {"metric": "a\n"}}, "is not a line of text: expected 200 characters at most"),
    (Look, {"cut": {"cone": {}}}, r"\[look\] cut has an unknown key 'cone'"),
    (Look, {"cut": {"style": "rough"}}, "style = 'rough' is unknown: expected crinkle, smooth"),
    (Ring, {"edges": 1}, r"\[look\] edges = 1 is not a boolean: expected true or false"),
    (Ring, {"peel": 1.5}, r"\[look\] peel = 1.5 is not a whole number"),
    (Ring, {"part": {"first": [1, "a"]}}, r"\[look\] part has no key 'table'"),
    (Pair, {"table": {"b": "c"}}, r"\[look\] table = .* is not a number"),
    (StoppingCriteria, {"max_iterations": -1}, "max_iterations = -1 is out of range"),
])  # fmt: skip
def test_errors_name_the_place_of_invalid_data(kind, change, message):
    value = Pair((1, "a"), {"b": 1.0}) if kind is Pair else kind()
    with pytest.raises(DecodeError, match=message):
        decode(kind, encode(value) | change, ("look",))


def test_a_missing_key_has_its_default():
    data = encode(Traces(factor=3))
    del data["since"]
    assert decode(Traces, data) == Traces(factor=3)


def test_a_type_can_have_a_hook():
    data = encode(Traces(Since.RUN), {Since: lambda since: since.name})
    assert data["since"] == "RUN"
    hooks = {Since: lambda name: Since[name]}
    assert decode(Traces, data, hooks=hooks) == Traces(Since.RUN)
    with pytest.raises(DecodeError, match="NEVER"):
        decode(Traces, data | {"since": "NEVER"}, hooks=hooks)


@pytest.mark.parametrize("hexes", [(1, True), (1, 2.0), (1, -1), (1, 2**31), (1, "a"), (1, None)])
def test_each_entry_of_a_list_of_integers_is_checked(hexes):
    for kind, name in ((Show, "hidden"), (Isolate, "hexes")):
        with pytest.raises(ParameterError, match=f"{name} = "):
            kind(**{name: hexes})
