"""Recipes: data that comes back as it was written, and one clear sentence for what is wrong."""

import re
import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METHODS, FileError, ParameterError, StoppingCriteria, read_recipe, write_recipe
from hexmend.parameters import declared
from hexmend.run.recipe import Recipe, Stage, from_toml, to_toml

HEAD = 'format = 1\ntitle = "T"\n'


def values(one):
    """Values that a parameter admits."""
    if one.choices is not None:
        return st.sampled_from(one.choices)
    if one.type is bool:
        return st.booleans()
    if one.type is str:
        return st.text(st.characters(codec="utf-8"))
    if one.type is int:
        return st.integers(one.low, one.high)
    words = [word for word in (one.no_limit, one.automatic, "0.5%" * bool(one.percent_of)) if word]
    numbers = st.floats(one.low, one.high)
    return numbers | st.sampled_from(words) if words else numbers


def made(cls):
    return st.builds(cls, **{one.name: values(one) for one in declared(cls)})


STAGES = st.builds(Stage, st.one_of([made(cls) for cls in METHODS.values()]), made(StoppingCriteria))
TEXT = st.text(st.characters(codec="utf-8"), min_size=1)
RECIPES = st.builds(Recipe, TEXT, st.lists(STAGES, min_size=1, max_size=4).map(tuple))


@given(RECIPES)
def test_a_recipe_comes_back_as_it_was_written(recipe):
    assert from_toml(to_toml(recipe)) == recipe


@pytest.mark.parametrize("name", METHODS)
def test_every_value_of_every_method_is_written(name):
    (stage,) = tomllib.loads(to_toml(Recipe.of(name)))["stage"]
    assert stage["method"] == name
    assert set(stage["parameters"]) == {one.name for one in declared(METHODS[name])}
    assert set(stage["stop"]) == {one.name for one in declared(StoppingCriteria)}


def test_what_a_file_does_not_name_has_its_default():
    recipe = from_toml(HEAD + '[[stage]]\nmethod = "local-sd"\nparameters.p = 4\n[[stage]]\nmethod = "mend"')
    assert recipe == Recipe.of(METHODS["local-sd"](p=4), "mend", title="T")


@pytest.mark.parametrize(("written", "read"), [("0", 0.0), ('"unlimited"', "unlimited")])
def test_a_surface_tolerance_is_a_number_or_unlimited(written, read):
    stage = f'[[stage]]\nmethod = "mend"\nparameters = {{ boundary = "slide", surface_tolerance = {written} }}'
    recipe = from_toml(HEAD + stage)
    assert recipe.stages[0].smoother.surface_tolerance == read
    assert from_toml(to_toml(recipe)) == recipe


def test_a_file_is_written_and_read(tmp_path):
    path, recipe = (
        tmp_path / "two.toml",
        Recipe.of("getme", Stage(METHODS["mend"](p=3), StoppingCriteria(max_iterations=7))),
    )
    write_recipe(path, recipe)
    assert read_recipe(path) == recipe
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))  # as some editors leave it
    assert read_recipe(path) == recipe


def test_a_recipe_without_a_stage_is_none():
    with pytest.raises(ParameterError, match="at least one"):
        Recipe("empty", ())


STAGE = '[[stage]]\nmethod = "getme"\n[[stage]]\n'


@pytest.mark.parametrize(("text", "said"), [
    ("format = 1\ntitle = \n", "is not TOML: invalid value (at line 2, column 9)"),
    ('format = 1\ntitle = "', "is not TOML: unterminated string (at line 2, column 10, the end)"),
    ("n = " + "9" * 5000, "is not TOML"),
    ("a = " + "[" * 5000, "nested too deeply"),
    ('title = "T"', "the recipe has no format: expected  format = 1"),
    ("format = 3", "format = 3 is not read: expected 1; use the Hexmend that wrote it"),
    ('format = "1"', "format = '1' is not read: expected 1"),
    (HEAD, "has no stage: expected [[stage]]"),
    (HEAD + "stage = 3", "has no stage: expected [[stage]]"),
    (HEAD + "stages = 3", "the recipe has no key 'stages': did you mean stage?"),
    ("format = 1\ntitle = 3", "title = 3 is not a text"),
    (HEAD + STAGE + 'method = "mned"', "stage 2: there is no method 'mned': did you mean mend?"),
    (HEAD + STAGE + "method = [1]", "stage 2: there is no method '[1]'"),
    (HEAD + STAGE + 'methd = "mend"', "stage 2: the stage has no key 'methd': did you mean method?"),
    (HEAD + STAGE, "stage 2: it has no method: expected a line such as"),
    (HEAD + STAGE + 'method = "mend"\nparameters.ofset = 1', "stage 2: mend has no parameter 'ofset': did you mean offset?"),
    (HEAD + STAGE + 'method = "mend"\nparameters.p = 99', "stage 2: p = 99 is out of range: expected a number from 1 to 32"),
    (HEAD + STAGE + 'method = "mend"\nparameters.p = nan', "stage 2: p = nan is not a number"),
    (HEAD + STAGE + 'method = "mend"\nparameters.p = "two"', "stage 2: p = 'two' is not a number"),
    (HEAD + STAGE + 'method = "mend"\nstop.keep_last = 1', "stage 2: keep_last = 1 is not a switch: expected true or false"),
    (HEAD + STAGE + 'method = "mend"\nparameters = 1', "stage 2: parameters = 1 is not a table"),
    (HEAD + STAGE + 'method = "mend"\nstop.max_iteration = 1', "stage 2: stop has no parameter 'max_iteration': did you mean max_iterations?"),
    (HEAD + STAGE + 'method = "mend"\nstop.max_iterations = 1.5', "stage 2: max_iterations = 1.5 is not a whole number"),
])  # fmt: skip
def test_what_is_wrong_is_said_with_its_place(text, said, tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(FileError) as error:
        read_recipe(path)
    assert str(error.value).startswith("wrong.toml: ")
    assert said in str(error.value)


def test_files_that_are_no_text_are_said(tmp_path):
    (tmp_path / "mesh.toml").write_bytes(b"format = 1\n\xff\xfe")
    with pytest.raises(FileError, match="line 2 holds bytes that are not UTF-8"):
        read_recipe(tmp_path / "mesh.toml")
    with pytest.raises(FileError, match="is a folder: expected a recipe"):
        read_recipe(tmp_path)
    with pytest.raises(FileError, match=r"no such file .* Did you mean mesh.toml"):
        read_recipe(tmp_path / "mash.toml")


def test_the_recipe_of_the_docs_is_one():
    text = (Path(__file__).resolve().parents[3] / "docs" / "methods" / "recipes.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    assert [stage.smoother.name for stage in from_toml(example).stages] == ["getme", "mend"]
