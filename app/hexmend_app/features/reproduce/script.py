"""Python script that makes the open mesh again: the calls of the journal that lead to it."""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Callable, Sequence
from graphlib import TopologicalSorter
from pathlib import Path
from typing import Any

import numpy as np

import hexmend
from hexmend import __version__
from hexmend.boundary.marking import with_curve, without_curves
from hexmend.doctor import repair
from hexmend.io.surfaces.read import sliding_on_boundary, sliding_on_file
from hexmend.mesh.fixing import fix, fix_outside, unfix
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.tags import with_tag, with_tag_renamed, without_tag
from hexmend.padding import pad
from hexmend.parameters import Parametrised, declared
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.terminal_text import printable
from hexmend_app.formats.session import SUFFIX
from hexmend_app.picture import Scene, to_toml
from hexmend_app.state.mesh.document import Command, MeasuredMesh
from hexmend_app.state.session.session import Session

#: First words of the comment on the view.
VIEW = "# Current view"
#: Functions of the journal that change a mesh, by name.
_FUNCTIONS = {
    function.__name__: function
    for function in (
        fix, fix_outside, unfix, with_tag, without_tag, with_tag_renamed, with_curve, without_curves,
        sliding_on_boundary, sliding_on_file, repair, pad,
    )
}  # fmt: skip
#: Source of the mesh in the result of functions that return more than a mesh; it slides on its own boundary.
_MESH_OF = {"repair": "[0].keeping_surface()", "pad": ".mesh.keeping_surface()"}
#: Maximum line length in characters.
WIDTH = 110


def script_of(session: Session, scene: Scene | None = None) -> str:
    """Return the script of the open mesh, which `python FILE` runs, with the scene of the view at its end."""
    document, body, imports = session.document, [], {"import hexmend as hx"}
    names: dict[MeasuredMesh, str] = {}
    if document.is_open:
        shown = document.now if document.previews and not session.run.busy else document.recorded
        titles = {change.state: change.title for change in document.to_data().changes}
        commands = _commands(session, shown)
        for number, (state, command) in enumerate(commands.items()):
            iteration = session.history.iteration_of(state)
            title = comment_text(titles.get(state) or (iteration.name if iteration is not None else "mesh"))
            name = names[state] = f"mesh_{number}"
            body.append(f"# {title[:1].upper()}{title[1:]}\n{name} = {_source(command, names, imports)}")
        body += _saved(session, names, commands)
        if scene is not None:
            body.append(_view_source(names[shown], scene))
    head = f'"""A mesh made in Hexmend {__version__}. To make it again, run: python THIS-FILE."""'
    return "\n\n".join([head, "\n".join(sorted(imports)), *body]) + "\n"


def _commands(session: Session, state: MeasuredMesh) -> dict[MeasuredMesh, Command]:
    """Return the calls that lead to a state, in an order in which they can run."""
    document, commands, needed = session.document, {}, [state]
    while needed:
        state = needed.pop()
        if state not in commands:
            command = document.journal.get(state) or session.history.command_of(state, document.recorded)
            if command is None or command.name not in (*_FUNCTIONS, "read", "smooth", "move"):
                command = _read(session, state)
            commands[state] = command
            needed += command.meshes
    order = TopologicalSorter({state: command.meshes for state, command in commands.items()}).static_order()
    return {state: commands[state] for state in order}


def _read(session: Session, state: MeasuredMesh) -> Command:
    """Return the call that reads a mesh which no call makes; without a file that has it, one of its name is read."""
    document = session.document
    path = next((original.path for original in document.originals if original.mesh is state.mesh), None)
    unsaved = () if path is not None else ("Save the mesh, or restore the file that had it, under this name first.",)
    path = path or document.path or Path(f"{state.mesh.name or 'mesh'}.vtu")
    return Command("read", values=(str(path.absolute()), *unsaved))


def _source(command: Command, names: dict[MeasuredMesh, str], imports: set[str]) -> str:
    """Return the source of a call; add to the imports those that it needs."""
    meshes = [names[state] for state in command.meshes]
    if command.name == "read":
        path, *comments = command.values
        return "".join([f"hx.read({path!r}).keeping_surface()", *(f"  # {comment}" for comment in comments)])
    if command.name == "move":
        return f"{meshes[0]}.with_points({meshes[1]}.points)"
    if command.name == "smooth":
        result = f"{_smooth_source(meshes[0], command.recipe)}.mesh"
        return (
            result
            if meshes[0] == meshes[-1] and not command.recipe.rules
            else f"{meshes[-1]}.with_points({result}.points)"
        )
    name, statement = import_of(_FUNCTIONS[command.name])
    arguments = [*meshes, *map(literal_source, command.values)]
    imports.update({statement} | {"import numpy as np" for one in arguments if "np.r_[" in one})
    return f"{name}({', '.join(arguments)}){_MESH_OF.get(command.name, '')}"


def _smooth_source(mesh: str, recipe: Recipe) -> str:
    """Return the source that runs a recipe; of one stage, its method and limits.

    >>> from hexmend import METHODS, MotionRules, Stage
    >>> stage = Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=5))
    >>> _smooth_source("mesh_0", Recipe.of(stage, rules=MotionRules(fix=("inlet",))))
    "hx.smooth(mesh_0, hx.Laplacian(), hx.StoppingCriteria(max_iterations=5), fix=['inlet'])"
    """
    if len(recipe.stages) > 1:
        return f"hx.smooth({mesh}, {value_source(recipe)})"
    (stage,) = recipe.stages
    arguments = [mesh, value_source(stage.smoother)]
    if stage.stop != StoppingCriteria():
        arguments.append(value_source(stage.stop))
    if recipe.rules:
        arguments.append(keywords_source(recipe.rules))
    return f"hx.smooth({', '.join(arguments)})"


def _saved(session: Session, names: dict[MeasuredMesh, str], commands: dict[MeasuredMesh, Command]) -> list[str]:
    """Return the source that writes the files that were saved."""
    meshes = {state.mesh: name for state, name in names.items()}
    read = {command.values[0] for command in commands.values() if command.name == "read"}
    files = [(str(original.path.absolute()), original) for original in reversed(session.document.originals)]
    lines = [
        f"hx.write({path!r}, {meshes[original.mesh]})"
        for path, original in files
        if original.mesh in meshes and path not in read and original.path.suffix != SUFFIX
    ]
    return ["\n".join(["# Save", *lines])] if lines else []


def _view_source(name: str, scene: Scene) -> str:
    """Return the scene of the view as source, with a comment on how to draw it."""
    parts = [part for panel in scene.panels for part in (panel, panel.wipe) if part is not None]
    meshes = " ".join(["MESH"] * max((part.mesh for part in parts), default=1))
    return (
        f"{VIEW}, of {name}. To draw it, save this text as view.toml and run\n"
        f"# hexmend render --scene view.toml {meshes} -o PICTURE.png\n"
        f"scene = {multiline_source(to_toml(scene, whole=False))}"
    )


def value_source(value: Parametrised | Recipe | Stage) -> str:
    """Return the source of a method, limits, a stage or a recipe; defaults are omitted.

    >>> value_source(hexmend.StoppingCriteria(max_iterations=5)), value_source(hexmend.StoppingCriteria())
    ('hx.StoppingCriteria(max_iterations=5)', 'hx.StoppingCriteria()')
    """
    if isinstance(value, Recipe):
        arguments = [*map(value_source, value.stages), f"title={value.title!r}"]
        arguments += [f"rules=hx.MotionRules({keywords_source(value.rules)})"] if value.rules else []
        return f"hx.Recipe.of({', '.join(arguments)})"
    if isinstance(value, Stage):
        return f"hx.Stage({value_source(value.smoother)}, {value_source(value.stop)})"
    values = ((parameter, getattr(value, parameter.name)) for parameter in declared(value))
    keywords = (f"{one.name}={_to_python(it)!r}" for one, it in values if it != one.default)
    return f"hx.{type(value).__name__}({', '.join(keywords)})"


def keywords_source(rules: MotionRules) -> str:
    """Return the source of rules of motion as named arguments.

    >>> keywords_source(MotionRules(interfaces="slide", fix=("inlet",)))
    "interfaces='slide', fix=['inlet']"
    """
    return ", ".join(f"{name}={value!r}" for name, value in rules.values().items())


def literal_source(value: Any) -> str:
    """Return the source of a string, number, tuple or None, or of an array of integers."""
    return integers_source(value) if getattr(value, "ndim", 0) else repr(_to_python(value))


def integers_source(values: Sequence[int] | np.ndarray) -> str:
    """Return the source of integers as a sorted list, with ranges if that is shorter.

    >>> integers_source([5, 3]), integers_source([*range(100), 200])
    ('[3, 5]', 'np.r_[0:100, 200]')
    """
    unique = np.unique(np.asarray(values, dtype=np.int64))
    ranges = np.split(unique, np.flatnonzero(np.diff(unique) != 1) + 1) if unique.size else []
    if unique.size <= 2 * len(ranges) + 8:
        text = f"[{', '.join(map(str, unique.tolist()))}]"
    else:
        text = ", ".join(str(run[0]) if run.size == 1 else f"{run[0]}:{run[-1] + 1}" for run in ranges)
        text = f"np.r_[{text}]"
    return "\n    ".join(textwrap.wrap(text, WIDTH)) or "[]"


def import_of(function: Callable[..., Any]) -> tuple[str, str]:
    """Return the name of a function in a script, and the import that it needs, from the shortest path.

    >>> from hexmend.boundary.marking import with_curve
    >>> import_of(hexmend.fix), import_of(with_curve)
    (('hx.fix', 'import hexmend as hx'), ('with_curve', 'from hexmend.boundary.marking import with_curve'))
    """
    name, parts = function.__name__, function.__module__.split(".")
    if getattr(hexmend, name, None) is function:
        return f"hx.{name}", "import hexmend as hx"
    modules = (".".join(parts[:count]) for count in range(2, len(parts) + 1))
    module = next(one for one in modules if getattr(sys.modules[one], name, None) is function)
    return name, f"from {module} import {name}"


def comment_text(text: str) -> str:
    r"""Return `text` made printable and joined into one line, for a comment.

    >>> comment_text("a\nname\x0c\x00")
    'a name ?'
    """
    return printable(" ".join(text.split()))


def multiline_source(text: str) -> str:
    """Return the source of a string of several lines, triple-quoted if possible.

    >>> print(multiline_source("a = 1"))
    \"\"\"\\
    a = 1\"\"\"
    """
    quotable = '"""' not in text and "\\" not in text and not text.endswith('"')
    return f'"""\\\n{text}"""' if quotable else repr(text)


def _to_python(value: object) -> object:
    return value.item() if isinstance(value, np.generic) else value
