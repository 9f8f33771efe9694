"""Recipes of studies: combinations of lists, and messages for malformed ones."""

import pytest

from hexmend import FileError, MotionRules, ParameterError, Recipe, write_recipe
from hexmend.study.batch.case import read_case
from hexmend.study.batch.plan import parse_plan, read_plan

CHAIN = '[[stage]]\nmethod = "getme"\nstop = { max_iterations = 7 }\n[[stage]]\nmethod = "mend"\n'


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "chain.toml").write_text(f'format = 1\ntitle = "Chain"\n{CHAIN}')
    return tmp_path


def plan(text, folder):
    return parse_plan(f"format = 1\n{text}", folder)


def test_lists_give_a_case_for_each_combination(folder):
    made = plan(
        """
        title = "All"
        methods = ["laplacian", "chain.toml"]
        [stop]
        max_iterations = 50
        tolerance = [1e-3, 1e-4]
        [task]
        max_memory_mb = 500
        [[method]]
        title = "sd"
        method = "local-sd"
        parameters = { p = [2, 4], delta = 0.1 }
        stop = { max-iterations = [10, 20], tolerance = 0 }
        """,
        folder,
    )
    assert [case.name for case in made.cases] == [
        "laplacian tolerance=0.001",
        "laplacian tolerance=0.0001",
        "Chain tolerance=0.001",
        "Chain tolerance=0.0001",
        "sd p=2 max_iterations=10",
        "sd p=2 max_iterations=20",
        "sd p=4 max_iterations=10",
        "sd p=4 max_iterations=20",
    ]
    last = made.cases[-1]
    assert (last.smoother.p, last.smoother.delta, last.stop.max_iterations, last.stop.tolerance) == (4, 0.1, 20, 0)
    assert [stage.stop.max_iterations for stage in made.cases[2].stages] == [50, 50]
    assert [stage.stop.tolerance for stage in made.cases[3].stages] == [1e-4, 1e-4]
    assert (made.title, made.limits.max_memory_mb, made.limits.max_seconds) == ("All", 500, 0)


def test_a_case_survives_the_round_trip_through_data(folder):
    for case in plan('methods = ["mend", "chain.toml"]', folder).cases:
        again = read_case(case.values())
        assert again == case
        assert isinstance(again.smoother, Recipe) == (case.name == "Chain")


def test_the_boundary_applies_to_methods_without_their_own(folder):
    made = plan(
        """
        methods = ["chain.toml", "mend"]
        [boundary]
        surface = "{mesh}.stl"
        surface_tolerance = 0.01
        [[method]]
        title = "others"
        method = "local-sd"
        parameters = { boundary = ["fixed", "slide"] }
        """,
        folder,
    )
    assert [case.slides for case in made.cases] == [False, True, False, True]
    assert made.cases[1].smoother.surface_tolerance == 0.01
    assert made.surface_of(folder / "parts/wheel.vtk") == folder / "wheel.stl"


def test_rules_of_motion_apply_to_methods_and_are_added_to_those_of_recipes(folder):
    recipe = Recipe.of("getme", title="Sliding", rules=MotionRules(interfaces="slide", fix=["inlet"]))
    write_recipe(folder / "sliding.toml", recipe)
    text = 'methods = ["mend", "sliding.toml"]\n[motion]\n'
    method, chain = plan(f'{text}fix = ["walls"]', folder).cases
    assert method.rules == MotionRules(fix=["walls"])
    assert chain.smoother.rules == MotionRules(interfaces="slide", fix=["inlet", "walls"])
    kept = plan(f'{text}interfaces = "keep"', folder).cases[1]
    assert kept.smoother.rules.interfaces == "keep"
    for case in (method, chain):
        again = read_case(case.values())
        assert (again.smoother, again.stop, again.rules) == (case.smoother, case.stop, case.rules)


@pytest.mark.parametrize(("text", "said"), [
    ("", "the study has no method"),
    ('methods = ["mend"]\n[motion]\nkeep = "all"', "there is no rule 'keep': expected one of interfaces"),
    ('methods = ["mend"]\n[motion]\ninterfaces = "glide"', "interfaces = 'glide': expected one of keep"),
    ('methods = ["mend"]\nmotion = 4', "motion = 4 is not a table"),
    ("methods = []", "the study has no method"),
    ('methods = "mend"', "methods = 'mend' is not a list of names"),
    ('method = "mend"', "method is not a list of tables"),
    ('metods = ["mend"]', "the study has no key 'metods': did you mean methods?"),
    ('methods = ["mand"]', "methods, mand: there is no method 'mand': did you mean mend?"),
    ('[[method]]\nmethod = "mend"\n[[method]]\nname = "mend"', "[[method]] 2: the method's table has no key 'name'"),
    ("[[method]]\n", "[[method]] 1: it has no method"),
    ('[[method]]\nmethod = "mend"\nrecipe = "chain.toml"', "[[method]] 1: it has method and recipe"),
    ("[[method]]\nmethod = 7", "[[method]] 1: method = 7 is not a text"),
    ('[[method]]\nmethod = "mend"\nparameters = { q = 2 }', "[[method]] 1: mend has no parameter 'q'"),
    ('[[method]]\nmethod = "mend"\nparameters = { p = [2, 99] }', "[[method]] 1: p = 99 is out of range"),
    ('[[method]]\nmethod = "mend"\nparameters = { p = [] }', "[[method]] 1: p = [] leaves nothing to run"),
    ('[[method]]\nmethod = "mend"\nparameters = { p = [[2]] }', "[[method]] 1: p = [2] is not a number"),
    ('[[method]]\nmethod = "mend"\nparameters = 3', "[[method]] 1: parameters = 3 is not a table"),
    ('[[method]]\nrecipe = "chain.toml"\nparameters = { p = 3 }', "[[method]] 1: a recipe has values of its own"),
    ('methods = ["chain.toml"]\n[stop]\nmax_iterations = -1', "max_iterations = -1 is out of range"),
    ('methods = ["mend"]\n[stop]\niterations = 3', "methods, mend: stop has no parameter 'iterations'"),
    ('methods = ["mend"]\n[task]\nmax_seconds = -1', "max_seconds = -1 is out of range"),
    ('methods = ["mend"]\n[task]\nmemory = 3', "task has no parameter 'memory'"),
    ('methods = ["mend", "mend"]', "two of the methods would be called 'mend'"),
    ('methods = ["mend"]\n[[method]]\nmethod = "mend"\nparameters = { p = 4 }', "two of the methods would be called"),
    ('methods = ["mend"]\ntitle = 4', "title = 4 is not a text"),
    ('methods = ["mend"]\n[boundary]\nsurface = 4', "surface = 4 is not a text"),
    ('methods = ["mend"]\n[boundary]\nslide = true', "[boundary] has no key 'slide'"),
    ('methods = ["mend"]\n[boundary]\nboundary = "fixed"\nsurface = "a.stl"', "the boundary is fixed: set boundary = 'slide'"),
    ('methods = ["smart-laplacian", "getme-sequential"]\n[boundary]\nboundary = "up"', "boundary = 'up' is unknown"),
    (f'[[method]]\nmethod = "mend"\nparameters = {{ p = {[2] * 101} }}\nstop = {{ tolerance = {[0] * 101} }}',
     "more than 10,000 cases"),
])  # fmt: skip
def test_errors_name_their_place_in_the_recipe(text, said, folder):
    with pytest.raises(ParameterError) as caught:
        plan(text, folder)
    assert said in str(caught.value)


@pytest.mark.parametrize(("text", "said"), [
    ("format = 1\nmethods = [", "recipe.toml: is not TOML"),
    ('methods = ["mend"]', "recipe.toml: the recipe has no format"),
    ('format = 9\nmethods = ["mend"]', "recipe.toml: format = 9 is not read: expected 1; use the Hexmend that wrote it"),
    ('format = 1\nmethods = ["none.toml"]', "none.toml: there is no such file"),
    ('format = 1\nmethods = ["recipe.toml"]', "recipe.toml: the recipe has no key 'methods'"),
])  # fmt: skip
def test_a_file_that_is_no_recipe_is_named(text, said, tmp_path):
    (tmp_path / "recipe.toml").write_text(text)
    with pytest.raises(FileError) as caught:
        read_plan(tmp_path / "recipe.toml")
    assert said in str(caught.value)
