"""Drawing with VTK: only this package turns a mesh into VTK's objects."""

# Qt comes before PyVista: it looks into every module that is imported after it, and one look at PyVista once that is
# complete has that load its plots, and matplotlib's with them: 0.4 s of every process that draws.
import hexmend_app.state.tasks.task  # noqa: F401
