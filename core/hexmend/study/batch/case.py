"""A case of a study: what is done to each of its meshes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from hexmend.errors import ParameterError
from hexmend.parameters import Parametrised, parameter
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage, read_stage
from hexmend.smoothers import Smoother


@dataclass(frozen=True)
class TaskLimits(Parametrised):
    """What the process of a task may take; past it the task has failed, and its row says so."""

    max_seconds: float = parameter(
        0.0,
        low=0,
        high=1e7,
        unit="s",
        help="Most seconds of a task, with reading and writing; then its process is ended. 0 sets no limit.",
    )
    max_memory_mb: int = parameter(
        0,
        low=0,
        high=1e9,
        unit="MB",
        help="Most memory of a task, which the system refuses to exceed; 0 is an equal share, for each "
        "task at work, of what is free as the study begins.",
    )


@dataclass(frozen=True)
class Case:
    """A method with its values and limits, or a recipe.

    Parameters
    ----------
    name : str
        Its own in the study: what tables call it.
    what : Smoother or Recipe
    stop : StoppingCriteria or None
        Limits of a method's run; None for a recipe, whose stages have theirs.
    """

    name: str
    what: Smoother | Recipe
    stop: StoppingCriteria | None = None

    @property
    def stages(self) -> tuple[Stage, ...]:
        """What is run, one after another."""
        return (
            self.what.stages if isinstance(self.what, Recipe) else (Stage(self.what, self.stop or StoppingCriteria()),)
        )

    @property
    def method(self) -> str:
        """The method's name, or a recipe's title."""
        return self.what.title if isinstance(self.what, Recipe) else self.what.name

    @property
    def parameters(self) -> str:
        """Every value of the method, as `name=value` words; a recipe has none."""
        values = {} if isinstance(self.what, Recipe) else self.what.values()
        return " ".join(f"{name}={value}" for name, value in values.items())

    @property
    def slides(self) -> bool:
        """Whether any of it lets nodes of the boundary slide."""
        return any(stage.smoother.slides for stage in self.stages)

    def values(self) -> dict[str, Any]:
        """The case as data, without its name: its title if it is a recipe, and every value of its stages."""
        title = self.what.title if isinstance(self.what, Recipe) else None
        return {"recipe": title, "stages": [stage.values() for stage in self.stages]}


def case_of(data: Mapping[str, Any]) -> Case:
    """The case of which `data` are the `values`; it is called after its method or recipe.

    Raises
    ------
    ParameterError
        Where this version of Hexmend, or this machine's, does not know them.
    """
    stages = tuple(read_stage(number, one) for number, one in enumerate(data["stages"], 1))
    if data["recipe"] is not None:
        return Case(data["recipe"], Recipe(data["recipe"], stages))
    if len(stages) != 1:
        raise ParameterError(f"a method has {len(stages)} stages: expected one")
    return Case(stages[0].smoother.name, stages[0].smoother, stages[0].stop)
