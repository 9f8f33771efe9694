"""Recipes: methods that run one after another, each with its parameters and limits.

A recipe is written as TOML::

    format = 1
    title = "GETMe, then mend"

    [[stage]]
    method = "getme"
    parameters = { relaxation = 0.75 }
    stop = { max_iterations = 100 }

    [[stage]]
    method = "mend"

A table ``[motion]`` has rules of motion such as ``interfaces = "slide"``; see `hexmend.mesh.rules.MotionRules`. Values
that are not named have their defaults. Hexmend writes all values of methods and limits, so that a file means the same
when defaults change.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from hexmend.errors import ParameterError
from hexmend.iteration import StoppingCriteria
from hexmend.mesh.rules import MotionRules
from hexmend.parameters import from_values, hint
from hexmend.smoothers import METHODS, Smoother
from hexmend.toml_text import parse_toml

#: Version of the format.
FORMAT = 1

_HEAD = "# A recipe: hexmend smooth MESH -o OUT --recipe THIS-FILE\n"


@dataclass(frozen=True)
class Stage:
    """A method and its limits."""

    smoother: Smoother
    stop: StoppingCriteria = field(default_factory=StoppingCriteria)

    def values(self) -> dict[str, Any]:
        """Return the stage as data with the keys `method`, `parameters` and `stop`, and all values."""
        return {"method": self.smoother.name, "parameters": self.smoother.values(), "stop": self.stop.values()}


@dataclass(frozen=True)
class Recipe:
    """Stages of a run; each begins with the result of the one before it.

    Parameters
    ----------
    title : str
    stages : tuple of Stage
        At least one.
    rules : MotionRules
        What happens to interfaces and to the nodes of named sets, in all stages.

    Raises
    ------
    ParameterError
        Without a stage.

    Examples
    --------
    >>> recipe = Recipe.of("getme", "mend")
    >>> recipe.title
    'GETMe, simultaneous; then Mend'
    >>> from_toml(to_toml(recipe)) == recipe
    True
    """

    #: Name in place of a method's in reports.
    name: ClassVar[str] = "recipe"

    title: str
    stages: tuple[Stage, ...]
    rules: MotionRules = field(default_factory=MotionRules)

    def __post_init__(self) -> None:
        object.__setattr__(self, "stages", tuple(self.stages))
        if not self.stages:
            raise ParameterError("a recipe has no stage: expected at least one")

    @classmethod
    def of(cls, *parts: Stage | Smoother | str, title: str = "", rules: MotionRules | None = None) -> Recipe:
        """Make a recipe of stages; a method, or the name of one, becomes a stage with the default limits.

        Parameters
        ----------
        *parts : Stage, Smoother or str
        title : str
            By default the titles of the methods.
        rules : MotionRules, optional
        """
        methods = (METHODS[part]() if isinstance(part, str) else part for part in parts)
        stages = tuple(part if isinstance(part, Stage) else Stage(part) for part in methods)
        title = title or "; then ".join(stage.smoother.title for stage in stages)
        return cls(title, stages, rules or MotionRules())

    def with_more_rules(self, rules: MotionRules, interfaces: str | None = None) -> Recipe:
        """Return a copy with more rules of motion; `interfaces` is the choice for interfaces unless it is None."""
        rules = self.rules.merge(rules)
        return replace(self, rules=replace(rules, interfaces=interfaces or rules.interfaces))

    def limited(self, **limits: Any) -> Recipe:
        """Return a copy with these fields of `StoppingCriteria` replaced in every stage."""
        return replace(self, stages=tuple(replace(stage, stop=replace(stage.stop, **limits)) for stage in self.stages))

    def values(self) -> dict[str, Any]:
        """Return the recipe as data with the keys `title`, `stages`, and `motion` if it has rules of motion."""
        motion = {"motion": self.rules.values()} if self.rules else {}
        return {"title": self.title, **motion, "stages": [stage.values() for stage in self.stages]}


def to_toml(recipe: Recipe) -> str:
    """Return the recipe as TOML text with all values."""
    import tomli_w

    values = recipe.values()
    stages = values.pop("stages")
    return _HEAD + tomli_w.dumps({"format": FORMAT, **values, "stage": stages})


def from_toml(text: str) -> Recipe:
    """Parse a recipe from TOML text.

    Raises
    ------
    ParameterError
        If the text is not a recipe; the message names line and column, or the stage, the key and what was expected.
    """
    data = parse_toml(text, "a recipe")
    check_format(data)
    check_keys("the recipe", data, ("format", "title", "motion", "stage"))
    title, stages = data.get("title", ""), data.get("stage", [])
    if not isinstance(title, str):
        raise ParameterError(f"title = {title!r} is not a text: expected a title in quotes")
    if not isinstance(stages, list) or not all(isinstance(stage, dict) for stage in stages) or not stages:
        raise ParameterError('the recipe has no stage: expected [[stage]] and a line such as  method = "mend"')
    rules = MotionRules.from_values(read_table(data, "motion"))
    return Recipe.of(*(read_stage(number, stage) for number, stage in enumerate(stages, 1)), title=title, rules=rules)


def check_format(data: Mapping[str, Any]) -> None:
    """Raise `ParameterError` unless a recipe has the version of the format that is read."""
    number = data.get("format")
    if number is None:
        raise ParameterError(f"the recipe has no format: expected  format = {FORMAT}  as its first line")
    if type(number) is not int or number != FORMAT:
        raise ParameterError(f"format = {number!r} is not read: expected {FORMAT}; use the Hexmend that wrote it")


def read_stage(number: int, data: Mapping[str, Any]) -> Stage:
    """Make a stage from data as of `Stage.values`.

    Parameters
    ----------
    number : int
        Its number in the recipe, for messages.
    data : mapping

    Raises
    ------
    ParameterError
    """
    try:
        check_keys("the stage", data, ("method", "parameters", "stop"))
        if "method" not in data:
            raise ParameterError('it has no method: expected a line such as  method = "mend"')
        cls = METHODS[str(data["method"])]
        smoother = from_values(cls, read_table(data, "parameters"), owner=cls.name)
        return Stage(smoother, from_values(StoppingCriteria, read_table(data, "stop"), owner="stop"))
    except ParameterError as error:
        raise ParameterError(f"stage {number}: {error}") from None


def read_table(data: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """Return the table of this key, empty if it is missing; `ParameterError` if it is not a table."""
    table = data.get(key, {})
    if not isinstance(table, dict):
        raise ParameterError(f"{key} = {table!r} is not a table: expected  {key} = {{ name = value, ... }}")
    return table


def check_keys(owner: str, data: Mapping[str, Any], known: Iterable[str]) -> None:
    """Raise `ParameterError` for the first unknown key of `data`, with the most similar known one."""
    for key in data:
        if key not in known:
            raise ParameterError(f"{owner} has no key {key!r}: {hint(key, known)}")
