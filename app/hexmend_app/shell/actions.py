"""What the user can do, as data: from it come menus, tool bar, shortcuts and tooltips."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ActionSpec:
    """One action.

    Parameters
    ----------
    id : str
        What the window's handlers and tests know it by.
    text : str
        In the menu.
    menu : str
        The menu it stands in; behind a slash, a menu in that one.
    shortcut : str
        Portable key sequence, "" for none.
    icon : str
        A Material Design icon's name, "" for none.
    help : str
        One sentence, shown as tooltip.
    tool : str
        Its word in the tool bar; "" keeps it out.
    checkable : bool
    needs_mesh : bool
        Enabled only while a mesh is open.
    separated : bool
        A line stands above it.
    exclusive : bool
        Of the actions of its menu, one is on.
    """

    id: str
    text: str
    menu: str
    shortcut: str = ""
    icon: str = ""
    help: str = ""
    tool: str = ""
    checkable: bool = False
    needs_mesh: bool = True
    separated: bool = False
    exclusive: bool = False


ACTIONS: tuple[ActionSpec, ...] = (
    ActionSpec(
        "open", "&Open…", "&File", "Ctrl+O", "folder-open-outline", "Open a mesh file.", "Open", needs_mesh=False
    ),
    ActionSpec(
        "open_demo", "Open the &demo mesh", "&File", help="Open the mesh that comes with Hexmend.", needs_mesh=False
    ),
    ActionSpec(
        "save", "&Save mesh as…", "&File", "Ctrl+S", "content-save-outline", "Save the mesh as it is now.", "Save"
    ),
    ActionSpec(
        "screenshot",
        "Save &picture…",
        "&File",
        "Ctrl+P",
        "camera-outline",
        "Save the view as PNG, at any size.",
        "Picture",
    ),
    ActionSpec("quit", "&Quit", "&File", "Ctrl+Q", help="Close the window.", needs_mesh=False, separated=True),
    ActionSpec("undo", "&Undo", "&Edit", "Ctrl+Z", "undo", "Take back the last change of the mesh.", "Undo"),
    ActionSpec("redo", "&Redo", "&Edit", "Ctrl+Shift+Z", "redo", "Do again what was taken back.", "Redo"),
    ActionSpec("run", "&Run or pause", "&Smooth", "F5", "play", "Run the chosen method, pause it, or go on."),
    ActionSpec("step", "One &step", "&Smooth", "F10", "step-forward", "Make one iteration and hold."),
    ActionSpec(
        "next_node",
        "Next &node of a sweep",
        "&Smooth",
        "F11",
        help="Let a local method move one node, and look at its step.",
    ),
    ActionSpec("ten_nodes", "Ten nodes of a s&weep", "&Smooth", "Shift+F11", help="Let a local method move ten nodes."),
    ActionSpec(
        "finish_sweep",
        "&Finish the sweep",
        "&Smooth",
        "Ctrl+F11",
        help="Let a local method move all nodes that are left.",
    ),
    ActionSpec("stop", "S&top", "&Smooth", "Shift+F5", "stop", "End the run and keep what has been reached."),
    ActionSpec("reset", "R&eset", "&Smooth", "Ctrl+R", "restore", "Put all nodes back to where they were when opened."),
    ActionSpec(
        "recipe_run",
        "R&un the recipe",
        "&Smooth",
        "Ctrl+Shift+F5",
        help="Run the stages of the recipe one after another, as one run.",
        separated=True,
    ),
    ActionSpec("recipe_load", "&Load a recipe…", "&Smooth", help="Load methods to be run one after another."),
    ActionSpec("recipe_save", "Sa&ve the recipe…", "&Smooth", help="Save the stages as TOML."),
    ActionSpec(
        "iteration_first",
        "Be&fore the run",
        "&Timeline",
        "Alt+Home",
        "skip-backward",
        "Show the mesh as it was before the run.",
    ),
    ActionSpec("iteration_back", "Iteration &back", "&Timeline", ",", "step-backward", "Show the iteration before."),
    ActionSpec("iteration_play", "&Play or hold", "&Timeline", "K", "play", "Show the iterations one after another."),
    ActionSpec("iteration_on", "Iteration &on", "&Timeline", ".", "step-forward", "Show the next iteration."),
    ActionSpec(
        "iteration_newest",
        "&Newest iteration",
        "&Timeline",
        "Alt+End",
        "skip-forward",
        "Show the newest iteration, and those that come.",
    ),
    ActionSpec(
        "iteration_branch",
        "&Run from here",
        "&Timeline",
        "Ctrl+F5",
        "source-branch",
        "Run the chosen method from the iteration shown, beside the run that it belongs to.",
        separated=True,
    ),
    ActionSpec(
        "iteration_beside",
        "Keep &in a view",
        "&Timeline",
        "V",
        "view-split-vertical",
        "Show the mesh as it is now in a view of its own, to which what comes can be compared.",
    ),
    ActionSpec(
        "film",
        "Save a fil&m…",
        "&Timeline",
        icon="movie-open-outline",
        help="Save the run as an animation: its iterations one after another, as the view shows them.",
    ),
    ActionSpec("fit", "&Fit", "&View", "F", "fit-to-page-outline", "Show the whole mesh.", "Fit"),
    ActionSpec("view_iso", "&Isometric", "&View", "0", "axis-arrow", "Look from a corner.", "Iso"),
    ActionSpec("view_x", "Along &X", "&View", "1", "axis-x-arrow", "Look along the X axis.", "X"),
    ActionSpec("view_y", "Along &Y", "&View", "2", "axis-y-arrow", "Look along the Y axis.", "Y"),
    ActionSpec("view_z", "Along &Z", "&View", "3", "axis-z-arrow", "Look along the Z axis.", "Z"),
    ActionSpec(
        "parallel",
        "&Parallel projection",
        "&View",
        "P",
        "",
        "Without perspective, for figures.",
        checkable=True,
        separated=True,
    ),
    ActionSpec("edges", "&Edges", "&View", "E", "grid", "Draw the edges of the elements.", "Edges", checkable=True),
    ActionSpec(
        "clip",
        "&Clip",
        "&View",
        "C",
        "box-cutter",
        "Cut the mesh open along planes or a box.",
        "Clip",
        checkable=True,
    ),
    *(
        ActionSpec(
            f"theme_{choice}",
            text,
            "&View/&Theme",
            help=help,
            checkable=True,
            needs_mesh=False,
            exclusive=True,
        )
        for choice, text, help in (
            ("light", "&Light", "Dark on light, as pictures for reports are in any theme."),
            ("dark", "&Dark", "Light on dark, easier on the eyes in a dim room."),
            ("desktop", "&As the desktop", "Light or dark as the desktop is, and changing with it."),
        )
    ),
    ActionSpec(
        "show_irregular",
        "I&rregular edges inside",
        "&View",
        "S",
        help="Show the singular edges: those inside the mesh that not four elements share.",
        checkable=True,
        separated=True,
    ),
    ActionSpec(
        "show_boundary",
        "Irregular edges on the &boundary",
        "&View",
        "B",
        help="Show edges of a smooth boundary that not two elements share.",
        checkable=True,
    ),
    ActionSpec("show_sharp", "S&harp edges", "&View", "H", help="Show where the boundary has an edge.", checkable=True),
    ActionSpec("show_fixed", "Fixe&d nodes", "&View", "X", help="Show nodes that no method moves.", checkable=True),
    ActionSpec("show_free", "Free &nodes", "&View", "M", help="Show nodes that methods may move.", checkable=True),
    ActionSpec(
        "show_locked",
        "&Locked nodes",
        "&View",
        "L",
        help="Show the nodes of elements that fixed nodes alone keep inverted.",
        checkable=True,
    ),
    ActionSpec(
        "next_worst",
        "&Next worst element",
        "&Inspect",
        "N",
        "chevron-down",
        "Go to the next element of the list of the worst, from the worst on.",
        "Worst",
    ),
    ActionSpec(
        "previous_worst", "&Previous worst element", "&Inspect", "Shift+N", "chevron-up", "Go back in the list."
    ),
    ActionSpec(
        "isolate",
        "&Isolate the element",
        "&Inspect",
        "I",
        help="Show nothing but the chosen element and its neighbours.",
        separated=True,
    ),
    ActionSpec(
        "dig",
        "&Dig the element away",
        "&Inspect",
        "Delete",
        help="Hide the chosen element and look behind it; Ctrl and a click in the view does the same.",
    ),
    ActionSpec(
        "undig", "&Undo digging", "&Inspect", "Backspace", help="Show the element again that was dug away last."
    ),
    ActionSpec(
        "tag",
        "&Tag the element",
        "&Inspect",
        "T",
        "tag-outline",
        "Give the chosen element the tag that the tags' panel names, or take it away; tags are saved with the mesh.",
    ),
    ActionSpec(
        "explain_node",
        "&Explain a node's step",
        "&Inspect",
        "D",
        help="Show what the chosen method does to the chosen node, or to one of the worst element, and why.",
    ),
    ActionSpec(
        "back",
        "Step &back",
        "&Inspect",
        "Esc",
        help="Show again what is hidden beside an isolated element; then look at none.",
    ),
    ActionSpec(
        "compare",
        "&Run the comparison",
        "&Compare",
        "F6",
        "play",
        "Run the methods that are ticked in the panel one after another; the mesh stays as it is.",
    ),
    ActionSpec(
        "cancel_comparison",
        "&Cancel the comparison",
        "&Compare",
        "Shift+F6",
        "stop",
        "End the comparison after the iteration at hand, and keep what has been reached.",
    ),
    ActionSpec(
        "wipe",
        "&Wipe",
        "&Compare",
        "W",
        "compare",
        "Lay two views over one another, with an edge between them that is dragged.",
        checkable=True,
        separated=True,
    ),
    ActionSpec("wipe_left", "Wipe to the &left", "&Compare", "[", help="See more of the view at the right."),
    ActionSpec("wipe_right", "Wipe to the ri&ght", "&Compare", "]", help="See more of the view at the left."),
    ActionSpec(
        "close_views",
        "Close &other views",
        "&Compare",
        "Ctrl+W",
        help="Show the mesh as it is now alone.",
    ),
    ActionSpec(
        "commands",
        "&Commands…",
        "&Help",
        "Ctrl+Shift+P",
        "magnify",
        "Find any command by its name.",
        needs_mesh=False,
    ),
    ActionSpec(
        "keys",
        "&Mouse and keys",
        "&Help",
        "F1",
        "mouse",
        "Say beside the view how it is turned, zoomed and panned.",
        needs_mesh=False,
    ),
    ActionSpec("about", "&About Hexmend", "&Help", help="Version, licence and sources.", needs_mesh=False),
)
