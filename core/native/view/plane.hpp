// Position of points along the normal of a plane.
#pragma once

#include "mesh/hexahedron.hpp"

namespace hexmend {

// x . normal without fused multiply-add: whether a node lies on a plane does not depend on the processor.
inline double height(const Point &x, const Point &normal) {
    return uncontracted(x[0] * normal[0]) + uncontracted(x[1] * normal[1]) + uncontracted(x[2] * normal[2]);
}

}  // namespace hexmend
