"""Drawing of meshes with VTK."""

# Import Qt before PyVista: PySide6 inspects modules that are imported after it. Inspecting a complete PyVista makes it
# load its plotting modules and matplotlib, which would add 0.4 s to the start of every process that draws.
import hexmend_app.state.tasks.task  # noqa: F401
