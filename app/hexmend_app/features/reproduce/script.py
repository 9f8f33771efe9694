"""Python script that makes the open mesh again: the calls of the journal that lead to it."""

from __future__ import annotations

from graphlib import TopologicalSorter
from pathlib import Path

from hexmend import __version__
from hexmend.boundary.marking import with_curve, without_curves
from hexmend.doctor import repair
from hexmend.io.surfaces.read import sliding_on_boundary, sliding_on_file
from hexmend.mesh.fixing import fix, fix_outside, unfix
from hexmend.mesh.tags import with_tag, with_tag_renamed, without_tag
from hexmend.padding import pad
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe
from hexmend_app.features.reproduce.source_code import (
    comment_text,
    import_of,
    keywords_source,
    literal_source,
    multiline_source,
    value_source,
)
from hexmend_app.formats.session import SUFFIX
from hexmend_app.picture import Scene, to_toml
from hexmend_app.state.mesh.document import Command, State
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


def script_of(session: Session, scene: Scene | None = None) -> str:
    """Return the script of the open mesh, which `python FILE` runs, with the scene of the view at its end."""
    document, body, imports = session.document, [], {"import hexmend as hx"}
    names: dict[State, str] = {}
    if document.is_open:
        shown = document.now if document.previews and not session.run.busy else document.recorded
        titles = {change.state: change.title for change in document.to_data().changes}
        commands = _commands(session, shown)
        for number, (state, command) in enumerate(commands.items()):
            moment = session.history.iteration_of(state)
            title = comment_text(titles.get(state) or (moment.name if moment is not None else "mesh"))
            name = names[state] = f"mesh_{number}"
            body.append(f"# {title[:1].upper()}{title[1:]}\n{name} = {_source(command, names, imports)}")
        body += _saved(session, names, commands)
        if scene is not None:
            body.append(_view_source(names[shown], scene))
    head = f'"""A mesh made in Hexmend {__version__}. To make it again, run: python THIS-FILE."""'
    return "\n\n".join([head, "\n".join(sorted(imports)), *body]) + "\n"


def _commands(session: Session, state: State) -> dict[State, Command]:
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


def _read(session: Session, state: State) -> Command:
    """Return the call that reads a mesh which no call makes; without a file that has it, one of its name is read."""
    document = session.document
    path = next((original.path for original in document.originals if original.mesh is state.mesh), None)
    unsaved = () if path is not None else ("Save the mesh, or restore the file that had it, under this name first.",)
    path = path or document.path or Path(f"{state.mesh.name or 'mesh'}.vtu")
    return Command("read", values=(str(path.absolute()), *unsaved))


def _source(command: Command, names: dict[State, str], imports: set[str]) -> str:
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


def _saved(session: Session, names: dict[State, str], commands: dict[State, Command]) -> list[str]:
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
