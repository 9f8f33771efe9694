"""Non-orthogonality of the worst face, as OpenFOAM's checkMesh measures it; 0 without neighbours."""

from hexmend.quality.finite_volume.hex_values import of_hexes, of_mesh
from hexmend.quality.metric import Metric

NON_ORTHOGONALITY = Metric(
    name="non-orthogonality",
    title="Non-orthogonal",
    formula="greatest over the internal faces of the angle between d, from centre to centre of the two hexes, and S",
    source="OpenFOAM, primitiveMeshTools::faceOrthogonality; acceptable below checkMesh's threshold",
    full_range=(0.0, 180.0),
    acceptable=(0.0, 70.0),
    better=-1,
    meaning=(
        "High values need corrections of the gradient across the face, which limit the time step; at 90 degrees and "
        "above finite-volume solvers fail."
    ),
    of=of_hexes("non_orthogonality"),
    of_mesh=of_mesh("non_orthogonality"),
    unit="degrees",
).register()
