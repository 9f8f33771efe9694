"""Switches of the layers that `structure.StructureLayers` draws: edges and nodes of the mesh's structure."""

from hexmend.mesh.structure import SHARP_DEGREES as DEGREES
from hexmend_app.picture.layer_switch import LAYERS, LayerSwitch

for _switch in (
    LayerSwitch(
        "irregular",
        "Irregular, inside",
        "Edges inside the mesh that three, five or more hexes share, also called singular: with 120° or 72° between "
        "faces at best, no method brings all hexes around them to quality 1. Drawn through the mesh, thick where "
        "nothing hides them; points are nodes where they end or fork.",
        "None: inside the mesh, four hexes share every edge.",
        action="I&rregular edges inside",
        action_help="Show the singular edges: those inside the mesh that not four hexes share.",
        keys="S",
        order=10,
    ),
    LayerSwitch(
        "boundary",
        "Irregular, boundary",
        "Edges of the boundary that not two hexes share although it is smooth there. One hex alone has an angle of up"
        " to 180° there, three share it: neither reaches quality 1.",
        "None: two hexes share every edge at which the boundary is smooth.",
        action="Irregular edges on the &boundary",
        action_help="Show edges of a smooth boundary that not two hexes share.",
        keys="B",
        order=20,
    ),
    LayerSwitch(
        "sharp",
        "Sharp edges",
        f"Edges at which the boundary turns by more than {DEGREES:g}°, or that more than two of its faces share.",
        "None: the boundary is smooth all round.",
        action="S&harp edges",
        action_help="Show where the boundary has an edge.",
        keys="H",
        order=30,
    ),
    LayerSwitch(
        "fixed",
        "Fixed nodes",
        "Nodes that no method moves, of the hexes in sight: those of the boundary, and others that are pinned.",
        "None: the mesh has no boundary.",
        action="Fixe&d nodes",
        action_help="Show nodes that no method moves.",
        keys="X",
        order=40,
    ),
    LayerSwitch(
        "free",
        "Free nodes",
        "Nodes that methods may move, of the hexes in sight. They are inside: cut or peel the mesh to see them.",
        "None: all nodes are on the boundary or pinned.",
        action="Free &nodes",
        action_help="Show nodes that methods may move.",
        keys="M",
        order=50,
    ),
    LayerSwitch(
        "locked",
        "Locked nodes",
        "Nodes of inverted hexes that fixed nodes alone keep inverted: no method that leaves these where they are can"
        " mend them. How many of them can be freed where the boundary slides is counted too: nothing holds these in "
        "inversion then.",
        "None: no hex is kept inverted by fixed nodes alone.",
        action="&Locked nodes",
        action_help="Show the nodes of hexes that fixed nodes alone keep inverted.",
        keys="L",
        order=60,
    ),
    LayerSwitch(
        "kinds",
        "Kinds of nodes",
        "What nodes of the boundary may do where it slides (boundary = slide), by the method's feature angle: pinned "
        "nodes and corners stay, others slide along their curve or on their patch. Where that is not enough, Mend may"
        " take nodes off the surface within its tolerance, corners found by the angle alone too. A whisker is a sharp"
        " edge that ends amid a patch: its nodes slide on that. Shift+P pins the chosen node.",
        "None: the mesh has no boundary.",
        action="&Kinds of boundary nodes",
        action_help="Show what nodes of the boundary may do where it slides.",
        keys="J",
        order=70,
        offered_early=True,
    ),
):
    LAYERS.add(_switch.name, _switch)
