#include "view/polygons.hpp"

#include <algorithm>
#include <utility>

#include "view/plane.hpp"

namespace hexmend {
namespace {

// Clip a polygon at one plane: now to then.
void cut_off(const std::vector<Point> &now, const Point &normal, double offset, std::vector<Point> &then) {
    then.clear();
    const Point *last = &now.back();
    double below = height(*last, normal) - offset;
    for (const Point &corner : now) {
        double above = height(corner, normal) - offset;
        if ((above > 0) != (below > 0)) {
            double share = below / (below - above);
            Point &crossing = then.emplace_back();
            for (int k = 0; k < 3; ++k) crossing[k] = (*last)[k] + share * (corner[k] - (*last)[k]);
        }
        if (above <= 0) then.push_back(corner);
        last = &corner, below = above;
    }
}

}  // namespace

// Sutherland and Hodgman's clipping (Communications of the ACM 17, 1974).
std::tuple<OwnedArray<double, 3>, OwnedArray<std::int64_t>, OwnedArray<std::int64_t>> before(
    Points points, PointNumbers start, PointNumbers places, PointNumbers owner, Points normals, Numbers offsets) {
    OwnedArray<double, 3> kept;
    OwnedArray<std::int64_t> begin{{0}}, whose;
    kept.values.reserve(3 * places.size());
    begin.values.reserve(owner.size() + 1), whose.values.reserve(owner.size());
    std::vector<Point> now, then;
    for (std::size_t i = 0; i < owner.size(); ++i) {
        now.clear();
        for (std::int64_t at = start[i]; at < start[i + 1]; ++at) now.push_back(points[places[at]]);
        for (std::size_t p = 0; p < normals.size() && now.size() >= 3; ++p) {
            cut_off(now, normals[p], offsets[p], then);
            std::swap(now, then);
        }
        if (now.size() < 3) continue;
        for (const Point &corner : now) kept.values.insert(kept.values.end(), corner.begin(), corner.end());
        begin.values.push_back(begin.values.back() + static_cast<std::int64_t>(now.size()));
        whose.values.push_back(owner[i]);
    }
    return {std::move(kept), std::move(begin), std::move(whose)};
}

}  // namespace hexmend
