"""Explicit time step at a wave speed of 1: the least height of the hex; 0 for an inverted hex."""

import math

import numpy as np

from hexmend.quality.corner_heights import least_heights
from hexmend.quality.metric import Metric

TIME_STEP = Metric(
    name="time-step",
    title="Time step",
    formula="least over the eight corners and their three faces of σ / |v × w|, the height over the face of v and w",
    source="Courant, Friedrichs and Lewy 1928; of a parallelepiped LS-DYNA's volume / largest face",
    full_range=(0.0, math.inf),
    acceptable=(0.0, math.inf),
    better=1,
    meaning="The least of all hexes, over the wave speed, is the time step of the whole explicit run.",
    of=lambda points, hexes, quality: np.maximum(least_heights(points, hexes), 0.0),
    unit="mesh unit",
).register()
