"""Settings of a run as short text: values that differ from the defaults, and rules of motion."""

from __future__ import annotations

from collections.abc import Iterator

from hexmend.mesh.rules import MotionRules
from hexmend.parameters import Parametrised, declared
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe
from hexmend.smoothers import Smoother


def settings_text(work: Smoother | Recipe, stop: StoppingCriteria | None = None) -> str:
    """Return the values of a run that differ from the defaults; "" if none does.

    Parameters
    ----------
    work : Smoother or Recipe
    stop : StoppingCriteria, optional
        None for a recipe, whose stages have their own.

    Examples
    --------
    >>> from hexmend.smoothers import METHODS
    >>> settings_text(METHODS["mend"](p=1, boundary="slide"), StoppingCriteria(max_iterations=20))
    'boundary=slide, p=1, max_iterations=20'
    >>> settings_text(Recipe.of("getme", METHODS["local-sd"](p=4)))
    'getme; local-sd p=4'
    """
    if not isinstance(work, Recipe):
        return ", ".join([*_changed(work), *_changed(stop or StoppingCriteria())])
    return "; ".join(f"{one.smoother.name} {settings_text(one.smoother, one.stop)}".strip() for one in work.stages)


def rules_text(rules: MotionRules) -> str:
    """Return rules of motion as text; "" without rules.

    >>> rules_text(MotionRules("slide", fix=("inlet", "outlet"), periodic=(("left", "right"),)))
    'interfaces=slide, fix=inlet outlet, periodic=left:right'
    """
    texts = []
    for key, value in rules.values().items():
        names = [value] if isinstance(value, str) else [one if isinstance(one, str) else ":".join(one) for one in value]
        texts.append(f"{key}={' '.join(names)}")
    return ", ".join(texts)


def _changed(values: Parametrised) -> Iterator[str]:
    for one in declared(values):
        value = getattr(values, one.name)
        if value != one.default:
            yield f"{one.name}={value:g}" if isinstance(value, float) else f"{one.name}={value}"
