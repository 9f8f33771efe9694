"""Declared parameters and registries."""

from dataclasses import dataclass

import numpy as np
import pytest

from hexmend.errors import ParameterError
from hexmend.parameters import Parameter, Parametrised, declared, from_strings, from_values, parameter
from hexmend.registry import Registry


@dataclass(frozen=True)
class Sample(Parametrised):
    rho: float = parameter(0.5, low=0, high=1, unit="m", help="A share.")
    count: int = parameter(3, low=1, help="A number.")
    kind: str = parameter("a", choices=("a", "b"), help="A choice.")
    strict: bool = parameter(False, help="A switch.")
    most: float = parameter(2.0, low=0, high=10, help="A limit.", no_limit="unlimited")


def test_declarations_are_read_off_the_class():
    rho, count, kind, strict, _ = declared(Sample)
    assert (rho.name, rho.type, rho.default, rho.low, rho.high, rho.unit, rho.help) == (
        "rho",
        float,
        0.5,
        0,
        1,
        "m",
        "A share.",
    )
    assert (count.type, kind.choices, strict.type) == (int, ("a", "b"), bool)
    assert rho.to_json()["choices"] is None
    assert kind.to_json()["choices"] == ["a", "b"]


def test_values_come_from_words():
    sample = from_strings(Sample, {"rho": "1e-1", "count": "4", "kind": "b", "strict": "yes"})
    assert sample == Sample(rho=0.1, count=4, kind="b", strict=True)
    assert sample.values() == {"rho": 0.1, "count": 4, "kind": "b", "strict": True, "most": 2.0}


def test_a_limit_may_have_a_word_for_none():
    assert from_strings(Sample, {"most": "unlimited"}).most == Sample(most=float("inf")).most == "unlimited"
    assert from_values(Sample, {"most": "unlimited"}) == Sample(most="unlimited")
    assert Sample(most=0).most == 0
    for wrong in ("none", 11, "nan"):
        with pytest.raises(ParameterError, match="expected a number from 0 to 10, or unlimited"):
            Sample(most=wrong)
    with pytest.raises(ParameterError, match=r"rho = 'unlimited' is not a number: expected a number from 0 to 1$"):
        Sample(rho="unlimited")


@dataclass(frozen=True)
class Distance(Parametrised):
    most: float = parameter(
        "auto", low=0, high=10, help="A limit.", no_limit="unlimited", automatic="auto", percent_of="diagonal"
    )


@pytest.mark.parametrize(("text", "value"), [("auto", "auto"), ("0.50 %", "0.5%"), ("3", 3.0), ("inf", "unlimited")])
def test_a_number_may_be_left_to_the_program_or_be_a_percentage(text, value):
    assert from_strings(Distance, {"most": text}) == from_values(Distance, {"most": text}) == Distance(most=value)
    assert Distance(most=text).most == value
    assert Distance().most == "auto"


@pytest.mark.parametrize("wrong", ["-1%", "101%", "x%", "%", "automatic", "", "nan%"])
def test_a_wrong_percentage_names_what_is_expected(wrong):
    expected = "a number from 0 to 10, a percentage such as 0.5% of the diagonal, auto, or unlimited"
    with pytest.raises(ParameterError, match=f"most = .*: expected {expected}$"):
        Distance(most=wrong)


@pytest.mark.parametrize("name", ["rho", "count", "kind", "strict", "most"])
@pytest.mark.parametrize("value", [np.array([1.0, 2.0]), np.array([1.0]), np.array(["unlimited", "a"]), [1], None])
def test_an_array_is_no_value_of_a_parameter(name, value):
    with pytest.raises(ParameterError, match=f"{name} = .* is .*: expected") as error:
        Sample(**{name: value})
    assert "\n" not in str(error.value)


NOT_ADMITTED = [
    ({"rho": "2"}, "rho = 2 is out of range: expected a number from 0 to 1"),
    ({"rho": "nan"}, "rho = 'nan' is not a number"),
    ({"rho": "much"}, "rho = 'much' is not a number: expected a number from 0 to 1"),
    ({"count": "2.5"}, "count = '2.5' is not a whole number: expected a whole number of at least 1"),
    ({"count": "0"}, "count = 0 is out of range"),
    ({"kind": "c"}, "kind = 'c' is unknown: expected one of a, b"),
    ({"strict": "maybe"}, "strict = 'maybe' is not a switch: expected true or false"),
    ({"rh": "1"}, "sample has no parameter 'rh': did you mean rho?"),
    ({"zzz": "1"}, "known: rho, count, kind, strict"),
]


@pytest.mark.parametrize(("words", "message"), NOT_ADMITTED)
def test_what_is_not_admitted_is_said(words, message):
    with pytest.raises(ParameterError) as error:
        from_strings(Sample, words, owner="sample")
    assert message in str(error.value)


def test_a_registry_knows_its_entries_in_order():
    registry = Registry("shape")
    registry.add("b", 2)
    registry.add("a", 1)
    assert list(registry) == ["b", "a"]
    assert len(registry) == 2
    assert "a" in registry
    assert "c" not in registry
    with pytest.raises(ValueError, match="registered twice"):
        registry.add("a", 3)
    with pytest.raises(ParameterError, match="there is no shape 'c'"):
        registry["c"]


def test_a_text_may_have_suggestions_and_be_another():
    target = Parameter("target", str, "auto", None, None, None, "", "", suggestions=("auto", "ideal"))
    assert target.check("x + 1") == "x + 1"
    assert target.range == "auto, ideal, or another text"
    assert "suggestions" not in target.to_json()
