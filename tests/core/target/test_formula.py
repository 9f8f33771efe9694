"""Formulas: arithmetic as Python has it, and nothing else."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.errors import ParameterError
from hexmend.target.formula import FUNCTIONS, evaluate

NUMBERS = st.floats(0.1, 10)


@given(x=NUMBERS, y=NUMBERS)
def test_arithmetic_is_that_of_python(x, y):
    text = "-x + 2 * y ** 2 / (x + 1) - min(x, y) + where(x > y, sin(pi * x), hypot(x, y))"
    expected = -x + 2 * y**2 / (x + 1) - min(x, y) + (math.sin(math.pi * x) if x > y else math.hypot(x, y))
    assert evaluate(text, {"x": np.array([x]), "y": np.array([y])})[0] == pytest.approx([expected])


def test_several_formulas_have_commas_between_them():
    assert [value.tolist() for value in evaluate("x, 2 * x, 1", {"x": np.array([3.0])})] == [[3.0], [6.0], 1.0]


@pytest.mark.parametrize("text", [
    "__import__('os').system('true')", "x.__class__", "x[0]", "(lambda: 1)()", "[x for x in y]", "open('a')", "f'{x}'",
    "x if y else z", "x and y", "'text'", "True", "1j", "sin", "sin(x, out=x)", "print(x)", "x @ x", "x % 2", "x // 2",
    "x := 3", "import os", "", "x +", "x < y < z", "{1: 2}", "*x, y", "sin(*x)", "...", "~x", "x == y", "x\ny", "\0",
])  # fmt: skip
def test_what_is_no_arithmetic_is_refused(text):
    ones = np.ones(2)
    with pytest.raises(ParameterError, match="formula"):
        evaluate(text, {"x": ones, "y": ones, "z": ones})


@pytest.mark.parametrize(("text", "complaint"), [
    ("9" * 400, "too large"),
    ("x" + "+x" * 300, "601 characters: expected at most 500"),
    ("(" * 240 + "x" + ")" * 240, "cannot be parsed"),
    ("sin(x, y)", "sin has 2 arguments: expected 1"),
    ("where(x)", "where has 1 arguments: expected 3"),
    ("a + 1", "a is not allowed"),
])  # fmt: skip
def test_what_is_wrong_is_named(text, complaint):
    with pytest.raises(ParameterError, match=complaint):
        evaluate(text, {"x": np.ones(1), "y": np.ones(1)})


def test_huge_powers_are_infinite_and_take_no_time():
    assert np.isinf(evaluate("9**9**9**9", {})[0])


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_takes_arrays(name):
    count = {"atan2": 2, "hypot": 2, "max": 2, "min": 2, "where": 3}.get(name, 1)
    values = evaluate(f"{name}({', '.join(['x'] * count)})", {"x": np.full(3, 0.5)})[0]
    assert values.shape == (3,)
    assert np.isfinite(values).all()
