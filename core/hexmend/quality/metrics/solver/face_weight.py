"""Interpolation weight of the worst face, as OpenFOAM's checkMesh measures it; 1/2 without neighbours."""

from hexmend.quality.finite_volume.hex_values import of_hexes, of_mesh
from hexmend.quality.metric import Metric

FACE_WEIGHT = Metric(
    name="face-weight",
    title="Face weight",
    formula="least over the internal faces of min(a, b) / (a + b), a and b the distances of the two centres along S",
    source="OpenFOAM, polyMeshTools::faceWeights; acceptable above the threshold of checkMesh -allGeometry",
    full_range=(0.0, 0.5),
    acceptable=(0.05, 0.5),
    better=1,
    meaning="Low values mean a thin hex next to a thick one: interpolation to the face uses nearly one hex alone.",
    of=of_hexes("weight"),
    of_mesh=of_mesh("weight"),
).register()
