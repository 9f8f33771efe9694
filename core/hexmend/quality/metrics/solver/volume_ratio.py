"""Ratio of volumes at the worst face, as OpenFOAM's checkMesh measures it; 1 without neighbours."""

from hexmend.quality.finite_volume.hex_values import of_hexes, of_mesh
from hexmend.quality.metric import Metric

VOLUME_RATIO = Metric(
    name="volume-ratio",
    title="Volume ratio",
    formula="least over the internal faces of the smaller volume of the two hexes over the larger",
    source="OpenFOAM, polyMeshTools::volRatio; acceptable above the threshold of checkMesh -allGeometry",
    full_range=(0.0, 1.0),
    acceptable=(0.01, 1.0),
    better=1,
    meaning="Low values mean a jump of size: waves are reflected there, and the order of accuracy falls.",
    of=of_hexes("volume_ratio"),
    of_mesh=of_mesh("volume_ratio"),
).register()
