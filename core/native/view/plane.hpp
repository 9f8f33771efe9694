// Where a point lies along the normal of a plane.
#pragma once

#include "mesh/hexahedron.hpp"

namespace hexmend {

// x . normal, as plain arithmetic rounds it: a node that lies on a plane does so on every processor.
inline double height(const Point &x, const Point &normal) {
    return rounded(x[0] * normal[0]) + rounded(x[1] * normal[1]) + rounded(x[2] * normal[2]);
}

}  // namespace hexmend
