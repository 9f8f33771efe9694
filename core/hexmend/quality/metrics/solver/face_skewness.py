"""Skewness of the worst face, as OpenFOAM's checkMesh measures it; +inf where a centre line does not meet the face."""

import math

from hexmend.quality.finite_volume.hex_values import of_hexes, of_mesh
from hexmend.quality.metric import Metric

FACE_SKEWNESS = Metric(
    name="face-skewness",
    title="Face skewness",
    formula=(
        "greatest over the six faces of the distance between the face's centre and the point where d meets its plane, "
        "over the face's extent that way"
    ),
    source="OpenFOAM, primitiveMeshTools::faceSkewness and boundaryFaceSkewness; threshold of checkMesh",
    full_range=(0.0, math.inf),
    acceptable=(0.0, 4.0),
    better=-1,
    meaning="High values mean that values interpolated between two centres do not belong to the face's centre.",
    of=of_hexes("skewness"),
    of_mesh=of_mesh("skewness"),
).register()
