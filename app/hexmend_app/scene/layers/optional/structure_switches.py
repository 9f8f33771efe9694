"""Switches of the layers drawn by `structure.StructureLayers`: edges and nodes of the mesh structure."""

from hexmend_app.picture.layer_switch import LAYERS, LayerSwitch
from hexmend_app.state.mesh.structure import SHARP_DEGREES as DEGREES

for _switch in (
    LayerSwitch(
        "irregular",
        "Irregular, inside",
        "Edges inside the mesh that are shared by three, five or more hexes instead of four, also called singular. The "
        "faces around them form angles of 120° or 72° at best, so not all of their hexes can reach quality 1. Hidden "
        "parts are drawn thin, visible parts thick; points mark nodes where these edges end or branch.",
        "None: all edges inside the mesh are shared by four hexes.",
        action="I&rregular edges inside",
        action_help="Show edges inside the mesh that are not shared by exactly four hexes.",
        keys="S",
        order=10,
    ),
    LayerSwitch(
        "boundary",
        "Irregular, boundary",
        "Edges where the boundary is smooth that do not belong to exactly two hexes. A single hex must span an angle of"
        " up to 180° there, and three hexes must share it, so they cannot reach quality 1.",
        "None: all edges where the boundary is smooth belong to two hexes.",
        action="Irregular edges on the &boundary",
        action_help="Show edges where the boundary is smooth that do not belong to exactly two hexes.",
        keys="B",
        order=20,
    ),
    LayerSwitch(
        "sharp",
        "Sharp edges",
        f"Edges where the boundary turns by more than {DEGREES:g}°, or where more than two boundary faces meet.",
        "None: the boundary is smooth everywhere.",
        action="S&harp edges",
        action_help="Show edges where the boundary has a sharp angle.",
        keys="H",
        order=30,
    ),
    LayerSwitch(
        "fixed",
        "Fixed nodes",
        "Visible nodes that no method moves: boundary nodes and pinned nodes.",
        "None: the mesh has no boundary.",
        action="Fixe&d nodes",
        action_help="Show nodes that no method moves.",
        keys="X",
        order=40,
    ),
    LayerSwitch(
        "free",
        "Free nodes",
        "Nodes that methods may move. They lie inside the mesh: cut or peel it to see them.",
        "None: all nodes are on the boundary or pinned.",
        action="Free &nodes",
        action_help="Show nodes that methods may move.",
        keys="M",
        order=50,
    ),
    LayerSwitch(
        "locked",
        "Locked nodes",
        "Nodes of hexes that are inverted because of their fixed nodes alone. No method can repair these hexes without"
        " moving fixed nodes. The legend also counts the hexes that a sliding boundary unlocks.",
        "None: no hex is inverted because of fixed nodes alone.",
        action="&Locked nodes",
        action_help="Show nodes of hexes that are inverted because of fixed nodes alone.",
        keys="L",
        order=60,
    ),
    LayerSwitch(
        "kinds",
        "Kinds of nodes",
        "Boundary nodes by how they may move on a sliding boundary (boundary = slide), classified by the feature angle "
        "of the method. Pinned nodes and corners are fixed; other nodes slide along their curve or on their patch. If "
        "necessary, Mend moves nodes off the surface within its tolerance, including corners found by the angle alone. "
        "A whisker is a sharp edge that ends inside a patch; its nodes slide on the patch. Nodes that a run moved "
        "off their corner, curve or patch have a colour of their own; all others are kept exactly on it. Shift+P pins "
        "the selected node.",
        "None: the mesh has no boundary.",
        action="&Kinds of boundary nodes",
        action_help="Show boundary nodes by how they may move on a sliding boundary, and those that have left it.",
        keys="J",
        order=70,
    ),
    LayerSwitch(
        "curved",
        "Curved faces",
        "Faces and edges of hexes with 20 or 27 nodes, curved along their mid-nodes; off: flat between the corners.",
        "None: the hexes of this mesh have eight nodes.",
        action="&Curved faces",
        action_help="Draw faces and edges of hexes with 20 or 27 nodes curved along their mid-nodes, else flat.",
        order=98,
        hidden_when_empty=True,
    ),
):
    LAYERS.add(_switch.name, _switch)
