"""Case of a study: a method with values and limits, which is run on each mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from hexmend.errors import ParameterError
from hexmend.mesh.rules import MotionRules
from hexmend.parameters import Parametrised, parameter
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage, read_stage
from hexmend.smoothers import Smoother


@dataclass(frozen=True)
class TaskLimits(Parametrised):
    """Limits of the process of a task; a task that exceeds them fails."""

    max_seconds: float = parameter(
        0.0,
        low=0,
        high=1e7,
        unit="s",
        help="Time limit of a task, with reading and writing; then its process is ended. 0 sets no limit.",
    )
    max_memory_mb: int = parameter(
        0,
        low=0,
        high=1e9,
        unit="MB",
        help="Memory limit of a task, which the system enforces; 0 means an equal share, for each "
        "running task, of the free memory at the start of the study.",
    )


@dataclass(frozen=True)
class Case:
    """Method with its values and limits, or a recipe.

    Parameters
    ----------
    name : str
        Unique in the study; tables use it.
    smoother : Smoother or Recipe
    stop : StoppingCriteria or None
        Limits of the run of a method; None for a recipe, whose stages have their own.
    rules : MotionRules
        Rules of motion of the run of a method; those of a recipe are its own.
    """

    name: str
    smoother: Smoother | Recipe
    stop: StoppingCriteria | None = None
    rules: MotionRules = field(default_factory=MotionRules)

    @property
    def stages(self) -> tuple[Stage, ...]:
        """Stages of the run, in order."""
        if isinstance(self.smoother, Recipe):
            return self.smoother.stages
        return (Stage(self.smoother, self.stop or StoppingCriteria()),)

    @property
    def method(self) -> str:
        """Name of the method, or title of the recipe."""
        return self.smoother.title if isinstance(self.smoother, Recipe) else self.smoother.name

    @property
    def parameters(self) -> str:
        """Values of the method, as `name=value` words; "" for a recipe."""
        values = {} if isinstance(self.smoother, Recipe) else self.smoother.values()
        return " ".join(f"{name}={value}" for name, value in values.items())

    @property
    def slides(self) -> bool:
        """True if a stage lets nodes of the boundary slide."""
        return any(stage.smoother.slides for stage in self.stages)

    def values(self) -> dict[str, Any]:
        """Return the case as data, without its name: the title of a recipe, and all values of the stages."""
        recipe = self.smoother if isinstance(self.smoother, Recipe) else None
        title = None if recipe is None else recipe.title
        rules = self.rules if recipe is None else recipe.rules
        motion = {"motion": rules.values()} if rules else {}
        return {"recipe": title, **motion, "stages": [stage.values() for stage in self.stages]}


def read_case(data: Mapping[str, Any]) -> Case:
    """Make a case from its `values`; it is named after the method or recipe.

    Parameters
    ----------
    data : mapping
        `Case.values`.

    Returns
    -------
    Case

    Raises
    ------
    ParameterError
        For data that this version of Hexmend does not know.
    """
    stages = tuple(read_stage(number, stage) for number, stage in enumerate(data["stages"], 1))
    rules = MotionRules.from_values(data.get("motion", {}))
    if data["recipe"] is not None:
        return Case(data["recipe"], Recipe(data["recipe"], stages, rules))
    if len(stages) != 1:
        raise ParameterError(f"a method has {len(stages)} stages: expected one")
    return Case(stages[0].smoother.name, stages[0].smoother, stages[0].stop, rules)
