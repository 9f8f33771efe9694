"""Colour maps of matplotlib, stored in a file so that matplotlib need not be imported."""

from functools import partial

import numpy as np

from hexmend_app.picture.colour_map import CHANGE_MAP, COLOUR_MAPS, ColourMap
from hexmend_app.resources import resource


def _stored(name: str) -> np.ndarray:
    with np.load(resource("colour_maps.npz")) as tables:
        return tables[name]


for _name, _title, _help in (
    ("viridis", "", "From violet over green to yellow."),
    ("cividis", "", "From blue to yellow; looks nearly the same with all kinds of colour vision."),
    ("plasma", "", "From blue over red to yellow."),
    ("inferno", "", "From black over red to pale yellow."),
    (CHANGE_MAP, "brown – teal", "For changes: from brown for worse over white for none to teal for better."),
):
    COLOUR_MAPS.add(_name, ColourMap(_name, _help, partial(_stored, _name), _title, diverging=_name == CHANGE_MAP))
